"""``gark design --emit`` and ``--emit-all``: method files of solutions, with their claims."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from garkcli.cli.options import Output
from garkcli.design.choices import Chosen, accepted_methods, first_method
from garkcli.design.design import CLAIMS, Design
from garkcli.errors import MethodError, UsageProblem
from garkcli.files import STDIN
from garkcli.methodfile.family import FamilyFile, with_values
from garkcli.page.writing import write_whole

_STANDARD_INPUT = {STDIN, "<stdin>"}


def make_folder(path: str) -> None:
    """Make the folder of --emit-all, where there is none.

    Raises:
        UsageProblem: its name is empty, or it cannot be made.
    """
    if not path:
        raise UsageProblem("the name of the folder is empty", "name a folder", code="cannot-write")
    try:
        Path(path).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        message = f"cannot make the folder {path}: {error.strerror}"
        raise UsageProblem(message, "choose another place", code="cannot-write") from None


def file_names(folder: str, source: str) -> Iterator[str]:
    """Where the files of the methods go that are found from a file, one after the other."""
    stem = Path(source).name.split(".")[0] or "method"
    if source in _STANDARD_INPUT:
        stem = "method"
    k = 0
    while True:
        k += 1
        yield str(Path(folder, f"{stem}-{k}.gark.yaml"))


def emit(family: FamilyFile, found: Design, path: str) -> None:
    """Write the first method among the solutions.

    Raises:
        UsageProblem: no order has finitely many.
        MethodError: its values cannot be written in a method file.
    """
    chosen = first_method(found)
    if chosen is None:
        raise _none()
    write_whole(path, [_text(family, found, chosen)])


def emit_all(family: FamilyFile, found: Design, folder: str, output: Output) -> None:
    """Write every method among the solutions of the highest order that has any, a file each.

    Raises:
        UsageProblem: no order has finitely many.
    """
    methods = list(accepted_methods(found))
    if not methods:
        raise _none()
    names = file_names(folder, family.source)
    for number, chosen in enumerate(methods, start=1):
        path = next(names)
        try:
            text = _text(family, found, chosen)
        except MethodError as error:
            output.note(f"solution {number} is not written: {error.message}")
            continue
        write_whole(path, [text])
        output.note(f"wrote {path}")


def _none() -> UsageProblem:
    message = "there is no single method to be written: "
    message += "no order has finitely many"
    cure = "choose values with --set, or ask for a higher order"
    return UsageProblem(message, cure, code="not-found")


def _text(family: FamilyFile, found: Design, chosen: Chosen) -> str:
    """A method file with the claims that are known of it."""
    claims = [f"{CLAIMS[found.whose]}: {chosen.order}"]
    if found.whose == "method":
        whole = [x for x in found.family.stable if x.colour is None]
        claims += [f"{x.kind}: true" for x in whole]
    claim = ", ".join(claims)
    head = f"found by gark design {family.source}: {claim}"
    return with_values(family, chosen.values, head, claim)
