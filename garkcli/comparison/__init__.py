"""Two methods held against each other: where they differ, and in what sense they are the same."""
