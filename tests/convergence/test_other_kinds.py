"""The orders that Nyström, nonlinearly partitioned and multiderivative methods show on problems."""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli.api.runs import converge
from tests.whole import in_whole

ERRATA = Path(__file__).resolve().parents[1] / "examples" / "errata"


@pytest.mark.parametrize(
    ("name", "on", "order"),
    [
        ("fine-34", None, 4),
        ("fine-34-misprint", None, 1),
        (str(ERRATA / "tracker-rkng-56.gark.yaml"), None, 2),
        ("nystrom-5-positions", "kepler", 5),
        ("nystrom-4", "oscillator", 4),
        ("imex-nprk-54sa", None, 3),
        pytest.param("nystrom-4", "van-der-pol", 4, marks=in_whole),
        pytest.param("fehlberg-rkng-56", None, 5, marks=in_whole),
        pytest.param("sharp-fine-56", None, 6, marks=in_whole),
        pytest.param("murua-5", None, 5, marks=in_whole),
        pytest.param("imex-nprk-54si", None, 3, marks=in_whole),
        pytest.param("imim-nprk-32b", "kepler", 2, marks=in_whole),
        ("tdrk-4", None, 4),
        ("tdrk-5", "lotka-volterra", 5),
        ("obreshkov-6", "oscillator", 6),
        ("hb-i2drk6", "logistic", 6),
        pytest.param("tdrk-5", None, 5, marks=in_whole),
        pytest.param("tdrk-4", "van-der-pol", 4, marks=in_whole),
        pytest.param("obreshkov-6", "kepler", 6, marks=in_whole),
    ],
)
def test_observed_orders(name: str, on: str | None, order: int) -> None:
    """The errors fall with the order that gark check proves, no faster."""
    found = converge(name, on)
    assert found.verdict == "agree"
    assert found.predicted_order == order
    assert found.observed_order is not None
    assert abs(found.observed_order - order) < 0.15
