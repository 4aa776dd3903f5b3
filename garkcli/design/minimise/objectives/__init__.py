"""What may be minimised: a file each."""
