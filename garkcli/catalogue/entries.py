"""The methods that have names, each as an entry: those of the package out of its index, those of
one's own by what their files claim, or judged on demand.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from garkcli.errors import HasFreeParameters, MethodFileError
from garkcli.methodfile.naming import every_shelf, visible
from garkcli.methodfile.shelves import Package, Shelf, Shelved
from garkcli.properties.registry import KEYS

if TYPE_CHECKING:
    from garkcli.catalogue.facts import Entry
    from garkcli.methodfile.build import MethodFile

FOUND, CLAIMED, UNREAD = "found", "claimed", "unread"
"""How the facts of an entry are known: as ``gark check`` finds them, by the word of the file, or
not at all.
"""


def all_entries(judges: bool = False) -> Iterator[Entry]:
    """An entry for each method that a name means.

    Args:
        judges: whether methods that no index knows are judged as by ``gark check``.
    """
    for shelf, method in visible(every_shelf()):
        yield entry_on(shelf, method, judges)


def entry_on(shelf: Shelf, method: Shelved, judges: bool = False) -> Entry:
    """The entry of one method.

    ``catalogue`` and ``folder`` say where it is, ``facts`` how they are known.
    """
    facts = FOUND
    if isinstance(shelf, Package):
        entry = _of_index(shelf.entries[method.name])
    else:
        entry, facts = _of_file(method, judges)
    entry.pop("digest", None)
    place = {"folder": method.folder, "catalogue": shelf.label}
    return {**entry, **place, "facts": facts}


def _of_index(known: Mapping[str, Any]) -> Entry:
    """An entry of the index; a property that is newer than the index is not decided."""
    fields = (key.replace("-", "_") for key in KEYS)
    missing = [field for field in fields if field not in known]
    return {**known, **dict.fromkeys(missing), "undecided": [*known["undecided"], *missing]}


def _of_file(method: Shelved, judges: bool) -> tuple[Entry, str]:
    """The entry of a method that no index knows."""
    # the index is read without any of this
    from garkcli.methodfile.load import loads

    try:
        read = loads(method.read(), method.name)
    except HasFreeParameters as error:
        return {**_blank(method), **_family(error)}, CLAIMED
    except MethodFileError:
        return _blank(method), UNREAD
    if not judges:
        return _claimed(read, method), CLAIMED
    return _judged(read, method.name, method.place), FOUND


def entry_of_method(read: MethodFile, file: str) -> Entry:
    """The entry of a method that was read from a file."""
    place = {"folder": "", "catalogue": "", "facts": FOUND}
    return {**_judged(read, read.source, file), **place}


def _judged(read: MethodFile, name: str, file: str) -> Entry:
    """What is found of a method."""
    from garkcli.catalogue.facts import found_of
    from garkcli.check.deciding import analyse
    from garkcli.order.certificate import DEFAULT_LIMIT

    analysis = analyse(read.tableau, DEFAULT_LIMIT, read.tolerance, further=read.further)
    return found_of(read, analysis, name, file)


def _blank(method: Shelved) -> Entry:
    """An entry of whose method nothing is known."""
    from garkcli.catalogue.facts import blank

    return {**blank(), "name": method.name, "file": method.place}


def _family(error: HasFreeParameters) -> Entry:
    """What can be said of a file with free parameters."""
    from garkcli.methodfile.load import described

    _, description = described(error.text, error.source, {})
    return {
        "aliases": list(description.aliases),
        "title": description.name,
        "reference": description.reference,
        "kind": "family",
        "structure": description.structure,
    }


def _claimed(read: MethodFile, method: Shelved) -> Entry:
    """What a file says of itself, its claims for facts."""
    from garkcli.catalogue.facts import blank, head, shape
    from garkcli.methodfile.expectations import AtLeast

    entry = {**blank(), **head(read, method.name, method.place), **shape(read)}
    for claim in read.claims:
        key = claim.key.replace("-", "_")
        if key not in entry:
            continue
        value = claim.value
        if isinstance(value, AtLeast):
            value = value.least
        is_plain = value is None or isinstance(value, bool | int)
        entry[key] = value if is_plain else str(value)
    return entry
