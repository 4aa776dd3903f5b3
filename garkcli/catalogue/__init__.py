"""Published methods as method files, in the folder ``data``: a folder for each kind, a file a
method.

The name of a method is that of its file without ``.gark.yaml``. ``paper`` holds the methods of the
paper, ``found`` those found by ``gark design``, ``errata`` tables published with errors, with their
actual order. ``index.json`` is made by ``python -m garkcli.catalogue``; look-ups and lists use it.

The module is a mapping from names to methods, see ``garkcli.catalogue.mapping``:

>>> import garkcli
>>> garkcli.catalogue["rk4"].stages, "no-such-method" in garkcli.catalogue
((4,), False)
"""

from __future__ import annotations

import sys

from garkcli.catalogue.mapping import Catalogue

sys.modules[__name__].__class__ = Catalogue
