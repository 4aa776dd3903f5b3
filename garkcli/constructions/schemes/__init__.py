"""Compositions known by name: a file each family of them."""
