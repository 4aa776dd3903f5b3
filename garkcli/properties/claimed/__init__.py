"""The properties that files may claim: their definitions, and how they are decided."""
