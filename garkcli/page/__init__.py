"""What reports are made of: signs, columns, plots in text, records for programs, files."""
