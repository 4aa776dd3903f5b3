"""Properties of a tableau: explicit or implicit, symmetric, stiffly accurate, reducible."""
