"""Constructions in method files: what is refused and where, and that the schema agrees."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml
from jsonschema import Draft7Validator

from garkcli.api.methods import find_order
from garkcli.check.check_file import check_file
from garkcli.errors import MethodFileError
from garkcli.methodfile.file_keys import method_file_schema
from garkcli.methodfile.load import loads
from garkcli.page.look import Look
from garkcli.report.check_text import render
from garkcli.report.checked import REPORT

VALIDATOR = Draft7Validator(method_file_schema())
VALID = Draft7Validator(REPORT.schema)
FAULTS = {
    "compose: {of: heun}": "no substeps",
    "compose: {scheme: suzuki}": "of missing beside scheme",
    "compose: {of: heun, scheme: suzuki, steps: [1]}": "given by scheme already",
    "compose: {of: heun, scheme: yoshida}": "is called yoshida-6",
    "compose: {of: heun, scheme: suzki}": "'suzki' is not known",
    "compose: {of: heun, scheme: suzuki, order: 5}": "has an even order",
    "compose: {of: heun, scheme: yoshida-6, order: 6}": "has one order, 6",
    "compose: {of: heun, scheme: suzuki, order: 8}": "from order 2 to 8 has radicals of degree 105",
    "compose: {of: heun, steps: [1], order: 6}": "order goes with scheme",
    "compose: {steps: [1/2]}": "step of no method",
    "compose: {steps: [{step: 1/2}]}": "the step of no method",
    "compose: {of: heun, steps: [{adjoint: true}]}": "step missing",
    "compose: {of: heun, steps: [{step: 1, adjoint: 1}]}": "is not known",
    "compose: {of: heun, steps: [1/2, x]}": "'x' is not a parameter",
    "compose: {of: heun, steps: [1/2 + i/2, 1/2 - i/2]}": "complex",
    "compose: {of: no-such-method, steps: [1]}": "no method of this name",
    "compose: {of: {A: [[0]]}, steps: [1]}": "b missing",
    "compose: {of: {family: gaus, stages: 1}, steps: [1]}": "no family 'gaus'",
    "compose: {of: {family: gauss, stages: 6}, steps: [1]}": "without simple radicals",
    "compose: {of: [heun], steps: [1]}": "a mapping of keys",
    "compose: {of: heun, steps: [1], structure: separable}": "unknown key 'structure'",
    "compose: {of: heun, steps: [1]}\nstructure: separable": "structure does not go with compose",
    "compose: {of: heun, steps: [1]}\ntransfer: collocation": "transfer goes with methods",
    "compose: {of: heun, steps: [1]}\nadjoint: heun": "given by compose already",
    "compose: [heun]": "a mapping of keys",
    "adjoint:": "adjoint: a method is missing",
    "compose: {of: ./mine.gark.yaml, steps: [1]}": "not a file",
    "compose: {of: folder/mine, steps: [1]}": "not a file",
    "adjoint: {family: gauss}": "needs its number of stages",
    "splitting: {}": "no flows",
    "splitting: {scheme: lie, flows: [{1: 1}, {2: 1}]}": "keep one of flows, scheme",
    "methods: {family: sdirk2, gamma: 1/2, stages: 3}": "it has 2",
    "splitting: {a: [1]}": "b missing beside a",
    "splitting: {a: [1, 2, 3], b: [1]}": "a has 3 numbers and b has 1",
    "splitting: {scheme: strang, terms: 3}": "exact flows of 3 parts",
    "splitting: {scheme: ruth-3, of: heun, terms: 3}": "is for 2 parts",
    "splitting: {flows: [{1: 1}]}": "part 2 never flows",
    "splitting: {flows: [{1: 1}, {4: 1}], of: heun, terms: 2}": "unknown key '4'",
    "splitting: {scheme: strang, of: [heun, heun, heun], terms: 2}": "3 methods for 2 parts",
    "splitting: {scheme: strang, of: [{splitting: {scheme: lie}}, heun]}": "has several",
    "splitting: {scheme: strang}\nstructure: semi-separable": "structure does not go",
    "splitting: {scheme: strang, of: heun}\nstructure: nystrom": "structure does not go",
    "of: heun\nsteps: [1]": "unknown keys",
    "multirate: {fast: heun, steps: 2}": "the slow method is missing",
    "multirate: {fast: heun, slow: heun, mis: heun, steps: 2}": "given by slow already",
    "multirate: {slow: heun, steps: 2}": "fast missing",
    "multirate: {slow: heun, fast: heun}": "steps missing",
    "multirate: {slow: heun, fast: heun, steps: 0}": "at least 1",
    "multirate: {mis: heun, fast: heun, steps: 2, coupling: collocation}": "coupling does not go with mis",
    "multirate: {slow: heun, fast: heun, steps: 2, coupling: fastest}": "'fastest' is not known",
    "multirate: {slow: rk4, fast: heun, steps: 2}": "no interpolation through them",
    "multirate: {mis: {family: radau-iia, stages: 2}, fast: heun, steps: 2}": "the slow stages begin at 1/3",
    "multirate: {mis: {splitting: {scheme: lie}}, fast: heun, steps: 2}": "multirate, mis: a method of 2 colours",
    "multirate: {slow: heun, fast: stoermer-verlet, steps: 2}": "multirate, fast: a method of 2 colours",
    "multirate: {slow: heun, fast: rk4, steps: 300}": "stages (limit 400)",
    "multirate: {mri: {c: [0, 1]}, fast: heun, steps: 2}": "gamma missing",
    "multirate: {mri: {c: [0, 1], gamma: []}, fast: heun, steps: 2}": "gamma is empty",
    "multirate: {mri: {c: [0, 2/3], gamma: [[[2/3]]]}, fast: heun, steps: 2}": "the slow stages end at 2/3",
    "multirate: {mri: {c: [0, 1], gamma: [[[1], [1]]]}, fast: heun, steps: 2}": "gamma, matrix 1 is 2 by 1 for 2 nodes",
    "multirate: {slow: heun, fast: heun, steps: 2, coupling: {fast-slow: [[0, 0], [0, 0]]}}": "slow-fast missing",
    "multirate: {slow: heun, fast: heun, steps: 2, coupling: {fast-slow: [[0, 0], [0, 0]], slow-fast: [[0, lambda]]}}": "slow-fast is 1 by 2",
    "multirate: {slow: heun, fast: heun, steps: 2, coupling: {fast-slow: [[0, 0], [0, 0]], slow-fast: [[0, 0], [0, n]]}}": "'n' is not a parameter",
    "multirate: {slow: heun, fast: heun, steps: 2, coupling: {gamma: [[1]]}}": "gamma has 1 column, and the slow method 2 stages",
    "multirate: {slow: heun, fast: heun, steps: 2, coupling: {embedded: [[1, 1]]}}": "gamma missing",
    "A: [[0]]\nb: [lambda]": "'lambda' is not a parameter",
}
"""Files with one fault each, and what is told."""


@pytest.mark.parametrize("text", FAULTS)
def test_faults(text: str) -> None:
    """Each is one fault, with its place and a cure."""
    with pytest.raises(MethodFileError) as caught:
        loads(text)
    assert FAULTS[text] in str(caught.value)
    (fault,) = caught.value.faults
    assert FAULTS[text] in f"{fault.message}; {fault.help}"
    assert fault.help or "is expected" in fault.message
    assert fault.line
    assert fault.column


GOOD = (
    "compose: {of: heun, steps: [1/2, {step: 1/2, adjoint: true}]}",
    "compose: {steps: [{of: heun, step: 1/2}, {of: rk4, step: 1/2}]}",
    "compose: {of: {family: gauss, stages: 2}, scheme: suzuki, from: 4, order: 6}",
    "compose: {of: {A: [[0]], b: [1]}, processor: {A: [[0]], b: [1/2]}}",
    "adjoint: {tableau: {A: [[0, 0], [1/2, 0]], b: [0, 1]}}",
    "adjoint: {adjoint: heun}",
    "splitting: {scheme: strang}\nstructure: nystrom",
    "splitting: {flows: [{1: 1/2}, {2: 1}, {1: 1/2}], of: [heun, rk4]}",
    "splitting: {a: [1/2, 1/2], b: [1]}",
    "extrapolate: {of: heun, sequence: [1, 2], from: 2, symmetric: false}",
    "extrapolate: {of: {splitting: {scheme: strang}}, order: 4}",
    "multirate: {mis: heun, fast: rk4, steps: 3}",
    "multirate: {slow: heun, fast: explicit-midpoint, steps: 3, coupling: collocation}",
    "multirate: {mri: {c: [0, 1], gamma: [[[1]]]}, fast: heun, steps: 2}",
    "multirate: {slow: heun, fast: heun, steps: 2, coupling: {fast-slow: [[0, 0], [lambda/M, 0]], slow-fast: [[0, 0], [1, 0]]}}",
    "multirate: {slow: rk4, fast: exact, coupling: {gamma: [[1, 0, 0, 0]], embedded: [[0, 0, 0, 1]]}}",
)
BAD = (
    "compose: {of: heun, steps: []}",
    "compose: {of: heun, steps: [1], schem: suzuki}",
    "compose: {of: {family: gauss}, steps: [1]}",
    "splitting: {flows: [{x: 1}]}",
    "extrapolate: {order: 4}",
    "adjoint: {}",
    "adjoint: heun\ncompose: {of: heun, steps: [1]}",
    "multirate: {fast: heun, steps: 2}",
    "multirate: {mis: heun, mri: {c: [0, 1], gamma: [[[1]]]}, fast: heun, steps: 2}",
)


@pytest.mark.parametrize("text", GOOD)
def test_the_schema_takes_what_loads(text: str) -> None:
    """What loads is valid by the schema."""
    assert loads(text).tableau.size
    assert VALIDATOR.is_valid(yaml.safe_load(text))


@pytest.mark.parametrize("text", BAD)
def test_the_schema_refuses_what_does_not_load(text: str) -> None:
    """What the schema refuses does not load."""
    assert not VALIDATOR.is_valid(yaml.safe_load(text))
    with pytest.raises(MethodFileError):
        loads(text)


def test_names_of_the_catalogue(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A name is the method of the catalogue, its tolerance included; names that lead in a circle
    and families are refused where they stand.
    """
    files = {
        "mine": "A: [[0.4999999999999]]\nb: [1]\ntolerance: 1e-9",
        "one": "adjoint: other",
        "other": "adjoint: one",
        "family": "A: [[t]]\nb: [1]\nparameters: {t: free}",
    }
    for name, text in files.items():
        (tmp_path / f"{name}.gark.yaml").write_text(text, encoding="utf-8")
    monkeypatch.setenv("GARK_PATH", str(tmp_path))
    method = loads("compose: {of: mine, scheme: triple-jump}")
    assert method.stages == (3,)
    assert str(method.tolerance) == "1/1000000000"
    assert find_order(method).order == 4
    for name, message in (("one", "made from itself"), ("family", "free parameters")):
        with pytest.raises(MethodFileError, match=message) as caught:
            loads(f"adjoint: {name}")
        assert [(x.line, x.column) for x in caught.value.faults] == [(1, 10)]


@pytest.mark.parametrize(
    "text",
    [
        "compose: {of: %s, steps: [1/2, 1/2]}",
        "adjoint: {adjoint: %s}",
        "extrapolate: {of: %s, order: 4}",
        "splitting: {scheme: strang, of: [heun, %s]}",
        "multirate: {mis: heun, fast: %s, steps: 2}",
        "parameters: {t: free}\ncompose: {of: %s, steps: [t, 1 - t]}",
    ],
)
def test_further_weights_are_left_behind(text: str, tmp_path: Path) -> None:
    """Embedded weights and dense output of the methods inside are not those of the result, which
    check says in text and in JSON; without them it says nothing.
    """
    pair = "{A: [[], [1]], b: [1/2, 1/2], embedded: [1, 0], "
    pair += "dense: {degree: 2, weights: [[1, -1/2], [0, 1/2]]}}"
    for base, left in ((pair, ["embedded weights", "dense output"]), ("heun", None)):
        path = tmp_path / "made.yaml"
        path.write_text(text % base, encoding="utf-8")
        outcome = check_file(str(path), limit=4)
        assert outcome.is_read
        report = render([outcome], Look())
        said = "embedded weights and dense output of its parts"
        assert (said in " ".join(report.split())) == (left is not None)
        (data,) = REPORT.document([outcome])["files"]
        assert data.get("left_behind") == left
        VALID.validate(REPORT.document([outcome]))


def test_adjoint_twice_is_the_method() -> None:
    """In a file, too, at points and in a stage algebra."""
    for text in ("{family: gauss, stages: 5}", "rk4", "{splitting: {scheme: ruth-3}}"):
        once = loads(
            f"compose: {{of: {text}, steps: [1]}}" if "gauss" not in text else f"methods: {text}"
        )
        twice = loads(f"adjoint: {{adjoint: {text}}}")
        assert twice.tableau == once.tableau


def test_steps_of_different_methods() -> None:
    """Steps may name their own methods; the two halves are two rows of stages."""
    method = loads(
        "compose: {steps: [{of: explicit-euler, step: 1/2}, {of: {family: radau-iia, stages: 1}, step: 1/2}]}"
    )
    assert list(map(str, method.b)) == ["1/2", "1/2"]
    assert [list(map(str, row)) for row in method.A] == [["0", "0"], ["1/2", "1/2"]]
