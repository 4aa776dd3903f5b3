"""Methods among arrays of numbers, by the identities that they meet; knows no program language."""
