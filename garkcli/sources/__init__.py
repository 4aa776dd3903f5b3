"""Tables of coefficients in program sources: parsed, evaluated exactly, found; never executed."""
