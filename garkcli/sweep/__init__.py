"""Many methods side by side: which there are, what is true of each, which are best."""
