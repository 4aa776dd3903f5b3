"""The tables of docs/catalogue.md, made from the method files and the index of the package."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeAlias

Entry: TypeAlias = dict[str, Any]
CATALOGUE = Path(__file__).resolve().parents[2] / "garkcli" / "catalogue"
FOLDERS = {
    "paper": "The paper",
    "erk": "Explicit methods",
    "dirk": "Diagonally implicit methods",
    "irk": "Implicit methods",
    "ark": "Additive methods: implicit-explicit pairs",
    "gark": "GARK methods",
    "sprk": "Symplectic partitioned methods",
    "splitting": "Splitting methods",
    "rkn": "Methods for quadratic kinetic energy",
    "nystrom": "Nyström methods",
    "nprk": "Nonlinearly partitioned methods",
    "derivatives": "Multiderivative methods",
    "rosenbrock": "Rosenbrock and W-methods",
    "multirate": "Multirate methods",
    "found": "Found by gark",
    "errata": "Known to be wrong",
}
"""The folders in the order of the page, with their headings."""
TYPES = {
    "explicit": "explicit",
    "sdirk": "SDIRK",
    "esdirk": "ESDIRK",
    "diagonally_implicit": "DIRK",
    "fully_implicit": "implicit",
}
WORDS = {
    "l_stable": "L-stable",
    "a_stable": "A-stable",
    "algebraically_stable": "algebraically stable",
    "p_stable": "P-stable",
    "stiffly_accurate": "stiffly accurate",
    "fsal": "FSAL",
    "symplectic": "symplectic",
    "symmetric": "symmetric",
}
OF_HEADINGS = {
    "erk": "explicit",
    "irk": "implicit",
    **dict.fromkeys(("nystrom", "nprk", "derivatives", "rosenbrock", "multirate"), ""),
}
"""The type of a folder that its heading says."""
NARROWER = {"a_stable": "l_stable", "stiffly_accurate": "fsal"}
_EMBEDDED = re.compile(r"^  embedded-order: (\d+)$", re.MULTILINE)
_HEAD = """\
|name|stages|order|properties|error|
|---|---|---|---|---|
"""


def entries() -> list[Entry]:
    """The index, an entry per method, each with the claim on its embedded order."""
    text = (CATALOGUE / "index.json").read_text(encoding="utf-8")
    methods: list[Entry] = json.loads(text)["methods"]
    for entry in methods:
        file = CATALOGUE / "data" / entry["file"]
        claim = _EMBEDDED.search(file.read_text(encoding="utf-8"))
        entry["embedded_order"] = claim[1] if claim else ""
    return methods


def tables(methods: list[Entry]) -> str:
    """A section a folder, a row per method."""
    return "\n".join(_sections(methods))


def _sections(methods: list[Entry]) -> Iterator[str]:
    for folder, heading in FOLDERS.items():
        rows = [x for x in methods if x["file"].startswith(f"{folder}/")]
        if rows:
            lines = "".join(map(_row, rows))
            yield f"## {heading}\n\n{_HEAD}{lines}"


def _row(entry: Entry) -> str:
    stages = "+".join(map(str, _stages(entry)))
    order = str(entry["order"])
    if entry["embedded_order"]:
        order += f"({entry['embedded_order']})"
    if entry["nonautonomous_order"] not in (None, entry["order"]):
        order += f", {entry['nonautonomous_order']} with time"
    if entry["w_order"] is not None:
        order += f", {entry['w_order']} with any matrix"
    error = entry["error_constant"] or ""
    cells = [f"`{entry['name']}`", stages, order]
    cells += [", ".join(_properties(entry)), error]
    return f"|{'|'.join(x.replace('|', '/') for x in cells)}|\n"


def _stages(entry: Entry) -> list[int]:
    """One number where stages are shared."""
    if entry["kind"] in ("rk", "ark", "row", "mri", "rkn", "nprk", "mdrk"):
        return [entry["stages"]]
    found: list[int] = entry["stages_by_colour"]
    return found


def _properties(entry: Entry) -> Iterator[str]:
    """What the method is, the narrower of two words that say the same, beyond its heading."""
    kind = next((word for key, word in TYPES.items() if entry[key]), "")
    if OF_HEADINGS.get(entry["file"].partition("/")[0]) != kind:
        yield kind
    for key, word in WORDS.items():
        narrower = NARROWER.get(key)
        if entry[key] and not (narrower and entry[narrower]):
            yield word
    if not entry["exact"]:
        yield f"±{entry['tolerance']}"
