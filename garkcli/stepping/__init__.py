"""One step of a method on a problem: its stages in order, written out as straight-line code."""
