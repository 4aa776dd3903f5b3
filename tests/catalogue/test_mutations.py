"""A digit of a file of the catalogue changed: a claim of the file fails."""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli import catalogue
from garkcli.check.check_file import check_file
from tests.whole import in_whole

CHANGES = [
    # entries of A
    ("dormand-prince-5", "-212/729", "-213/729"),
    ("cash-karp-5", "253/4096", "263/4096"),
    ("verner-6", "-165/64", "-155/64"),
    ("gauss-2", "[1/4, ", "[1/5, "),
    ("lobatto-iiic-3", "-1/3", "-1/4"),
    ("kvaerno-4", "0.4358665", "0.4358765"),
    pytest.param("ark-436", "2731218467317", "2731218567317", marks=in_whole),
    ("imex-gark-2a", "[1/4, 1/2", "[1/4, 1/3"),
    ("ruth-3", "7/24", "7/25"),
    # weights
    ("heun-3", "b: [1/4", "b: [1/5"),
    ("ssp-104", "1/10", "1/11"),
    ("fehlberg-8", "b: [0, 0, 0, 0, 0, 34/105", "b: [0, 0, 0, 0, 0, 34/106"),
    pytest.param("dop853", "b: [5.42", "b: [5.43", marks=in_whole),
    # nodes
    ("bogacki-shampine-5", "c: [0, 1/6", "c: [0, 1/7"),
    ("sdirk-4", "c: [0.25", "c: [0.35"),
    # embedded weights
    ("bogacki-shampine-3", "embedded: [7/24", "embedded: [7/23"),
    pytest.param("tsitouras-5", "1/66", "1/67", marks=in_whole),
    ("tr-bdf2", "1/3 - sqrt(2)/12", "1/3 - sqrt(2)/13"),
    ("verner-8", "embedded: [1083", "embedded: [1093"),
    pytest.param("ark-548", "embedded: [-975461918565", "embedded: [-975461918465", marks=in_whole),
    # coefficients of compositions
    pytest.param("yoshida-6c", "1.4477", "1.4478", marks=in_whole),
    pytest.param("blanes-moan-s-10", "0.14881", "0.14882", marks=in_whole),
    ("kahan-li-6", "a2: 0.33", "a2: 0.34"),
    # what a formula is made of
    ("ars-343", "13*g", "12*g"),
    ("norsett-3", "24*x^3", "25*x^3"),
    # dense output
    ("dormand-prince-5", "40617522/29380423", "40617523/29380423"),
]
"""Methods, each with a text of its file and what it is changed to, at its first place."""


@pytest.mark.parametrize(("name", "before", "after"), CHANGES)
def test_a_changed_digit_is_seen(name: str, before: str, after: str, tmp_path: Path) -> None:
    """The file with the change is read, and at least one of its claims does not hold."""
    text = catalogue[name].text
    assert before in text
    changed = tmp_path / f"{name}.gark.yaml"
    changed.write_text(text.replace(before, after, 1), encoding="utf-8")
    outcome = check_file(str(changed))
    assert not outcome.faults, outcome.faults
    assert outcome.failed_claims
