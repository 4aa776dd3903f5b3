"""What targets write for languages that ``gark import`` reads comes back."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import pytest

from garkcli.bridges.preparing import prepared
from garkcli.bridges.readers.registry import reader_named
from garkcli.bridges.registry import bridges
from garkcli.bridges.rounding import nearest_float
from garkcli.bridges.subject import read
from garkcli.methodfile.load import loads
from tests.bridges.examples import MIDPOINTS, RALSTON, VERLET, payload_of

READ_BACK = {
    "julia": "julia",
    "mathematica": "mathematica",
    "matlab": "matlab",
    "rklab": "matlab",
    "ordinarydiffeq": "julia",
    "climatimesteppers": "julia",
    "rungekutta-jl": "tsv",
}
"""From a target to the reader of what it writes."""


@pytest.mark.parametrize("target", READ_BACK)
@pytest.mark.parametrize("method", [RALSTON, MIDPOINTS, VERLET])
def test_what_is_written_is_read(target: str, method: str) -> None:
    """Blocks and weights come back, in the place of each; they have short decimals or fractions."""
    payload = payload_of(method)
    bridge = bridges()[target]
    assert bridge.reads_back
    if payload.kind not in bridge.kinds:
        return
    reader = reader_named(READ_BACK[target])
    (found,) = reader.find(bridge.written(payload), f"x{bridge.suffix}")
    assert not found.trouble
    for l, blocks in enumerate(payload.A):
        read = found.A[l] if len(found.A) > l else found.A[0]
        for block, other in zip(blocks, read, strict=True):
            assert (block is None) == (other is None)
            for row, texts in zip(block or (), other or (), strict=True):
                assert near(row, texts)
        assert near(payload.b[l], found.b[l])
    if payload.embedded and target not in {"rungekutta-jl", "climatimesteppers"}:
        assert found.embedded
        assert near(payload.embedded[0], found.embedded[0])


def test_a_general_pair_with_nodes_of_its_parts() -> None:
    """Both parts see both, each at nodes of its own: all blocks come back out of JSON."""
    q = "{A: [[0, 1/3], [-1, 1/2]], b: [1/2, 1/2], c: [1/3, -1/2]}"
    p = "{A: [[0, 0], [0, 1/2]], b: [0, 1], c: [0, 1/2]}"
    method = loads(f"structure: general\nprk: {{q: {q}, p: {p}}}")
    text = bridges()["json"].written(prepared(method))
    (found,) = reader_named("json").find(text, "x.json")
    assert read(found).tableau == method.tableau


def near(row: Sequence[Any], texts: Sequence[str]) -> bool:
    """Whether texts are the entries of a row, or the floats nearest to these."""
    pairs = zip(row, texts, strict=True)
    return all(float(Fraction(y)) == nearest_float(x) for x, y in pairs)
