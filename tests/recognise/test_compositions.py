"""Symmetric compositions are known by half of their coefficients, or by one row of them."""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli import audit
from garkcli.recognise.compositions import FORMS

BLANES_MOAN = (
    "0.0792036964311957, 0.1303114101821663, 0.2228614958676077,"
    " {}, 0.3246481886897062, 0.1096884778767498"
)
"""S6, order 4, of Blanes and Moan (2002)."""
YOSHIDA = "0.784513610477560, 0.235573213359357, -1.17767998417887"
"""Solution A of order 6 of Yoshida (1990), the middle 1.31518632068390 behind it."""
SUZUKI = "p, p, 1 - 4*p, p, p"


@pytest.mark.parametrize(
    ("form", "row", "order", "stages"),
    [
        ("adjoint", BLANES_MOAN.format("-0.3667132690474257"), 4, 7),
        ("middle", f"{YOSHIDA}, 1.31518632068390", 6, 8),
        ("halves", YOSHIDA, 6, 8),
        ("palindrome", SUZUKI, 4, 6),
    ],
)
def test_a_row_is_a_composition(
    form: str, row: str, order: int, stages: int, tmp_path: Path
) -> None:
    """It is judged as the splitting of drifts and kicks that it is; no name tells it."""
    path = tmp_path / "a.py"
    path.write_text(f"def first():\n    p = 1/(4 - 4**(1/3))\n    x = [{row}]\n    return go(x)\n")
    (found,) = audit([str(path)])
    assert found.order is not None
    assert (found.order.order, found.table.how) == (order, FORMS[form])
    assert [len(x) for x in found.table.b] == [stages, stages]


@pytest.mark.parametrize(
    "row",
    [
        BLANES_MOAN.format("-0.3667132960474257"),
        "1/4, 1/8, 1/8",
        "1/4, 1/2, 1/4",
        "0.25, 0.5, 0.25",
        "0.5, 0.5",
        "(3 - sqrt(3))/6, (3 + sqrt(3))/6",
        "0.788675134594812882, 0.211324865405187118",
    ],
)
def test_other_rows_are_none(row: str, tmp_path: Path) -> None:
    """Digits that miss order 3, sums alone, and nodes of Gauss."""
    path = tmp_path / "a.py"
    path.write_text(f"def first():\n    x = [{row}]\n    return go(x)\n")
    assert list(audit([str(path)])) == []
