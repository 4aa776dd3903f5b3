"""``gark show``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.options import Output, declared
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.catalogue.facts import Entry
    from garkcli.methodfile.build import MethodFile


@declared("show", FORMATS)
def command(file: str, settings: dict[str, str], output: Output) -> int:
    """All about one method: its tableau, orders, properties, where it was published.

    What is known of a method of the package stands in its index; every other one is judged as by
    gark check.
    """
    from garkcli.cli.rendering import shown_entries
    from garkcli.methodfile.load import load
    from garkcli.report.show import REPORT, Shown

    method = load(file, settings)
    shown = Shown(
        _entry(file, method, settings),
        method.tableau,
        shown_entries(method.tableau, None, method.further),
        method.description,
        method.bibliography,
    )
    output.tell(REPORT, [shown])
    return 0


def _entry(file: str, method: MethodFile, settings: dict[str, str]) -> Entry:
    """What is known of the method."""
    from garkcli.catalogue.entries import entry_of_method, entry_on
    from garkcli.methodfile.naming import find_named, shelf_of

    named = find_named(file)
    if named is not None and not settings:
        return entry_on(shelf_of(named), named, judges=True)
    return entry_of_method(method, file)
