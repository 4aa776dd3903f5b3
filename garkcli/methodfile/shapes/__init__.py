"""Tableaus that are said by their stages and their shape: a file a shape."""
