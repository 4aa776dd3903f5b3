"""The properties of a method for people."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from garkcli.page.paint import folded, indented
from garkcli.properties.keys import KEYS
from garkcli.properties.naming import number_text, stages_name

if TYPE_CHECKING:
    from garkcli.properties.property import Verdict
    from garkcli.properties.shape import Shape
    from garkcli.properties.subject import Subject
    from garkcli.properties.symmetry import Reflection
    from garkcli.tableau.tableau import Tableau

_WIDTH = 80
_NAMES = {
    "stiffly-accurate": "stiffly accurate",
    "fsal": "first same as last",
    "symmetric": "symmetric",
    "algebraically-stable": "algebraically stable",
}
"""Properties that are told where they hold."""
_ODDITIES = {
    "reducible": (True, "reducible, see gark reduce"),
    "positive-weights": (False, "not all weights positive"),
    "nodes-in-unit-interval": (False, "nodes outside [0, 1]"),
}
"""Properties that are told where they are unusual."""


def property_lines(subject: Subject, has_further: bool = False) -> list[tuple[str, str]]:
    """The block of a plain check, as labels with texts: only what has meaning and is not usual.

    Args:
        subject: the method.
        has_further: whether it has weights besides b, which may need stages that b does not.
    """
    whole = _whole(subject)
    lines = [("stages", whole)]
    kinds = {shape.name for shape in subject.shapes if shape is not None}
    if kinds - {subject.shape.name}:
        by_colour = _by_colour(subject)
        lines.append(("by colour", by_colour))
    stage_order = _stage_order(subject)
    lines.append(("stage order", stage_order))
    told = [_told(subject, key) for key in _NAMES if _is(subject, key, True)]
    for key, (odd_value, text) in _ODDITIES.items():
        if not _is(subject, key, odd_value):
            continue
        if key == "reducible" and has_further:
            text = "reducible as far as b goes"
        told.append(text)
    if told:
        lines.append(("properties", ", ".join(told)))
    keys = [*_NAMES, *_ODDITIES]
    undecided = [key for key in keys if subject.verdict(key).is_undecided]
    if undecided:
        lines.append(("not decided", ", ".join(undecided)))
    return lines


def _is(subject: Subject, key: str, wanted: bool) -> bool:
    return subject.verdict(key).value is wanted


def _told(subject: Subject, key: str) -> str:
    if key != "symmetric":
        return _NAMES[key]
    reflections = subject.symmetry.reflections
    if not reflections:
        return "symmetric once reduced"
    renumbering = _reflected(subject.tableau, reflections)
    return f"symmetric ({renumbering})"


def _reflected(tableau: Tableau, reflections: Sequence[Reflection]) -> str:
    """How the stages of each space are renumbered; only those that move are named."""
    if all(x.images is None for x in reflections):
        return "x → 1 − x"
    parts = []
    for space, reflection in enumerate(reflections):
        stage = stages_name(tableau, [(space, 0)])
        _, _, colours = stage.partition(" of ")
        moved = _moved(reflection)
        if colours:
            moved = f"{colours}: {moved}"
        parts.append(moved)
    return "; ".join(parts)


def _moved(reflection: Reflection) -> str:
    if reflection.images is None:
        return "x → 1 − x"
    pairs = []
    for i, j in enumerate(reflection.images, start=1):
        image = j + 1
        if i < image:
            pairs.append(f"{i}↔{image}")
    if not pairs:
        return "each stage its own"
    moved = ", ".join(pairs)
    return f"stages {moved}"


def _named(shape: Shape) -> str:
    if shape.gamma is None:
        return shape.name
    gamma = number_text(shape.gamma)
    return f"{shape.name}, γ = {gamma}"


def _whole(subject: Subject) -> str:
    """The kind of the whole method, and what is solved together."""
    shape, tableau = subject.shape, subject.tableau
    text = _named(shape)
    total = sum(space.stages for space in tableau.spaces)
    if shape.implicit_stages not in (None, 0, total):
        text += f", {shape.implicit_stages} of {total} implicit"
    if len(shape.systems) == 1 and len(shape.systems[0]) == total:
        return text
    for system in shape.systems:
        stages = stages_name(tableau, system)
        text += f"; {stages} together"
    return text


def _by_colour(subject: Subject) -> str:
    names = [colour.name for colour in subject.tableau.colours]
    by_kind: dict[str, list[str]] = {}
    for name, shape in zip(names, subject.shapes, strict=True):
        if shape is None:
            continue
        kind = _named(shape)
        by_kind.setdefault(kind, []).append(name)
    texts = []
    for kind, found in by_kind.items():
        colours = ", ".join(found)
        texts.append(f"{colours} {kind}")
    return "; ".join(texts)


def _stage_order(subject: Subject) -> str:
    found = subject.stage_orders
    verdict = subject.verdict("stage-order")
    text = str(verdict.value)
    if verdict.is_at_least:
        text = f"at least {text}"
    if len(set(found)) > 1:
        numbers = ", ".join(f">={q}" if q >= subject.limit else str(q) for q in found)
        text += f"   by colour {numbers}"
    return text


def every_property_lines(subject: Subject) -> list[str]:
    """All properties, a line each, with what decides them."""
    longest = max(map(len, KEYS))
    margin = " " * (longest + 4)
    lines = []
    for key in KEYS:
        verdict = subject.verdict(key)
        text = verdict_text(verdict)
        if verdict.why and verdict.value is not True:
            text += f": {verdict.why}"
        first, *others = folded(text, _WIDTH - len(margin), "")
        lines.append(f"  {key:{longest}}  {first}")
        lines += indented(others, margin)
    return lines


def verdict_text(verdict: Verdict) -> str:
    """The answer in a word or a number."""
    if verdict.value is None:
        return "not decided" if verdict.is_undecided else "no meaning"
    if verdict.value is True:
        return "yes"
    if verdict.value is False:
        return "no"
    text = str(verdict.value)
    if verdict.is_at_least:
        return f"at least {text}"
    return text
