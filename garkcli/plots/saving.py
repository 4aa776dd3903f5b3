"""Figures as files, in the format of the suffix, reproducible byte by byte."""

from __future__ import annotations

import warnings
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from garkcli.errors import UsageProblem
from garkcli.page.writing import refuse_unwritable, write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from garkcli.plots.scene import Scene

SUFFIXES = (".png", ".svg", ".pdf")


def check_suffix(path: Path) -> None:
    suffix = path.suffix
    if suffix.lower() not in SUFFIXES:
        kind = f"of kind {suffix!r}" if suffix else "without a suffix"
        message = f"no figure can be saved to {path.name!r}, {kind}"
        endings = ", ".join(SUFFIXES)
        raise UsageProblem(message, f"end it in {endings}", code="option-value")
    need_matplotlib()
    refuse_unwritable(str(path))


def need_matplotlib() -> None:
    if find_spec("matplotlib") is None:
        cure = "install garkcli[plot]; text and JSON do without"
        raise UsageProblem("a figure needs matplotlib", cure, code="missing-package")


def save_scene(scene: Scene, path: Path) -> None:
    check_suffix(path)
    from garkcli.plots.figure import figure

    save(figure(scene), path)


def save(figure: Figure, path: Path) -> None:
    """Writes a figure whole or not at all; UsageProblem for another suffix, or if it cannot."""
    from matplotlib import rc_context

    check_suffix(path)
    kind = path.suffix.lower().removeprefix(".")
    undated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind)
    drawn = BytesIO()
    # no date, and no names drawn by lot: the same result gives the same file
    with rc_context({"svg.hashsalt": "gark"}), warnings.catch_warnings():
        # of a name in letters that the font has not
        warnings.filterwarnings("ignore", "Glyph .* missing")
        figure.savefig(drawn, format=kind, dpi=150, metadata=undated)
    write_whole(str(path), [drawn.getvalue()])
