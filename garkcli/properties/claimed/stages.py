"""Properties of stages and weights."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.exact.field import ONE, ZERO
from garkcli.exact.roots import sign
from garkcli.frozen import replace
from garkcli.order.weak_stages import weak_stage_order as weak_order
from garkcli.properties import last_stage
from garkcli.properties.naming import entry, entry_is, number_words, place, stages_name
from garkcli.properties.pattern import spaces_that_matter
from garkcli.properties.reduction import is_plainly_irreducible, reduced, sizes, stages_that_matter
from garkcli.properties.subject import MISSING_BLOCKS, SEES_ALL, Subject, claimed
from garkcli.properties.symmetry import MOST_TRIALS, symmetry
from garkcli.properties.verdict import Verdict
from garkcli.reason import NO_REASON, Reason
from garkcli.stability.algebraic import algebraic_within, contractivity, negative_pivot
from garkcli.tableau.embedded import Further, as_colours
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau


def obstacle(tableau: Tableau) -> Reason:
    """Why a method with all blocks is not algebraically stable; empty if it is."""
    weights = _negative_weight(tableau)
    if weights:
        return weights
    pivot = negative_pivot(contractivity(tableau))
    if pivot is None:
        return NO_REASON
    if not pivot:
        return Reason("elimination of M meets 0 on its diagonal, beside nonzero entries")
    return Reason("elimination of M meets {} on its diagonal", number_words(pivot))


def _negative_weight(tableau: Tableau, tolerance: fmpq = ZERO) -> Reason:
    for m, colour in enumerate(tableau.colours):
        if not isinstance(tableau.space(m), PointSpace):
            continue  # the weights of every family are positive
        for j, b in enumerate(colour.b):
            if sign(b + tolerance) < 0:
                return entry_is(place("b", tableau, [m], j), b)
    return NO_REASON


def obstacle_within(tableau: Tableau, tolerance: fmpq) -> Reason | None:
    """Returns the ``obstacle`` within a tolerance; empty without one, None if undecided."""
    if not all(isinstance(space, PointSpace) for space in tableau.spaces):
        return None
    negative = _negative_weight(tableau, tolerance)
    if negative:
        return negative
    holds = algebraic_within(tableau, tolerance)
    if holds is None:
        return None
    return NO_REASON if holds else Reason("a minor of M is negative")


@claimed(
    "A. Prothero, A. Robinson, Math. Comp. 28 (1974); globally, for GARK "
    "methods: A. Sandu, M. Günther, SIAM J. Numer. Anal. 53 (2015)",
    meaning=SEES_ALL,
    asks="equations",
    noted=(True, "stiffly accurate"),
)
def stiffly_accurate(subject: Subject) -> Verdict:
    """A stage value is the new value: for one stage i of one method l, a_ij^{l,m} = b_j^{m} for
    every vector field m and all j.
    """
    tableau = subject.tableau
    if not subject.is_complete:
        return Verdict.meaningless(MISSING_BLOCKS)
    if last_stage.is_stiffly_accurate(tableau, subject.tolerance):
        return Verdict(True)
    return Verdict(False, _missed(tableau))


def _missed(tableau: Tableau) -> Reason:
    space = tableau.spaces[-1]
    if not isinstance(space, PointSpace):
        return Reason("at no node the stage has the weights as its rows")
    k = len(tableau.spaces) - 1
    i = space.stages - 1
    (m, j), *_ = last_stage.missed_entries(tableau, k, i, last_stage.new_value(tableau))
    of_entry = entry_is(entry(tableau, k, m, i, j), tableau.blocks[k, m][i][j])
    of_weight = entry_is(place("b", tableau, [m], j), tableau.colours[m].b[j])
    return Reason("{}, {}", of_entry, of_weight)


@claimed(
    "J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980)",
    meaning=SEES_ALL,
    asks="equations",
    noted=(True, "first same as last"),
)
def fsal(subject: Subject) -> Verdict:
    """The first stage value is the old value and the last one the new value (first same as last):
    its row is zero, and the row of the last the weights, for all vector fields, in each method.
    The last evaluations of a step are the first ones of the next.
    """
    tableau = subject.tableau
    if not subject.is_complete:
        return Verdict.meaningless(MISSING_BLOCKS)
    found = last_stage.first_same_as_last(tableau, subject.tolerance)
    if found.not_first is not None:
        stage = stages_name(tableau, [(found.not_first, 0)])
        return Verdict(False, Reason("{} is not the old value", stage))
    if found.not_last is not None:
        last = tableau.spaces[found.not_last].stages - 1
        stage = stages_name(tableau, [(found.not_last, last)])
        return Verdict(False, Reason("{} is not the new value", stage))
    return Verdict(True)


@claimed(
    "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section V.2",
    asks="equations",
    noted=(True, "symmetric"),
)
def symmetric(subject: Subject) -> Verdict:
    """The method is its own adjoint, the inverse of the step with −h: renumbering the stages of
    each method, the same for all blocks, turns A^{l,m} into 𝟙 (b^{m})ᵀ − A^{l,m} and keeps the
    weights. In the stage algebra of a family the renumbering is x → 1 − x. A reducible method is
    symmetric if the reduced one is.
    """
    holds = subject.symmetry.holds
    if holds:
        return Verdict(True)
    has_algebra = not all(isinstance(space, PointSpace) for space in subject.tableau.spaces)
    if holds is None and subject.tolerance and has_algebra:
        return Verdict.undecided("rounding leaves the nodes open")
    return _reduced_verdict(subject, holds)


def _reduced_verdict(subject: Subject, holds: bool | None) -> Verdict:
    """Returns the verdict on a method without a symmetric renumbering, reduced if possible."""
    tableau = subject.tableau
    if not is_plainly_irreducible(tableau, subject.tolerance):
        smaller = subject.reduced
        if smaller is None:
            return Verdict.undecided("stages at irrational nodes are not compared")
        settled = _with_idle_stages_in_the_middle(smaller)
        if settled is not tableau:
            holds = symmetry(settled, subject.tolerance).holds
    if holds is None:
        return Verdict.undecided(f"more than {MOST_TRIALS} images of stages were tried")
    if holds:
        return Verdict(True, Reason("once it is reduced"))
    return Verdict(False, Reason("not self-adjoint"))


def _with_idle_stages_in_the_middle(tableau: Tableau) -> Tableau:
    """Adds the row b_m/2, its own image in the adjoint, to a last stage without influence."""
    half = fmpq(1, 2)
    blocks = dict(tableau.blocks)
    matters = spaces_that_matter(tableau)
    idle = [k for k, space in enumerate(tableau.spaces) if k not in matters and space.stages == 1]
    for k, m in tableau.blocks:
        if k in idle:
            blocks[k, m] = (tuple(half * b for b in tableau.colours[m].b),)
    return replace(tableau, blocks=blocks) if idle else tableau


@claimed(
    "G. Dahlquist, R. Jeltsch, TRITA-NA-7904 (1979); W. H. Hundsdorfer, M. N. Spijker, "
    "BIT 21 (1981)",
    asks="equations",
    noted=(True, "reducible (gark convert --to reduced)"),
)
def reducible(subject: Subject) -> Verdict:
    """Fewer stages give the same step, embedded weights and dense output. A stage on which no
    weight and no used stage depends can be left out (DJ-reducible), such as the last one of an FSAL
    method without embedded weights. Stages that are equal on every problem can be merged. `gark
    convert --to reduced` writes the smaller method.
    """
    tableau, further = subject.tableau, subject.further
    whole = as_colours(tableau, further)
    if is_plainly_irreducible(whole, subject.tolerance):
        return Verdict(False, Reason("every stage has a weight, and no two have the same row sums"))
    smaller = reduced(whole, subject.tolerance) if further else subject.reduced
    if smaller is None:
        return Verdict.undecided("stages at irrational nodes are not compared")
    if sizes(smaller) != sizes(tableau):
        stages = ", ".join(str(space.stages) for space in smaller.spaces)
        return Verdict(True, Reason("{} stages do the same", stages))
    if further and subject.reduced is not None and sizes(subject.reduced) != sizes(tableau):
        return Verdict(False, Reason("{} need stages that b does without", _names(further)))
    matters = stages_that_matter(smaller, subject.tolerance)
    idle = [(k, 0) for k, x in enumerate(smaller.spaces) if x.stages == 1 and (k, 0) not in matters]
    if idle:
        stage = stages_name(tableau, idle)
        return Verdict(False, Reason("no step depends on {}, but a method keeps one stage", stage))
    return Verdict(False, Reason("every stage matters, and no two are equal"))


def _names(further: Further) -> str:
    names = [] if further.embedded is None else ["embedded weights"]
    return " and ".join(names if further.dense is None else [*names, "weights of dense output"])


@claimed("E. Hairer, G. Wanner, Solving ODEs II, section IV.15", kind="count", asks="equations")
def stage_order(subject: Subject) -> Verdict:
    """The largest q for which B^{l}(q) and C^{l,m}(q) hold for all l and m whose block exists:
    quadrature and stage values of the same order q. For one colour l: for that l and all m. The
    nodes are those of the file.
    """
    found = subject.simplifying.stage_orders
    return Verdict(min(found), _by_colour(subject, found), is_at_least=min(found) >= subject.limit)


def _by_colour(subject: Subject, found: Sequence[int]) -> Reason:
    if len(found) == 1:
        return NO_REASON
    names = [colour.name for colour in subject.tableau.colours]
    by_colour = [
        f"colour {name} has {'at least ' if q >= subject.limit else ''}{q}"
        for q, name in zip(found, names, strict=True)
    ]
    return Reason("{}", ", ".join(by_colour))


@claimed(
    "D. I. Ketcheson, B. Seibold, D. Shirokoff, D. Zhou, DIRK schemes with high weak stage order "
    "(2020), definition 2; for several colours: docs/stiff-problems.md",
    kind="count",
    asks="equations",
)
def weak_stage_order(subject: Subject) -> Verdict:
    """The largest q for which b^{l} A^{l,m} ⋯ A^{n,p} (A^{p,r} (c^{r})^(k−1) − (c^{p})^k / k) = 0
    for k = 1, …, q and all products of existing blocks, also the empty one: the errors of the
    stages up to order q never reach the new value. Stiff linear problems with terms that depend on
    time lose no order up to q. For one method: bᵀ A^j (A c^(k−1) − c^k / k) = 0 for all j.
    For one colour l: with products of A^{l,l} only, if f^{l} is stiff and the other terms are
    functions of time.
    """
    colours = range(subject.tableau.size)
    least = weak_order(subject.defects, colours, subject.limit)
    found = (
        [least]
        if len(colours) == 1
        else [weak_order(subject.defects, [l], subject.limit) for l in colours]
    )
    return Verdict(least, _by_colour(subject, found), is_at_least=least >= subject.limit)


@claimed(
    "J. C. Butcher, Numerical Methods for ODEs, section 23",
    asks="signs",
    noted=(False, "nodes outside [0, 1]"),
)
def nodes_in_unit_interval(subject: Subject) -> Verdict:
    """All nodes c_i^{l} lie in [0, 1]: nothing is evaluated outside of the step."""
    for l, colour in enumerate(subject.tableau.colours):
        if not isinstance(subject.tableau.space(l), PointSpace):
            continue  # those of every family do
        for i, c in enumerate(colour.c):
            beyond = -c if sign(c) < 0 else c - ONE
            if sign(beyond - subject.tolerance) > 0:
                return Verdict(False, entry_is(place("c", subject.tableau, [l], i), c))
    return Verdict(True)


@claimed(
    "E. Hairer, G. Wanner, Solving ODEs II, section IV.12",
    asks="signs",
    noted=(False, "not all weights positive"),
)
def positive_weights(subject: Subject) -> Verdict:
    """All weights b_i^{l} are positive. In the stage algebra of a family the quadratic
    form f ↦ b^{l}(f²) is positive definite.
    """
    tableau, tolerance = subject.tableau, subject.tolerance
    why_open = ""
    for m, colour in enumerate(tableau.colours):
        if not isinstance(tableau.space(m), PointSpace):  # those of every family are
            if tolerance:
                why_open = why_open or "rounding leaves the signs open"
            continue
        for j, b in enumerate(colour.b):
            if not b or sign(b + tolerance) < 0:
                return Verdict(False, entry_is(place("b", tableau, [m], j), b))
            if sign(b - tolerance) <= 0:
                why_open = "a weight is not larger than the tolerance"
    if why_open:
        return Verdict.undecided(why_open)
    return Verdict(True)


@claimed(
    "K. Burrage, J. C. Butcher, SIAM J. Numer. Anal. 16 (1979); for GARK methods: "
    "A. Sandu, M. Günther, SIAM J. Numer. Anal. 53 (2015)",
    meaning=SEES_ALL,
    asks="signs",
    noted=(True, "algebraically stable"),
)
def algebraically_stable(subject: Subject) -> Verdict:
    """No weight is negative, and the matrix M with the blocks B^{l} A^{l,m} + (A^{m,l})ᵀ B^{m} −
    b^{l} (b^{m})ᵀ is positive semidefinite. Then differences of solutions never grow if every
    vector field is contractive (B-stability).
    """
    if not subject.is_complete:
        return Verdict.meaningless(MISSING_BLOCKS)
    if not subject.tolerance:
        return Verdict.unless(obstacle(subject.tableau))
    found = obstacle_within(subject.tableau, subject.tolerance)
    if found is None:
        return Verdict.undecided("rounding leaves the signs open")
    return Verdict.unless(found)
