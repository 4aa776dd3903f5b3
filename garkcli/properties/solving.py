"""What is solved for in a step, in words; singly diagonally implicit methods."""

from __future__ import annotations

from typing import Literal

from garkcli.properties.naming import number_text, stages_name
from garkcli.properties.property import Verdict
from garkcli.properties.subject import Subject

UNDECIDED = "an entry may be zero"
"""Why the order of the stages is left open."""


def what_is_solved_for(subject: Subject) -> str:
    """The stages that depend on themselves; empty where there are none."""
    together = what_is_solved_together(subject)
    if together:
        return together
    alone = list(subject.graph.loops)
    if not alone:
        return ""
    verb = "depends on itself" if len(alone) == 1 else "depend on themselves"
    return f"{stages_name(subject.tableau, alone)} {verb}"


def what_is_solved_together(subject: Subject) -> str:
    """The largest system of stages; empty where each is solved for by itself."""
    systems = subject.shape.systems
    if not systems:
        return ""
    largest = max(systems, key=len)
    return f"{stages_name(subject.tableau, largest)} are solved together"


def what_is_not_singly(subject: Subject) -> str:
    """Why there is no common coefficient γ; empty where there is one."""
    shape = subject.shape
    if shape.kind != "diagonally implicit":
        return what_is_solved_together(subject) or f"it is {shape.kind}"
    if shape.gamma is not None:
        return ""
    found = {x: None for entries in subject.graph.loops.values() for x in entries}
    first, second, *_ = (number_text(x) for x in found if x is not None)
    return f"stages depend on themselves by {first} and by {second}"


def decide_singly(subject: Subject, wanted: Literal["SDIRK", "ESDIRK"]) -> Verdict:
    """Whether all implicit stages have one γ, and which stages are explicit."""
    shape = subject.shape
    if shape.kind is None:
        return Verdict.undecided(UNDECIDED)
    if shape.singly == wanted:
        return Verdict(True)
    why = what_is_not_singly(subject)
    if not why:
        explicit = set(subject.graph.successors) - set(subject.graph.loops)
        none = "no stage is explicit"
        names = stages_name(subject.tableau, explicit) if explicit else ""
        why = f"{names} {'is' if len(explicit) == 1 else 'are'} explicit" if names else none
    return Verdict(False, why)
