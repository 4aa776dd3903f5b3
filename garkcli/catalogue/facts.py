"""The facts of each method in the index, as found by ``gark check``, and the index of the package.

The index is the same, byte by byte, on every machine.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from garkcli.catalogue.known import fingerprint
from garkcli.check.analysis import AnyAnalysis
from garkcli.check.check_file import check_file
from garkcli.check.claims import found_value
from garkcli.check.outcome import Outcome
from garkcli.comparison.comparison import form_of
from garkcli.constructions.derivatives import Derivatives
from garkcli.errors import GarkError
from garkcli.exact.display import decimal
from garkcli.glossary.key import METHOD_FILE
from garkcli.grammar.nodes import one_line
from garkcli.grammar.reading import read_text
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.expectations import AtLeast
from garkcli.methodfile.folders import SUFFIX
from garkcli.methodfile.load import loads
from garkcli.methodfile.shelves import key_of
from garkcli.ntrees.count import count_trees
from garkcli.order.constants import error_constants
from garkcli.order.meant import as_meant, with_further
from garkcli.properties.registry import KEYS
from garkcli.properties.subject import find
from garkcli.properties.verdict import Size
from garkcli.tableau.tableau import Tableau

Entry = dict[str, Any]
VERSION = 4
"""An index of another version is made anew."""
MOST_TREES = 20_000
"""Most trees of one order over which error coefficients are summed."""
_DIGITS = 4


_ORDERS = (
    *("order", "embedded_order", "conjugate_order", "pair_order", "nonautonomous_order"),
    *("w_order", "index_1_order"),
)
_UNKNOWN: Entry = {
    "name": "",
    "aliases": [],
    "file": "",
    "title": "",
    "reference": "",
    "authors": [],
    "year": "",
    **dict.fromkeys(_ORDERS),
    "stages": None,
    "stages_by_colour": [],
    "colours": None,
    "kind": None,
    "structure": None,
    "exact": None,
    "tolerance": None,
    "embedded": None,
    "dense": None,
    "error_constant": None,
    "symplectic": None,
}


def blank() -> Entry:
    return {**_UNKNOWN, **{find(key).field: None for key in KEYS}, "undecided": []}


class NoMethod(GarkError):
    """A file of the catalogue that is not a method, or fails its claims."""


def digest(text: str) -> str:
    return hashlib.sha256(text.replace("\r\n", "\n").encode("utf-8")).hexdigest()[:16]


def entry_of(path: str, name: str, file: str, text: str) -> Entry:
    """The entry of a file, by its path in the catalogue; NoMethod also if a claim fails."""
    outcome = check_file(path)
    analysis = outcome.analysis or outcome.of_other_kind
    if analysis is None or not outcome.ok:
        raise NoMethod(f"{path}: {_what_fails(outcome)}", code="other-file")
    found = found_of(loads(text, path), analysis, name, file)
    return {**found, "digest": digest(text), "fingerprint": fingerprint(analysis.tableau)}


def found_of(method: MethodFile, analysis: AnyAnalysis, name: str, file: str) -> Entry:
    values: Entry = {"symplectic": found_value("symplectic", analysis)}
    open_ones = []
    for key in KEYS:
        field = find(key).field
        verdict = analysis.subject.verdict(key)
        is_open = verdict.is_undecided or verdict.is_at_least
        value = None if is_open else verdict.value
        values[field] = str(value) if isinstance(value, Size) else value
        if is_open:
            open_ones.append(field)
    return {
        **head(method, name, file),
        **{key: _order(key, analysis) for key in _ORDERS},
        **shape(method),
        "error_constant": _error_constant(analysis),
        **values,
        "undecided": open_ones,
    }


def _what_fails(outcome: Outcome) -> str:
    if outcome.faults:
        return outcome.faults[0].message
    if outcome.analysis is None and outcome.of_other_kind is None:
        return "it has free parameters"
    failing = [claim for claim in outcome.claims if not claim.holds]
    return "; ".join([f"{x.claim}: expected {x.expected}, found {x.found}" for x in failing])


def head(method: MethodFile, name: str, file: str) -> Entry:
    book = method.bibliography
    return {
        "name": name,
        "aliases": list(method.aliases),
        "file": file,
        "title": "" if method.name == method.source else method.name,
        "reference": one_line(method.reference),
        "authors": list(book.authors) if book else [],
        "year": book.year if book else "",
    }


def shape(method: MethodFile) -> Entry:
    tableau = method.tableau
    kind = _kind(tableau)
    # of these kinds several colours are one vector field: it and its Jacobian, or its arguments
    fields = {"row": tableau.size // 2, "rkn": 1, "nprk": 1}.get(kind, tableau.size)
    colours = tableau.colours[:fields]
    # collocation stands for an exact solution, which has no stages
    told = colours[1:] if kind == "mri" else colours
    stages = [tableau.spaces[colour.space].stages for colour in told]
    rounding = method.tolerance
    if kind == "mdrk":
        stages = [len(Derivatives.of(tableau).nodes)]
    return {
        "stages": max(stages),
        "stages_by_colour": stages,
        "colours": len(colours),
        "kind": kind,
        "structure": method.structure,
        "exact": rounding is None,
        "tolerance": None if rounding is None else decimal(rounding),
        "embedded": method.embedded is not None,
        "dense": method.dense is not None,
    }


def _kind(tableau: Tableau) -> str:
    return "prk" if tableau.is_partitioned else form_of(tableau)


def _order(key: str, analysis: AnyAnalysis) -> object:
    found = found_value(key.replace("_", "-"), analysis)
    return found.least if isinstance(found, AtLeast) else found


def _error_constant(analysis: AnyAnalysis) -> str | None:
    """The rounded norm of the principal error; None for too many trees."""
    order = analysis.order
    if order.is_lower_bound or count_trees(analysis.tableau.size, order.order + 1) > MOST_TREES:
        return None
    constants = error_constants(analysis.tableau, order.order + 1)
    if constants is None:
        return None
    return f"{constants.all.two:.{_DIGITS}g}"


Tell = Callable[[str], None]


def method_files(data: Path) -> list[tuple[str, Path]]:
    """Names and paths; NoMethod if two have the same name or a name is not well-formed."""
    paths: dict[str, Path] = {}
    for path in data.rglob(f"*{SUFFIX}"):
        name = path.name.removesuffix(SUFFIX)
        if name != key_of(name):
            cure = f"{key_of(name)}{SUFFIX} would be its name"
            raise NoMethod(f"{path} is not named as methods are", cure, code="name-taken")
        if name in paths:
            message = f"{paths[name]} and {path} have one name"
            raise NoMethod(message, "keep one of them, or rename it", code="name-in-doubt")
        paths[name] = path
    return sorted(paths.items())


def made(data: Path, before: str, tell: Tell) -> str:
    """The text of the index; entries of ``before`` stay if their files do; NoMethod for a fault."""
    known = _known(before)
    entries = []
    for name, path in method_files(data):
        text, _ = read_text(str(path), METHOD_FILE)
        file = path.relative_to(data).as_posix()
        entry = known.get((file, digest(text)))
        if entry is None:
            tell(name)
            entry = entry_of(str(path), name, file, text)
        entries.append(entry)
    return "".join(_text(entries))


def _known(before: str) -> dict[tuple[str, str], Entry]:
    index: dict[str, Any] = json.loads(before) if before else {}
    if index.get("facts") != VERSION:
        return {}
    fields = {*blank(), "fingerprint"}
    return {(x["file"], x["digest"]): x for x in index["methods"] if x.keys() >= fields}


def _text(entries: list[Entry]) -> Iterator[str]:
    # one entry per line, so that diffs are short
    yield f'{{"facts": {VERSION}, "methods": ['
    for number, entry in enumerate(entries):
        yield ",\n" if number else "\n"
        yield json.dumps(entry, ensure_ascii=True)
    yield "\n]}\n"


def recovered(data: Path, before: dict[str, dict[str, Any]], index: str) -> str:
    """The text of ``order/recovered.json``; entries of ``before`` stay if their files do."""
    known = {(x["method"], x["digest"]): (key, x) for key, x in before.items()}
    entries = _known(index).items() if before else ()
    exact = {(Path(file).name, text) for (file, text), entry in entries if entry["exact"]}
    found: dict[str, dict[str, Any]] = {}
    for name, path in method_files(data):
        text, _ = read_text(str(path), METHOD_FILE)
        one = known.get((name, digest(text)))
        if one is None and (path.name, digest(text)) not in exact:
            one = _recovered_of(str(path), name, text)
        if one is not None:
            found.setdefault(*one)
    lines = [f"{json.dumps(key)}: {json.dumps(x)}" for key, x in found.items()]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _recovered_of(path: str, name: str, text: str) -> tuple[str, dict[str, Any]] | None:
    rounded = with_further(as_meant(loads(text, path)))
    if rounded is None:
        return None
    key, data = rounded.search.kept
    return key, {"method": name, "digest": digest(text), **data}


def update_copies(data: Path, copies: Path) -> Iterator[Path]:
    originals = dict(method_files(data))
    for copy in sorted(copies.rglob(f"*{SUFFIX}")):
        original = originals.get(copy.name.removesuffix(SUFFIX))
        if original is None:
            continue
        content = original.read_bytes()
        if copy.read_bytes() != content:
            copy.write_bytes(content)
            yield copy
