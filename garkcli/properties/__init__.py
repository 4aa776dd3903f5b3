"""What a tableau is like: explicit or implicit, symmetric, stiffly accurate, reducible."""
