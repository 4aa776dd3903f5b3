"""Published methods as method files, below ``data``: a folder a kind, a file a method.

The name of a method is that of its file without ``.gark.yaml``, in lower case, its words joined by
hyphens. ``paper`` has those of the paper, ``found`` what ``gark design`` found, ``errata`` tables
that are published wrong, with the order that they have. ``index.json`` is made from them by
``python -m garkcli.catalogue``; names are looked up in it, and lists are made of it.

The room is a mapping from these names to methods, see ``garkcli.catalogue.mapping``:

>>> import garkcli
>>> garkcli.catalogue["rk4"].stages, "no-such-method" in garkcli.catalogue
((4,), False)
"""

from __future__ import annotations

import sys

from garkcli.catalogue.mapping import Catalogue

sys.modules[__name__].__class__ = Catalogue
