"""The room of N-trees. Only the tree table and its users need numpy."""
