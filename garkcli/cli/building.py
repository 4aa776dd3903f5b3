"""``gark new`` and ``gark claims``: method files and their claims."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

import click

from garkcli.cli import options as opt
from garkcli.cli.command import declared
from garkcli.cli.endings import settled
from garkcli.cli.output import Output
from garkcli.doing import hush
from garkcli.errors import HasFreeParameters, UsageProblem
from garkcli.frozen import replace
from garkcli.tell.report import FORMATS
from garkcli.terminal import is_terminal

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile
    from garkcli.methodfile.template import Member

EXAMPLE = "gark new midpoint.gark.yaml --tableau '0 |; 1/2 | 1/2; | 0 1'"


class New(opt.Options):
    file: str | None = opt.maybe_argument("FILE", opt.FILE)
    tableau: str | None = opt.option(
        "--tableau",
        opt.text("TEXT"),
        "A Butcher tableau, its lines separated by ; or line ends; @FILE reads it from a file, - "
        "from standard input.",
        heading="Method",
    )
    families: tuple[str, ...] = opt.repeated(
        "--family", opt.text("NAME-STAGES"), "A family with its stages, one per colour; repeatable."
    )
    transfer: str | None = opt.option(
        "--transfer",
        opt.hidden_default(opt.text("RULE")),
        "The rule for the blocks between families; by default collocation.",
        of="gark.transfer",
    )
    name: str | None = opt.option(
        "--name", opt.text("TEXT"), "The name of the method.", of="from_arrays.name"
    )
    force: bool = opt.flag("--force", "Overwrite an existing file.", heading="Output")
    rules = (
        opt.excludes(file, opt.OUTPUT, "FILE and -o at once", "name one place"),
        opt.excludes(tableau, families, "--tableau and --family at once", "give one"),
    )


@declared("new", New, ["yaml"], output=opt.WRITTEN)
def new(given: New, output: Output) -> None:
    """A method file with comments and claims, from a tableau or from families.

    Paste a tableau as a book prints it: a line per stage, with or without a bar after the node,
    and a line of weights below. You may leave out zeros on the right. Without options gark asks.

    If a number looks wrong or rounded, a hint names it, and the file makes no claims.
    """
    from garkcli.api.calls import with_claims
    from garkcli.check.check_file import check_method
    from garkcli.check.findings import hints
    from garkcli.methodfile.load import loads
    from garkcli.methodfile.template import of_families
    from garkcli.report.check import wrong_row_sums
    from garkcli.tell.dialect import Plain

    place: str | None = output.path if given.file is None else given.file
    if given.file is not None:
        settled(given.file, ["yaml"], option="FILE")
    output.check_place(place)
    if place is not None and os.path.exists(place) and not given.force:
        message = f"{place} is there already"
        raise UsageProblem(message, "--force writes over it", code="cannot-write")
    if given.tableau is None and not given.families:
        given = _asked(given)
    stem = os.path.basename(given.file or "").removesuffix(".yaml").removesuffix(".gark")
    name = given.name or stem or "a new method"
    if given.tableau is None:
        members = [_member(text) for text in given.families]
        text = of_families(name, members, given.transfer or "collocation")
    elif given.transfer is not None:
        raise UsageProblem("--transfer goes with --family", "leave it out", code="option-alone")
    else:
        text = of_tableau_text(name, given.tableau)
    method = loads(text, "the new file")
    outcome = check_method(method)
    doubts = [x.reason for x in hints(outcome)]
    for reason in (*wrong_row_sums(outcome), *doubts):
        output.note(f"hint: {Plain().reason(reason)}")
    if not doubts:
        text = with_claims(method)
    if place is None:
        output.write(text)
        return
    from garkcli.page.writing import write_whole

    write_whole(place, [text])
    output.note(
        f"wrote {place} without claims; if the numbers are meant, gark claims {place} --write"
        if doubts
        else f"wrote {place}; gark check {place} proves its claims"
    )


def of_tableau_text(name: str, text: str) -> str:
    """A file for a pasted tableau, or one of ``-`` or ``@FILE``; MethodError if it is none."""
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
    from garkcli.families.registry import member_named
    from garkcli.methodfile.template import Member

    found = member_named(text, is_known=False)
    if found is None:
        message = f"--family {text}: a name and stages are expected"
        cure = "for instance --family gauss-2; gark list families has the names"
        raise UsageProblem(message, cure, code="option-value")
    return Member(*found)


def _asked(given: New) -> New:
    """Asks for a name, a tableau, or families and a rule; UsageProblem without a terminal."""
    if not is_terminal(sys.stdin):
        raise UsageProblem("a new method needs --tableau or --family", EXAMPLE, code="option-alone")
    hush()
    name = given.name
    if name is None:
        name = click.prompt("name", default="a new method")
    kind = click.prompt(
        "a tableau, or methods of families",
        type=click.Choice(["tableau", "families"]),
        default="tableau",
    )
    if kind == "tableau":
        click.echo("lines of the tableau, an empty one after the last:")
        lines = "\n".join(iter(_typed_line, ""))
        return replace(given, name=name, tableau=lines, transfer=None)
    families: list[str] = []
    while answer := click.prompt(
        "family:stages, empty after the last", default="", show_default=False
    ):
        families.append(str(answer))
    transfer = click.prompt("transfer", default="collocation") if len(families) > 1 else None
    return replace(given, name=name, families=tuple(families), transfer=transfer)


def _typed_line() -> str:
    return str(click.prompt("", default="", show_default=False, prompt_suffix=""))


class ClaimsOptions(opt.Options):
    files: tuple[str, ...] = opt.arguments_of("FILE...", opt.METHOD)
    write: bool = opt.flag(
        "--write", "Put the claims into the files, and change nothing else.", heading="Claims"
    )
    all: bool = opt.flag("--all", "Every decided claim.")
    keys: tuple[str, ...] = opt.repeated(
        "--key", opt.text("KEY"), "Add this claim; repeatable.", of="claims_of.keys"
    )


@declared("claims", ClaimsOptions, FORMATS)
def claims(given: ClaimsOptions, output: Output) -> None:
    """The true claims of a method, as a file makes them under `expect`.

    For a file with claims: these, corrected. Otherwise the orders, whether it is symplectic, its
    stage order, and the properties that it has. Claims that do not apply or are undecided are left
    out.

    --write puts the claims into the files, so that gark check fails once the method changes.
    """
    from garkcli.api.calls import refuse_unknown, true_claims_of
    from garkcli.methodfile.carried import write_claims
    from garkcli.methodfile.expectations import CLAIMS
    from garkcli.page.writing import write_whole
    from garkcli.report.claims import REPORT, Claims, yaml_text

    refuse_unknown(given.keys)
    if given.write and "-" in given.files:
        raise UsageProblem("--write needs a file", "name one in place of -", code="option-alone")
    paths = output.files_meant(given.files)
    if given.write:
        from garkcli.methodfile.naming import find_named

        for path in paths:
            if find_named(path) is not None:
                message = f"--write needs a file, and {path} is a name of the catalogue"
                raise UsageProblem(message, "give the path of the file", code="option-alone")
    methods = [_loaded(path) for path in paths]
    found = []
    for method in methods:
        made = (claim.key for claim in method.claims)
        wanted = list(CLAIMS) if given.all else [*made, *given.keys]
        found.append(true_claims_of(method, wanted))
    if given.write:
        for method, true in zip(methods, found, strict=True):
            text = write_claims(method.source, method.text, true.claims)
            if text != method.text:
                write_whole(method.source, [text], is_renewed=True)
    told = [Claims(true, given.write) for true in found]
    if output.format == "text":
        output.write(yaml_text(told, output.width, output.verbosity <= 0))
    else:
        output.tell(REPORT, *told)


def _loaded(path: str) -> MethodFile:
    from garkcli.methodfile.load import load

    try:
        return load(path)
    except HasFreeParameters as error:
        message = f"{error.source} has free parameters, and claims are of one method"
        cure = "gark check says what holds for every value"
        raise UsageProblem(message, cure, code="free-parameters") from None
