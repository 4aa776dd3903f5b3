"""``gark plot``."""

from __future__ import annotations

import shlex
from contextlib import suppress
from typing import TYPE_CHECKING, Literal, TypeAlias

from garkcli.cli import options as opt
from garkcli.cli.command import declared
from garkcli.cli.output import Output
from garkcli.errors import GarkError, UsageProblem

if TYPE_CHECKING:
    from garkcli.ntrees.tree import Tree
    from garkcli.plots.scene import Panel
    from garkcli.tableau.garkmethod import GarkMethod
What: TypeAlias = Literal[
    "region", "star", "oscillator", "convergence", "energy", "tableau", "tree"
]


class PlotOptions(opt.Derivable):
    file: str = opt.argument("FILE", opt.METHOD)
    what: What | None = opt.option(
        "--what",
        opt.words("region", "star", "oscillator", "convergence", "energy", "tableau", "tree"),
        "The stability region, the order star, the trace on the oscillator, errors over step "
        "sizes, the energy over a long time, the tableau, or the tree at which the order ends; by "
        "default the first that there is of region, oscillator and tableau.",
        heading="Picture",
    )
    open: bool = opt.OPEN


@declared("plot", PlotOptions, ["text", "svg"])
def plot(given: PlotOptions, output: Output) -> None:
    """One look at a method: its picture in the terminal, as SVG in a file, or in the browser.

    -o FILE.svg writes the picture as SVG, -o FILE.txt as text; PNG and PDF are drawn by --plot of
    gark stability, converge and energy. With --open and without -o the picture is written into a
    temporary folder. If a method has no such picture, gark says why.
    """
    if given.open:
        output.demand_file()
    (file,) = output.files_meant([given.file], given.settings)
    method = given.method(file, is_any_kind=True)
    what, panel = _first(method) if given.what is None else (given.what, None)
    if given.open and output.path is None:
        output.path, output.format = _temporary(what), "svg"
    if what == "tableau":
        _tableau(method, output)
    elif what == "tree":
        _tree(_last_tree(method), method, output)
    else:
        _panel(panel or _panel_of(what, method, file), method.name, output)
    if given.open and output.path is not None:
        output.show(output.path)


def _temporary(what: str) -> str:
    """A path in a new folder, which stays when the command ends, for the browser to read."""
    from pathlib import Path
    from tempfile import mkdtemp

    return str(Path(mkdtemp(prefix="gark-")) / f"{what}.svg")


def _panel_of(what: str, method: GarkMethod, file: str) -> Panel:
    """UsageProblem with the pictures that the method may have if it has no such one."""
    from garkcli.webpage.pictures import NotDrawn, panel_named

    try:
        return panel_named(what, method)
    except NotDrawn as error:
        why = str(error).rstrip(".")
        others = ", ".join(x for x in (*_possible(method), "tableau", "tree") if x != what)
        message = f"--what {what}: {why[:1].lower()}{why[1:]}"
        cure = f"choose among {others}"
        if what == "energy":
            cure += f"; or follow another problem: gark energy {shlex.quote(file)} --plot e.svg"
        raise UsageProblem(message, cure, code="option-value") from None


def _possible(method: GarkMethod) -> list[str]:
    from garkcli.webpage.pictures import NotDrawn, panel_named

    found = []
    for what in ("region", "star", "oscillator"):
        try:
            panel_named(what, method)
        except (NotDrawn, GarkError):
            continue
        found.append(what)
    if method.tableau.is_gark:
        return [*found, "convergence", "energy"]
    return found if method.tableau.exact_to is not None else [*found, "convergence"]


def _first(method: GarkMethod) -> tuple[str, Panel | None]:
    from garkcli.webpage.pictures import NotDrawn, panel_named

    for what in ("region", "oscillator"):
        with suppress(NotDrawn, UsageProblem):
            return what, panel_named(what, method)
    return "tableau", None


def _panel(panel: Panel, name: str, output: Output) -> None:
    if output.format == "svg":
        from garkcli.plots.svg import document

        output.write(document(panel, name))
        return
    from functools import partial

    from garkcli.page.lines import folded
    from garkcli.page.plaintext import plain_text
    from garkcli.plots.terminal import drawn

    # before lines are measured: signs without Unicode are longer
    spelt = partial(plain_text, encoding=output.look.encoding)
    width = min(output.width, 80)
    lines = [*folded(spelt(f"{name}: {panel.title}"), width, "  "), *drawn(panel, spelt, width)]
    output.write("\n".join(lines) + "\n")


def _last_tree(method: GarkMethod) -> Tree:
    from garkcli.api.methods import find_order

    witness = find_order(method).witness
    if witness is None:
        message = "--what tree: no tree is known at which the order ends"
        raise UsageProblem(message, "gark check says how far it looked", code="option-value")
    return witness.tree


def _tree(tree: Tree, method: GarkMethod, output: Output) -> None:
    from garkcli.ntrees.drawing import draw_svg_sheet, draw_text
    from garkcli.ntrees.notation import format_tree
    from garkcli.page.plaintext import plain_text
    from garkcli.report.check import named_colours

    names = [colour.name for colour in method.tableau.colours]
    has_colours, is_named = len(names) > 1, not method.tableau.has_fields_alone
    written = format_tree(tree, names if is_named else has_colours)
    if output.format == "svg":
        output.write(draw_svg_sheet([tree], [written], title=f"{method.name}: {written}"))
        return
    lines = [written, *([named_colours(tree, names)] if is_named else []), ""]
    lines += draw_text(tree, has_colours, output.width)
    output.write(plain_text("\n".join(lines), encoding=output.look.encoding) + "\n")


def _tableau(method: GarkMethod, output: Output) -> None:
    from garkcli.cli.tableaux import coupling_of_slow_stages, write_tableau

    if output.format == "text":
        write_tableau(method, output)
        return
    from garkcli.plots.svg import of_lines
    from garkcli.report.tableau import REPORT, of_method

    shown = of_method(method, coupling=coupling_of_slow_stages(method))
    text = "".join(REPORT.pieces(shown, width=output.width))
    output.write(of_lines(text.splitlines(), f"{method.name}: tableau"))
