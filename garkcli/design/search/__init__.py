"""Methods with unknowns by search: least squares from many starts, exact numbers, a proof."""
