"""docs/errata.md: each table of tests/examples/errata fails as the page says, and holds mended."""

from __future__ import annotations

import re

import pytest

from garkcli import check_file
from garkcli.check.outcome import Outcome
from tests.cli.harness import ROOT
from tests.whole import IS_WHOLE

PAGE = (ROOT / "docs" / "errata.md").read_text(encoding="utf-8")
FILES = {x.name.removesuffix(".gark.yaml"): x for x in (ROOT / "tests/examples/errata").iterdir()}
ROWS = {name: row for row in PAGE.splitlines() for name in re.findall(r"`([\w-]+)`", row)}
MENDED = {
    "alshina-2": "d1=-3/4 d2=3/4",
    "blastfoam-rk-2": "a21=1",
    "cgdycore-kencar-3": "g=1767732205903/4055673282236 a43=10755448449292/10357097424841",
    "cgdycore-ssp-3": "b3=2/3",
    "ckllsrk-54-3c": "c5=0.845495878172714486610480717826",
    "ckllsrk-95-4c": "a7=1183947748311/9144450320350",
    "daceypy-54": "a21=2/9",
    "dcm-heun-2": "b1=1/4",
    "dcm-rk-65": "b6=7/90",
    "diffeq-rodas-4": "d4=-0.03620000000000023",
    "esdirk-547": "c4=49/353",
    "foodie-heun-2": "b2=1/2 e1=1",
    "hermes-lobatto-iiib-2": "a12=0 a21=1/2",
    "hermes-rk-2": "c1=0 c2=2/3",
    "implode-fehlberg-45": "a31=3/32 a32=9/32",
    "kencarp-5": "a76=-4269925059573/7827059040749",
    "kvaerno-3": "c2=0.871733043",
    "nsde-butcher-7": "a81=5/154",
    "nsde-ssp2-322": "a21=0",
    "nsde-ssp2-332": "b3=1/3",
    "odeint-rodas-4": "d4=-0.03620000000000023",
    "odetojava-ars-222": "a33=1-sqrt(2)/2",
    "odetojava-ars-232": "a33=1-sqrt(2)/2",
    "odetojava-ars-343": "a31=0.3212788860",
    "odetojava-lirk-32": "d=0.245886896936575047939191445319",
    "odetojava-rk-4": "c2=1/2 c3=1/2 c4=1",
    "odetojava-three-eighths": "a31=-1/3 a32=1",
    "parthenon-rk-2": "b1=1/2 b2=1/2",
    "pep-425": "c3=37/63 c4=19/20",
    "pep-756": "c3=0.29430105666234846",
    "ponio-21": "c2=1",
    "ponio-548": "a31=41/400",
    "ponio-ralston-4": "c3=0.45573725",
    "pystella-inhomogeneous-3": "c2=1/4 c3=2/3",
    "pystella-williamson-3": "c2=1/3 c3=3/4",
    "rungekutta-ssprk-3": "a31=1/4",
    "sbscl-rodas-4": "d2=-0.1043",
    "simframe-cash-karp-5": "c4=3/5",
    "speake-fehlberg-5": "c6=1/2",
    "simframe-dormand-prince-5": "a65=-5103/18656 b5=-2187/6784",
    "sir-54": "d4=1.788803890902483",
    "ssp-sdirk-2": "c1=1/4 c2=3/4",
    "tacs-548": "a32=-567603406766/11931857230679",
    "tfdiffeq-bosh-3": "c2=1/2 a32=3/4",
    "timepack-ark-324": "a41=6485989280629/16251701735622 a42=-4246266847089/9704473918619"
    " a43=10755448449292/10357097424841",
    "timepack-esdirk-58": "c7=30/83",
    "trab1-fehlberg-45": "a62=2",
    "trab1-gauss-2": "x=1/4",
    "tracker-rkng-56": "a51=81/640",
    "wme7-lobatto-iiia-3": "c2=1/2",
}
"""The numbers that belong in place of the wrong ones."""
LONG = {
    *("rk-1214", "pep-756", "kencarp-5", "tacs-548", "ponio-548", "cgdycore-kencar-3"),
    *("timepack-esdirk-58", "fehlberg-45"),
}
"""Files that take long: they are checked in ``make whole``."""


def checked(name: str, settings: str = "") -> Outcome:
    """What gark check finds, with other numbers in place of the wrong ones."""
    if name in LONG and not IS_WHOLE:
        pytest.skip("takes long")
    values = dict(x.split("=", 1) for x in settings.split())
    return check_file(FILES[name], limit=8 if name == "pep-756" else 60, settings=values)


def test_every_file_is_on_the_page() -> None:
    """So the page has no error without a file that shows it."""
    assert {*FILES} - {*ROWS} == set()
    assert {*MENDED} < {*FILES}


@pytest.mark.every_case
@pytest.mark.parametrize("name", FILES)
def test_a_table_fails_as_its_row_says(name: str) -> None:
    """A claim fails; where the row has two orders, the first is found and the second claimed."""
    outcome = checked(name)
    assert outcome.faults == ()
    failed = {(x.found, x.expected) for x in outcome.failed_claims}
    assert failed
    if orders := re.search(r"\| (\d+), not (\d+) \|", ROWS[name]):
        assert orders.groups() in failed


@pytest.mark.every_case
@pytest.mark.parametrize("name", MENDED)
def test_a_mended_table_is_right(name: str) -> None:
    """All claims hold with the right numbers."""
    outcome = checked(name, MENDED[name])
    assert outcome.ok, outcome.failed_claims


def test_the_sign_of_an_error_estimate() -> None:
    """Fehlberg's pair 8(9) with the sign that Tudat has."""
    if not IS_WHOLE:
        pytest.skip("takes long")
    command = re.search(r"gark check fehlberg-9 --set e=(\S+)`", PAGE)
    assert command
    failed = check_file("fehlberg-9", settings={"e": command[1]}).failed_claims
    assert ("8", "9") in {(x.found, x.expected) for x in failed}
