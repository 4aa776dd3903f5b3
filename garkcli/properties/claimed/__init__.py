"""One file a property: its definition, and how it is decided."""
