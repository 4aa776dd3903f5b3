"""The same method in other forms: entry by entry, additive, partitioned, padded, canonical."""
