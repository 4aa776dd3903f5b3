"""What a method does to linear and contractive problems, decided exactly."""
