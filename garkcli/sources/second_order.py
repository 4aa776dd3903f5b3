"""Steps for positions and velocities: ``x + h*v + h**2/2*k``, ``v + h*k``.

A step of a Runge–Kutta method for x' = v, v' = f(x, v) has the matrix A·A for positions; other
matrices are those of a Nyström method.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from garkcli.sources.positions import CLOSE, Position, Row, is_product, position_of, velocity_of
from garkcli.sources.stages import FollowedStep, NoStep, Roles, StageSlope, is_whole, terms_of
from garkcli.sources.values import ZERO, Array, Terms, Value, near


def nystrom_in(
    slopes: Sequence[StageSlope], values: Mapping[str, Value], returned: Sequence[str]
) -> Roles:
    """The matrix and weights of positions, the weights of velocities and the nodes of a step; of a
    Runge–Kutta method, if its values have the velocities of the stages, A, b and c.

    Raises:
        NoStep: there is none.
    """
    forms = {x: form for x, value in values.items() if (form := terms_of(value))}
    h = FollowedStep(slopes, values, returned, ()).h
    found = [
        _roles(x, slopes, forms, h)
        for x in _results(forms, returned, h)
        if any(_argument(of, x.base, h) is not None for of in slopes)
    ]
    if not found or any(not _are_equal(x, found[0]) for x in found[1:]):
        raise NoStep
    return found[0]


def _results(forms: Mapping[str, Terms], returned: Sequence[str], h: str) -> Iterator[Position]:
    """The positions after the step: the last values, or the returned ones."""
    last: dict[str, Position] = {}
    sure: dict[str, Position] = {}
    for name, form in forms.items():
        x = position_of(form, h)
        if x is not None and x.row and abs(near(x.node) - 1) < CLOSE:
            last[x.base] = x
            if name in (x.base, *returned):
                sure[x.base] = x
    yield from (last | sure).values()


def _argument(slope: StageSlope, base: str, h: str) -> Position | None:
    """The position that f is given; the base alone is one."""
    for form in slope.args:
        if (x := position_of(form, h)) is not None and x.base == base:
            return x
        if form is not None and velocity_of(form, h) == (base, {}):
            return Position(base, "", ZERO, {})
    return None


def _roles(
    end: Position, slopes: Sequence[StageSlope], forms: Mapping[str, Terms], h: str
) -> Roles:
    of_velocity = [
        (name, x[1])
        for name, form in forms.items()
        if (x := velocity_of(form, h)) is not None and x[0] == end.velocity and is_whole(x[1])
    ]
    given = [(x.name, at) for x in slopes if (at := _argument(x, end.base, h)) is not None]
    names = [name for name, _ in given]
    used = {name for x in (end, *(at for _, at in given)) for name in x.row}
    used |= {name for _, row in of_velocity for name in row}
    before = sorted(used - {*names})
    if (
        not of_velocity
        or len(before) > 1
        or any(x.velocity not in ("", end.velocity) for _, x in given)
    ):
        raise NoStep
    # the first slope may be given
    ordered = [*before, *(name for name in names if name in used)]
    stages = {name: at for name, at in given if name in ordered}
    weights = of_velocity[-1][1]
    for slope in slopes:
        if slope.name in stages and any(
            (x := velocity_of(form, h)) is not None and x[0] == end.velocity for form in slope.args
        ):
            # f depends on the velocity
            raise NoStep
    if len(ordered) < 2 and not before:
        raise NoStep
    if not _are_at_their_times([x for x in slopes if x.name in stages], stages, h):
        raise NoStep
    start = Position(end.base, "", ZERO, {})
    rows = [stages.get(name, start) for name in ordered]
    if any(not x.row.keys() <= {*ordered} for x in rows) or not weights.keys() <= {*ordered}:
        raise NoStep
    every = (x for form in forms.values() if (x := velocity_of(form, h)) is not None)
    velocities = [{}, *(row for base, row in every if base == end.velocity)]
    of_stages = _of_velocities(ordered, rows, velocities)
    nodes = Array([x.node for x in rows])
    if of_stages and is_product(end.row, weights, of_stages):
        # x' = v of a Runge–Kutta method
        return {
            "A": _matrix([*of_stages.values()], ordered),
            "b": _row(weights, ordered),
            "c": nodes,
        }
    positions = {"A_q": _matrix([x.row for x in rows], ordered), "b_q": _row(end.row, ordered)}
    return positions | {"b": _row(weights, ordered), "c": nodes}


def _are_at_their_times(
    slopes: Sequence[StageSlope], stages: Mapping[str, Position], h: str
) -> bool:
    """Whether arguments that are times are those of the positions beside them."""
    times = {
        (x.name, j): form.get((h,), ZERO)
        for x in slopes
        for j, form in enumerate(x.args)
        if form and all(len(at) == 1 for at in form)
    }
    columns = {j for (_, j), node in times.items() if near(node)}
    return all(
        abs(near(node) - near(stages[name].node)) < CLOSE
        for (name, j), node in times.items()
        if j in columns
    )


def _of_velocities(
    names: Sequence[str], positions: Sequence[Position], velocities: Sequence[Row]
) -> Mapping[str, Row]:
    """The velocities of stages whose multiples are positions; empty if there are none."""
    found: dict[str, Row] = {}
    for name, x in zip(names, positions, strict=True):
        fitting = (
            row
            for row in velocities
            if abs(near(*row.values()) - near(x.node)) < CLOSE
            and row.keys() <= found.keys()
            and is_product(x.row, row, found)
        )
        row = next(fitting, None)
        if row is None:
            return {}
        found[name] = row
    return found


def _matrix(rows: Sequence[Row], names: Sequence[str]) -> Value:
    return Array([_row(row, names) for row in rows])


def _row(row: Row, names: Sequence[str]) -> Value:
    return Array([row.get(name, ZERO) for name in names])


def _are_equal(x: Roles, y: Roles) -> bool:
    """Whether two components have the same coefficients."""
    flat = [[near(v) for of in z.values() for v in Array([of]).flat()] for z in (x, y)]
    return (
        x.keys() == y.keys()
        and len(flat[0]) == len(flat[1])
        and all(abs(a - b) < CLOSE for a, b in zip(*flat, strict=True))
    )
