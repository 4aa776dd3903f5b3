"""Steps of a method on a problem, as straight-line code."""
