"""The page of ``gark report``: one self-contained HTML document."""
