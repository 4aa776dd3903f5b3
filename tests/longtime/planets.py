"""Planar systems of a sun and two planets as problem files, and the methods that step them.

The systems are made of rational numbers: the same on every machine.
"""

from __future__ import annotations

from fractions import Fraction

from garkcli.problems.draw import Draw

SUN_JUPITER_SATURN = (Fraction(1, 1000), Fraction(3, 10_000))
"""The masses of the planets, the sun's being 1."""

STOERMER_VERLET = "methods/stoermer-verlet.gark.yaml"
YOSHIDA_4 = """
prk:
  q:
    A: [[0, 0, 0], [w, 0, 0], [w, v, 0], [w, v, w]]
    b: [w, v, w]
  p:
    A: [[w/2, 0, 0, 0], [w/2, (w + v)/2, 0, 0], [w/2, (w + v)/2, (w + v)/2, 0]]
    b: [w/2, (w + v)/2, (w + v)/2, w/2]
structure: separable
parameters: {w: 1/(2 - cbrt(2)), v: 1 - 2*w}
"""
GAUSS_2 = "methods: [{family: gauss, stages: 2}]"
RK4 = "methods/rk4.gark.yaml"
RALSTON = "ark: {A: [[[0, 0], [2/3, 0]]], b: [[1/4, 3/4]]}"


def between(draw: Draw, low: Fraction, high: Fraction) -> Fraction:
    """A fraction in thousandths of the way from ``low`` to ``high``."""
    return low + (high - low) * Fraction(draw.between(0, 1000), 1000)


def two_planets(seed: int) -> str:
    """A random system of a sun and two planets, half of them around a sun that moves.

    Masses are 10⁻⁴ to 3·10⁻³, semi-axes 1 and 1.5 to 3, eccentricities up to 1/4.
    """
    draw = Draw(seed)
    masses = [between(draw, Fraction(1, 10_000), Fraction(3, 1000)) for _ in range(2)]
    axes = [Fraction(1), between(draw, Fraction(3, 2), Fraction(3))]
    eccentricities = [between(draw, Fraction(0), Fraction(1, 4)) for _ in range(2)]
    half_angles = [between(draw, Fraction(-3), Fraction(3)) for _ in range(2)]
    orbits = list(zip(masses, axes, eccentricities, half_angles, strict=True))
    return system(orbits, sun_moves=seed % 2 == 1)


def system(orbits: list[tuple[Fraction, Fraction, Fraction, Fraction]], sun_moves: bool) -> str:
    """The problem file of planets that start at their perihelia.

    Args:
        orbits: the mass, the semi-axis, the eccentricity and tan(φ/2) of the direction φ of the
            perihelion, of each planet.
        sun_moves: whether the sun is a body too; the centre of mass then rests.
    """
    names = [f"{k + 1}" for k in range(len(orbits))]
    kinetic, potential, initial = [], [], []
    momenta: dict[str, list[str]] = {"x": [], "y": []}
    for name, (mass, axis, e, tangent) in zip(names, orbits, strict=True):
        cosine, sine = ((1 - tangent**2) / (1 + tangent**2), 2 * tangent / (1 + tangent**2))
        radius, speed = axis * (1 - e), f"sqrt({(1 + e) / (axis * (1 - e))})"
        px, py = f"{-mass * sine}*{speed}", f"{mass * cosine}*{speed}"
        initial += [f"x{name}: {radius * cosine}", f"y{name}: {radius * sine}"]
        initial += [f"px{name}: {px}", f"py{name}: {py}"]
        momenta["x"].append(f"({px})")
        momenta["y"].append(f"({py})")
        kinetic.append(f"(px{name}**2 + py{name}**2)/(2*{mass})")
        sun = ("- xs", "- ys") if sun_moves else ("", "")
        potential.append(f"- {mass}/sqrt((x{name} {sun[0]})**2 + (y{name} {sun[1]})**2)")
    potential.append(f"- {orbits[0][0] * orbits[1][0]}/sqrt((x1 - x2)**2 + (y1 - y2)**2)")
    variables = [f"{axis}{name}" for name in names for axis in "xy"]
    if sun_moves:
        variables += ["xs", "ys"]
        kinetic.append("(pxs**2 + pys**2)/2")
        initial += ["xs: 0", "ys: 0"]
        initial += [f"p{axis}s: -({' + '.join(momenta[axis])})" for axis in "xy"]
    return "\n".join(
        [
            f"variables: [{', '.join(variables)}]",
            "hamiltonian:",
            f"  - {' + '.join(kinetic)}",
            f'  - "{" ".join(potential)}"',
            f"initial: {{{', '.join(initial)}}}",
            "t_end: 6",
            "",
        ]
    )
