"""Method files in editors, by the Language Server Protocol."""
