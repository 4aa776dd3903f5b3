"""From a path to an outcome: analysis, claims, findings."""
