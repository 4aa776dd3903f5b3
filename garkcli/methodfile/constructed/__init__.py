"""Methods that files make from others: a file each construction."""
