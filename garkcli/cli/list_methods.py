"""``gark list methods``: the options that say which methods, and the list."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import click

from garkcli.catalogue.entries import ORDERS, Range, Wanted, read_range, sorted_by
from garkcli.cli.options import Output
from garkcli.errors import UsageProblem
from garkcli.properties.property import Property
from garkcli.properties.registry import every_property

_COUNTS = {
    "order": "The order, such as 4, '>=4' or 2..4; so the others.",
    "embedded-order": "The order of embedded weights.",
    "conjugate-order": "The order of the symplectic conjugate.",
    "pair-order": "The order of the symplectic pair.",
    "nonautonomous-order": "The order for y' = f(t, y), with the printed nodes.",
    "stages": "The stages, of several colours the most.",
    "colours": "The vector fields.",
}
_TRUTHS = {
    "symplectic": "Symplectic methods.",
    "embedded": "Methods with embedded weights.",
    "dense": "Methods with dense output.",
    "exact": "Methods whose coefficients are not rounded.",
}
_KINDS = ("rk", "ark", "prk", "gark", "family")


class RangeType(click.ParamType):  # type: ignore[type-arg]
    """A whole number or several that follow each other."""

    name = "range"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> object:
        """The numbers that are meant."""
        try:
            return read_range(value) if isinstance(value, str) else value
        except UsageProblem as error:
            self.fail(str(error), param, ctx)


def _of_kind(kind: str) -> list[Property]:
    return [x for x in every_property() if x.kind == kind]


def filter_options() -> list[click.Option]:
    """All options that say which methods are listed, and how they are sorted; they arrive by their
    keys in entries of the catalogue, None where they were not given.
    """
    counts = {**_COUNTS}
    counts |= {x.key: f"The property {x.key}." for x in _of_kind("count")}
    truths = {**_TRUTHS}
    truths |= {x.key: f"The property {x.key}." for x in _of_kind("truth")}
    words = {
        "kind": (_KINDS, "Runge-Kutta, additive, partitioned, or general."),
        "sort": (ORDERS, "By what the list is sorted; by default the order."),
    }
    structures = "Which vector fields the problem has: general, separable, nystrom ..."
    judging = "Judge methods of one's own as gark check does; else they are as they claim."
    return [
        *(click.Option([f"--{key}"], type=RangeType(), help=x) for key, x in counts.items()),
        *(click.Option([f"--{key}/--no-{key}"], default=None, help=x) for key, x in truths.items()),
        *(click.Option([f"--{x}"], type=click.Choice(y), help=z) for x, (y, z) in words.items()),
        click.Option(["--structure"], metavar="WORD", help=structures),
        click.Option(["--folder"], metavar="NAME", help="Of the catalogue, such as erk."),
        click.Option(["--judge"], is_flag=True, default=None, help=judging),
    ]


def refuse_filters(given: Mapping[str, object], format: str) -> None:
    """Filters and formats of the list of methods, where something else is listed.

    Raises:
        UsageProblem: there is one.
    """
    for key, value in given.items():
        if value not in (None, ()):
            name = "words" if key == "words" else f"--{key.replace('_', '-')}"
            message = f"{name}: chosen are methods alone"
            raise UsageProblem(message, "write gark list methods", code="options-clash")
    if format == "csv":
        message = f"--format {format} is for methods"
        raise UsageProblem(message, "write gark list methods", code="options-clash")


def list_methods(given: Mapping[str, Any], output: Output) -> int:
    """Write the methods that are as wanted."""
    from garkcli.catalogue.entries import all_entries
    from garkcli.report.list_methods import REPORT

    wanted = _wanted(given)
    found = [x for x in all_entries(bool(given["judge"])) if wanted.takes(x)]
    listed = sorted_by(found, given["sort"] or "order")
    output.tell(REPORT, [listed])
    return 0


def _wanted(given: Mapping[str, Any]) -> Wanted:
    """What the options say."""
    ranges: dict[str, Range] = {}
    truths: dict[str, bool] = {}
    for key, value in given.items():
        if isinstance(value, Range):
            ranges[key] = value
        elif isinstance(value, bool) and key != "judge":
            truths[key] = value
    values = {key: given[key] for key in ("kind", "structure") if given[key]}
    folder = given["folder"] or ""
    return Wanted(ranges, truths, values, folder, given["words"])
