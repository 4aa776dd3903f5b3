"""The best methods of a family, by an objective."""
