"""``gark check`` on directories: what reading, starting and reporting cost beside the certificates
themselves.
"""

from __future__ import annotations

import subprocess
from itertools import product
from pathlib import Path
from time import perf_counter

import pytest

from garkcli import conjugate, pair
from garkcli.errors import MethodFileError
from garkcli.methodfile.load import load
from garkcli.order.certificate import find_order
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import PAIR_RULES, RULES
from tests.benchmarks.measuring import (
    GARK,
    assert_ratio,
    interleaved,
    process,
    seconds,
    side_by_side,
)
from tests.catalogue.catalogue import entries
from tests.catalogue.method_files import method_file

FILES = 200
MEMBERS = [
    f"{{family: {f}, stages: {s}}}"
    for f in ("gauss", "radau-iia", "lobatto-iiia")
    for s in (2, 3, 4)
]


def family_files() -> list[str]:
    """Pairs of Gauss, Radau and Lobatto methods of 2 to 4 stages, coupled by every rule in turn."""
    rules = (*RULES, *PAIR_RULES)
    pairs = [(one, other) for one, other in product(MEMBERS, MEMBERS) if one != other]
    return [
        f"methods: [{one}, {other}]\ntransfer: {rules[k % len(rules)]}\n"
        for k, (one, other) in enumerate(pairs)
    ]


def rational_file(k: int) -> str:
    """A Butcher tableau of 2 to 5 stages with small rational entries, explicit for every other
    ``k``.
    """
    s = 2 + k % 4
    implicit = k % 2

    def entry(i: int, j: int) -> str:
        return (
            f"{(3 * i + 5 * j + k) % 7 + 1}/{(i + 2 * j + k) % 5 + 2}" if j < i + implicit else "0"
        )

    rows = ", ".join(f"[{', '.join(entry(i, j) for j in range(s))}]" for i in range(s))
    weights = ", ".join(f"{2 * (i + 1)}/{s * (s + 1)}" for i in range(s))
    return f"methods: [{{A: [{rows}], b: [{weights}]}}]\n"


@pytest.fixture(scope="module")
def directory(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two hundred method files."""
    folder = tmp_path_factory.mktemp("methods")
    families = family_files()
    texts = [*families, *(rational_file(k) for k in range(FILES))][:FILES]
    assert 50 <= len(families) <= FILES - 50
    for k, text in enumerate(texts):
        (folder / f"m{k:03}.gark.yaml").write_text(text)
    return folder


def certificates(tableau: Tableau) -> tuple[Tableau, ...]:
    """The tableaus whose order a check decides: the method, its conjugate, their pair."""
    return tableau, conjugate(tableau), pair(tableau)


def test_a_directory_costs_its_certificates(directory: Path) -> None:
    """Two hundred files in one call: within four times their certificates and one start-up."""
    paths = sorted(directory.glob("*.gark.yaml"))
    tableaus: list[Tableau] = []
    for path in paths:
        try:
            tableaus += certificates(load(str(path)).tableau)
        except MethodFileError as error:
            raise AssertionError(f"{path.read_text()}: {error}") from error
    assert len(tableaus) == 3 * FILES
    orders = seconds(lambda: [find_order(tableau) for tableau in tableaus], 3)
    start = seconds(process([*GARK, "check", str(paths[0])]), 5)
    whole = seconds(process([*GARK, "check", str(directory)]), 3)
    detail = f"{whole:.2f} s, certificates {orders:.2f} s, start-up {start:.2f} s"
    assert_ratio(
        f"gark check of {FILES} files / certificates and start-up",
        whole / (orders + start),
        4.0,
        detail,
    )


def test_two_workers_cost_little_more(tmp_path: Path) -> None:
    """A thousand files by two workers: the processor time of two commands that check half of them
    each, and at most a fifth for what goes between processes.

    Those two run side by side too: processors that share a core take longer for the same work, up
    to a third on the machine where this was written.
    """
    halves = [tmp_path / "even", tmp_path / "odd"]
    for half in halves:
        half.mkdir()
    for k in range(1000):
        (halves[k % 2] / f"m{k:03}.gark.yaml").write_text(rational_file(k))
    command = [*GARK, "check", "-q"]
    apart = side_by_side([[*command, str(half)] for half in halves])
    two, one = interleaved(process([*command, "-j", "2", str(tmp_path)]), apart, 4)
    detail = f"{two:.2f} s, {one:.2f} s"
    assert_ratio("processor time of gark check -j 2 / two commands", two / one, 1.2, detail)


def test_the_catalogue_in_one_call(tmp_path: Path) -> None:
    """All 94 published methods with their claims, by two workers, in less than 20 seconds."""
    catalogue = entries()
    assert len(catalogue) == 94
    for name, entry in catalogue.items():
        (tmp_path / f"{name}.gark.yaml").write_text(method_file(entry), encoding="utf-8")
    start = perf_counter()
    done = subprocess.run(
        [*GARK, "check", "-j", "2", str(tmp_path)], capture_output=True, text=True
    )
    time = perf_counter() - start
    assert done.returncode == 0, done.stdout[-2000:]
    assert "94 files, 94 claims: all hold" in done.stdout
    assert_ratio("gark check -j 2 of the catalogue / 20 s", time / 20, 1.0, f"{time:.1f} s")
