"""The page: the sections of methods in one document."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator, Sequence
from functools import cache
from hashlib import sha256
from importlib import import_module
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from garkcli.api.anymethod import AnyMethod
from garkcli.api.numbers import Whole, whole
from garkcli.doing import doing
from garkcli.errors import MethodError, counted, printable
from garkcli.frozen import replace
from garkcli.plots.svg import STYLE
from garkcli.webpage.heading import COLUMNS, comparison_row, heading
from garkcli.webpage.reported import MOST_CONDITIONS, Content, Reported, reported
from garkcli.webpage.sections.pictures import of_several
from garkcli.webpage.tree_picture import dots

MOST_ROWS = 2000
"""The largest number of conditions of all methods on a page: about 3 MB."""

SECTIONS = {
    "faults": "What is wrong with the file",
    "tableau": "Tableau",
    "orders": "Orders",
    "claims": "Claims",
    "simplifying": "Simplifying assumptions",
    "properties": "Properties",
    "stability": "Stability",
    "reference": "Reference",
    "pictures": "Pictures",
    "conditions": "Order conditions",  # the longest, and across on paper: pages of its own
}
"""The sections and their headings, in order. Each is a file in ``sections``; its ``content`` is
passed to the template of the same name.
"""


def report_page(*methods: AnyMethod, order: Whole | None = None, pictures: bool = True) -> str:
    """All results about methods as one self-contained HTML page: ``gark report``.

    Args:
        methods: names, paths, or methods; several are compared in a table. The faults of a file
            that cannot be read are part of the page.
        order: the largest order of the conditions that are listed; by default the first that fails.
        pictures: whether stability, errors and energy are drawn.

    Raises:
        MethodError: no method is given, or something else.

    >>> report_page("heun", pictures=False).splitlines()[0]
    '<!doctype html>'
    """
    if not methods:
        raise MethodError("a page of no method", "give at least one", code="arrays")
    listed = None if order is None else whole(order, "order", 1)
    return render([reported(x, listed, has_pictures=pictures) for x in methods])


def render(methods: Sequence[Reported]) -> str:
    """Returns the page of one or several methods, the latter with a comparison."""
    has_several = len(methods) > 1
    room = min(MOST_CONDITIONS, MOST_ROWS // max(len(methods), 1))
    methods = [replace(x, most_conditions=room) for x in methods]
    shown = [
        {"place": f"m{number}", "heading": heading(x), "sections": list(_sections(x))}
        for number, x in enumerate(methods, 1)
    ]
    compared = [comparison_row(x) for x in methods] if has_several else []
    # trees of the pair have twice the colours, those with time, g or a matrix no more than one more
    sizes = [2 * x.tableau.size + 1 for x in methods if x.tableau is not None]
    script = _static("page.js")
    page = _environment().get_template("page.html")
    return page.render(
        title=counted(len(methods), "method") if has_several else methods[0].outcome.name,
        methods=shown,
        has_several=has_several,
        compared=compared,
        pictures=of_several(methods),
        columns=list(COLUMNS),
        dots=dots(sizes),
        style=Markup(_static("page.css") + STYLE),
        script=Markup(script),
        policy=_policy(script),
    )


def _sections(method: Reported) -> Iterator[tuple[Content, Content]]:
    """Yields the nonempty sections with the content for their templates."""
    for name, title in SECTIONS.items():
        with doing(f"{method.outcome.name}: {title}"):
            content = import_module(f"garkcli.webpage.sections.{name}").content(method)
        if content is not None:
            yield {"name": name, "title": title}, content


def _policy(script: str) -> str:
    """Returns the content security policy: the page may run its script and load nothing."""
    digest = b64encode(sha256(script.encode()).digest()).decode()
    return (
        "default-src 'none'; style-src 'unsafe-inline'; img-src data:; "
        f"script-src 'sha256-{digest}'"
    )


@cache
def _environment() -> Environment:
    """Returns templates that escape all texts."""
    return Environment(
        loader=PackageLoader("garkcli.webpage"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        finalize=_visible,
    )


def _visible(value: object) -> object:
    """Returns a text with all its characters visible; markup is unchanged."""
    return printable(value) if isinstance(value, str) and not isinstance(value, Markup) else value


@cache
def _static(name: str) -> str:
    return (files("garkcli.webpage") / "static" / name).read_text(encoding="utf-8")
