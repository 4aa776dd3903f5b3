"""The format of a file by its ending: one rule for all options that name a file to write."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from os.path import splitext

import click

from garkcli.errors import UsageProblem

AUTO = "auto"
PLAIN = ".txt"
ENDINGS: Mapping[str, tuple[str, ...]] = {
    ".json": ("json", "sarif"),
    ".jsonl": ("jsonl", "ndjson"),
    ".ndjson": ("ndjson", "jsonl"),
    ".sarif": ("sarif",),
    ".csv": ("csv",),
    ".tsv": ("tsv",),
    ".md": ("markdown",),
    ".markdown": ("markdown",),
    ".tex": ("latex",),
    ".html": ("html",),
    ".htm": ("html",),
    ".yaml": ("yaml",),
    ".yml": ("yaml",),
    ".bib": ("bibtex",),
    ".xml": ("junit", "xml"),
    ".v": ("coq",),
    ".png": ("png",),
    ".svg": ("svg",),
    ".pdf": ("pdf",),
    ".parquet": ("parquet",),
    **dict.fromkeys((".c", ".h", ".cc", ".cpp", ".cxx", ".hpp", ".hh"), ("c",)),
    **dict.fromkeys((".f", ".f90", ".f95", ".f03", ".f08"), ("fortran",)),
    ".inputs": ("inputs",),
    ".jl": ("julia",),
    ".m": ("matlab", "mathematica"),
    **dict.fromkeys((".wl", ".wls"), ("mathematica",)),
    ".py": ("python",),
    ".r": ("r",),
}
"""A command writes the first of several formats that it can."""
CURES = {
    "yaml": "gark convert, design --emit and claims --write write method files",
    "html": "gark report writes pages",
    "latex": "gark check, tableau and trees write LaTeX",
    **dict.fromkeys(
        ("c", "fortran", "inputs", "julia", "matlab", "mathematica", "python", "r", "tsv"),
        "gark export writes tables for programs",
    ),
}
PICTURES = ("png", "svg", "pdf")
UNDRAWN = ("tableau", "tree")
"""No other command draws these."""
DRAWN_BY_OTHERS = ("check", "plot", "show", "stability")
"""Other commands draw pictures of their methods."""
DRAWING = {"convergence": "converge", "energy": "energy"}


def ending_of(path: str) -> str:
    """Returns the ending in lower case; empty if unknown."""
    ending = splitext(path)[1].lower()
    return ending if ending in ENDINGS else ""


def settled(
    path: str, formats: Sequence[str], chosen: str | None = None, option: str = "-o"
) -> str | None:
    """The format of the ending, or ``chosen``; UsageProblem naming ``option`` for others."""
    ending = ending_of(path)
    if not ending:
        is_plain = splitext(path)[1].lower() == PLAIN and "text" in formats
        return chosen or ("text" if is_plain else None)
    held = ENDINGS[ending]
    if chosen is not None:
        if chosen in held:
            return chosen
        message = f"{option} {path}: {chosen} does not go into a {ending} file"
        cure = f"leave out --format, or choose another ending: {_listed(formats)}"
    else:
        fitting = next((x for x in held if x in formats), None)
        if fitting is not None:
            return fitting
        message = f"{option} {path}: no {ending} file can be written here"
        cure = f"choose another ending: {_listed(formats)}"
    further = [CURES[x] for x in held[:1] if x in CURES and x not in formats]
    if held[0] in PICTURES and option == "-o":
        further = [_drawing(path)]
    raise UsageProblem(message, "; ".join(filter(None, [cure, *further])), code="wrong-ending")


def _drawing(path: str) -> str:
    """The option of this command that draws into a file, or the line of another one."""
    context = click.get_current_context(silent=True)
    options = [] if context is None else [x for y in context.command.params for x in y.opts]
    given = {} if context is None else context.params
    place = shlex.quote(path)
    if "--svg" in options:
        return f"--svg {shlex.quote(splitext(path)[0] + '.svg')} draws"
    if "--plot" in options:
        return f"--plot {place} draws"
    if context is not None and context.info_name == "report":
        return "a browser prints the page as PDF"
    file, what = given.get("file") or next(iter(given.get("files") or ()), None), given.get("what")
    if what in UNDRAWN or context is None or context.info_name not in DRAWN_BY_OTHERS:
        return ""
    file = shlex.quote(file) if isinstance(file, str) else "FILE"
    return f"gark {DRAWING.get(what or '', 'stability')} {file} --plot {place} draws"


def _listed(formats: Sequence[str]) -> str:
    found = [PLAIN] if "text" in formats else []
    for format in formats:
        found += [x for x, held in ENDINGS.items() if format == held[0]][:1]
    return ", ".join(found) or "none"
