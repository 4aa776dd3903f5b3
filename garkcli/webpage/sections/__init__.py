"""The sections of a page, one file each, with templates of the same names."""
