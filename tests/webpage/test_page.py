"""The page of ``gark report``: well-formed, without a network, harmless, and saying what the other
reports say.
"""

from __future__ import annotations

import json
import re
from base64 import b64encode
from collections.abc import Iterator
from functools import cache
from hashlib import sha256
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element

import pytest
from hypothesis import given, settings, strategies

import garkcli
from garkcli.check.check_file import check_file
from garkcli.errors import MethodError, printable
from garkcli.frozen import replace
from garkcli.glossary.faults import cure_of
from garkcli.order.admissible import count_conditions
from garkcli.page.safety import written_out
from garkcli.properties.registry import KEYS
from garkcli.report.checked import REPORT
from garkcli.webpage import page as page_module
from garkcli.webpage import reported as reported_module
from garkcli.webpage.page import SECTIONS, render, report_page
from garkcli.webpage.pictures import Picture
from garkcli.webpage.reported import Reported, reported
from garkcli.webpage.sections import pictures, properties, stability
from tests.cli.harness import ROOT, gark
from tests.webpage.reading import by_id, elements, name_of, number_of, read, rows_of, text_of
from tests.whole import in_whole

VERLET = "methods/stoermer-verlet.gark.yaml"
PAIRED = "methods/collocation.gark.yaml"
RECTANGULAR = "methods/rectangular.gark.yaml"
DENSE = "tests/examples/valid/embedded-and-dense.gark.yaml"
ROUNDED = "tests/examples/valid/rounded.gark.yaml"
MULTIRATE = "tests/examples/valid/constructions-multirate.gark.yaml"
FAMILY = "tests/examples/families/sdirk.gark.yaml"
FAILING = "tests/examples/failing/collocation-misprinted.gark.yaml"
UNREADABLE = "tests/examples/invalid/many-faults.gark.yaml"
METHODS = ["rk4", RECTANGULAR, VERLET, DENSE, ROUNDED, MULTIRATE]
"""Of one colour, of two, for positions and momenta, with more weights, rounded, made of others."""
OF_OTHER_KINDS = {
    "ros3p": 12,
    "grk4t": 12,
    "mri-gark-erk33a": 5,
    "fine-34": 6,
    "nystrom-4-positions": 3,
}
"""How many orders each has."""
"""Rosenbrock methods, exact and rounded, and a multirate one with the exact fast part."""
ALL = [*METHODS, FAMILY, FAILING, UNREADABLE, *OF_OTHER_KINDS]
HOSTILE = """<script>alert(1)</script>"><img src=x onerror=alert(2)></style></title>{{ 7*7 }}"""


@cache
def text(*methods: str) -> str:
    """The whole page of some methods, with few conditions and no picture."""
    return report_page(*methods, order=2, pictures=False, details=True)


@cache
def page(*methods: str) -> Element:
    """The same, read."""
    return read(text(*methods))


@cache
def checked(method: str) -> dict[str, Any]:
    """What ``gark check --format json`` says of a method."""
    (found,) = REPORT.document([check_file(method)])["files"]
    data: dict[str, Any] = found
    return data


def section(method: str, name: str) -> Element:
    """A section of the page of one method."""
    return by_id(page(method), f"m1-{name}")


@in_whole
@pytest.mark.parametrize("method", ALL)
def test_what_is_read_aloud_is_in_order(method: str) -> None:
    """The page is well-formed; one heading of the first level and none left out below it; each name
    once, and what is referred to is there; tables have captions and their heads a scope, pictures
    a title, boxes that scroll a name.
    """
    root = page(method)
    ids = [x.get("id") for x in elements(root) if x.get("id")]
    assert len(ids) == len(set(ids))
    levels = [int(name_of(x)[1]) for x in elements(root, *HEADINGS)]
    assert levels.count(1) == 1
    assert levels[0] == 1
    assert all(b <= a + 1 for a, b in pairwise(levels))
    for landmark in ("header", "nav", "main", "footer"):
        assert len([*elements(root, landmark)]) == 1
    for element in elements(root):
        labels = (element.get("aria-labelledby") or "").split()
        assert set(labels) <= set(ids)
        if element.get("role") == "group":
            assert element.get("aria-label")
    for head in elements(root, "th"):
        assert head.get("scope") in ("col", "row", "colgroup", "rowgroup")
    for table in elements(root, "table"):
        assert name_of(table[0]) == "caption"
        assert text_of(table[0])
    for picture in elements(root, "svg"):
        if picture.get("aria-hidden") != "true":
            assert picture.get("role") == "img"
            assert name_of(picture[0]) == "title"
            assert text_of(picture[0])


HEADINGS = ("h1", "h2", "h3", "h4", "h5", "h6")


@pytest.mark.parametrize("method", ALL)
def test_nothing_is_fetched(method: str) -> None:
    """What a page refers to is within it, but for links to the publication; the policy in its head
    forbids the rest, and allows the one script that it has, to the letter.
    """
    root = page(method)
    ids = {x.get("id") for x in elements(root)}
    for element in elements(root):
        for key, value in element.attrib.items():
            word = key.rpartition("}")[2]
            assert word not in ("src", "srcset", "action", "data", "style")
            assert not word.startswith("on")
            if word == "href" and value.startswith("#"):
                assert value[1:] in ids
            elif word == "href":
                assert name_of(element) == "a"
                assert value.startswith(("https://", "http://"))
    (style,) = elements(root, "style")
    assert not re.search(r"url\(|@import|</", style.text or "")
    (script,) = elements(root, "script")
    digest = b64encode(sha256((script.text or "").encode()).digest())
    (policy,) = [x.get("content") or "" for x in elements(root, "meta") if x.get("http-equiv")]
    assert "default-src 'none'" in policy
    assert f"script-src 'sha256-{digest.decode()}'" in policy


def test_the_same_method_has_the_same_page() -> None:
    """To the letter, and nothing in it has to be written out for a terminal."""
    again = report_page(DENSE, order=2, pictures=False, details=True)
    assert again == text(DENSE)
    assert written_out(again, "html") == again


@pytest.mark.parametrize("method", METHODS)
def test_orders_are_those_of_the_check(method: str) -> None:
    """Each with its number, its tree drawn and written, and how far off its condition is."""
    data = checked(method)
    found = {}
    for card in section(method, "orders").iter("div"):
        if (card.get("class") or "").startswith("order "[:5]) and (card.get("class") != "orders"):
            (head,) = elements(card, "h3")
            number = text_of(next(elements(head, "strong")))
            found[text_of(head).removesuffix(number).replace("order", "").strip()] = number, card
    for prefix in ("", "conjugate", "pair", "embedded", "dense"):
        number = data[f"{prefix}_order".lstrip("_")]
        if number is None:
            assert found.get(prefix, ("none",))[0] == "none"
            continue
        if prefix in ("conjugate", "pair") and method == "rk4":
            assert prefix not in " ".join(found)
            continue
        shown, card = found["symplectic pair" if prefix == "pair" else prefix]
        bound = data.get(f"{prefix}_order_is_lower_bound".lstrip("_"))
        near = data.get(f"{prefix}_order_tolerance".lstrip("_"))
        known = f"at least {number}" if bound else str(number)
        assert shown == (f"{known} within {near}" if near else known)
        witness = data.get(f"{prefix}_witness".lstrip("_"))
        if witness is not None:
            said = text_of(card)
            tree = witness["tree"]
            assert tree in said or tree.replace("_1", "") in said or "fails as above" in said
    exact = data["tolerance"] is None
    assert ("proved" in text_of(section(method, "orders"))) == exact
    if data["symplectic"]:
        near = "" if exact else f" within {data['tolerance']}"
        assert f" Symplectic{near}." in text_of(page(method))
    if not exact:
        assert f"within {data['tolerance']}" in text_of(found[""][1])


@pytest.mark.parametrize("method", OF_OTHER_KINDS)
def test_methods_of_other_kinds_have_pages(method: str) -> None:
    """Every order that the check finds is there, with its number and the names of its tree; the
    conditions are those of their command; what such methods do not have is left out.
    """
    data, found = checked(method), section(method, "orders")
    cards = [x for x in elements(found, "div") if x.get("class") in ("order", "order main")]
    orders = [key for key in data if key.endswith("order") and data[key] is not None]
    assert len(orders) == len(cards) == OF_OTHER_KINDS[method]
    near = data["tolerance"]
    numbers = [text_of(next(elements(x, "strong"))) for x in elements(found, "h3")]
    told = [f"{data[key]} within {near}" if near else str(data[key]) for key in orders]
    assert sorted(numbers) == sorted(told)
    said = text_of(found)
    if "w_order" in data:
        assert "colour 1 is f, 3 is E" in said
        assert "]_g, order " in said
        assert "condition " not in said  # blocks of W, E and g have no names
    run = json.loads(gark("conditions", method, "--order", "2", "--format", "json").out)
    (table,) = elements(section(method, "conditions"), "table")
    lines = [*elements(next(elements(table, "tbody")), "tr")]
    assert [x.get("data-root") for x in lines] == [str(x["root"]) for x in run["conditions"]]
    is_stable = "w_order" in data or method == "nystrom-4-positions"
    names = [text_of(x) for x in elements(page(method), "h2")]
    has = {"Simplifying assumptions": False, "Stability": is_stable, "Tableau": True}
    for title, is_there in has.items():
        assert any(x.startswith(title) for x in names) == is_there


def test_a_rosenbrock_method_has_its_arrays_and_its_region() -> None:
    """α and γ under their names, the first with the embedded weights; R(z) drawn, and no steps. A
    multirate method with the exact fast part has the tableau of its slow method and no picture.
    """
    tables = [*elements(section("ros3p", "tableau"), "table")]
    titles = [text_of(x) for x in elements(section("ros3p", "tableau"), "h3")]
    assert titles == ["α, with c and b", "γ, with d, the weights of ∂f/∂t, in place of A and c"]
    weights, more = ([*elements(next(elements(t, "tfoot")), "tr")] for t in tables)
    assert [number_of(x) for x in [*elements(weights[1], "math")][1:]] == ["(1)/(3)"] * 3
    assert (len(weights), len(more)) == (2, 1)
    corner = next(elements(next(elements(tables[1], "tbody")), "math"))
    assert number_of(corner) == "(1)/(2)+((sqrt(3)))/(6)"
    assert "m1-picture-oscillator" in report_page("nystrom-4", order=1)
    drawn = read(report_page("ros3p", "mri-gark-erk33a", "rk4", order=1))
    names = [x.get("id") or "" for x in elements(drawn, "figure")]
    assert [x for x in names if x.startswith("m1")] == ["m1-picture-region"]
    assert not [x for x in names if x.startswith("m2")]
    assert "m3-pictures-convergence" in names
    (compared,) = [x for x in elements(drawn, "table") if "method" in text_of(x[0])][:1]
    rows = [[text_of(x) for x in row] for row in rows_of(compared)]
    assert [row[2] for row in rows] == ["3", "3", "4"]
    assert [row[-1] for row in rows] == ["3", "3", "4"]
    method = garkcli.load("ros3p")
    assert "index 1" in report_page(replace(method, name="mine"), order=1, pictures=False)


def test_every_dot_is_drawn(tmp_path: Path) -> None:
    """Trees with time have a colour more than the method."""
    file = tmp_path / "shifted.gark.yaml"
    file.write_text("A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\nc: [0, 1/2]\n")
    root = read(report_page(str(file), order=1, pictures=False))
    ids = {x.get("id") for x in elements(root)}
    used = {x.get("href") or "" for x in elements(root, "use")}
    assert {x.removeprefix("#") for x in used} <= ids
    assert "#dot2" in used


def test_the_witness_is_exact() -> None:
    """Value, required and residual of the classical method, as numbers in MathML."""
    witness = checked("rk4")["witness"]
    numbers = [number_of(x) for x in elements(section("rk4", "orders"), "math")]
    assert numbers[2:5] == ["0", "(1)/(120)", "-(1)/(120)"]
    assert witness["residual"] == "-1/120"


@pytest.mark.parametrize("method", ["rk4", "gauss-2", "dormand-prince-5"])
def test_the_tableau_can_be_read_back(method: str) -> None:
    """Its entries in MathML make the method again, exactly: A, b and c."""
    table = next(elements(section(method, "tableau"), "table"))
    (body,) = elements(table, "tbody")
    rows = [[number_of(x) for x in elements(row, "math")] for row in elements(body, "tr")]
    nodes = [row[0] for row in rows]
    weights = [
        number_of(x)
        for x in next(elements(table, "tfoot")).findall("tr")[0].iter()
        if name_of(x) == "math"
    ]
    made = garkcli.from_arrays([row[1:] for row in rows], weights[1:], nodes)
    wanted = garkcli.load(method)
    assert str((made.A, made.b, made.c)) == str((wanted.A, wanted.b, wanted.c))


def test_blocks_have_their_places() -> None:
    """A method for positions and momenta is Q and P; colours have names and numbers, blocks that do
    not exist are blank; the dense output and the embedded weights are there.
    """
    captions = [text_of(x) for x in elements(section(RECTANGULAR, "tableau"), "caption")]
    assert [caption[0] for caption in captions] == ["Q", "P"]
    heads = [
        text_of(x)
        for x in elements(section(RECTANGULAR, "tableau"), "th")
        if x.get("scope") == "colgroup"
    ]
    assert heads == ["1 q", "2 p"]
    dense = section(DENSE, "tableau")
    degree = len(checked(DENSE)["colours"])
    assert degree == 1
    stages = checked(DENSE)["colours"][0]["stages"]
    formulas = next(elements(dense, "ul"))
    assert len([*elements(formulas, "li")]) == stages
    (first, *_) = elements(dense, "tfoot")
    assert len(first.findall("tr")) == 2


@pytest.mark.parametrize("method", METHODS)
def test_simplifying_assumptions_are_those_of_the_check(method: str) -> None:
    """B, C and D, cell by cell: the number stands in the cell."""
    data = checked(method)["simplifying"]
    tables = [*elements(section(method, "simplifying"), "table")]
    for table, wanted in zip(tables, ([data["B"]], data["C"], data["D"]), strict=True):
        shown = [[text_of(x) for x in row if name_of(x) == "td"] for row in rows_of(table)]
        numbers = [["–" if n is None else str(n) for n in row] for row in wanted]
        assert [[cell.removeprefix("≥ ") for cell in row] for row in shown] == numbers
    assert f"order at least {data['bound']}, from min{{r, 2η+2" in text_of(
        section(method, "simplifying")
    )


@pytest.mark.parametrize("method", [*METHODS, FAILING, FAMILY])
def test_claims_are_those_of_the_check(method: str) -> None:
    """What is claimed, what is found, and whether it holds, row by row."""
    claims = checked(method)["claims"]
    shown = section(method, "claims")
    if not claims:
        assert "claims nothing" in text_of(shown)
        return
    (table,) = elements(shown, "table")
    rows = [[text_of(cell) for cell in row] for row in rows_of(table) if len(row) > 1]
    assert rows == [
        [
            claim["claim"],
            claim["expected"],
            claim["found"],
            "holds" if claim["holds"] else "fails",
            str(claim["line"]),
        ]
        for claim in claims
    ]


@in_whole
def test_an_undecided_claim_is_no_failed_one(tmp_path: Path) -> None:
    """Rounding leaves a sign open: the heading, the table and the comparison say so."""
    path = tmp_path / "open.gark.yaml"
    text = "A: [[0.167, 3.333], [-1.333, 0.333]]\nb: [0.333, 0.667]\ntolerance: 1e-3\n"
    path.write_text(f"{text}expect: {{p-stable: true, order: 2}}\n", encoding="utf-8")
    outcome = check_file(str(path))
    assert page_module.claims_text(outcome) == "Of its 2 claims, 1 is undecided."
    assert page_module.comparison_row(reported(str(path)))["mark"] == "open"
    shown = section(str(path), "claims")
    classes = {x.get("class") for x in elements(shown, "span")}
    assert {"sign holds", "sign open"} <= classes
    assert "sign fails" not in classes
    made = [x.get("class") for x in elements(page(str(path)), "div")]
    assert "head open" in made


@pytest.mark.parametrize("method", [*METHODS, FAILING, FAMILY])
def test_conditions_are_those_of_their_command(method: str) -> None:
    """Tree, order, γ, σ and verdict of each row, which the filters look at too."""
    run = gark("conditions", method, "--order", "2", "--format", "json")
    wanted = json.loads(run.out)["conditions"]
    shown = section(method, "conditions")
    (table,) = elements(shown, "table")
    lines = [*elements(next(elements(table, "tbody")), "tr")]
    assert len(lines) == len(wanted)
    states = set()
    for line, row, one in zip(lines, rows_of(table), wanted, strict=True):
        cells = [text_of(cell) for cell in row]
        tree = one["tree"]
        if len(garkcli_colours(method)) == 1:
            tree = tree.replace("_1", "")
        assert tree in cells[0]  # the title of the picture
        assert cells[3].removesuffix(" times").startswith(tree)
        assert cells[2] == str(one["order"]) == line.get("data-order")
        assert cells[-2:] == [str(one["gamma"]), str(one["sigma"])]
        assert line.get("data-root") == str(one["root"])
        assert (cells[1] in ("holds", "within")) == one["holds"]
        assert line.get("data-state") == cells[1]
        states.add(cells[1])
    form = next(elements(shown, "form"))
    assert form.get("hidden") is not None
    assert form.get("data-table") == table.get("id")
    choices = {text_of(x) for x in elements(form, "option")}
    assert states <= choices
    (count,) = elements(form, "output")
    assert count.get("aria-live") == "polite"


def garkcli_colours(method: str) -> list[object]:
    """The colours of a method."""
    colours: list[object] = checked(method)["colours"]
    return colours


def test_a_large_table_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whole orders as long as there is room; of the next one it is told how many are left out, and
    what lists them.
    """
    monkeypatch.setattr(page_module, "MOST_ROWS", 10)
    root = read(report_page(VERLET, order=4, pictures=False))
    shown = by_id(root, "m1-conditions")
    tableau = garkcli.load(VERLET).tableau
    count = [count_conditions(tableau, n) for n in (1, 2, 3, 4)]
    fitting = sum(sum(count[:n]) <= 10 for n in (1, 2, 3, 4))
    assert 0 < fitting < 4
    (table,) = elements(shown, "table")
    assert len(rows_of(table)) == sum(count[:fitting])
    said = text_of(shown)
    assert f"The {count[fitting]} of order {fitting + 1} and all later ones are left out" in said
    assert f"gark conditions {VERLET} --only" in said


@pytest.mark.parametrize("method", METHODS)
def test_properties_are_those_of_the_check(method: str) -> None:
    """The answers of the report in JSON, and why."""
    report = checked(method)
    data = report["properties"]
    answers = {True: "yes", False: "no"}
    table = next(elements(section(method, "properties"), "table"))
    shown = {text_of(row[0]): text_of(row[1]) for row in rows_of(table)}
    for key, answer in shown.items():
        value = data.get(key.replace("-", "_"))
        known, _, near = answer.partition(" within ")
        if value is not None and near:
            assert near == report["tolerance"], key
            answer = known
        if isinstance(value, bool):
            assert answer == answers[value], key
        elif isinstance(value, int):
            assert answer.removeprefix("at least ") == str(value), key
    assert len(shown) == len(KEYS)
    said = text_of(section(method, "properties"))
    assert f"symplectic {answers[data['symplectic']]}" in said


@in_whole
def test_a_family_is_told_for_every_value() -> None:
    """Entries are rational functions, conditions vary, and it is said where the order is higher."""
    assert "Order 2 for every value of g." in text_of(page(FAMILY))
    orders = text_of(section(FAMILY, "orders"))
    assert "; order 3 where 6*g^2 - 6*g + 1 = 0" in orders
    names = {text_of(x) for x in elements(section(FAMILY, "tableau"), "mi")}
    assert "g" in names
    for name in ("stability", "pictures"):
        said = text_of(section(FAMILY, name))
        assert f"gark report --set g=… {FAMILY}" in said
    further = read(report_page(FAMILY, order=3))
    varying = text_of(by_id(further, "m1-conditions"))
    assert "2 of them do not hold for every value" in varying
    assert "varies" in varying


def test_a_file_that_is_no_method_has_its_faults() -> None:
    """Each with its place, the line and the cure."""
    shown = section(UNREADABLE, "faults")
    outcome = check_file(UNREADABLE)
    faults = [*elements(shown, "li")]
    assert len(faults) == len(outcome.faults) > 1
    for item, fault in zip(faults, outcome.faults, strict=True):
        said = text_of(item)
        assert f"line {fault.line}, column {fault.column}" in said
        assert " ".join(fault.message.split()) in said
        assert " ".join(fault.help.split()) in said


@in_whole
def test_several_methods_are_compared() -> None:
    """A row each, with a link to its part; the parts have the sections of single pages."""
    root = page("rk4", RECTANGULAR, FAMILY)
    assert text_of(next(elements(root, "h1"))) == "3 methods"
    table = next(elements(by_id(root, "comparison"), "table"))
    rows = [[text_of(cell) for cell in row] for row in rows_of(table)]
    assert [row[1] for row in rows] == ["2 hold", "2 hold", "none"]
    assert [row[2] for row in rows] == ["4", "4", "2 for every value"]
    assert [row[-1] for row in rows] == ["4", "2, 3", "2"]
    links = [x.get("href") for x in elements(table, "a")]
    assert links == ["#m1", "#m2", "#m3"]
    alone = text_of(section(RECTANGULAR, "orders"))
    together = text_of(by_id(root, "m2-orders"))
    assert together == alone.replace("Orders", "Orders the rectangular method", 1)


HOSTILE_FILE = f"""
name: '{HOSTILE}'
description: '{HOSTILE}'
reference:
  authors: ['{HOSTILE}']
  title: '{HOSTILE}'
  year: "1901"
  doi: 'javascript:alert(3)"'
  url: 'javascript:alert(4)'
  note: '{HOSTILE}'
  coefficients: '{HOSTILE}'
methods:
  - {{name: '{HOSTILE}', A: [[0, 0], [1, 0]], b: [1/2, 1/2]}}
  - {{name: 'a', A: [[1/2]], b: [1]}}
transfer: {{blocks: {{"1,2": [[0], [1]], "2,1": [[1/2, 0]]}}}}
"""


@in_whole
def test_texts_of_strangers_are_texts(tmp_path: Path) -> None:
    """A name, a description, a reference, a path: none of them becomes an element, an attribute, a
    template or a link to a script, and all of them can be read.
    """
    folder = tmp_path / "<b onclick=alert(5)>"
    folder.mkdir()
    file = folder / "'&lt;<u>.gark.yaml"
    file.write_text(HOSTILE_FILE, encoding="utf-8")
    root = read(report_page(file, "rk4", order=2, pictures=False))
    for name in ("script", "style"):
        assert len([*elements(root, name)]) == 1
    assert [*elements(root, "img", "b", "u")] == []
    for element in elements(root):
        for key, value in element.attrib.items():
            assert not key.startswith("on")
            assert not value.startswith("javascript:")
    said = text_of(root)
    assert said.count(HOSTILE) >= 4
    assert "49" not in text_of(by_id(root, "m1-title"))
    assert str(file) in said


class Tags(HTMLParser):
    """The elements of a page by their names, and its title."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.title = ""

    def handle_starttag(self, tag: str, attrs: object) -> None:  # noqa: ARG002 -- given by the class above
        self.tags.append(tag)

    def handle_data(self, data: str) -> None:
        if self.tags and self.tags[-1] == "title" and not self.title:
            self.title = data

    def of(self, name: str) -> Tags:
        """Of the page of a method that is called so."""
        known = found_once()
        outcome = replace(known.outcome, name=name)
        self.feed(render([replace(known, outcome=outcome)], has_details=True))
        return self


@cache
def found_once() -> Reported:
    """What is found of a small method."""
    return reported(garkcli.load("euler").conjugate, 1, has_pictures=False)


@in_whole
@settings(max_examples=10, deadline=None)
@given(strategies.text(min_size=1, max_size=40))
def test_any_name_is_text(name: str) -> None:
    """Whatever a method is called, the page has the same elements, and its title is the name."""
    found = Tags().of(name)
    assert found.tags == Tags().of("plain").tags
    assert found.title == f"{printable(name)} – gark report"


def test_signs_that_cannot_be_seen_are_written_out() -> None:
    """Controls and letters that turn the direction of writing show as what they are."""
    method = replace(garkcli.load("euler").conjugate, name="a\u202eb\x07c")
    root = read(report_page(method, pictures=False))
    assert text_of(next(elements(root, "h1"))) == r"a\u202eb\x07c"


def test_methods_without_files_have_pages() -> None:
    """A conjugate, and arrays: what there is to say of them is said."""
    conjugated = garkcli.load("rk4").conjugate
    arrays = ([[0, 0], [1, 0]], ["1/2", "1/2"])
    root = read(report_page(conjugated, arrays, pictures=False))
    orders = [text_of(by_id(root, f"m{k}-orders")) for k in (1, 2)]
    assert orders[0].startswith(f"Orders {conjugated.name} order 4 4, proved")
    assert orders[1].startswith("Orders <arrays> order 2 2, proved")
    with pytest.raises(MethodError, match="at least one"):
        report_page()


@in_whole
def test_exit_codes_are_those_of_the_check(tmp_path: Path) -> None:
    """0, 1 where a claim fails, 2 where a file is no method; the page is written each time, and the
    faults are told on stderr too, or that a claim fails.
    """
    for method, code in (("rk4", 0), (FAILING, 1), (UNREADABLE, 2)):
        target = tmp_path / "page.html"
        run = gark("report", method, "--no-pictures", "-n", "2", "-o", str(target))
        assert (run.code, run.out) == (code, "")
        assert ("error" in run.err) == (code == 2)
        assert (f"{method}: a claim fails, see the page\n" in run.err) == (code == 1)
        written = target.read_text(encoding="utf-8")
        assert written == report_page(method, order=2, pictures=False)
    run = gark("report", FAMILY, "--set", "g=1/4", "--no-pictures", "-n", "1", "-o", "-")
    assert run.code == 0
    assert "decided in rational arithmetic" in run.out
    assert gark("report", "rk4", FAMILY, "--set", "g=1/4", "-o", "-").code == 2


def test_a_section_is_a_file_with_its_template() -> None:
    """Every file of the folder is in the list, under its name, and no template is left over."""
    room = ROOT / "garkcli" / "webpage"
    files = {x.stem for x in (room / "sections").glob("*.py")} - {"__init__"}
    assert files == set(SECTIONS)
    shared = {"page", "head", "contents", "comparison"}
    templates = {x.stem for x in (room / "templates").glob("*.html")}
    assert templates == files | shared


def test_hints_are_those_of_the_check() -> None:
    """What the failing conditions of a misprinted method tell, with code and cure."""
    printed = " ".join(gark("check", FAILING).out.split())
    told = [text_of(x) for x in elements(section(FAILING, "remarks"), "p")]
    assert told
    for hint, cure in zip(told[::2], told[1::2], strict=True):
        code, _, text = hint.partition(" ")
        assert f" hint {text}" in printed
        assert cure == cure_of("check", code)


@in_whole
def test_stability_is_that_of_its_command() -> None:
    """Each fact as it is printed, usually or with details, and the stability function typeset."""
    runs = [gark("stability", RECTANGULAR, "rk4", *more).out for more in ([], ["-v"])]
    printed = " ".join(" ".join(runs).split())
    for method in (RECTANGULAR, "rk4"):
        shown = section(method, "stability")
        facts = [[text_of(x) for x in elements(shown, tag)] for tag in ("dt", "dd")]
        assert len(facts[0]) > 4
        for label, fact in zip(*facts, strict=True):
            answer = f": {label}" if fact == "yes" else f": not {label}{fact.removeprefix('no')}"
            assert f"{label} {fact}" in printed or answer in printed, (label, fact)
    heads = [
        text_of(x) for x in elements(section("methods/collocation.gark.yaml", "stability"), "h3")
    ]
    assert heads == ["colour 1 alone", "colour 2 alone"]
    formula = next(elements(section("rk4", "stability"), "math"))
    assert text_of(formula) == "R(z)=z4+4z3+12z2+24z+2424"


@pytest.mark.parametrize("method", [*ALL, "methods/collocation.gark.yaml"])
def test_formulas_are_typeset(method: str) -> None:
    """No power, root or exact fraction stands among the words: what is quoted is code, the entry
    for BibTeX, and what the file says in words.
    """
    main = next(elements(page(method), "main"))
    said = " ".join(_outside(main, {"math", "code", "pre", "title", "svg"}))
    found = re.findall(r"\w\^\d|sqrt\(|\w\*\w|[−-]?\b\d+/\d+\b|[²∞√ωηζ]", said)
    assert method == UNREADABLE or found == [], said


def _outside(element: Element, names: set[str]) -> Iterator[str]:
    """The texts that stand in none of some elements."""
    if name_of(element) not in names:
        yield element.text or ""
        for part in element:
            yield from _outside(part, names)
            yield part.tail or ""


@in_whole
def test_what_takes_long_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of many stages with rounded coefficients the page says which command decides their
    stability; rational ones are decided.
    """
    monkeypatch.setattr(reported_module, "MOST_STAGES", 1)
    slow = replace(reported(ROUNDED), has_details=True)
    assert slow.is_slow
    assert not reported("rk4").is_slow
    content = stability.content(slow)
    assert content is not None
    assert "parts" not in content
    shown = read(report_page(ROUNDED, order=1, pictures=False))
    said = text_of(by_id(shown, "m1-stability"))
    assert f"takes long for this method: gark stability {ROUNDED}" in said
    left_out = properties.content(slow)
    assert left_out is not None
    assert "real-stability" in left_out["left_out"]
    keys = [one["key"] for one in left_out["verdicts"]]
    assert {*keys, *left_out["left_out"]} == set(KEYS)


def test_pictures_stand_on_the_page(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is drawn is there as it is, with its note; a picture that is not there has its reason."""
    drawn = '<svg role="img"><title>a curve</title><path d="M0 0L1 1"/></svg>'
    found = [
        Picture("one", "One", "a curve", drawn, "It rises."),
        Picture("two", "Two", "", "", "Not drawn: <it> has none."),
    ]
    monkeypatch.setattr(pictures, "pictures", lambda *_: found)
    root = read(report_page("euler", order=1))
    one, two = elements(by_id(root, "m1-pictures"), "figure")
    assert text_of(one) == "One a curve It rises."
    assert text_of(two) == "Two Not drawn: <it> has none."
    assert [x.get("d") for x in elements(one, "path")] == ["M0 0L1 1"]


@in_whole
def test_another_file_is_not_written_over(tmp_path: Path) -> None:
    """A page takes the name of its method only from another page."""
    (tmp_path / "rk4.html").write_text("my notes")
    run = gark("report", "rk4", "--no-pictures", cwd=tmp_path)
    assert (run.code, (tmp_path / "rk4.html").read_text()) == (2, "my notes")
    assert "-o rk4.html writes over it" in run.err
    for _ in range(2):
        assert gark("report", "heun", "--no-pictures", cwd=tmp_path).code == 0
    assert gark("report", "lobatto-iiic*-5", "--no-pictures", cwd=tmp_path).code == 0
    assert (tmp_path / "lobatto-iiic-star-5.html").exists()


@in_whole
def test_the_command_for_more_conditions_is_that_of_the_pair(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Also of a conjugate; a method from arrays has no file, and no command."""
    monkeypatch.setattr(page_module, "MOST_ROWS", 10)
    pair = garkcli.load(PAIRED).pair
    assert isinstance(pair, garkcli.GarkMethod)
    said = text_of(by_id(read(report_page(pair, pictures=False)), "m1-conditions"))
    assert f"gark conditions {PAIRED} --pair --only --order" in said
    arrays = garkcli.gark(["gauss-2", "gauss-3"], "legendre")
    said = text_of(by_id(read(report_page(arrays, pictures=False)), "m1-conditions"))
    assert "left out" in said
    assert "gark conditions" not in said


def test_definitions_keep_their_role() -> None:
    """Screen readers read ``dd`` and ``dt`` of a list as what they are: what scrolls is in them."""
    for template in sorted(Path(garkcli.__file__).with_name("webpage").rglob("*.html")):
        assert not re.search(r"<d[dt]\b[^>]*\brole=", template.read_text(encoding="utf-8")), (
            template.name
        )


def test_weights_of_positions_have_a_bar() -> None:
    """A Nyström method has b̄ below Ā, and b below A."""
    page = report_page("nystrom-4", pictures=False)
    of_positions, of_velocities = page.split('<table class="tableau')[1:3]
    assert "&#x000AF;" in of_positions
    assert "&#x000AF;" not in of_velocities


def test_what_one_looks_for_is_first(tmp_path: Path) -> None:
    """Tableau, stability picture and claims; conjugate and symplectic pair of one colour where the
    file claims something about them.
    """
    root = read(report_page("rk4", order=1))
    heads = [x.get("id") for x in elements(root, "section")]
    assert heads[:3] == ["m1-tableau", "m1-picture", "m1-claims"]
    assert "m1-picture-region" in [x.get("id") for x in elements(by_id(root, "m1-picture"))]
    further = [x.get("id") for x in elements(by_id(root, "m1-pictures"), "figure")]
    assert further == ["m1-pictures-convergence"]
    plain = "A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\n"
    file = tmp_path / "heun.yaml"
    for claims, is_told in (("", False), ("expect: {pair-order: 2}\n", True)):
        file.write_text(plain + claims)
        page_of = read(report_page(str(file), order=1, pictures=False))
        for name in ("tableau", "orders"):
            assert ("symplectic pair" in text_of(by_id(page_of, f"m1-{name}"))) is is_told
    assert "symplectic pair" in text_of(by_id(read(text(PAIRED)), "m1-tableau"))


def test_a_page_has_the_rest_with_details() -> None:
    """Without them a page has the usual facts of the commands, few conditions, and energies if the
    method is made for them; it says what has more.
    """
    usual, whole = (read(report_page("dormand-prince-5", details=x)) for x in (False, True))
    names = [[x.get("id") for x in elements(root, "section")] for root in (usual, whole)]
    assert {*names[1]} - {*names[0]} == {"m1-simplifying"}
    assert "gark report -v" in text_of(next(elements(usual, "footer")))
    assert "gark report -v" not in text_of(next(elements(whole, "footer")))
    printed = [gark("stability", "dormand-prince-5", *more).out for more in ([], ["-v"])]
    for root, out in zip((usual, whole), printed, strict=True):
        labels = [text_of(x) for x in elements(by_id(root, "m1-stability"), "dt")]
        assert ("conserved form" in labels) is ("conserved form" in out)
        assert len(labels) > 7
        ids = [x.get("id") for x in elements(by_id(root, "m1-pictures"), "figure")]
        assert ("m1-pictures-energy" in ids) is (root is whole)
    properties = [by_id(root, "m1-properties") for root in (usual, whole)]
    assert [len([*elements(x, "table")]) for x in properties] == [0, 1]
    said = text_of(properties[0])
    assert "it is explicit, stiffly-accurate, fsal" in said
    assert "it is not symmetric, reducible" in said
    assert "stage-order 1" in said
    assert "real-stability" not in said
    conditions = read(report_page("feagin-10", pictures=False))
    (table,) = elements(by_id(conditions, "m1-conditions"), "table")
    assert len(rows_of(table)) == 37
    verlet = read(report_page(VERLET, order=1))
    assert "m1-pictures-energy" in [x.get("id") for x in elements(verlet, "figure")]


def test_long_coefficients_are_decimals_and_labels_are_not_repeated() -> None:
    """The stability of ARS(3,4,3), whose exact R(z) would be cut off at every width; a page on one
    method names it once, in its title.
    """
    page = report_page("ars-343", pictures=False)
    assert 'class="whose"' not in page
    stability = page.partition(">Stability</h2>")[2].partition("</section>")[0]
    assert max(map(len, re.findall(r"\d+", stability))) < 14
    first = stability.partition("<dl")[2].partition("</dl>")[0]
    labels = re.findall(r"<dt>(.*?)</dt>", first)
    assert len(labels) == len(set(labels)) > 8
    assert "γ = γ" not in re.sub(r"<[^>]*>", "", page)
