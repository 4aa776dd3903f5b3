"""The page of ``gark report``: one HTML document that needs nothing else."""
