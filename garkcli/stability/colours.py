"""Methods of several colours on ẏ = Σ λ_l y and on ẏ = Σ f_l(y), a parameter a colour."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import fmpq

from garkcli.exact.field import ONE, ZERO, Number
from garkcli.stability.damping import ImexPair, Ray, imex_pair
from garkcli.stability.fraction import Fraction, lines_needed, stability_fraction
from garkcli.stability.linear import StabilityFunction, stability_function
from garkcli.stability.ssp import AdditiveRadius, additive_radius
from garkcli.tableau.tableau import Tableau


@dataclass(frozen=True)
class Colours:
    """What several colours do together.

    Attributes:
        names: of the colours.
        R: R(z_1, …, z_N); None where it is too large.
        lines: the lines that determine it.
        radii: points on the boundary of the region of absolute monotonicity.
        pair: the method as an implicit-explicit pair; None where it is none.
        explicit_alone: R of the explicit colour alone, of the first one where there is no pair.
        real: the z_E ≤ 0 with every z_I damped; None where there is no pair, or not decided.
        imaginary: the same for z_E on the imaginary axis.
    """

    names: tuple[str, ...]
    R: Fraction | None
    lines: int
    radii: tuple[AdditiveRadius, ...]
    pair: ImexPair | None
    explicit_alone: StabilityFunction
    real: Ray | None
    imaginary: Ray | None

    @property
    def size(self) -> int:
        """How many colours there are."""
        return len(self.names)


def several_colours(tableau: Tableau, ratios: Sequence[fmpq] = ()) -> Colours:
    """What is decided about a method whose colours all see one another.

    Args:
        tableau: the method, of two colours at least.
        ratios: r_2/r_1 for which the additive radius is wanted beside the usual ones.
    """
    R = stability_fraction(tableau)
    pair = imex_pair(tableau, R)
    explicit = 0 if pair is None else pair.explicit
    return Colours(
        names=tuple(colour.name for colour in tableau.colours),
        R=R,
        lines=lines_needed(tableau),
        radii=_radii(tableau, ratios),
        pair=pair,
        explicit_alone=stability_function(tableau, _unit(tableau.size, explicit)),
        real=None if pair is None else pair.real_ray(),
        imaginary=None if pair is None else pair.imaginary_ray(),
    )


def _radii(tableau: Tableau, ratios: Sequence[fmpq]) -> tuple[AdditiveRadius, ...]:
    """On the axes, on the diagonal and on the lines that are asked for."""
    size = tableau.size
    directions: list[list[Number]] = [_unit(size, l) for l in range(size)]
    directions.append([ONE] * size)
    directions += [[ONE, ratio] for ratio in ratios]
    return tuple(additive_radius(tableau, direction) for direction in directions)


def _unit(size: int, l: int) -> list[Number]:
    return [ONE if m == l else ZERO for m in range(size)]
