"""Tables in other people's formats, read and never executed."""
