"""Languages: each lowers its syntax trees to common statements."""
