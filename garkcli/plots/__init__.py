"""Pictures of results: figures with matplotlib, plots in text."""
