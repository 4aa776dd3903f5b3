"""Panels as elements of SVG, in the colours of the surrounding page, --picture-1 to --picture-4 of
STYLE, with dashes that can be distinguished in grey. No ids: a page can have many pictures.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from typing import TypeAlias

from garkcli.plots import scene

Value: TypeAlias = str | float | None
"""Numbers are lengths, None leaves an attribute out."""
_LEFT, _RIGHT, _TOP, _BOTTOM = 58, 12, 10, 40
"""Space around the frame: numbers and a label on the left and below."""
_INSIDE = scene.WIDTH - _LEFT - _RIGHT
ON_ANY = ("#2f7dc8", "#d24a3a", "#3f8f36", "#9b6ac0")
"""For pages without STYLE, such as notebooks, light or dark: contrast at least 3 to 1 on both."""
_DARK_COLOURS = ("#8ab8f5", "#ff9d8c", "#8fd08a", "#d3a6f2")
_LEGEND_ROW = 18
_LONGEST = 46  # characters of a name
_LONGEST_TITLE = 60
_HEAD = 26.0
_RADIUS = 3
_MOST_ACROSS, _MOST_UP = 6, 7


def _variables(colours: Sequence[str]) -> str:
    return ";".join(f"--picture-{k}:{colour}" for k, colour in enumerate(colours, start=1))


def _colours() -> str:
    light = _variables(scene.COLOURS[: len(ON_ANY)])
    dark = _variables(_DARK_COLOURS)
    screen = f"@media screen and (prefers-color-scheme:dark){{:root{{{dark}}}}}\n"
    return f":root{{{light}}}\n{screen}"


STYLE = _colours() + "svg.plot{display:block;width:100%;max-width:30rem;height:auto}\n"


def colour(style: int | None) -> str:
    if style is None:
        return "currentColor"
    place = style % len(ON_ANY)
    return f"var(--picture-{place + 1},{ON_ANY[place]})"


def svg(panel: scene.Panel) -> str:
    inside, height = _inside(panel)
    view = f"0 0 {scene.WIDTH} {_number(height)}"
    head = _opened("svg", **{"class": "plot"}, role="img", viewBox=view, **_LOOK)
    return "\n".join([head, element("title", panel.title), *inside, "</svg>"])


_LOOK: dict[str, Value] = {"font_size": "12", "fill": "currentColor", "stroke_linejoin": "round"}


def _inside(panel: scene.Panel) -> tuple[list[str], float]:
    frame = _Frame(panel)
    foot = frame.bottom + _BOTTOM
    lines = [
        element("desc", panel.description),
        *frame.axes(panel),
        *frame.cut_off(panel.shapes),
        *_legend_rows(panel.legend, foot + 6),
    ]
    return lines, foot + _LEGEND_ROW * len(panel.legend)


def document(panel: scene.Panel, name: str) -> str:
    title = f"{name}: {panel.title}"
    inside, height = _inside(panel)
    style = f"{_colours()}svg{{color:#1d1f24;background:#fff;font-family:sans-serif}}\n"
    dark = "@media (prefers-color-scheme:dark){svg{color:#e8e8e8;background:#17191d}}\n"
    caption = scene.shortened(title, _LONGEST_TITLE)
    lines = [
        _file(scene.WIDTH, height + _HEAD, -_HEAD, _LOOK),
        f"<style>\n{style}{dark}</style>",
        element("title", title),
        element("text", caption, x=_LEFT - 46.0, y=-8.0, font_weight="bold"),
        *inside,
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _file(width: float, height: float, top: float, attributes: Mapping[str, Value]) -> str:
    """Returns the head of a document of this size, whose first line is at ``top``."""
    size = {"width": float(width), "height": float(height)}
    view = " ".join(map(_number, (0.0, top, *size.values())))
    place = {"xmlns": "http://www.w3.org/2000/svg", "role": "img", "viewBox": view}
    return _opened("svg", **place, **size, **attributes)


def of_lines(lines: Sequence[str], title: str) -> str:
    wide, high = 8 * max(map(len, lines)) + 2 * _TOP, 18 * len(lines) + 2 * _TOP
    look: dict[str, Value] = {
        "font_family": "DejaVu Sans Mono, monospace",
        "font_size": "13",
        "style": "background:#fff;white-space:pre",
    }
    rows = [
        element("text", line, x=float(_TOP), y=float(_TOP + 18 * k), **{"xml:space": "preserve"})
        for k, line in enumerate(lines, start=1)
    ]
    return "\n".join([_file(wide, high, 0, look), element("title", title), *rows, "</svg>", ""])


class _Frame:
    def __init__(self, panel: scene.Panel) -> None:
        x, y = panel.x, panel.y
        self._x, self._y = x, y
        width, height = float(_INSIDE), panel.height
        if panel.is_plane:
            unit = min(width / (x.high - x.low), height / (y.high - y.low))
            width, height = (x.high - x.low) * unit, (y.high - y.low) * unit
        self.left = _LEFT + (_INSIDE - width) / 2
        self.top = float(_TOP)
        self.width, self.height = width, height
        self.bottom = self.top + height

    def across(self, x: float) -> float:
        return self.left + self.width * (x - self._x.low) / (self._x.high - self._x.low)

    def down(self, y: float) -> float:
        return self.bottom - self.height * (y - self._y.low) / (self._y.high - self._y.low)

    def path(self, points: Iterable[scene.Point]) -> str:
        return _path((self.across(x), self.down(y)) for x, y in points)

    def axes(self, panel: scene.Panel) -> Iterator[str]:
        left, bottom = self.left, self.bottom
        middle = left + self.width / 2, self.top + self.height / 2
        box = {"x": left, "y": self.top, "width": self.width, "height": self.height}
        yield element("rect", **box, fill="none", stroke="currentColor")
        for mark in panel.x.marks(_MOST_ACROSS):
            x = self.across(mark.at)
            yield element("path", d=_path([(x, bottom), (x, bottom + 4)]), stroke="currentColor")
            yield element("text", mark.label, x=x, y=bottom + 16, text_anchor="middle")
        for mark in panel.y.marks(_MOST_UP):
            y = self.down(mark.at)
            yield element("path", d=_path([(left - 4, y), (left, y)]), stroke="currentColor")
            yield element("text", mark.label, x=left - 7, y=y + 4, text_anchor="end")
        yield element("text", panel.x.label, x=middle[0], y=bottom + 33, text_anchor="middle")
        start = left - _LEFT + 12
        turned = f"rotate(-90 {_number(start)} {_number(middle[1])})"
        yield element(
            "text", panel.y.label, x=start, y=middle[1], text_anchor="middle", transform=turned
        )

    def cut_off(self, shapes: Sequence[scene.Shape]) -> Iterator[str]:
        """Yields the shapes in a nested picture, which clips them and needs no id for it."""
        box = {"x": self.left, "y": self.top, "width": self.width, "height": self.height}
        yield _opened("svg", **box, viewBox=" ".join(map(_number, box.values())))
        for shape in shapes:
            if isinstance(shape, scene.Curve):
                yield from self._curve(shape)
            elif isinstance(shape, scene.Area):
                yield from self._area(shape)
            else:
                yield from self._rule(shape)
        yield "</svg>"

    def _curve(self, curve: scene.Curve) -> Iterator[str]:
        if curve.has_line and curve.points:
            yield element("path", d=self.path(curve.points), fill="none", **_stroke(curve))
        if curve.has_dots:
            for x, y in curve.points:
                place = {"cx": self.across(x), "cy": self.down(y), "r": _RADIUS}
                yield element("circle", **place, style=f"fill:{colour(curve.style)}")

    def _area(self, area: scene.Area) -> Iterator[str]:
        data = "".join(self.path(loop) + "Z" for loop in area.outlines(self._x, self._y))
        if not data:
            return
        stroke = _stroke(area) if area.has_outline else {}
        style = f"fill:{colour(area.style)};{stroke.pop('style', '')}".removesuffix(";")
        opacity = f"{area.opacity:g}"
        yield element(
            "path", d=data, style=style, fill_opacity=opacity, fill_rule="evenodd", **stroke
        )

    def _rule(self, rule: scene.RuledLine) -> Iterator[str]:
        ends = [rule.start, rule.end]
        yield element("path", d=self.path(ends), stroke="currentColor", stroke_width=0.7)
        if not rule.label:
            return
        x = self.across((rule.start[0] + rule.end[0]) / 2)
        y = self.down((rule.start[1] + rule.end[1]) / 2)
        yield element(
            "text",
            rule.label,
            x=x + (3 if rule.is_right else -3),
            y=y + (11 if rule.is_below else -4),
            text_anchor="start" if rule.is_right else "end",
            font_size="10",
        )


def _legend_rows(named: Sequence[scene.Curve | scene.Area], y: float) -> Iterator[str]:
    for shape in named:
        start, end = (_LEFT - 46, y), (_LEFT - 12, y)
        if isinstance(shape, scene.Area) and not shape.has_outline:
            style = f"fill:{colour(shape.style)}"
            place = {"x": start[0], "y": y - 5, "width": end[0] - start[0], "height": 10}
            yield element("rect", **place, style=style, fill_opacity=f"{shape.opacity:g}")
        elif not isinstance(shape, scene.Curve) or shape.has_line:
            yield element("path", d=_path([start, end]), **_stroke(shape) | {"stroke_width": 2.0})
        else:
            place = {"cx": (start[0] + end[0]) / 2, "cy": y, "r": _RADIUS}
            yield element("circle", **place, style=f"fill:{colour(shape.style)}")
        yield element("text", scene.shortened(shape.label, _LONGEST), x=_LEFT - 4, y=y + 4)
        y += _LEGEND_ROW


def _stroke(shape: scene.Curve | scene.Area) -> dict[str, Value]:
    dashes = () if shape.style is None else scene.DASHES[shape.style % len(ON_ANY)]
    return {
        "style": f"stroke:{colour(shape.style)}",
        "stroke_width": shape.width if isinstance(shape, scene.Curve) else 1.6,
        "stroke_dasharray": " ".join(f"{x:g}" for x in dashes) or None,
    }


def element(name: str, words: str | None = None, /, **attributes: Value) -> str:
    """Returns an element with attributes, empty or with a text.

    >>> element("text", "a < b", x=1.26, text_anchor="end", style=None)
    '<text x="1.3" text-anchor="end">a &lt; b</text>'
    """
    head = _opened(name, **attributes)
    if words is None:
        return head.removesuffix(">") + "/>"
    return f"{head}{escape(words)}</{name}>"


def _opened(name: str, **attributes: Value) -> str:
    parts = [name]
    for key, value in attributes.items():
        if value is not None:
            written = value if isinstance(value, str) else _number(value)
            parts.append(f'{key.replace("_", "-")}="{written}"')
    return f"<{' '.join(parts)}>"


def _path(points: Iterable[scene.Point]) -> str:
    return "M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in points)


def _number(x: float) -> str:
    short = f"{x:.1f}".removesuffix(".0")
    return "0" if short == "-0" else short
