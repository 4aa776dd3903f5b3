"""Languages: from the syntax tree of each to the statements that all are lowered to."""
