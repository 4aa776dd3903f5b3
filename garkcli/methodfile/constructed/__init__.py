"""Methods constructed from others: a file for each construction."""
