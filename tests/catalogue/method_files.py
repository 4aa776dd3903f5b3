"""An entry of the catalogue as a method file with its claim."""

from __future__ import annotations

from tests.catalogue.catalogue import Entry


def method_file(entry: Entry) -> str:
    """The YAML text: ``ark`` where stages are shared, ``prk`` for separable problems, ``tableau``
    otherwise.

    An entry that is not exact states its rounding as the tolerance.
    """
    blocks, order = entry["blocks"], entry["verified_order"]
    lines = [f"name: {_quoted(entry['name'])}", f"reference: {_quoted(entry['source'])}"]
    if entry["problem_class"] != "general":
        structure = "nystrom" if entry["problem_class"] == "rkn" else "separable"
        lines += [f"structure: {structure}", "prk:"]
        for part, drives, at in (("q", 0, 1), ("p", 1, 0)):
            lines += [f"  {part}:", f"    A: {_list(blocks['A'][at][drives])}"]
            lines += [f"    b: {_list(blocks['b'][drives])}", f"    c: {_list(blocks['c'][at])}"]
    elif entry["kind"] == "ark":
        lines += ["ark:", f"  A: {_list(blocks['A'][0])}", f"  b: {_list(blocks['b'])}"]
        lines += [f"  c: {_list(blocks['c'][0])}"]
    else:
        lines += ["tableau:", *(f"  {key}: {_list(blocks[key])}" for key in "Abc")]
    if not entry["exact"]:
        lines.append(f"tolerance: {entry['rounding']}")
    return "\n".join([*lines, f"expect: {{order: {order}}}", ""])


def _list(value: object) -> str:
    return (
        f"[{', '.join(_list(x) for x in value)}]"
        if isinstance(value, list)
        else _quoted(str(value))
    )


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
