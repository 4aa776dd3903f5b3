"""What gark writes as a method file is read again, as the same method."""

from __future__ import annotations

from pathlib import Path

import pytest
from flint import fmpq

from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.methodfile.load import load, loads
from garkcli.methodfile.writer import can_spell_out, write_tableau_file
from garkcli.tableau.conjugate import ZeroWeight, conjugate
from garkcli.tableau.forms import pair
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import ROOT, gark
from tests.whole import IS_WHOLE, in_whole, sample

CATALOGUE = sorted((ROOT / "garkcli/catalogue/data").rglob("*.gark.yaml"))
FILES = [*sample(CATALOGUE, 16), *sorted((ROOT / "methods").rglob("*.gark.yaml"))]
DIGITS = 60
"""In which numbers agree: the same radical may have another form in a field of its own."""
STAGES = 12
"""Most stages of a method here, of all colours together."""
GAPS = {
    "nothing": "tableau: {A: [[null]], b: [[1]]}\n",
    "no colour": "tableau: {A: [[null, null], [null, null]], b: [[1], [1]]}\n",
    "one way": "tableau: {A: [[null, [[1/2]]], [null, null]], b: [[1], [1]]}\n",
    "lower": "tableau: {A: [[[[1/2]], null], [[[1/2]], [[1/2]]]], b: [[1], [1]]}\n",
    "linear": "tableau: {A: [[[[1/2]]]], b: [[1]]}\nlinear: [1]\n",
    "separable": "methods: [{family: gauss, stages: 2}, {family: gauss, stages: 2}]\n"
    "transfer: collocation\nstructure: separable\n",
    "semi-separable": "methods: [{family: gauss, stages: 2}, {family: gauss, stages: 2}]\n"
    "transfer: collocation\nstructure: semi-separable\n",
}


def _is_read_again(made: Tableau, tolerance: fmpq | None = None) -> bool:
    """Whether its file has the same blocks and linear colours, and every number to 60 digits."""
    written = write_tableau_file(made, "again", tolerance)
    found = loads(written).tableau
    size = range(made.size)
    return (
        found.size == made.size
        and [x.is_linear for x in found.colours] == [x.is_linear for x in made.colours]
        and all(
            (found.block(l, m) is None) == (made.block(l, m) is None) for l in size for m in size
        )
        and all(
            to_ball(x, DIGITS).overlaps(to_ball(y, DIGITS))
            for x, y in zip(_numbers(found), _numbers(made), strict=True)
        )
    )


def _numbers(tableau: Tableau) -> list[Number]:
    """The weights and nodes of its colours, and the entries of its blocks."""
    rows = [row for colour in tableau.colours for row in (colour.b, colour.c)]
    for l, m in tableau.edges():
        rows += tableau.block(l, m) or ()
    return [x for row in rows for x in row]


def _made(tableau: Tableau) -> list[Tableau]:
    """A tableau with its conjugate and its pair, where there are any, as files spell them out."""
    found = [tableau] if can_spell_out(tableau) else []
    try:
        found += [conjugate(tableau), pair(tableau)]
    except ZeroWeight:
        return found
    return found


@pytest.mark.parametrize("text", GAPS.values(), ids=GAPS)
def test_gaps_are_read_again(text: str) -> None:
    """A colour that does not see another, none that sees any, one that is linear."""
    tableau = in_points(loads(text).tableau)
    assert tableau is not None
    for made in _made(tableau):
        assert _is_read_again(made)


@in_whole
def test_all_methods_are_read_again() -> None:
    """Those of the gallery and every sixteenth of the catalogue; all of them in ``make whole``."""
    seen = 0
    for path in FILES:
        method = load(path)
        tableau = in_points(method.tableau)
        if tableau is None or sum(space.stages for space in tableau.spaces) > STAGES:
            continue
        if not can_spell_out(method.tableau):
            continue
        for made in _made(tableau):
            assert _is_read_again(made, method.tolerance), path.name
            seen += 1
    assert seen > (300 if IS_WHOLE else 30)


@pytest.mark.parametrize("text", list(GAPS.values())[:-1], ids=list(GAPS)[:-1])
@pytest.mark.parametrize("options", [("tableau",), ("convert",), ("reduce",)], ids=" ".join)
def test_commands_write_the_same_method(
    options: tuple[str, ...], text: str, tmp_path: Path
) -> None:
    """``gark diff`` finds no difference between a file and what is written of it. A semi-separable
    pair is refused: a method file does not spell it out.
    """
    first, second = tmp_path / "first.yaml", tmp_path / "second.yaml"
    first.write_text(text)
    run = gark(*options, str(first), "--format", "yaml")
    assert run.code == 0, run.err
    second.write_text(run.out)
    assert gark("diff", str(first), str(second)).code == 0


@pytest.mark.parametrize("text", GAPS.values(), ids=GAPS)
def test_commands_write_pairs_that_load(text: str, tmp_path: Path) -> None:
    """``gark conjugate --pair`` of a file, with its order the one of ``gark check``."""
    path = tmp_path / "first.yaml"
    path.write_text(text)
    run = gark("conjugate", "--pair", str(path), "--format", "yaml")
    assert run.code == 0, run.err
    assert gark("check", "-", stdin=run.out).code == 0
