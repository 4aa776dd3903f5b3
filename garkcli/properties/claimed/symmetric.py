"""Symmetric methods."""

from __future__ import annotations

from dataclasses import replace

from flint import fmpq

from garkcli.properties.pattern import spaces_that_matter
from garkcli.properties.property import Property, Verdict
from garkcli.properties.reduction import is_plainly_irreducible, reduced
from garkcli.properties.subject import Subject
from garkcli.properties.symmetry import MOST_RENUMBERINGS, symmetry
from garkcli.tableau.tableau import Tableau


def _decide(subject: Subject) -> Verdict:
    found = subject.symmetry
    if found.holds is None and subject.tolerance:
        return Verdict.undecided("rounding leaves the nodes open")
    if found.holds is None:
        return Verdict.undecided(f"there are more than {MOST_RENUMBERINGS} renumberings")
    if found.holds:
        return Verdict(True)
    return _reduced_verdict(subject)


def _reduced_verdict(subject: Subject) -> Verdict:
    """Where no renumbering does: stages that do nothing, and equal ones, may be in its way."""
    obstacle = Verdict(False, "no renumbering of the stages gives the adjoint method")
    tableau = subject.tableau
    if is_plainly_irreducible(tableau, subject.tolerance):
        return obstacle
    smaller = reduced(tableau)
    if smaller is None:
        return Verdict.undecided("stages at irrational nodes are not compared")
    settled = _with_idle_stages_in_the_middle(smaller)
    if settled is tableau:
        return obstacle
    holds = symmetry(settled, subject.tolerance).holds
    if holds is None:
        return Verdict.undecided("there are too many renumberings once it is reduced")
    if holds:
        return Verdict(True, "once it is reduced")
    return obstacle


def _with_idle_stages_in_the_middle(tableau: Tableau) -> Tableau:
    """The same method where a last stage that does nothing has the row b_m/2.

    A stage space of which nothing is left keeps one stage, whose row no step depends on. With this
    row it is its own image in the adjoint method.
    """
    half = fmpq(1, 2)
    blocks = dict(tableau.blocks)
    matters = spaces_that_matter(tableau)
    idle = [k for k, space in enumerate(tableau.spaces) if k not in matters and space.stages == 1]
    for k, m in tableau.blocks:
        if k in idle:
            blocks[k, m] = (tuple(half * b for b in tableau.colours[m].b),)
    return replace(tableau, blocks=blocks) if idle else tableau


PROPERTY = Property(
    key="symmetric",
    text=(
        "The method is its own adjoint, the inverse of the step with −h: renumbering the stages of"
        " each method, the same for all blocks, turns A^{l,m} into 𝟙 (b^{m})ᵀ − A^{l,m} and keeps"
        " the weights. In the stage algebra of a family the renumbering is x → 1 − x. Of a"
        " reducible method it is asked of the smaller one that does the same."
    ),
    source="E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section V.2",
    kind="truth",
    decide=_decide,
)
