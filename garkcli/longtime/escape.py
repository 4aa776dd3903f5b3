"""How coordinates oscillate along a trajectory, and whether one of them leaves for ever."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from garkcli.arrays import Floats, Integers


# least part of its size that a coordinate moves in a step to have a direction
_MOVES = 2.0**-40
# times that a position has turned back when its motion is called bounded: what only passes by
# turns once
_BOUND = 2
# how many times its former bound a position is when it has left that
_FAR = 2.0


class Excursions:
    """Counts the turns of all coordinates, and keeps how far each position went up to its last one,
    in pieces.

    A position has escaped at the end when it had turned back twice, and is now twice as far from
    zero as it ever was before it or its momentum turned for the last time. An angle that begins to
    rotate does not escape: its momentum goes on oscillating.
    """

    def __init__(self) -> None:
        import numpy as np

        self._shape_for(0)
        self._positions: Floats = np.zeros(0)  # at the end

    def _shape_for(self, d: int) -> None:
        """Begin to count for d degrees of freedom."""
        import numpy as np

        # turns of each coordinate, and the step of the last turn of each pair (q, p)
        self._turned: Integers = np.zeros(2 * d, dtype=np.int64)
        self._last_turns: Integers = np.zeros(d, dtype=np.int64)
        self._bounds: Floats = np.zeros(d)  # largest |q| up to the last turn
        self._beyond: Floats = np.zeros(d)  # and after it

    @property
    def turns(self) -> int:
        """How often the coordinate that oscillates fastest has turned back."""
        return int(self._turned.max(initial=0))

    @property
    def escape(self) -> int | None:
        """The number of the last step before a position has escaped, the latest of all; None where
        none has.
        """
        d = len(self._positions)
        was_bound = self._turned[:d] >= _BOUND
        is_far = abs(self._positions) > _FAR * self._bounds
        has_escaped = was_bound & is_far
        steps = self._last_turns[has_escaped]
        if not steps.size:
            return None
        return int(steps.max())

    def add(self, first: int, states: Floats) -> None:
        """The states of the steps ``first``, ``first`` + 1, …, shape (m, 2d); pieces overlap in two
        states.
        """
        import numpy as np

        d = states.shape[1] // 2
        if not self._turned.size:
            self._shape_for(d)
        moves = np.diff(states, axis=0)
        ends = np.abs(states[1:])
        is_move = np.abs(moves) > _MOVES * ends
        directions = np.sign(moves) * is_move
        products = directions[1:] * directions[:-1]
        turned = products < 0
        self._turned += turned.sum(axis=0)
        self._positions = states[-1, :d]
        sizes = np.abs(states[:, :d])
        of_positions = turned[:, :d]
        of_momenta = turned[:, d:]
        either = of_positions | of_momenta
        for i in range(d):
            turns = np.flatnonzero(either[:, i])
            self._add_position(i, first, sizes[:, i], turns)

    def _add_position(self, i: int, first: int, sizes: Floats, turns: Integers) -> None:
        """Of position i: |q| in the steps from ``first`` on, and where it or its momentum turned.

        The turn number n is about the state n + 1.
        """
        beyond = self._beyond[i]
        if not turns.size:
            self._beyond[i] = max(beyond, sizes.max())
            return
        last = int(turns[-1]) + 1
        up_to_it = sizes[: last + 1]
        after_it = sizes[last:]
        self._bounds[i] = max(self._bounds[i], beyond, up_to_it.max())
        self._beyond[i] = after_it.max()
        self._last_turns[i] = first + last
