"""``--plot``: what is refused before the work, and the figure after it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from garkcli.cli.options import Output

if TYPE_CHECKING:
    from garkcli.plots.scene import Scene


def check_plot(path: str | None) -> None:
    """Refuse a picture of another kind, before the work.

    Raises:
        UsageProblem: its suffix is none of those that can be drawn.
    """
    if path is not None:
        from garkcli.plots.saving import check_suffix

        check_suffix(Path(path))


def save_plot(scene: Scene, path: str, output: Output) -> None:
    """Draw the scene into a file, and say so."""
    from garkcli.plots.saving import save_scene

    save_scene(scene, Path(path))
    output.note(f"wrote {path}")
