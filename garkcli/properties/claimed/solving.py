"""Implicitness: explicit, diagonally implicit and other methods."""

from __future__ import annotations

from typing import Literal

from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots
from garkcli.properties.naming import number_words, stages_name
from garkcli.properties.subject import Subject, claimed
from garkcli.properties.verdict import Size, Verdict
from garkcli.reason import NO_REASON, Reason

UNDECIDED = "an entry may be zero"


def what_is_solved_for(subject: Subject) -> Reason:
    together = what_is_solved_together(subject)
    if together:
        return together
    implicit = list(subject.graph.loops)
    if not implicit:
        return NO_REASON
    verb = "depends on itself" if len(implicit) == 1 else "depend on themselves"
    return Reason(f"{{}} {verb}", stages_name(subject.tableau, implicit))


def what_is_solved_together(subject: Subject) -> Reason:
    """Names the largest system of stages; empty if each is solved by itself."""
    systems = subject.shape.systems
    if not systems:
        return NO_REASON
    largest = max(systems, key=len)
    return Reason("{} are solved together", stages_name(subject.tableau, largest))


def what_is_not_singly(subject: Subject) -> Reason:
    """Why there is no common coefficient γ; empty if there is one."""
    shape = subject.shape
    if shape.kind != "diagonally implicit":
        return what_is_solved_together(subject) or Reason(f"it is {shape.kind}")
    if shape.gamma is not None:
        return NO_REASON
    diagonal = {x: None for entries in subject.graph.loops.values() for x in entries}
    first, second, *_ = (number_words(x) for x in diagonal if x is not None)
    return Reason("stages depend on themselves by {} and by {}", first, second)


def decide_singly(subject: Subject, wanted: Literal["SDIRK", "ESDIRK"]) -> Verdict:
    """Whether all implicit stages share one γ, and the required stages are explicit."""
    shape = subject.shape
    if shape.kind is None:
        return Verdict.undecided(UNDECIDED)
    if shape.singly == wanted:
        return Verdict(True)
    why = what_is_not_singly(subject)
    if not why and subject.graph.changes_fields:
        why = Reason("stages depend on themselves through different vector fields")
    if not why:
        explicit = set(subject.graph.successors) - set(subject.graph.loops)
        why = Reason("no stage is explicit")
        if explicit:
            verb = "is" if len(explicit) == 1 else "are"
            why = Reason(f"{{}} {verb} explicit", stages_name(subject.tableau, explicit))
    return Verdict(False, why)


@claimed("E. Hairer, S. P. Nørsett, G. Wanner, Solving ODEs I, section II.1", asks="zeros")
def explicit(subject: Subject) -> Verdict:
    """No stage value depends on itself, directly or through others: all stages of all methods can
    be computed one after the other.
    """
    if subject.shape.kind is None:
        return Verdict.undecided(UNDECIDED)
    return Verdict.unless(what_is_solved_for(subject))


@claimed("R. Alexander, SIAM J. Numer. Anal. 14 (1977)", asks="zeros")
def diagonally_implicit(subject: Subject) -> Verdict:
    """At least one stage value depends on itself, and no two depend on each other: implicit stages
    are solved one after the other. Explicit methods are not called diagonally implicit.
    """
    kind = subject.shape.kind
    if kind is None:
        return Verdict.undecided(UNDECIDED)
    if kind == "explicit":
        return Verdict(False, Reason(f"it is {kind}"))
    return Verdict.unless(what_is_solved_together(subject))


@claimed("E. Hairer, G. Wanner, Solving ODEs II, section IV.6", asks="equations")
def sdirk(subject: Subject) -> Verdict:
    """Every stage value depends on itself directly, all with the same coefficient γ and through the
    same vector fields, and no two depend on each other. The claim `gamma` says which γ it is.
    """
    return decide_singly(subject, "SDIRK")


@claimed("C. A. Kennedy, M. H. Carpenter, NASA/TM-2016-219173", asks="equations")
def esdirk(subject: Subject) -> Verdict:
    """The first stage value is the old value; every other one depends on itself directly, all with
    the same coefficient γ and through the same vector fields, and no two depend on each other. With
    several methods this holds for each. The claim `gamma` says which γ it is.
    """
    return decide_singly(subject, "ESDIRK")


@claimed(
    "E. Hairer, G. Wanner, Solving ODEs II, section IV.6",
    kind="number",
    meaning="diagonally implicit methods whose implicit stages share one coefficient",
    asks="equations",
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


@claimed("E. Hairer, G. Wanner, Solving ODEs II, section IV.5", asks="zeros")
def fully_implicit(subject: Subject) -> Verdict:
    """At least two stage values, of one method or of several, depend on each other and are solved
    together: the graph of who sees whom has a strongly connected component of more than one stage.
    """
    kind = subject.shape.kind
    if kind is None:
        return Verdict.undecided(UNDECIDED)
    return Verdict.unless(NO_REASON if kind == "fully implicit" else Reason(f"it is {kind}"))


@claimed("E. Hairer, G. Wanner, Solving ODEs II, section IV.6", kind="count", asks="zeros")
def implicit_stages(subject: Subject) -> Verdict:
    """The number of stage values that depend on themselves, directly or through others. Stages
    that several vector fields share count once.
    """
    count = subject.shape.implicit_stages
    if count is None:
        return Verdict.undecided(UNDECIDED)
    return Verdict(count, what_is_solved_for(subject))
