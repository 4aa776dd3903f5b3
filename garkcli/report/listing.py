"""``gark list``: what method files and commands can name."""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.families.registry import Family
from garkcli.report.json_text import to_json
from garkcli.report.paint import Paint


def render(
    families: Mapping[str, Family],
    rules: Mapping[str, str],
    problems: Mapping[str, str],
    format: str,
    paint: Paint,
) -> str:
    """The lists as text or JSON."""
    if format == "json":
        data = {
            "schema": "gark/list/1",
            "families": [
                {
                    "name": x.name,
                    "stages": _stages(x),
                    "order": x.order,
                    "summary": x.summary,
                }
                for x in families.values()
            ],
            "transfer": [
                {"name": name, "summary": summary} for name, summary in rules.items()
            ],
            "problems": [
                {"name": name, "summary": summary} for name, summary in problems.items()
            ],
        }
        return to_json(data) + "\n"
    lines = [paint("strong", f"{'families':<20} {'stages':<8} {'order':<7}")]
    lines += [
        f"  {x.name:<18} {_stages(x):<8} {x.order:<7} {x.summary}"
        for x in families.values()
    ]
    for title, entries in (("transfer rules", rules), ("problems", problems)):
        width = max(len(name) for name in entries) + 2
        lines += ["", paint("strong", title)]
        for name, summary in entries.items():
            lines.append(
                f"  {name:<{width}}{summary}"
                if len(summary) + width < 78
                else f"  {name}\n      {summary}"
            )
    lines += [
        "",
        "A problem of your own is a file: --problem FILE.yaml, see docs/problem-file.md.",
    ]
    return "\n".join(lines) + "\n"


def _stages(family: Family) -> str:
    return (
        str(family.smallest)
        if family.largest == family.smallest
        else f">= {family.smallest}"
    )
