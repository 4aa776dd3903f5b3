"""``gark import`` of what ``gark export --to json`` writes of Rosenbrock, multirate, Nyström,
nonlinearly partitioned and multiderivative methods.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from garkcli.bridges.collecting import TableResult, collected
from garkcli.methodfile.load import load, loads
from tests.cli.harness import ROOT, gark
from tests.whole import IS_WHOLE

FOLDERS = ("rosenbrock", "multirate", "nystrom", "nprk", "derivatives")
FILES = [
    path
    for folder in FOLDERS
    for path in sorted((ROOT / "garkcli/catalogue/data" / folder).glob("*.yaml"))
]
SLOW = ("rodas6p", "dprkn-1210", "merk54", "esdirk46a", "imex-mri-gark4")
QUICK = [x for x in FILES if not any(name in x.name for name in SLOW)]
TEXTS = {
    "several colours": (
        "rosenbrock: {blocks: {alpha: [[[[], [1]], [[], [1]]], [[[], [1]], [[], [1]]]],"
        " gamma: [[[[g], [-2*g, g]], null], [null, null]], b: [[1/2, 1/2], [1/2, 1/2]]}}\n"
        "parameters: {g: 1 - sqrt(2)/2}"
    ),
    "alpha, beta, gamma": (
        "multirate: {mis: {alpha: [[], [0, 1]], beta: [[1/2], [-1/2, 1]], gamma: [[0], [0]]},"
        " fast: exact}"
    ),
    "only explicit": "multirate: {mri: {restart: sr, c: [0, 1], omega: [[[1]]]}, fast: exact}",
    "positions": (
        "nystrom: {Abar: [[0]], c: [1/2], bbar: [1/2], b: [1],"
        " dense: {degree: 2, bbar: [[0, 1/2]]}}"
    ),
}


def back(path: Path) -> TableResult:
    """The only method of a document."""
    [found] = collected([str(path)])
    return found


def exported(name: str, path: Path) -> Path:
    """The JSON of a method."""
    assert gark("export", name, "--to", "json", "-o", str(path)).code == 0
    return path


@pytest.mark.parametrize("file", FILES if IS_WHOLE else QUICK[::9], ids=lambda x: x.stem)
def test_the_catalogue_comes_back(file: Path, tmp_path: Path) -> None:
    """The same method with all its weights and its rounding; its claims hold."""
    method = load(str(file))
    found = back(exported(str(file), tmp_path / "method.json")).method
    assert found is not None
    made = found.method
    assert (made.tableau, made.embedded, made.dense) == (
        method.tableau,
        method.embedded,
        method.dense,
    )
    assert (made.tolerance, made.dense_tolerance) == (method.tolerance, method.dense_tolerance)
    assert found.findings == ()
    assert found.text == made.text
    assert made.claims[0].key == "order"


@pytest.mark.parametrize("name", TEXTS)
def test_further_forms_come_back(name: str, tmp_path: Path) -> None:
    """Forms that the catalogue has not."""
    file = tmp_path / "method.yaml"
    file.write_text(TEXTS[name], encoding="utf-8")
    found = back(exported(str(file), tmp_path / "method.json")).method
    assert found is not None
    wanted = loads(TEXTS[name])
    assert (found.method.tableau, found.method.dense) == (wanted.tableau, wanted.dense)


def document(tmp_path: Path, **changed: Any) -> Path:
    """The JSON of a Rosenbrock method, with other values."""
    path = exported("ros3p", tmp_path / "ros3p.json")
    content = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps({**content, **changed}), encoding="utf-8")
    return path


def test_false_orders_are_errors(tmp_path: Path) -> None:
    """A declared order that is too high fails, one that is too low is told."""
    path = document(tmp_path, order=4)
    assert [(x.code, x.level) for x in back(path).errors] == [("order", "error")]
    assert gark("audit", str(path)).code == 1
    assert gark("import", str(path), "-o", str(tmp_path / "x.gark.yaml")).code == 1
    path = document(tmp_path, order=2)
    assert not back(path).errors
    found = back(path).method
    assert found is not None
    assert [x.message for x in found.findings] == ["order 3, declared 2"]


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("b", "[1]\nexpect: {order: 9}"),
        ("b", ["1\nexpect: {order: 9}", ["1"]]),
        ("b", [{"a": "1"}]),
        ("alpha", [["1"], ["1"]]),
        ("gamma", None),
        ("c", True),
        ("name", 5),
        ("order", [1]),
        ("b", []),
        ("tolerance", "1e-9\nexpect: {order: 9}"),
        ("b", [[[[[[[["1"]]]]]]]]),
    ],
)
def test_hostile_documents(key: str, value: Any, tmp_path: Path) -> None:
    """What is no array of numbers never becomes a line of a method file."""
    path = document(tmp_path, **{key: value})
    for found in collected([str(path)]):
        if found.method is None:
            assert found.trouble
        else:
            assert "9" not in {x.value for x in found.method.method.claims}
            assert "order: 9" not in found.method.text


def test_what_is_no_export_is_read_as_before(tmp_path: Path) -> None:
    """Objects with A and b, documents of other kinds, and no JSON."""
    path = tmp_path / "x.json"
    path.write_text('{"schema": "gark/export/1", "A": [["0"]], "b": ["1"]}', encoding="utf-8")
    assert back(path).table.form is None
    for text in ('"gark/export/1"', "gark/export/1", '{"schema": "gark/export/1", "kind": []}'):
        path.write_text(text, encoding="utf-8")
        assert list(collected([str(path)])) == []


def test_a_step_predictor_has_no_coupling(tmp_path: Path) -> None:
    """JSON holds couplings; of other methods with an exact fast part it says why not."""
    path = tmp_path / "x.yaml"
    path.write_text("multirate: {slow: heun, fast: exact}", encoding="utf-8")
    told = gark("export", str(path), "--to", "json")
    assert told.code == 2
    assert "is no multirate infinitesimal step" in told.err
