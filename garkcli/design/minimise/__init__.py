"""Which methods of a family are best, by an objective."""
