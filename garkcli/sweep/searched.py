"""One method of a sweep that is searched for: the first find of a seed."""

from __future__ import annotations

from garkcli.design.search.run import Method, results
from garkcli.methodfile.family import with_values
from garkcli.methodfile.load import loads
from garkcli.methodfile.search_file import FileSearch
from garkcli.sweep.plan import Point
from garkcli.tableau.tableau import Tableau


def first_find(point: Point) -> Method | None:
    """What ``gark design --search`` finds first from the seed of a point; None where it finds
    nothing.
    """
    template = point.template
    assert point.seed is not None
    for result in results(_asked(point).search, template.starts, point.seed, most=1):
        if result.methods:
            return result.methods[0]
    return None


def method_found(point: Point, found: Method) -> Tableau:
    """The method of an exact find, read again from the text of its file."""
    claim = f"order: {found.order}"
    text = with_values(_asked(point).family, found.values, "", claim)
    return loads(text, point.key).tableau


def _asked(point: Point) -> FileSearch:
    template = point.template
    settings = tuple(point.settings.items())
    return FileSearch(template.text, template.name, settings, template.order)
