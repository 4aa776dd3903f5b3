"""The sections of a page, one file each, with a template of the same name."""
