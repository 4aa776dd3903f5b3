"""What may be wanted of a method besides its order: a file each."""
