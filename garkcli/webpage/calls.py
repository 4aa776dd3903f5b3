"""The page as a call."""

from __future__ import annotations

from garkcli.api.anymethod import AnyMethod
from garkcli.api.numbers import Whole, whole
from garkcli.errors import MethodError
from garkcli.webpage.page import render
from garkcli.webpage.reported import reported


def report_page(*methods: AnyMethod, order: Whole | None = None, pictures: bool = True) -> str:
    """All that is found of methods as one HTML page, which needs nothing else: ``gark report``.

    Args:
        methods: names, paths, or methods; several are compared in a table. The faults of a file
            that cannot be read are part of the page.
        order: up to which order conditions are listed; None for the first order that fails.
        pictures: whether stability, errors and energy are drawn.

    Raises:
        MethodError: there is no method, or something that is none.

    >>> report_page("heun", pictures=False).splitlines()[0]
    '<!doctype html>'
    """
    if not methods:
        raise MethodError("a page of no method", "give at least one", code="arrays")
    listed = None if order is None else whole(order, "order", 1)
    return render([reported(x, listed, has_pictures=pictures) for x in methods])
