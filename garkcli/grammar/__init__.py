"""A grammar of YAML files: keys declared once, values with positions, all faults at once."""
