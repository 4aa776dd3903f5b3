"""``gark export --to certificate`` and ``tools/referee.py``: what is proved, and what is found out."""

from __future__ import annotations

import ast
import importlib.util
import json
import os
import re
import subprocess
import sys
import tracemalloc
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

import garkcli
from garkcli import find_order, load, loads
from garkcli.check.analysis import MethodProof, analyse, prove_method
from garkcli.constructions.nprk import nprk
from garkcli.constructions.nystrom import nystrom
from garkcli.constructions.rosenbrock import rosenbrock
from garkcli.errors import MethodError
from garkcli.order.certificate import prove
from garkcli.reason import Reason
from garkcli.report.certificate import REPORT, coq_proof
from garkcli.tableau.tableau import Tableau
from tests.constructions.test_rosenbrock import RODAS3
from tests.whole import IS_WHOLE, at_most, in_whole, sample

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "tools" / "referee.py"
METHODS = [
    path
    for path in sample(sorted((ROOT / "methods").rglob("*.gark.yaml")), 2)
    # takes the referee seconds; is rounded; has an analysis of its own
    if IS_WHOLE or not path.name.startswith("legendre-gauss10")
    if not path.name.startswith(("low-storage5", "nystrom4"))
]


def _referee() -> ModuleType:
    spec = importlib.util.spec_from_file_location("referee", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


REFEREE = _referee()


def certificate(text: str) -> dict[str, Any]:
    """The proof of a method file."""
    data = json.loads(REPORT.json([prove_method(loads(text))]))
    assert isinstance(data, dict)
    return data


def judged(data: dict[str, Any], folder: Path) -> int:
    """The exit code of the referee on a proof."""
    path = folder / "proof.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    code = REFEREE.main([str(path)])
    assert isinstance(code, int)
    return code


COLLOCATION = (ROOT / "methods" / "collocation.gark.yaml").read_text(encoding="utf-8")
RADICALS = (ROOT / "methods" / "collocation-conjugate.gark.yaml").read_text("utf-8")


def test_the_referee_shares_no_code() -> None:
    """It imports the standard library alone and is short, with everything that it says."""
    text = SCRIPT.read_text(encoding="utf-8")
    imported = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            imported |= {alias.name for alias in node.names}
        if isinstance(node, ast.ImportFrom):
            imported.add(str(node.module))
    library = {"fractions", "itertools", "json", "math", "re", "sys"}
    assert imported == library
    assert sum(bool(line.strip()) for line in text.splitlines()) < 480


@pytest.mark.parametrize("path", sample(METHODS, 4), ids=lambda path: path.name.split(".")[0])
def test_every_method_is_proved(
    path: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The orders that the referee proves are those of ``gark check``."""
    method = load(path)
    data = json.loads(REPORT.json([prove_method(method)]))
    assert judged(data, tmp_path) == 0
    found = analyse(method.tableau)
    orders = [found.order, found.conjugate_order, found.pair_order]
    names = ["method", "conjugate", "pair"]
    shown = capsys.readouterr().out.splitlines()[1:]
    assert [line.split(",")[0].strip() for line in shown] == [
        f"{name}: order {order.order}"
        for name, order in zip(names, orders, strict=True)
        if order is not None
    ]


LONG = {
    *("mclachlan-atela-3", "mri-gark-erk45a", "sharp-9", "tsitouras-9a", "tsitouras-9b"),
    *("verner-9", "verner-9-robust"),
}
"""Methods of many stages or with a field of a large degree: each takes the referee over a second."""
CATALOGUE = sorted((Path(garkcli.__file__).parent / "catalogue/data").rglob("*.gark.yaml"))
KINDS = {"candy-rozmus-4", "gauss-2", "leapfrog-2", "p-stable-gauss2-lobatto3", "cash-karp"}
"""Methods of each kind, which are always among those that are proved."""


def chosen() -> list[Path]:
    """The methods of this run: every sixteenth of the catalogue, in ``make whole`` all."""
    if IS_WHOLE:
        return CATALOGUE
    few = [x for x in CATALOGUE[::16] if x.name.split(".")[0] not in LONG]
    return sorted({*few, *(x for x in CATALOGUE if x.name.split(".")[0] in KINDS)})


def test_the_catalogue_is_proved(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The referee accepts the certificate of every exact method of the sample. Where a weight is
    zero it has no pair: nobody can make one from it. All are proved in ``make whole``.
    """
    seen = set()
    for path in chosen():
        method = load(path)
        if method.tolerance is not None:
            continue
        data = json.loads(REPORT.json([prove_method(method)]))
        assert judged(data, tmp_path) == 0, path.name
        assert ("conjugate" in data) == ("pair" in data) == ("no_conjugate" not in data)
        proved = re.findall(r"^  (\w+): order (?:at least )?(\d+)", capsys.readouterr().out, re.M)
        parts = ("method", "conjugate", "pair")
        assert proved == [(x, str(data[x]["order"])) for x in parts if x in data]
        seen.add(path.name.split(".")[0])
    assert {"leapfrog-2", "candy-rozmus-4", "gauss-2"} <= seen


@in_whole
def test_as_a_program(tmp_path: Path) -> None:
    """Run as people run it: several files, the worst exit code; no file is no proof."""
    good, bad = tmp_path / "good.json", tmp_path / "bad.json"
    data = certificate(COLLOCATION)
    good.write_text(json.dumps(data), encoding="utf-8")
    data["pair"]["order"] = 5
    bad.write_text(json.dumps(data), encoding="utf-8")

    def run(*paths: Path) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-I", str(SCRIPT), *map(str, paths)]
        return subprocess.run(
            command, capture_output=True, text=True, encoding="utf-8", check=False
        )

    assert run(good).returncode == 0
    assert run(good, bad).returncode == 1
    assert "not proved" in run(bad).stdout
    assert run(tmp_path / "none.json", good).returncode == 2
    assert run(SCRIPT).returncode == 2
    assert run().returncode == 2


def _drop_a_tree(data: dict[str, Any]) -> None:
    data["method"]["spanning"][3][1].pop()


def _repeat_a_tree(data: dict[str, Any]) -> None:
    lists = [trees for row in data["method"]["spanning"] for trees in row]
    trees = max(lists, key=len)
    assert len(trees) > 1
    trees[-1] = trees[0]


def _claim_more(data: dict[str, Any]) -> None:
    data["method"]["order"] = 5
    data["method"]["spanning"].append([["[[[[[]_1]_1]_1]_1]_1"], ["[[[[[]_1]_1]_1]_1]_2"]])


def _claim_less(data: dict[str, Any]) -> None:
    data["method"]["order"] = 3
    data["method"]["spanning"].pop()


def _true_witness(data: dict[str, Any]) -> None:
    data["method"]["order"] = 3
    tree = data["method"]["spanning"].pop()[0][0]
    data["method"]["witness"]["tree"] = tree


def _other_value(data: dict[str, Any]) -> None:
    data["method"]["witness"]["value"] = "1/7"


def _other_requirement(data: dict[str, Any]) -> None:
    """The witness has another required value."""
    data["method"]["witness"]["required"] = "1/7"


def _other_weight(data: dict[str, Any]) -> None:
    data["conjugate"]["colours"][0]["b"][0] = "2/3"


def _pair_of_less(data: dict[str, Any]) -> None:
    data["pair"]["spanning"][3][2].pop()


def _pair_of_more(data: dict[str, Any]) -> None:
    data["pair"]["order"] = 5


def _other_block(name: str) -> Callable[[dict[str, Any]], None]:
    def change(data: dict[str, Any]) -> None:
        row = data[name]["blocks"][0]["A"][0]
        row[0] = "1/3"

    return change


def _missing_block(data: dict[str, Any]) -> None:
    data["conjugate"]["blocks"].pop()


def _coinciding_nodes(data: dict[str, Any]) -> None:
    data["method"]["spaces"][0]["modulus"] = ["1/4", "-1", "1"]


@pytest.mark.parametrize(
    "change",
    [
        _drop_a_tree,
        _repeat_a_tree,
        _claim_more,
        _claim_less,
        _true_witness,
        _other_requirement,
        _other_value,
        _other_weight,
        _other_block("method"),
        _other_block("conjugate"),
        _pair_of_less,
        _pair_of_more,
        _missing_block,
        _coinciding_nodes,
    ],
)
@pytest.mark.parametrize("text", [COLLOCATION, RADICALS], ids=["rational", "radicals"])
def test_a_false_proof_is_found_out(
    text: str, change: Callable[[dict[str, Any]], None], tmp_path: Path
) -> None:
    """Trees that do not span, orders too high or too low, other blocks, other nodes."""
    data = certificate(text)
    if change is _coinciding_nodes and "modulus" not in data["method"]["spaces"][0]:
        pytest.skip("no node polynomial")
    change(data)
    assert judged(data, tmp_path) == 1


def _no_trees(data: dict[str, Any]) -> None:
    data["method"] |= {"spanning": [[]] * 50, "order": 50, "witness": None}


def _no_method(data: dict[str, Any]) -> None:
    del data["method"]


def _driving_nothing(data: dict[str, Any]) -> None:
    for name in ("method", "conjugate"):
        for colour in data[name]["colours"]:
            colour["drives"] = "z"
    data["conjugate"] = data["method"]


def _linear_conjugate(data: dict[str, Any]) -> None:
    data["conjugate"]["colours"][0]["linear"] = True


def _pair_without_conjugate(data: dict[str, Any]) -> None:
    del data["conjugate"]


def _half_a_pair(data: dict[str, Any]) -> None:
    data["pair"]["spanning"] = data["method"]["spanning"]


def _no_space(data: dict[str, Any]) -> None:
    data["method"]["colours"][-1]["space"] = 0


def _block_twice(data: dict[str, Any]) -> None:
    first = data["method"]["blocks"][0]
    data["method"]["blocks"].append(json.loads(json.dumps(first)))
    first["A"][0][0] = "7"


def _no_coupling(data: dict[str, Any]) -> None:
    """Without the blocks between colours the conditions of mixed trees are gone."""
    blocks = data["method"]["blocks"]
    data["method"]["blocks"] = [x for x in blocks if x["space"] == x["colour"]]


@pytest.mark.parametrize(
    "change",
    [
        _no_trees,
        _no_method,
        _driving_nothing,
        _linear_conjugate,
        _half_a_pair,
        _no_space,
        _block_twice,
        _no_coupling,
    ],
)
def test_a_proof_with_gaps_is_none(
    change: Callable[[dict[str, Any]], None], tmp_path: Path
) -> None:
    """Whatever a proof leaves out is missed: colours without trees, a form that pairs nothing,
    fewer conditions by a colour that is said to be linear.
    """
    data = certificate(COLLOCATION)
    change(data)
    assert judged(data, tmp_path) == 1


def test_a_pair_needs_its_conjugate(tmp_path: Path) -> None:
    """Without the blocks that drive momenta there is no pair to judge."""
    data = certificate(COLLOCATION)
    _pair_without_conjugate(data)
    assert judged(data, tmp_path) == 1


ENDLESS = ("1e1000000000", "1E-1000000000", "1/1e9999999999", "9" * 100_000)


@in_whole
@pytest.mark.parametrize("number", ENDLESS, ids=["power", "small", "below", "digits"])
def test_no_number_is_without_end(
    number: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A text of which a number of gigabytes would be made is refused before it is one, wherever a
    certificate has numbers: each place has one of these texts.
    """
    made: list[object] = []

    class Counted(Fraction):
        def __new__(cls, *parts: Any) -> Any:
            made.extend(x for x in parts if isinstance(x, str))
            assert number not in made
            return Fraction(*parts)

    monkeypatch.setattr(REFEREE, "Fraction", Counted)
    for text in (COLLOCATION, RADICALS):
        data = certificate(text)
        for holder, key in list(_numbers(data))[ENDLESS.index(number) :: len(ENDLESS)]:
            kept, holder[key] = holder[key], number
            assert judged(data, tmp_path) == 1
            holder[key] = kept
    assert len(made) > 25


def _numbers(data: Any) -> Iterator[tuple[Any, Any]]:
    """Where a number of each kind is, the first of every list."""
    if isinstance(data, dict):
        for key, value in data.items():
            if key in {"required", "value"}:
                yield data, key
            yield from _numbers(value)
    elif isinstance(data, list) and data:
        if isinstance(data[0], str) and "[" not in data[0]:
            yield data, 0
        yield from (pair for x in data[:1] for pair in _numbers(x))


def _large(degree: int = 1, colours: int = 1, spaces: Sequence[int] = (1,)) -> dict[str, Any]:
    """A method without blocks: its field, its colours, and spaces that nobody uses."""
    modulus = ["-2", *["0"] * (degree - 1), "1"]
    colour = {"drives": "y", "linear": False, "space": 1, "b": ["1"]}
    method = {
        "order": 1,
        "colours": [colour] * colours,
        "spaces": [{"stages": stages} for stages in spaces],
        "blocks": [],
        "spanning": [[[f"[]_{l}"] for l in range(1, colours + 1)]],
        "witness": None,
    }
    field = {"modulus": modulus, "theta_between": ["1", "3"]}
    return {"schema": "gark/certificate/1", "name": "large", "field": field, "method": method}


@pytest.mark.parametrize(
    ("at", "over", "words"),
    [
        ({"degree": 60}, {"degree": 61}, "61 as degree of the field (limit 60)"),
        ({"colours": 100}, {"colours": 101}, "101 colours (limit 100)"),
        ({"degree": 60}, {"degree": 20_001}, "20001 as degree of the field"),
        ({"colours": 100}, {"colours": 20_000}, "20000 colours"),
        ({"spaces": [1, 9_999]}, {"spaces": [1, 10_000]}, "10001 numbers of a stage value"),
        ({"spaces": [1]}, {"spaces": [1, *[9_000] * 20_000]}, "numbers of a stage value"),
        (
            {"degree": 50, "spaces": [1, 199]},
            {"degree": 50, "spaces": [1, 200]},
            "10050 numbers of a stage value",
        ),
    ],
)
def test_a_small_file_does_not_fill_the_memory(
    at: dict[str, Any],
    over: dict[str, Any],
    words: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """What is at a limit is proved, what is over it is refused with words and little memory."""
    assert judged(_large(**at), tmp_path) == 0
    capsys.readouterr()
    data = _large(**over)
    tracemalloc.start()
    assert judged(data, tmp_path) == 2
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert words in capsys.readouterr().out
    assert peak < 200_000_000


@in_whole
def test_matrices_do_not_fill_the_memory(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """An entry of a matrix is as many numbers as the square of the degree."""
    assert REFEREE.MOST_NUMBERS == 4_000_000
    monkeypatch.setattr(REFEREE, "MOST_NUMBERS", 4 * 60**2)
    data = _large(degree=60)
    for count, code in ((3, 1), (4, 2)):
        data["method"]["blocks"] = [{"space": 1, "colour": 1, "A": [["0"]] * count}]
        assert judged(data, tmp_path) == code
    assert "numbers of matrices (limit 14400)" in capsys.readouterr().out


@pytest.mark.parametrize("stages", [0, -1, 10**12])
def test_an_impossible_number_of_stages(stages: int, tmp_path: Path) -> None:
    """It is refused before anything of its size is made."""
    data = certificate(COLLOCATION)
    data["method"]["spaces"][0]["stages"] = stages
    assert judged(data, tmp_path) == 2


def test_a_large_file_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The file itself has a limit."""
    data = certificate(COLLOCATION)
    size = len(json.dumps(data))
    for most, code in ((size, 0), (size - 1, 2)):
        monkeypatch.setattr(REFEREE, "MOST_BYTES", most)
        assert judged(data, tmp_path) == code


def test_many_stages_need_no_memory(tmp_path: Path) -> None:
    """Stages of which a file says only how many there are take no room for pairs of them."""
    data = certificate(COLLOCATION)
    data["method"]["spaces"].append({"stages": 10_000})
    tracemalloc.start()
    judged(data, tmp_path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 100_000_000


@pytest.mark.parametrize("entry", ["1/0", "x", 1e999, None, [], {"a": 1}])
def test_what_is_no_number_is_no_proof(entry: object, tmp_path: Path) -> None:
    """No traceback, and nothing is proved."""
    data = certificate(COLLOCATION)
    data["method"]["blocks"][0]["A"][0][0] = entry
    assert judged(data, tmp_path) in {1, 2}


def test_what_is_assumed_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Colours whose vector field is linear are named, and a name cannot write lines of its own."""
    text = "tableau: {A: [[0, 0], [1/2, 0]], b: [1/3, 2/3]}\nlinear: [1]\n"
    data = certificate(text) | {"name": "x\n  method: order 9"}
    assert judged(data, tmp_path) == 0
    first, second, *_ = capsys.readouterr().out.splitlines()
    assert first.endswith("x?  method: order 9")
    assert second.endswith("where the vector field is linear: 1")


def test_what_is_not_seen_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Conditions that a missing block takes away are an assumption, and it is named."""
    data = certificate("A: [[0, 0], [1/2, 0]]\nb: [0, 1]\n")
    spanning = [[["[]_1"]]] + [[[]]] * 8
    data["method"] |= {"blocks": [], "spanning": spanning, "order": 9}
    data["method"]["witness"] = None
    path = ROOT / "methods" / "stoermer-verlet.gark.yaml"
    separable = certificate(path.read_text(encoding="utf-8"))
    for proof, assumed in (
        (data, "free of what 1 drives: 1"),
        (separable, "free of what 1 drives: 1; free of what 2 drives: 2"),
    ):
        assert judged(proof, tmp_path) == 0
        line = capsys.readouterr().out.splitlines()[1]
        assert line.endswith(f", where the vector field is {assumed}")


def test_names_in_any_encoding(tmp_path: Path) -> None:
    """A name that the terminal has no letters for is no fault of the proof."""
    path = tmp_path / "proof.json"
    data = certificate(COLLOCATION) | {"name": "Störmer α"}
    path.write_text(json.dumps(data), encoding="utf-8")
    run = subprocess.run(
        [sys.executable, str(SCRIPT), str(path)],
        capture_output=True,
        env={**os.environ, "PYTHONIOENCODING": "ascii"},
        check=False,
    )
    assert run.returncode == 0
    assert b"St\\xf6rmer \\u03b1" in run.stdout


@pytest.mark.parametrize("ends", [("2", "3"), ("-10", "10")])
def test_theta_is_one_root(ends: tuple[str, str], tmp_path: Path) -> None:
    """The interval of θ holds exactly one root of the modulus."""
    data = certificate(RADICALS)
    data["field"]["theta_between"] = list(ends)
    assert judged(data, tmp_path) == 1


def test_rounded_coefficients_have_no_proof() -> None:
    """Exact orders of rounded coefficients are refused, with what there is instead."""
    method = loads("A: [[0]]\nb: [0.9999999]\ntolerance: 1e-6\n")
    with pytest.raises(Exception, match="rounded") as caught:
        prove_method(method)
    assert "prove_method_exists" in str(caught.value)


_ENTRIES = st.sampled_from(["0", "1/2", "1/3", "1", "-1/4", "sqrt(2)/2", "1/6"])


@st.composite
def _additive(draw: st.DrawFn) -> str:
    """A random additive method file of two stages, of one colour or two."""
    colours = draw(st.integers(1, 2))
    blocks, weights = [], []
    for _ in range(colours):
        first = draw(_ENTRIES.filter(lambda x: x != "0"))
        weights.append(f'["{first}", "1 - {first}"]')
        rows = [[draw(_ENTRIES) for _ in range(2)] for _ in range(2)]
        blocks.append(json.dumps(rows))
    return f"ark: {{A: [{', '.join(blocks)}], b: [{', '.join(weights)}]}}\n"


@settings(max_examples=at_most(8, 160))
@given(_additive())
def test_random_methods_are_proved(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    """Whatever the method is, the referee agrees with its order, conjugate and pair."""
    method = loads(text)
    data = json.loads(REPORT.json([prove_method(method)]))
    assert data["method"]["order"] == find_order(method).order
    assert judged(data, tmp_path_factory.mktemp("proof")) == 0


def rosenbrock_certificate(tableau: Tableau) -> dict[str, Any]:
    """The proof of a method of which colours are no vector fields: it has no conjugate."""
    proof = MethodProof("ROS", prove(tableau), None, None, Reason("it is no GARK method"))
    data = json.loads(REPORT.json([proof]))
    assert isinstance(data, dict)
    return data


@pytest.mark.parametrize("name", ["tableau", "with_any_matrix", "with_old_jacobian"])
def test_vertices_of_every_kind(name: str, tmp_path: Path) -> None:
    """The referee proves orders of Rosenbrock and W-methods too, and notices a missing tree, a
    condition of trees that the exact solution does not have, and other branches at a vertex.
    """
    half, one, zero = fmpq(1, 2), fmpq(1), fmpq(0)
    ros2 = rosenbrock(((zero, zero), (one, zero)), ((half, zero), (-one, half)), (half, half))
    tableau = getattr(ros2, name)
    data = rosenbrock_certificate(tableau)
    assert data["method"]["order"] == 2
    assert judged(data, tmp_path) == 0
    for by_colour in data["method"]["spanning"]:
        for trees in by_colour:
            for i in range(len(trees)):
                (tree,) = trees[i : i + 1]
                del trees[i]
                assert judged(data, tmp_path) == 1
                trees.insert(i, tree)
    assert judged(data, tmp_path) == 0
    for colour in data["method"]["colours"]:
        if "vertices" not in colour:
            continue
        kept = dict(colour["vertices"])
        wrong: list[tuple[str, Any]] = [("branches", [0, 1, 2])]
        if kept["weight"] == 1:  # larger roots have no tree up to order 2
            wrong += [("weight", 3), ("in_solution", not kept["in_solution"])]
        for key, value in wrong:
            colour["vertices"][key] = value
            assert judged(data, tmp_path) == 1, (key, value)
            colour["vertices"] = dict(kept)
    assert judged(data, tmp_path) == 0


def test_vertices_that_are_integrated_twice(tmp_path: Path) -> None:
    """The referee proves order 2 of Verlet's method as a Nyström method, and order 2 of a
    nonlinearly partitioned one; it notices a missing tree and another weight.
    """
    half, one, zero = fmpq(1, 2), fmpq(1), fmpq(0)
    square = ((zero, zero), (half, zero))
    verlet = nystrom(square, None, (zero, one), (half, zero), (half, half)).tableau
    midpoint, _ = nprk([[], [[zero, half]]], [[], [zero, one]])
    for tableau in (verlet, midpoint):
        data = rosenbrock_certificate(tableau)
        assert data["method"]["order"] == 2
        assert judged(data, tmp_path) == 0
        trees = next(x for x in data["method"]["spanning"][1] if x)
        (tree,) = trees[:1]
        del trees[:1]
        assert judged(data, tmp_path) == 1
        trees.insert(0, tree)
    data = rosenbrock_certificate(verlet)
    data["method"]["colours"][0]["vertices"]["weight"] = 1
    assert judged(data, tmp_path) == 1


@pytest.mark.parametrize("name", ["tableau", "with_any_matrix", "with_old_jacobian"])
def test_witness_of_every_kind(name: str, tmp_path: Path) -> None:
    """RODAS3: order and witness as gark has them; another required value is noticed."""
    data = rosenbrock_certificate(getattr(RODAS3, name))
    assert judged(data, tmp_path) == 0
    data["method"]["witness"]["required"] = "1/7"
    assert judged(data, tmp_path) == 1
    with pytest.raises(MethodError, match="a proof for Coq is for GARK methods"):
        coq_proof(MethodProof("ROS", prove(getattr(RODAS3, name)), None, None, Reason()))
