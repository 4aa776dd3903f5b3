"""The properties that files may claim: definitions and decisions."""
