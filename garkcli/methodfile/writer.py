"""A method back to YAML, such that it loads again with the same blocks."""

from __future__ import annotations

from collections.abc import Sequence

import yaml
from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.exact.display import decimal, to_text
from garkcli.exact.field import Number
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.source import Source
from garkcli.tableau.tableau import Tableau

_DROPPED = ("expect", "conjugate", "name", "description")


def write_tableau_file(
    tableau: Tableau, name: str, tolerance: fmpq | None = None, note: str = ""
) -> str:
    """A method file with every block of ``tableau`` spelled out.

    Args:
        tableau: over point spaces, every entry exact.
        name: what the file calls the method.
        tolerance: the rounding of its coefficients, or None.
        note: a comment above it.
    """
    lines = [f"# {line}" for line in note.splitlines()]
    lines += ["gark: 1", f"name: {_quoted(name)}"]
    lines += _prk(tableau) if _is_prk(tableau) else _blocks(tableau)
    if tolerance is not None:
        lines.append(f"tolerance: {decimal(tolerance)}")
    return "\n".join(lines) + "\n"


def can_spell_out(tableau: Tableau) -> bool:
    """Whether a spelled-out file says everything about ``tableau``: a GARK tableau, or a
    partitioned pair.
    """
    return not tableau.is_partitioned or _is_prk(tableau)


def _is_prk(tableau: Tableau) -> bool:
    return [colour.part for colour in tableau.colours] == ["q", "p"]


def _blocks(tableau: Tableau) -> list[str]:
    lines = ["tableau:", "  c:"]
    lines += [f"    - {_row(colour.c)}" for colour in tableau.colours]
    lines.append("  A:")
    for l in range(tableau.size):
        for m in range(tableau.size):
            block = tableau.block(l, m)
            dash = "    - -" if m == 0 else "      -"
            comment = f"  # A^{{{l + 1},{m + 1}}}"
            if block is None:
                lines.append(f"{dash} null{comment}")
                continue
            lines.append(f"{dash}{comment}")
            lines += [f"        - {_row(row)}" for row in block]
    lines.append("  b:")
    lines += [f"    - {_row(colour.b)}" for colour in tableau.colours]
    linear = [str(l + 1) for l, colour in enumerate(tableau.colours) if colour.is_linear]
    return [*lines, f"linear: [{', '.join(linear)}]"] if linear else lines


def _prk(tableau: Tableau) -> list[str]:
    """The form ``prk``: the rows of q.A are the positions at which the colour p evaluates its
    forces.
    """
    lines = ["prk:"]
    for part, drives, seen_at in (("q", 0, 1), ("p", 1, 0)):
        block = tableau.block(seen_at, drives) or ()
        lines += [f"  {part}:", "    A:"]
        lines += [f"      - {_row(row)}" for row in block]
        lines += [
            f"    b: {_row(tableau.colours[drives].b)}",
            f"    c: {_row(tableau.colours[seen_at].c)}",
        ]
    if len(tableau.spaces) == 1:
        return [*lines, "structure: general"]
    return [*lines, f"structure: {'nystrom' if tableau.colours[0].is_linear else 'separable'}"]


def _row(numbers: Sequence[Number]) -> str:
    texts = (to_text(x) for x in numbers)
    return f"[{', '.join(_quoted(x) if ',' in x else x for x in texts)}]"


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(x if x.isprintable() else f"\\U{ord(x):08x}" for x in escaped) + '"'


def write_conjugate_of(method: MethodFile, name: str) -> str:
    """The file of ``method`` with ``conjugate: true`` added, or taken away where it stands.

    Exact for every method: nothing is spelled out. Claims and description are left behind, as they
    are about the other method.
    """
    root = Source(method.source, method.text).compose()
    if root is None:
        raise ValueError("the text of a method file")
    kept: list[tuple[Node, Node]] = [(key, x) for key, x in root.value if key.value not in _DROPPED]
    kept.insert(0, (_scalar("name"), _scalar(name)))
    if not method.is_conjugate:
        kept.append((_scalar("conjugate"), ScalarNode("tag:yaml.org,2002:bool", "true")))
    text = yaml.serialize(
        MappingNode(root.tag, kept, flow_style=False), allow_unicode=True, width=110
    )
    return str(text)


def _scalar(text: str) -> ScalarNode:
    return ScalarNode("tag:yaml.org,2002:str", text)
