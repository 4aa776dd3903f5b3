"""``gark design``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import click

from garkcli.cli.options import (
    CONTEXT,
    PATH,
    Output,
    choices_option,
    common,
    settings_option,
)

if TYPE_CHECKING:
    from garkcli.design.choices import Choice
    from garkcli.design.design import Design, Whose
    from garkcli.design.stable_values import Wanted
    from garkcli.methodfile.family import FamilyFile


@click.command("design", context_settings=CONTEXT)
@click.argument("file", type=PATH, metavar="FILE")
@click.option(
    "--order",
    type=click.IntRange(1, 60),
    metavar="P",
    help="The order wanted; by default as far as some value reaches.",
)
@click.option(
    "--pair", "is_pair", is_flag=True, help="The order of the symplectic pair."
)
@click.option(
    "--conjugate",
    "is_conjugate",
    is_flag=True,
    help="The order of the conjugate.",
)
@click.option(
    "--seconds",
    type=click.FloatRange(min=0, min_open=True),
    default=60,
    show_default=True,
    metavar="T",
    help="After so many an order is left undecided.",
)
@click.option(
    "--digits",
    type=click.IntRange(1, 1000),
    default=12,
    show_default=True,
    metavar="N",
    help="Digits of numbers without simple radicals.",
)
@click.option(
    "--emit",
    "emitted",
    type=PATH,
    metavar="FILE",
    help="Write the first method found as a method file with its claim.",
)
@click.option(
    "--p-stable",
    "wanted",
    flag_value="p-stable",
    help="The exact set of values of one parameter for which the method is P-stable.",
)
@click.option(
    "--a-stable",
    "wanted",
    flag_value="a-stable",
    help="The same for A-stability.",
)
@click.option(
    "--l-stable",
    "wanted",
    flag_value="l-stable",
    help="The same for L-stability.",
)
@click.option(
    "--search",
    "starts",
    type=click.IntRange(1, 10_000_000),
    metavar="N",
    help="Search from N random starts instead, and prove what is found.",
)
@click.option(
    "--seed",
    type=int,
    metavar="S",
    help="With --search: of the starts; 0 by default.",
)
@click.option(
    "--most",
    type=click.IntRange(1, 100_000),
    metavar="K",
    help="With --search: methods to find at most; 5 by default.",
)
@click.option(
    "-j",
    "--jobs",
    type=click.IntRange(1, 1000),
    metavar="N",
    help="With --search: processes.",
)
@click.option(
    "--emit-all",
    type=PATH,
    metavar="DIR",
    help="With --search: write every method found into a folder.",
)
@settings_option
@choices_option
@common(["text", "json"])
def command(
    file: str,
    order: int | None,
    is_pair: bool,
    is_conjugate: bool,
    seconds: float,
    digits: int,
    emitted: str | None,
    wanted: Wanted | None,
    settings: dict[str, str],
    choices: dict[str, str],
    output: Output,
    **searching: Any,
) -> int:
    """For which values of its free parameters a method has an order, exactly.

    A parameter is free by parameters: {tau: free}. The answer is every value, these values, a
    family of a dimension, or none, and then the tree whose condition cannot be met. Each value
    found goes through the certificate of gark check. Exit code 1: no value has the order of
    --order, or the stability that is asked for.

    With --search methods of the order are looked for by least squares from random starts. Each find
    is exact, its order proved by the certificate; proved to exist; or numerical, and then it is
    not proved. The same seed has the same finds everywhere. Exit code 3: nothing was found, which
    says nothing of what there is.
    """
    from garkcli.design.design import find_parameters
    from garkcli.errors import UsageProblem
    from garkcli.methodfile.family import load_family

    _refuse_alone(searching)
    if is_pair and is_conjugate:
        raise UsageProblem(
            "--pair and --conjugate are two methods", "ask for one"
        )
    whose: Whose = (
        "pair" if is_pair else "conjugate" if is_conjugate else "method"
    )
    family = load_family(file, settings)
    if wanted is not None:
        others = (order, emitted, searching["starts"])
        if any(x is not None for x in others):
            raise UsageProblem(
                f"--{wanted} gives a set of values, --order, --emit, --search do not",
                "ask for one; --set takes a value that was found",
            )
        return _stable_values(family, wanted, whose, digits, output)
    if searching["starts"] is not None:
        from garkcli.cli.searching import search

        return search(
            family, order, whose, {**searching, "emit": emitted}, output
        )
    chosen: list[Choice] = []
    if choices:
        known = find_parameters(family, order, whose, seconds)
        chosen = _walk(known, choices)
        family = load_family(file, {**settings, **choices})
    found = find_parameters(family, order, whose, seconds)
    if output.format == "json":
        from garkcli.report import design_data

        output.write(design_data.render(file, found, digits, chosen))
    else:
        from garkcli.report import design_text

        output.write(
            design_text.render(file, found, digits, output.width, chosen)
        )
    if emitted is not None:
        _emit(family, found, emitted)
    order = order or family.order
    is_reached = order is None or found.reaches(order)
    return _exit_code(found.last.kind == "undecided", is_reached)


def _walk(known: Design, choices: Mapping[str, str]) -> list[Choice]:
    """What each value of --choose leaves."""
    from garkcli.design.choices import walk_down
    from garkcli.design.groebner import NotDecided
    from garkcli.errors import ExpressionError, UsageProblem, did_you_mean
    from garkcli.exact.domain import Domain
    from garkcli.exact.expression import parse
    from garkcli.exact.field import Algebraic

    unknowns = known.family.parameters
    values = {}
    for name, text in choices.items():
        if name not in unknowns:
            cure = did_you_mean(name, list(unknowns))
            raise UsageProblem(f"--choose: no unknown {name!r}", cure)
        try:
            expression = parse(text)
            value = Domain([expression]).evaluate(expression)
        except ExpressionError as error:
            raise UsageProblem(
                f"--choose {name}: {error.message}", error.help
            ) from None
        if isinstance(value, Algebraic):
            raise UsageProblem(
                f"--choose {name}: a rational number is expected",
                "--set takes radicals",
            )
        values[name] = text, value
    if len(values) == len(unknowns):
        raise UsageProblem(
            "--choose leaves no unknown",
            "gark check with --set judges one method",
        )
    try:
        return walk_down(known, values)
    except NotDecided:
        raise UsageProblem(
            "--choose: what is left is not decided in the time of --seconds",
            "choose with --set",
        ) from None


def _refuse_alone(searching: Mapping[str, object]) -> None:
    """Options that say nothing without --search."""
    from garkcli.errors import UsageProblem

    for name in ("seed", "most", "jobs", "emit_all"):
        if searching["starts"] is None and searching[name] is not None:
            option = "--" + name.replace("_", "-")
            raise UsageProblem(
                f"{option} goes with --search", "add --search N"
            )


def _stable_values(
    family: FamilyFile,
    wanted: Wanted,
    whose: Whose,
    digits: int,
    output: Output,
) -> int:
    """The set of values with a kind of stability."""
    from garkcli.design.stable_values import stable_values
    from garkcli.report import stable_values as report

    found = stable_values(family, wanted, whose)
    if output.format == "json":
        output.write(report.render_json(family.source, found, digits))
    else:
        output.write(
            report.render_text(family.source, found, digits, output.width)
        )
    is_open = not found.found and bool(found.undecided)
    return _exit_code(is_open, bool(found.found))


def _emit(family: FamilyFile, found: Design, path: str) -> None:
    """Write the first method among the solutions."""
    from garkcli.design.chosen import first_method
    from garkcli.errors import UsageProblem
    from garkcli.methodfile.family import with_values
    from garkcli.page.writing import write_whole

    chosen = first_method(found)
    if chosen is None:
        raise UsageProblem(
            "there is no single method to be written: no order has finitely many",
            "choose values with --set, or ask for a higher order",
        )
    key = {
        "method": "order",
        "conjugate": "conjugate-order",
        "pair": "pair-order",
    }
    claim = f"{key[found.whose]}: {chosen.order}"
    head = f"found by gark design {family.source}: {claim}"
    write_whole(path, [with_values(family, chosen.values, head, claim)])


def _exit_code(is_undecided: bool, is_reached: bool) -> int:
    """What cannot be decided is no fault of the file: 3, as what could not be done."""
    if is_undecided:
        return 3
    return 0 if is_reached else 1
