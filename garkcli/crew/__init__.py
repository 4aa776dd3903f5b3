"""Who does a list of things: this process, several side by side, or a cluster."""
