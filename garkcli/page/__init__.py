"""Components of reports: characters, columns, plots in text, records for programs, files."""
