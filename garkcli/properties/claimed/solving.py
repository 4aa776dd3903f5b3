"""What is solved for in a step: explicit, diagonally implicit and other methods."""

from __future__ import annotations

from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots
from garkcli.properties.property import Size, Verdict, claimed
from garkcli.properties.solving import (
    UNDECIDED,
    decide_singly,
    what_is_not_singly,
    what_is_solved_for,
    what_is_solved_together,
)
from garkcli.properties.subject import Subject


@claimed("E. Hairer, S. P. Nørsett, G. Wanner, Solving ODEs I, section II.1")
def explicit(subject: Subject) -> Verdict:
    """No stage value depends on itself, neither directly nor through others: all stages of all
    methods can be put in an order in which each follows from those before.
    """
    if subject.shape.kind is None:
        return Verdict.undecided(UNDECIDED)
    return Verdict.unless(what_is_solved_for(subject))


@claimed("R. Alexander, SIAM J. Numer. Anal. 14 (1977)")
def diagonally_implicit(subject: Subject) -> Verdict:
    """At least one stage value depends on itself, and no two depend on each other: implicit stages
    are solved for one after the other. Explicit methods are not called so.
    """
    kind = subject.shape.kind
    if kind is None:
        return Verdict.undecided(UNDECIDED)
    if kind == "explicit":
        return Verdict(False, "it is explicit")
    return Verdict.unless(what_is_solved_together(subject))


@claimed("E. Hairer, G. Wanner, Solving ODEs II, section IV.6")
def sdirk(subject: Subject) -> Verdict:
    """Every stage value depends on itself directly, all with the same coefficient γ, and no two
    depend on each other. The claim `gamma` says which γ it is.
    """
    return decide_singly(subject, "SDIRK")


@claimed("C. A. Kennedy, M. H. Carpenter, NASA/TM-2016-219173")
def esdirk(subject: Subject) -> Verdict:
    """The first stage value is the old value; every other one depends on itself directly, all with
    the same coefficient γ, and no two depend on each other. For several methods this is meant of
    each. The claim `gamma` says which γ it is.
    """
    return decide_singly(subject, "ESDIRK")


@claimed(
    "E. Hairer, G. Wanner, Solving ODEs II, section IV.6",
    kind="number",
    meaning="diagonally implicit methods whose implicit stages share one coefficient",
)
def gamma(subject: Subject) -> Verdict:
    """The coefficient by which every implicit stage value depends on itself directly. Each of the
    systems that are solved has the matrix I − hγJ.
    """
    shape = subject.shape
    if shape.kind is None:
        return Verdict.undecided(UNDECIDED)
    if shape.gamma is None:
        return Verdict.meaningless(what_is_not_singly(subject))
    ((root, _),) = real_roots(Polynomial([-shape.gamma, 1]))
    return Verdict(Size(root))


@claimed("E. Hairer, G. Wanner, Solving ODEs II, section IV.5")
def fully_implicit(subject: Subject) -> Verdict:
    """At least two stage values, of one method or of several, depend on each other and are solved
    for together: the graph of who sees whom has a strongly connected component of more than one
    stage.
    """
    kind = subject.shape.kind
    if kind is None:
        return Verdict.undecided(UNDECIDED)
    return Verdict.unless("" if kind == "fully implicit" else f"it is {kind}")


@claimed("E. Hairer, G. Wanner, Solving ODEs II, section IV.6", kind="count")
def implicit_stages(subject: Subject) -> Verdict:
    """The number of stage values that depend on themselves, directly or through others. Stages
    that several vector fields share count once.
    """
    count = subject.shape.implicit_stages
    if count is None:
        return Verdict.undecided(UNDECIDED)
    return Verdict(count, what_is_solved_for(subject))
