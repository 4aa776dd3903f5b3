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
from typing import TYPE_CHECKING

from garkcli.catalogue.mapping import Catalogue

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile


def open_method(name: str) -> MethodFile:
    """A method by its name or one of its aliases.

    Args:
        name: of the package, of a folder of ``GARK_PATH``, or of another package's catalogue;
            capitals do not count, and blanks and underscores are hyphens.

    Raises:
        MethodFileError: there is no such method, or the name may mean several.

    >>> open_method("Stoermer Verlet").name
    'Störmer-Verlet'
    """
    from garkcli.methodfile.load import load
    from garkcli.methodfile.naming import PREFIX

    return load(name if name.startswith(PREFIX) else PREFIX + name)


def method_names() -> list[str]:
    """The names of all methods, those of your own folders first.

    >>> "rk4" in method_names()
    True
    """
    from garkcli.methodfile.naming import every_shelf, visible

    return [method.name for _, method in visible(every_shelf())]


sys.modules[__name__].__class__ = Catalogue
