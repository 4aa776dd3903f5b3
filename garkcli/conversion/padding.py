"""Stages that do nothing, so that a method has as many as are wanted."""

from __future__ import annotations

from garkcli.conversion.sheet import CannotConvert, Place, Sheet, arranged


def padded(sheet: Sheet, stages: int) -> Sheet:
    """The method with as many stages a colour, the new ones first, with zeros.

    A new stage is at the node 0, sees nothing and has no weight: its value is that before the step.
    In front of the others it leaves explicit methods explicit, diagonally implicit ones diagonally
    implicit, and last stages last.

    Raises:
        CannotConvert: a colour has more stages already.
    """
    spaces: list[list[Place]] = []
    for k, space in enumerate(sheet.tableau.spaces):
        missing = stages - space.stages
        if missing < 0:
            raise CannotConvert(
                f"a colour has {space.stages} stages, more than {stages}",
                "--to canonical leaves out those without influence",
                code="too-many",
            )
        places: list[Place] = [None] * missing
        places += [(k, i) for i in range(space.stages)]
        spaces.append(places)
    return arranged(sheet, spaces)
