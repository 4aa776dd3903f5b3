"""No input, however made, is met with anything but a verdict or the errors of
``garkcli.errors``.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from random import Random
from time import process_time, sleep
from typing import Any

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from garkcli.constructions.schemes import SCHEMES, SPLITTINGS
from garkcli.errors import ExpressionError, MethodFileError, Remark
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.rewriting import substitute
from garkcli.families.registry import FAMILIES
from garkcli.methodfile.description import FORMS, STRUCTURES
from garkcli.methodfile.expectations import CLAIMS
from garkcli.methodfile.file_keys import KEYS
from garkcli.methodfile.load import loads
from garkcli.methodfile.transfers import ALL_RULES
from garkcli.problems.files.load import loads_problem
from garkcli.tableau.tableau import Tableau
from tests.fuzz.inputs import RADICALS, SIGNS, WORDS, method_file, seeds, soup
from tests.fuzz.long_run import Cases, run
from tests.fuzz.problem_inputs import problem_file, problem_seeds, written_problem
from tests.oracles.draws import fractions
from tests.whole import at_most, in_whole

SLOWEST = 5.0
"""Seconds of the processor that no file may take before its verdict."""
FUZZ = settings(
    max_examples=int(os.environ.get("GARK_FUZZ_EXAMPLES", at_most(20, 60))),
    deadline=None,  # that is of a clock; ``faults_of`` has the other
    derandomize=True,
    database=None,
    suppress_health_check=list(HealthCheck),
)
"""As many cases, always the same ones; ``make fuzz`` asks for more."""

NUMBERS = st.one_of(
    st.integers(-3, 12),
    fractions(-3, 3, 12).map(str),
    st.sampled_from([word.strip('"') for word in RADICALS]),
    st.floats(),
    st.sampled_from(["tau", "1 - tau", "free", ">= 2"]),
)
SCALARS = st.one_of(
    NUMBERS, st.none(), st.booleans(), st.dates(), st.text(max_size=20), st.sampled_from(WORDS)
)
TREES = st.recursive(
    SCALARS,
    lambda below: st.lists(below, max_size=4) | st.dictionaries(SCALARS, below, max_size=4),
    max_leaves=12,
)
"""Any value that YAML can write."""


def _or_anything(good: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """Mostly what belongs there."""
    return st.integers(0, 11).flatmap(lambda chance: TREES if chance == 0 else good)


def _rows(strategy: st.SearchStrategy[Any], longest: int = 3) -> st.SearchStrategy[list[Any]]:
    return st.integers(1, longest).flatmap(
        lambda size: st.lists(strategy, min_size=size, max_size=size)
    )


ROW = _or_anything(_rows(_or_anything(NUMBERS)))
MATRIX = _or_anything(_rows(ROW))
BUTCHER = st.fixed_dictionaries({"A": MATRIX, "b": ROW}, optional={"c": ROW, "name": SCALARS})
FAMILY = st.fixed_dictionaries(
    {"family": _or_anything(st.sampled_from(sorted(FAMILIES)))},
    optional={"stages": _or_anything(st.integers(0, 5))},
)
RULE = st.one_of(
    st.sampled_from(ALL_RULES),
    st.dictionaries(st.sampled_from(ALL_RULES), NUMBERS, min_size=1, max_size=3),
)
TRANSFER = RULE | st.fixed_dictionaries(
    {},
    optional={
        "default": RULE,
        "blocks": st.dictionaries(st.sampled_from(["1,2", "2,1", "3, 1"]), RULE | MATRIX),
    },
)
VALUES: dict[str, st.SearchStrategy[Any]] = {
    "gark": st.just(1),
    "methods": _rows(FAMILY | BUTCHER),
    "transfer": TRANSFER,
    "tableau": st.fixed_dictionaries(
        {"A": _rows(_rows(MATRIX | st.none())), "b": _rows(ROW)}, optional={"c": MATRIX}
    ),
    "ark": st.fixed_dictionaries({"A": _rows(MATRIX), "b": ROW | MATRIX}, optional={"c": ROW}),
    "prk": st.fixed_dictionaries({"q": BUTCHER, "p": BUTCHER}),
    "structure": st.sampled_from(STRUCTURES),
    "conjugate": st.booleans(),
    "linear": st.lists(st.integers(0, 4), max_size=3),
    "parameters": st.dictionaries(st.sampled_from(["tau", "x", "sqrt"]), NUMBERS),
    "tolerance": st.floats(1e-20, 1),
    "expect": st.dictionaries(st.sampled_from(CLAIMS), TREES, max_size=3),
}


PARTS = _or_anything(
    st.sampled_from(["heun", "explicit-euler", "no-method"])
    | st.just({"family": "gauss", "stages": 1})
    | st.just({"A": [[0]], "b": [1]})
    | st.just({"splitting": {"scheme": "strang"}})
)
STEPS = SCALARS | st.fixed_dictionaries(
    {"step": SCALARS}, optional={"of": PARTS, "adjoint": SCALARS}
)
VALUES |= {
    "shu-osher": st.fixed_dictionaries(
        {}, optional={"alpha": MATRIX, "beta": MATRIX, "c": ROW, "embedded": ROW}
    ),
    "low-storage": st.fixed_dictionaries(
        {"form": SCALARS | st.sampled_from(["2N", "2C", "2R", "3R", "2S", "3S*"])},
        optional={
            "A": ROW | MATRIX,
            **dict.fromkeys(("B", "b", "gamma1", "gamma2", "gamma3", "delta", "beta", "c"), ROW),
        },
    ),
    "nprk": st.fixed_dictionaries(
        {}, optional={"a": st.lists(MATRIX, max_size=3), "b": MATRIX, "embedded": MATRIX}
    ),
    "derivatives": st.fixed_dictionaries(
        {},
        optional={
            "A": st.lists(MATRIX, max_size=3),
            **dict.fromkeys(("b", "embedded"), MATRIX),
            "c": ROW,
        },
    ),
    "nystrom": st.fixed_dictionaries(
        {},
        optional={
            **dict.fromkeys(("Abar", "A"), MATRIX),
            **dict.fromkeys(("c", "bbar", "b"), ROW),
            "embedded": _or_anything(st.fixed_dictionaries({}, optional={"bbar": ROW, "b": ROW})),
        },
    ),
    "rosenbrock": st.fixed_dictionaries(
        {},
        optional={
            "blocks": _or_anything(
                st.fixed_dictionaries(
                    {},
                    optional={
                        **dict.fromkeys(
                            ("alpha", "gamma"),
                            st.lists(st.lists(MATRIX | st.none(), max_size=2), max_size=2),
                        ),
                        **dict.fromkeys(("b", "c", "d", "embedded"), MATRIX),
                    },
                )
            ),
            "alpha": MATRIX,
            "gamma": SCALARS | MATRIX,
            "b": ROW,
            "c": ROW,
            "d": ROW,
            "embedded": ROW,
            "transformed": _or_anything(
                st.fixed_dictionaries(
                    {"A": MATRIX, "C": MATRIX, "gamma": NUMBERS | ROW, "m": ROW},
                    optional={"e": ROW},
                )
            ),
        },
    ),
    "adjoint": PARTS,
    "compose": st.fixed_dictionaries(
        {},
        optional={
            "of": PARTS,
            "steps": _or_anything(st.lists(STEPS, max_size=3)),
            "scheme": _or_anything(st.sampled_from(sorted(SCHEMES)[:4])),
            "order": SCALARS,
            "processor": PARTS,
        },
    ),
    "extrapolate": st.fixed_dictionaries(
        {"of": PARTS},
        optional={
            "sequence": _or_anything(st.just([1, 2])),
            "order": _or_anything(st.integers(1, 4)),
            "from": SCALARS,
            "symmetric": SCALARS,
        },
    ),
    "splitting": st.fixed_dictionaries(
        {},
        optional={
            "a": _or_anything(st.just([1, 0])),
            "b": _or_anything(st.just([1])),
            "flows": _or_anything(st.lists(st.just({1: 1, 2: 1}), max_size=2)),
            "scheme": _or_anything(st.sampled_from(sorted(SPLITTINGS))),
            "of": PARTS,
            "terms": _or_anything(st.integers(0, 4)),
        },
    ),
    "multirate": st.fixed_dictionaries(
        {"fast": PARTS | st.just("exact")},
        optional={
            "steps": _or_anything(st.integers(0, 3)),
            "slow": PARTS,
            "mis": PARTS
            | st.fixed_dictionaries({"beta": MATRIX}, optional={"alpha": MATRIX, "gamma": MATRIX}),
            "mri": _or_anything(
                st.fixed_dictionaries(
                    {"c": ROW},
                    optional={
                        "gamma": _rows(MATRIX),
                        "omega": _rows(MATRIX),
                        "embedded": MATRIX
                        | st.fixed_dictionaries({}, optional={"gamma": MATRIX, "omega": MATRIX}),
                        "restart": _or_anything(st.sampled_from(("merk", "sr"))),
                    },
                )
            ),
            "coupling": SCALARS
            | st.fixed_dictionaries({}, optional={"fast-slow": MATRIX, "slow-fast": MATRIX})
            | st.fixed_dictionaries({"gamma": MATRIX}, optional={"embedded": MATRIX}),
        },
    ),
}


def _files() -> st.SearchStrategy[dict[Any, Any]]:
    """One form, and a few of the other keys, each with a value that may belong there."""
    assert set(VALUES) < set(KEYS)
    others = {key: _or_anything(value) for key, value in VALUES.items() if key not in FORMS}
    others |= {key: SCALARS for key in KEYS if key not in VALUES}
    return st.sampled_from(FORMS).flatmap(
        lambda form: st.fixed_dictionaries({form: _or_anything(VALUES[form])}, optional=others)
    )


def faults_of(text: str, load: Callable[[str], object] = loads) -> tuple[Remark, ...]:
    """The faults of a file; none where it is good. Any other exception is what fuzzing looks for,
    or much time.
    """
    start = process_time()
    try:
        load(text)
    except MethodFileError as error:
        return error.faults or (Remark("an error without faults"),)
    finally:
        assert process_time() - start < SLOWEST, text
    return ()


def check_places(text: str) -> None:
    """Every fault of a file says something, and where."""
    assert all(fault.line >= 1 and fault.column >= 1 and fault.message for fault in faults_of(text))


def offset_of_fault(text: str) -> int:
    """Where a number is wrong; 0 where it is right."""
    try:
        expression = substitute(parse(text), {"tau": parse("1/2")})
        Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        return error.start
    return 0


@pytest.mark.parametrize("seed", range(at_most(1, 3)))
def test_method_files(seed: int) -> None:
    """Three hundred damaged files a seed: a method or its faults, each with a place in the file,
    and soon.
    """
    random, files = Random(seed), seeds()
    refused = 0
    for _ in range(300):
        text = method_file(random, files)
        faults = faults_of(text)
        refused += bool(faults)
        assert all(fault.line >= 1 and fault.column >= 1 and fault.message for fault in faults), (
            text
        )
    assert 0 < refused < 300


@in_whole
@pytest.mark.parametrize("seed", range(at_most(1, 3)))
def test_problem_files(seed: int) -> None:
    """Damaged problem files: a problem or its faults, each with a place, and soon; ``make fuzz`` has
    thousands.
    """
    random, files = Random(seed), problem_seeds()
    refused = 0
    for _ in range(40):
        text = problem_file(random, files)
        faults = faults_of(text, loads_problem)
        refused += bool(faults)
        assert all(fault.line >= 1 and fault.column >= 1 and fault.message for fault in faults), (
            text
        )
    assert 0 < refused < 40


@in_whole
def test_what_is_damaged_was_good() -> None:
    """The problem files that damage begins with have no faults; of the written ones many have
    none.
    """
    assert not any(faults_of(text, loads_problem) for text in problem_seeds())
    count = at_most(15, 40)
    good = sum(not faults_of(written_problem(Random(seed)), loads_problem) for seed in range(count))
    assert count < 5 * good < 4 * count


MISDEEDS = {
    "2": "raises",
    "4": "warns",
    "6": "fills the memory",
    "8": "has no faults",
    "10": "works on",
}
"""What a loader does with some inputs and may not."""


class Faulty(Cases):
    """A loader with misdeeds, which sleeps over the first input."""

    def load(self, text: str) -> Tableau | None:
        """Nothing is loaded."""
        if text == "0":
            sleep(3 * self.seconds)
        match MISDEEDS.get(text):
            case "raises":
                raise ValueError
            case "warns":
                warnings.warn("soon gone", DeprecationWarning, stacklevel=1)
            case "fills the memory":
                bytearray(2**30)
            case "has no faults":
                raise MethodFileError("m", ())
            case "works on":
                while True:
                    pass
        return None

    def reader(self) -> Callable[[int], str]:
        """Numbers as texts."""
        return str


@in_whole
def test_faults_of_the_loader_are_found() -> None:
    """In workers every misdeed is a fault, at its number, and the next number follows; sleep takes
    no processor.
    """
    found = run(Faulty(1, seconds=0.2), range(12))
    assert [case.number for case in found] == [*range(12)]
    assert {case.number for case in found if case.kind != "loaded"} == {*map(int, MISDEEDS)}
    errors = {MISDEEDS[str(case.number)]: case.error for case in found if case.kind == "fault"}
    assert "ValueError" in errors["raises"]
    assert "DeprecationWarning" in errors["warns"]
    assert "MemoryError" in errors["fills the memory"]
    assert "without a place" in errors["has no faults"]
    assert "longer than 0.2 s" in errors["works on"]


@in_whole
@pytest.mark.parametrize("are_problems", [False, True])
def test_the_long_run_in_short(are_problems: bool) -> None:
    """Its first cases: each has a verdict, and the same text whenever it is asked for."""
    cases = Cases(1, are_problems)
    numbers = range(at_most(15, 40))
    found = run(cases, numbers)
    assert [case.number for case in found] == [*numbers]
    assert {case.kind for case in found} == {"loaded", "refused"}
    assert cases.reader()(7) == cases.reader()(7) != cases.reader()(8)


@pytest.mark.parametrize("seed", range(4))
def test_numbers(seed: int) -> None:
    """Five hundred texts of number signs a seed: a value, or an error with offsets inside the
    text.
    """
    random = Random(seed)
    for _ in range(500):
        text = soup(random, SIGNS, 30)
        assert 0 <= offset_of_fault(text) <= len(text), text


@in_whole
@FUZZ
@given(_files())
def test_files_of_any_values(content: dict[Any, Any]) -> None:
    """Mappings of the right keys to values that may belong there, as YAML writes them."""
    check_places(yaml.safe_dump(content))


@FUZZ
@given(TREES)
def test_any_yaml(content: object) -> None:
    """Whatever YAML can write."""
    check_places(yaml.safe_dump(content))


@FUZZ
@given(
    st.text(max_size=200)
    | st.lists(st.sampled_from(WORDS) | st.text(max_size=3), max_size=40).map("".join)
)
def test_any_text(text: str) -> None:
    """Text that need not be YAML."""
    check_places(text)


@FUZZ
@given(st.text(max_size=60) | st.text(alphabet="0123456789.+-*/^()eE, sqrtcboau", max_size=60))
def test_any_number(text: str) -> None:
    """Text that need not be a number: a value, or an error with offsets inside the text."""
    assert 0 <= offset_of_fault(text) <= len(text)
