"""P-stability."""

from flint import fmpq

from garkcli.errors import UsageProblem
from garkcli.exact.cells import Interval
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.properties.linear import ends_text, first_gap
from garkcli.properties.property import Property, Verdict
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    from garkcli.stability.oscillator import oscillator_stability

    if subject.tolerance:
        return Verdict.undecided("the coefficients are rounded")
    tableau = subject.tableau
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    try:
        found = oscillator_stability(tableau, problem)
    except UsageProblem as error:
        return Verdict.meaningless(error.message)
    if found.is_p_stable:
        return Verdict(True)
    return Verdict(False, _lost(found.stable))


def _lost(stable: tuple[Interval, ...]) -> str:
    gap = first_gap(stable)
    return f"powers of the step matrix are not bounded for {ends_text(gap, '(hω)²')}"


PROPERTY = Property(
    key="p-stable",
    text=(
        "On the harmonic oscillator q̈ = −ω²q all numerical solutions stay bounded for every step"
        " size: the powers of the step matrix M(hω) are bounded. With several terms the kinetic"
        " energy is the first, the potential one is divided equally among the others."
    ),
    source="J. D. Lambert, I. A. Watson, J. Inst. Math. Appl. 18 (1976)",
    kind="truth",
    decide=_decide,
    meaning="methods whose vector fields can carry the split oscillator",
    is_cheap=False,
)
