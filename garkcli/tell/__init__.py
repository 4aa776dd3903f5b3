"""Results described once and told in every format: rows, kinds of values, dialects, outputs."""
