"""What the words of reports and files mean: ``gark explain`` and docs/glossary.md."""
