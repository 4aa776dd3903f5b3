"""Methods with unknowns: for which values a method is what is wanted, exactly."""
