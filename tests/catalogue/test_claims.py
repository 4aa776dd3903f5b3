"""Methods of the catalogue have what their files claim, the orders that were found elsewhere, and
reports that fit a screen: a sample in the suite, all in ``make whole``.
"""

from __future__ import annotations

import csv
import json
import re
from decimal import Decimal
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from garkcli.check.check_file import check_file
from garkcli.check.outcome import Outcome
from garkcli.frozen import replace
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import load, loads
from garkcli.page.look import Look
from garkcli.page.plaintext import ascii_form
from garkcli.report.check_text import render
from garkcli.report.checked import REPORT
from garkcli.tableau.pointwise import numeric_entries
from tests.report.test_told import latex_faults
from tests.whole import IS_WHOLE, at_most, in_whole, sample

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "garkcli" / "catalogue" / "data"
LONG = {
    *("feagin-14", "ono-12", "sharp-9", "sofroniou-10", "tsitouras-9a", "tsitouras-9b"),
    *("verner-9-robust", "yoshida-8a", "yoshida-8c", "yoshida-8d", "baker-10", "verner-9"),
    *("mclachlan-atela-3", "feagin-12", "feagin-12-misprint", "feagin-10", "curtis-8", "curtis-10"),
    *("mclachlan-ss-17", "yoshida-8b", "yoshida-8e", "stepanov-10", "hairer-10", "ono-10"),
    *("fehlberg-9", "dormand-prince-8", "wso-1254", "wso-1255", "mclachlan-8", "kahan-li-8"),
    *("ark-548", "ark-548b", "dop853", "blanes-moan-srkn-14a", "esdirk-43i6", "rodas6p"),
}
"""Methods of many stages, which take long; they are judged in ``make whole``."""
ALL = {x.name.removesuffix(".gark.yaml"): x for x in sorted(DATA.rglob("*.yaml"))}
MISPRINTED = {
    name: re.findall(r'as in\s+the\s+method\s+"([a-z0-9-]+)"', path.read_text(encoding="utf-8"))
    for name, path in ALL.items()
    if path.parent.name == "errata"
}
"""Files with a misprint, each with the method that is right."""
SAMPLE = {
    *sample([name for name in ALL if name not in LONG], 12),
    *(x for pair in MISPRINTED.items() for x in (pair[0], *pair[1]) if x not in LONG),
}
"""Every twelfth file that does not take long, and those with a misprint."""
FILES = {name: path for name, path in ALL.items() if name in SAMPLE or IS_WHOLE}
TABLE = Path(__file__).parent / "verified_orders.csv"
"""Orders of methods and of their embedded methods, from all trees in 260-bit arithmetic."""
COPIES = {x.name for x in (ROOT / "methods").rglob("*.gark.yaml")}
NO_ROW_SUMS = {"rko65", "feagin-12-misprint", "gauss-2-misprint", "lobatto-iiib-2"}
"""Whose nodes are printed otherwise, so that the order with time is claimed."""


@cache
def outcomes() -> dict[str, Outcome]:
    """What is found of each file, by its name."""
    return {name: replace(check_file(str(x)), file=name, name=name) for name, x in FILES.items()}


@cache
def method_of(name: str) -> MethodFile:
    """A file as it is read."""
    return load(str(ALL[name]))


def alike() -> list[str]:
    """Files whose fingerprint in the index another one has; in ``make whole`` all files."""
    text = (DATA.parent / "index.json").read_text(encoding="utf-8")
    places = sorted((x["fingerprint"], x["name"]) for x in json.loads(text)["methods"])
    pairs = [(x, y) for (p, x), (q, y) in pairwise(places) if q - p < 1e-7]
    return [*ALL] if IS_WHOLE else sorted({name for names in pairs for name in names})


@pytest.fixture(scope="module")
def judged() -> dict[str, Any]:
    """What gark check says of each file as JSON, by its name."""
    return {name: REPORT.data(outcome) for name, outcome in outcomes().items()}


def test_every_claim_holds(judged: dict[str, Any]) -> None:
    """Each file of the catalogue was judged, makes claims, and none fails."""
    assert set(judged) == set(FILES)
    assert [name for name, found in judged.items() if not found["ok"]] == []
    assert [name for name, found in judged.items() if not found["claims"]] == []


def test_all_that_matters_is_claimed(judged: dict[str, Any]) -> None:
    """Files that are not copies of the user's claim order, symplecticity, B, C and D and the kind
    of their stages, or the orders and the stability of Rosenbrock methods, or the orders of
    Nyström and multirate ones; with embedded weights their order, with other nodes the order with time.
    """
    for name, found in judged.items():
        if FILES[name].name in COPIES:
            continue
        keys = {claim["claim"] for claim in found["claims"]}
        if "rosenbrock" in found:
            assert {"order", "w-order", "old-jacobian-order"} <= keys, name
            assert {"nonautonomous-order", "a-stable", "l-stable"} <= keys, name
            assert ("index-1-order" in keys) == (found["index_1_order"] is not None), name
            assert ("embedded-order" in keys) == (found["embedded_order"] is not None), name
            continue
        if "nystrom" in found:
            assert {"order", "position-order", "velocity-order"} <= keys, name
            assert ("embedded-order" in keys) == (found["embedded_order"] is not None), name
            continue
        if "nprk" in found:
            assert "order" in keys, name
            continue
        if "derivatives" in found:
            assert {"order", "a-stable", "l-stable"} <= keys, name
            assert ("embedded-order" in keys) == (found["embedded_order"] is not None), name
            continue
        if "multirate" in found:
            assert {"order", "slow-order", "nonautonomous-order"} <= keys, name
            assert ("embedded-order" in keys) == (found["embedded_order"] is not None), name
            continue
        assert {"order", "symplectic", "B", "C", "D"} <= keys, name
        assert {"explicit", "stage-order", "symmetric"} <= keys, name
        text = FILES[name].read_text(encoding="utf-8")
        has_weights = re.search(r"^ *embedded: ", text, re.MULTILINE)
        assert ("embedded-order" in keys) == bool(has_weights), name
        if name in NO_ROW_SUMS:
            assert "nonautonomous-order" in keys, name


def test_orders_are_those_found_elsewhere(judged: dict[str, Any]) -> None:
    """A computation of its own, over all trees up to the order and one more, in balls of 260 bits
    on the tables as their sources print them; of some collections up to order 9.
    """
    with TABLE.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) > 180
    for row in rows:
        if row["method"] not in FILES:
            continue
        found = judged[row["method"]]
        if row["order"].startswith(">= "):
            assert found["order"] >= int(row["order"].removeprefix(">= "))
        else:
            assert found["order"] == int(row["order"]), row
        if row["embedded order"]:
            embedded = found["embedded_order"]
            assert embedded == int(row["embedded order"]), row


def test_misprinted_tables_have_lost_order(judged: dict[str, Any]) -> None:
    """Each file of errata/ names the method that is right, whose order, or order with time, is
    larger.
    """
    assert MISPRINTED
    for name, (right,) in MISPRINTED.items():
        assert "order" in load(str(ALL[name])).description
        if name not in FILES:
            continue
        bad, good = judged[name], judged[right]
        key = "order" if "nystrom" in bad else "nonautonomous_order"
        assert bad[key] < good[key]


TWINS = [
    {"cash-4-2", "cash-4-3"},  # another embedded method
    {"feagin-12", "feagin-12-misprint"},  # another node
    {"gauss-2", "gauss-2-misprint"},  # another node
    {"rectangular", "rectangular-from-methods"},  # the paper's two ways
]
"""Files whose coefficients are the same, and what is not."""


def test_no_method_is_there_twice() -> None:
    """Up to the order of the stages and 9 digits no two files have the same blocks and weights, but
    for the twins, which differ in something else.
    """
    found: dict[object, set[str]] = {}
    for name in alike():
        method = method_of(name)
        printed = numeric_entries(method.tableau, 15)
        blocks = [_sorted(block) for row in printed.A for block in row]
        weights = [sorted(map(_rounded, row)) for row in printed.b]
        key = str((method.structure, blocks, weights))
        found.setdefault(key, set()).add(name)
    again = [names for names in found.values() if len(names) > 1]
    assert sorted(map(sorted, again)) == sorted(map(sorted, TWINS))
    assert len(found) >= at_most(10, 200)


def _rounded(x: Any) -> float:
    return round(float(x.str(20, radius=False)), 9) + 0.0


def _sorted(block: Any) -> object:
    """What renumbering does not change: rows and columns as sorted lists, and the diagonal."""
    if block is None:
        return None
    rows = [[_rounded(x) for x in row] for row in block]
    columns = [list(column) for column in zip(*rows, strict=True)]
    diagonal = [row[i] for i, row in enumerate(rows) if i < len(row)]
    parts = (map(sorted, rows), map(sorted, columns), diagonal)
    return [sorted(part) for part in parts]


FAMILIES = {
    "dirk/implicit-midpoint": ("gauss", 1),
    "irk/gauss-2": ("gauss", 2),
    "irk/gauss-3": ("gauss", 3),
    "irk/lobatto-iiia-3": ("lobatto-iiia", 3),
    "irk/lobatto-iiia-4": ("lobatto-iiia", 4),
    "irk/lobatto-iiib-3": ("lobatto-iiib", 3),
    "irk/lobatto-iiib-4": ("lobatto-iiib", 4),
    "irk/lobatto-iiic-3": ("lobatto-iiic", 3),
    "irk/lobatto-iiic-4": ("lobatto-iiic", 4),
    "irk/lobatto-iiie-2": ("lobatto-iiie", 2),
    "irk/radau-ia-2": ("radau-ia", 2),
    "irk/radau-iia-2": ("radau-iia", 2),
    "irk/radau-iia-3": ("radau-iia", 3),
    "irk/radau-iib-2": ("radau-iib", 2),
}


@pytest.mark.parametrize("file", FAMILIES)
def test_tables_in_radicals_are_members_of_families(file: str) -> None:
    """The coefficients as printed, against those that follow from the definition, to 30 digits."""
    family, stages = FAMILIES[file]
    text = f"methods: {{family: {family}, stages: {stages}}}\n"
    made, printed = (
        numeric_entries(method.tableau, 30)
        for method in (loads(text), load(str(DATA / f"{file}.gark.yaml")))
    )
    for left, right in ((made.A, printed.A), (made.b, printed.b)):
        assert _digits(left) == _digits(right)


def _digits(cells: Any) -> Any:
    """Numbers in nested tuples to 28 decimals."""
    if isinstance(cells, tuple):
        return [_digits(x) for x in cells]
    return f"{Decimal(cells.str(33, radius=False)):.28f}".replace("-0.0", "0.0")


def test_every_sign_of_the_files_has_an_ascii_form() -> None:
    """Names and references are shown on streams without Greek and accents, too."""
    texts = [file.read_text(encoding="utf-8") for file in ALL.values()]
    signs = {sign for sign in "".join(texts) if not sign.isascii()}
    assert signs
    assert [x for x in signs if set(ascii_form(x)) & {"\\", "?"}] == []


def test_references_say_where_the_digits_are_from() -> None:
    """Each file but those of the paper and what gark found has a reference with fields."""
    folders = {"paper", "found"}
    for name, file in ALL.items():
        if file.parent.name in folders or file.name in COPIES:
            continue
        text = file.read_text(encoding="utf-8")
        assert re.search(r"^  title: \S", text, re.MULTILINE), name
        assert re.search(r"^  coefficients: \S", text, re.MULTILINE), name


@in_whole
def test_publications_have_one_doi() -> None:
    """Most files have the DOI of their publication, without an address, the same in all of them."""
    known: dict[tuple[str, str], set[str]] = {}
    for name in sample([*ALL], 6):
        book = method_of(name).bibliography
        if book:
            known.setdefault((book.title, book.year), set()).add(book.doi)
    assert all(len(dois) == 1 for dois in known.values())
    found = {doi for dois in known.values() for doi in dois if doi}
    assert len(found) >= at_most(10, 65)
    assert [x for x in found if not re.fullmatch(r"10\.\d{4}/\S+", x)] == []


def test_a_method_of_one_colour_fits_a_glance() -> None:
    """At most 12 lines of at most 80 columns each, but for a tree of one word, for such methods of
    the catalogue, of which the first begins with the order; no colour is named.
    """
    count = 0
    for name, outcome in outcomes().items():
        found = outcome.analysis or outcome.of_other_kind
        assert found is not None
        text = render([outcome], Look())
        lines = text.splitlines()
        assert max(len(line) for line in lines if len(line.split()) > 1) <= 80, name
        assert lines[0].startswith(f"{name}: order {found.order.order}"), name
        if outcome.of_other_kind is not None:
            of_one_word = sum(len(line.split()) == 1 for line in lines)
            assert len(lines) <= 16 + of_one_word, name
            continue
        if found.tableau.size > 1:
            continue
        count += 1
        assert len(lines) <= 12, name
        assert "{1" not in text, name
    assert count > at_most(10, 150)


def test_latex_of_every_method_can_be_set() -> None:
    """Braces and dollars are balanced in each line, no special sign is raw, and no sign is there
    that LaTeX lacks.
    """
    for name, outcome in outcomes().items():
        assert list(latex_faults(REPORT.render([outcome], "latex"))) == [], name
