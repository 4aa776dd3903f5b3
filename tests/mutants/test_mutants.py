"""What `make mutants` leaves out, which tests it takes, and its list of known survivors."""

from __future__ import annotations

import ast
from itertools import pairwise
from pathlib import Path
from typing import IO

import pytest

from tests.mutants.places import (
    ROOMS,
    ROOT,
    Mutation,
    known,
    lines_of_statement,
    reason_of_kind,
    reason_of_proposal,
    source,
    span,
    without_meaning,
)
from tests.mutants.run import Record, pytest_in, stages

TEXT = '''\
"""A file."""
MOST = 3
Pair: TypeAlias = int | None


@lru_cache(maxsize=16)
def f(x: int | None, γ: int = 2) -> int | None:
    """What it does."""
    assert x is not None
    α = {"µ": 1} if x > 5 else γ  # γ
    for a, b in zip(
        x,
        α, strict=True
    ):
        if a > 4:
            raise ValueError(f"{a + 1} of 4")
        match b:
            case 7:
                return 8
    return cast("int | None", x + 9)
'''


def test_what_has_no_meaning_is_left_alone() -> None:
    """Types, decorators, assertions and texts of errors; numbers and conditions remain."""
    spared = [span(node, TEXT) for node in without_meaning(ast.parse(TEXT))]
    left = set()
    for node in ast.walk(ast.parse(TEXT)):
        if isinstance(node, ast.Constant) and not isinstance(node.value, str):
            start, _ = span(node, TEXT)
            if not any(first <= start < last for first, last in spared):
                left.add(node.value)
    assert left == {3, 2, 1, 5, 4, 7, 8, 9}


def test_mutants_are_judged_by_all_tests(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where tests are recorded and where they judge, none is left out as in the suite."""
    runs: list[dict[str, str]] = []
    monkeypatch.delenv("GARK_WHOLE", raising=False)

    def started(*_: object, env: dict[str, str], stdout: IO[bytes], **__: object) -> None:
        stdout.close()
        runs.append(env)

    monkeypatch.setattr("subprocess.Popen", started)
    for plugin in ("recording", "choosing"):
        pytest_in(tmp_path, tmp_path / "said.txt", plugin, GARK_RECORD="x")
    assert [run["GARK_WHOLE"] for run in runs] == ["1", "1"]
    assert all(run["GARK_RECORD"] == "x" for run in runs)


def test_columns_are_those_of_characters() -> None:
    """Not of bytes, which letters like γ have two of."""
    node = next(
        x for x in ast.walk(ast.parse(TEXT)) if isinstance(x, ast.Compare) and x.lineno == 10
    )
    assert span(node, TEXT) == ((10, 20), (10, 25))


@pytest.mark.parametrize(
    ("line", "lines"),
    [
        (2, None),
        (6, None),
        (10, [10]),
        (12, [11, 12, 13, 14]),
        (15, [15]),
        (17, [17]),
        (18, [18]),
        (19, [19]),
    ],
)
def test_a_place_belongs_to_a_statement(line: int, lines: list[int] | None) -> None:
    """A loop is its head, and what an import does belongs to no test."""
    found = lines_of_statement(TEXT, line)
    assert (found and [*found]) == lines


def test_tests_of_the_room_come_first_and_fast_ones_before_slow_ones() -> None:
    """Those that run the line, and no others."""
    path = "garkcli/stability/damping.py"
    line = source(path).splitlines().index("            if turns >= 2:") + 1
    record = Record(
        code="",
        files={},
        seconds={"tests/check/x::a": 1, "tests/stability/x::b": 9, "tests/stability/x::c": 2},
        lines={
            path: {
                "tests/check/x::a": [line],
                "tests/stability/x::b": [line - 1, line],
                "tests/stability/x::c": [line],
                "tests/stability/x::d": [line - 1],
                "tests/stability/x::failing": [line],
            }
        },
    )
    mutation = Mutation(path, (line, 15), "ReplaceComparisonOperator_GtE_Gt", 0)
    (own, _), (others, files) = stages(mutation, record)
    assert own == ["tests/stability/x::c", "tests/stability/x::b"]
    assert others == ["tests/check/x::a"]
    assert files == []


def test_every_room_exists() -> None:
    """A room that moves is not left out in silence."""
    assert all((ROOT / "garkcli" / room).is_dir() for room in ROOMS)


@pytest.mark.parametrize(
    ("line", "word"),
    [
        ("MOST_FIELD = 6", "limit"),
        ("_MAX_ROWS: int = 7", "limit"),
        ("FIRST_BITS = 64", "precision"),
        ("CHUNK = 1 << 16", "at a time"),
        ("STARTS = 100", "how many"),
        ("FINE = (10**3, 10**6, 10**9)", "which"),
    ],
)
def test_kinds_of_lines_have_a_reason(line: str, word: str) -> None:
    """Named limits, precisions and trials; the pattern is that of lines in the rooms."""
    why = reason_of_kind(line, "")
    assert why
    assert word in why


@pytest.mark.parametrize(
    "line", ["with ctx.workprec(2 * bits):", "MOSTLY = 3", "if n > MOST_TREES:", "STEPS_BITS = 2"]
)
def test_other_lines_are_of_no_kind(line: str) -> None:
    """Where a limit is compared a test sees it."""
    assert reason_of_kind(line, "") is None


@pytest.mark.parametrize(
    ("was", "becomes", "is_known"),
    [
        ("if n > MOST_TREES:", "if n >= MOST_TREES:", True),
        ("if n >= MOST_TREES:", "if n > MOST_TREES:", True),
        ("while not n <= MAX:", "while not n < MAX:", True),
        ("if n > MOST_TREES:", "if n <= MOST_TREES:", False),
        ("if n > MOST_TREES:", "if n < MOST_TREES:", False),
        ("if n > 0 and m > MOST:", "if n >= 0 and m > MOST:", False),
        ("if n > MOST or not m:", "if n > MOST and not m:", False),
        ("with ctx.workprec(bits + 32):", "with ctx.workprec(bits +  33):", True),
        ("with ctx.workprec(bits + 32):", "with ctx.workprec(bits - 32):", False),
        ("with ctx.workprec(2 * bits + 64):", "with ctx.workprec( 1 * bits + 64):", False),
    ],
)
def test_changes_by_one_of_limits_and_spare_bits(was: str, becomes: str, is_known: bool) -> None:
    """The edge of a comparison with a limit, a spare bit; no other change of such a line."""
    assert (reason_of_kind(was, becomes) is not None) == is_known


def test_proposals_are_files_or_functions_in_them() -> None:
    """Each exists; a line outside of the named functions is none."""
    for entry in known("proposal"):
        nodes = ast.walk(ast.parse(source(entry["file"])))
        names = {x.name for x in nodes if isinstance(x, ast.FunctionDef | ast.ClassDef)}
        assert names.issuperset(entry.get("names", ()))
        assert len(entry["why"]) > 10
    path = "garkcli/order/bounded.py"
    lines = source(path).splitlines()
    inside = lines.index("    for _ in range(12):") + 1
    proof = lines.index("    return bool(centre > (slope + lost) * (1 + UNIT))") + 1
    assert reason_of_proposal(path, inside)
    assert reason_of_proposal(path, proof) is None


def test_known_survivors_are_still_there() -> None:
    """Each entry has a reason, and text of its file that becomes another text."""
    entries = known()
    keys = [(x["file"], x["was"], x.get("becomes", ""), x.get("after", "")) for x in entries]
    assert len(keys) == len({*keys})
    for entry in entries:
        lines = [line.strip() for line in source(entry["file"]).splitlines()]
        first, *_ = was = entry["was"].splitlines()
        assert {*was} <= {*lines}, entry
        assert ("after" in entry) == (lines.count(first) > 1), entry
        if "after" in entry:
            assert (entry["after"], first) in pairwise(lines), entry
        assert entry["was"] != entry.get("becomes")
        assert len(entry["why"]) > 10
