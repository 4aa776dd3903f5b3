"""Methods constructed from others, with one file for each construction."""
