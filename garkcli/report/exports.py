"""``gark list exports``: the targets of ``gark export``."""

from __future__ import annotations

from textwrap import wrap

from garkcli.bridges.registry import Bridge, bridges
from garkcli.page.json_text import to_json
from garkcli.page.paint import Paint
from garkcli.page.record import Field, Record
from garkcli.page.schema import FLAG, TEXT, Schema, array, published

_WIDTH = 80
_TARGET: Record[Bridge] = Record(
    Field("name", TEXT, lambda x: x.name),
    Field("kinds", array(TEXT), lambda x: list(x.kinds)),
    Field("reads_back", FLAG, lambda x: x.reads_back),
    Field("has_test", FLAG, lambda x: x.test_driver is not None),
    Field("suffix", TEXT, lambda x: x.suffix),
    Field("summary", TEXT, lambda x: x.summary),
)


def render(format: str, paint: Paint) -> str:
    """A line a target, or JSON: a list of objects."""
    found = bridges().values()
    if format == "json":
        return to_json([_TARGET.data(bridge) for bridge in found]) + "\n"
    width = max(len(bridge.name) for bridge in found) + 4
    lines = [paint("strong", "targets")]
    for bridge in found:
        kinds = ", ".join(bridge.kinds)
        about = f"{bridge.summary} ({kinds})"
        first, *rest = wrap(about, _WIDTH - width)
        label = f"  {bridge.name}".ljust(width)
        lines.append(label + first)
        lines += [" " * width + line for line in rest]
    return "\n".join(lines) + "\n"


def exports_schema() -> Schema:
    """The JSON Schema of ``gark list exports``."""
    return published("list of gark list exports", array(_TARGET.schema))
