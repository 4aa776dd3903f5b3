"""Published methods as method files, below ``data``: a folder a kind, a file a method.

The name of a method is that of its file without ``.gark.yaml``, in lower case, its words joined by
hyphens. ``paper`` has those of the paper, ``found`` what ``gark design`` found, ``errata`` tables
that are published wrong, with the order that they have.
"""
