"""One file a form that methods can be brought into."""
