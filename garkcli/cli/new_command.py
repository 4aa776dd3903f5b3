"""``gark new``."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

import click

from garkcli.cli.options import Output, declared
from garkcli.cli.streams import is_terminal
from garkcli.doing import hush
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.methodfile.template import Member

EXAMPLE = "gark new midpoint.gark.yaml --tableau '0 |; 1/2 | 1/2; | 0 1'"


@declared("new", ["yaml"])
def command(
    file: str | None,
    tableau: str | None,
    families: tuple[str, ...],
    transfer: str | None,
    name: str | None,
    force: bool,
    output: Output,
) -> int:
    """A method file with comments and with its claims, from a tableau or from families.

    A tableau is pasted as it stands in a book: a line a stage, with or without a bar after the
    node, and a line of weights below; zeros to the right may be left out. Without options it is
    asked for.
    """
    place = _place(file, force, output)
    if tableau is not None and families:
        raise UsageProblem("--tableau and --family at once", "give one", code="options-clash")
    if tableau is None and not families:
        tableau, families, transfer, name = _asked(name)
    name = name or _title(file)
    if tableau is not None:
        if transfer is not None:
            raise UsageProblem("--transfer goes with --family", "leave it out", code="option-alone")
        text = of_tableau_text(name, tableau)
    else:
        text = _of_families(name, families, transfer or "collocation")
    text = _with_claims(text)
    if place is None:
        output.write(text)
        return 0
    from garkcli.page.writing import write_whole

    write_whole(place, [text])
    output.note(f"{place}: written; gark check {place} proves its claims")
    return 0


def _place(file: str | None, force: bool, output: Output) -> str | None:
    """Where the file goes; None for standard output.

    Raises:
        UsageProblem: it is there already, or two places are named.
    """
    if file is not None and output.path is not None:
        raise UsageProblem("FILE and -o at once", "name one place", code="options-clash")
    place = file if file is not None else output.path
    if place is None:
        return None
    from garkcli.page.writing import refuse_unwritable

    refuse_unwritable(place)
    if os.path.exists(place) and not force:
        raise UsageProblem(
            f"{place} is there already", "--force writes over it", code="cannot-write"
        )
    return place


def _title(place: str | None) -> str:
    if place is None:
        return "a new method"
    base = os.path.basename(place)
    return base.removesuffix(".yaml").removesuffix(".gark") or base


def of_tableau_text(name: str, text: str) -> str:
    """A method file of a pasted tableau; ``-`` is standard input.

    Raises:
        MethodError: it is no tableau, or no text.
    """
    from garkcli.methodfile.pasted import read_pasted
    from garkcli.methodfile.template import of_tableau

    if text == "-":
        from garkcli.methodfile.file_kind import METHOD_FILE
        from garkcli.methodfile.reading import read_text

        text, _ = read_text("-", METHOD_FILE)
    if "\n" not in text.strip():
        text = text.replace(";", "\n")
    return of_tableau(name, read_pasted(text))


def _of_families(name: str, families: tuple[str, ...], transfer: str) -> str:
    from garkcli.methodfile.template import of_families

    members = [_member(text) for text in families]
    return of_families(name, members, transfer)


def _member(text: str) -> Member:
    """A family with its stages.

    Raises:
        UsageProblem: it is not written so.
    """
    from garkcli.methodfile.template import Member

    family, sign, stages = text.partition(":")
    is_count = stages.isascii() and stages.isdigit() and len(stages) < 4
    if not sign or not is_count:
        raise UsageProblem(
            f"--family {text}: a name and stages are expected",
            "for instance --family gauss:2; gark list has the names",
            code="option-value",
        )
    return Member(family.strip(), int(stages))


def _with_claims(text: str) -> str:
    """The file with what is true of its method.

    Raises:
        MethodFileError: it makes no method.
    """
    from garkcli.check.deciding import analyse
    from garkcli.check.true_claims import true_claims, usual_keys
    from garkcli.methodfile.claims_writer import write_claims
    from garkcli.methodfile.load import loads

    method = loads(text, "the new file")
    analysis = analyse(method.tableau)
    claims = true_claims(analysis, usual_keys(analysis))
    return write_claims("the new file", text, claims)


Answers = tuple["str | None", "tuple[str, ...]", "str | None", "str | None"]


def _asked(name: str | None) -> Answers:
    """What is asked for where no option says it: tableau, families, transfer and name.

    Raises:
        UsageProblem: nobody is there to answer.
    """
    if not is_terminal(sys.stdin):
        raise UsageProblem("a new method needs --tableau or --family", EXAMPLE, code="option-alone")
    hush()
    if name is None:
        name = click.prompt("name", default="a new method")
    kind = click.prompt(
        "a tableau, or methods of families",
        type=click.Choice(["tableau", "families"]),
        default="tableau",
    )
    if kind == "tableau":
        click.echo("lines of the tableau, an empty one after the last:")
        return "\n".join(iter(_typed_line, "")), (), None, name
    members = []
    while True:
        answer = click.prompt("family:stages, empty after the last", default="", show_default=False)
        if not answer:
            break
        members.append(str(answer))
    transfer = None
    if len(members) > 1:
        transfer = click.prompt("transfer", default="collocation")
    return None, tuple(members), transfer, name


def _typed_line() -> str:
    return str(click.prompt("", default="", show_default=False, prompt_suffix=""))
