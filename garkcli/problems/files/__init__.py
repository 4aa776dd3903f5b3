"""Problem files: from text to problems."""
