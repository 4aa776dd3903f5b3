"""What claims mean, as sections of docs/properties.md."""

from __future__ import annotations

from garkcli.properties.definitions import Definition


def as_markdown(found: Definition) -> str:
    """The explanation as a section of a page."""
    lines = [f"### {found.key}", "", found.text, "", f"Claim: {found.values}."]
    if found.meaning:
        lines[-1] += f" For {found.meaning}."
    lines += ["", f"Source: {found.source}."]
    return "\n".join(lines) + "\n"
