"""Conversion of methods to other forms: entry by entry, additive, partitioned, canonical."""
