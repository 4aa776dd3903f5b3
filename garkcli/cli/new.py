"""``gark new``."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

import click

from garkcli.cli.endings import settled
from garkcli.cli.options import Given, Output, declared
from garkcli.cli.streams import is_terminal
from garkcli.doing import hush
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from garkcli.methodfile.template import Member

EXAMPLE = "gark new midpoint.gark.yaml --tableau '0 |; 1/2 | 1/2; | 0 1'"


@declared("new", ["yaml"])
def new(given: Given, output: Output) -> None:
    """A method file with comments and claims, from a tableau or from families.

    Paste a tableau as a book prints it: a line per stage, with or without a bar after the node,
    and a line of weights below. You may leave out zeros on the right. Without options gark asks.
    """
    from garkcli.api.calls import with_claims
    from garkcli.methodfile.load import loads
    from garkcli.methodfile.template import of_families

    place: str | None = output.path if given.file is None else given.file
    if given.file is not None:
        settled(given.file, ["yaml"], option="FILE")
    output.check_place(place)
    if place is not None and os.path.exists(place) and not given.force:
        message = f"{place} is there already"
        raise UsageProblem(message, "--force writes over it", code="cannot-write")
    if given.tableau is None and not given.families:
        _ask(given)
    stem = os.path.basename(given.file or "").removesuffix(".yaml").removesuffix(".gark")
    name = given.name or stem or "a new method"
    if given.tableau is None:
        members = [_member(text) for text in given.families]
        text = of_families(name, members, given.transfer or "collocation")
    elif given.transfer is not None:
        raise UsageProblem("--transfer goes with --family", "leave it out", code="option-alone")
    else:
        text = of_tableau_text(name, given.tableau)
    text = with_claims(loads(text, "the new file"))
    if place is None:
        output.write(text)
        return
    from garkcli.page.writing import write_whole

    write_whole(place, [text])
    output.note(f"wrote {place}; gark check {place} proves its claims")


def of_tableau_text(name: str, text: str) -> str:
    """Returns a method file for a pasted tableau; ``-`` is standard input, ``@FILE`` a file.

    Raises MethodError if it is not a tableau.
    """
    from garkcli.glossary.key import METHOD_FILE
    from garkcli.grammar.reading import read_text
    from garkcli.methodfile.pasted import read_pasted
    from garkcli.methodfile.template import of_tableau

    if text == "-" or text.startswith("@"):
        text, _ = read_text(text.removeprefix("@"), METHOD_FILE)
    if "\n" not in text.strip():
        text = text.replace(";", "\n")
    return of_tableau(name, read_pasted(text))


def _member(text: str) -> Member:
    """Returns the family and the stages.

    Raises UsageProblem for other texts.
    """
    from garkcli.families.registry import member_named
    from garkcli.methodfile.template import Member

    found = member_named(text, is_known=False)
    if found is None:
        message = f"--family {text}: a name and stages are expected"
        cure = "for instance --family gauss-2; gark list families has the names"
        raise UsageProblem(message, cure, code="option-value")
    return Member(*found)


def _ask(given: Given) -> None:
    """Asks for a name, a tableau, or families and a transfer rule that no option gives.

    Raises UsageProblem without a terminal.
    """
    if not is_terminal(sys.stdin):
        raise UsageProblem("a new method needs --tableau or --family", EXAMPLE, code="option-alone")
    hush()
    if given.name is None:
        given.name = click.prompt("name", default="a new method")
    given.transfer = None
    kind = click.prompt(
        "a tableau, or methods of families",
        type=click.Choice(["tableau", "families"]),
        default="tableau",
    )
    if kind == "tableau":
        click.echo("lines of the tableau, an empty one after the last:")
        given.tableau = "\n".join(iter(_typed_line, ""))
        return
    given.families = []
    while answer := click.prompt(
        "family:stages, empty after the last", default="", show_default=False
    ):
        given.families.append(str(answer))
    if len(given.families) > 1:
        given.transfer = click.prompt("transfer", default="collocation")


def _typed_line() -> str:
    return str(click.prompt("", default="", show_default=False, prompt_suffix=""))
