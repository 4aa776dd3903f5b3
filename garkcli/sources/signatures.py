"""The arguments of calls that make tables, by place; and tables of other methods."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from garkcli.frozen import Frozen, field


class Signature(Frozen):
    """A call that makes a table.

    Attributes:
        roles: of its arguments, in order; ``-`` for those without a role.
        form: ``rk``, ``ark`` (two parts on shared stages), ``halves`` (two tables that are these
            parts), ``lists`` (a list of each), ``drift-first`` or ``force-first`` (weights of
            drifts and kicks), a scheme of few registers.
        counts: its numbers of arguments; empty if not fixed.
        format: of the table, if it differs from that of the language.
        has_default_weights: whether missing weights are the last row of the matrix.
        is_guess: whether other data look alike, so only arrays that fit together are a table.
        named: the roles of argument names with another meaning elsewhere.
    """

    roles: Sequence[str]
    form: str = "rk"
    counts: Sequence[int] = ()
    format: str = ""
    has_default_weights: bool = False
    is_guess: bool = False
    named: Mapping[str, str] = field(default_factory=dict)


def _all(names: str, roles: str, form: str = "rk", **besides: Any) -> dict[str, Signature]:
    return dict.fromkeys(names.split(), Signature(roles.split(), form, **besides))


_PETSC: Mapping[str, Any] = {"format": "petsc", "has_default_weights": True}
_THREE = "gamma1 gamma2 gamma3 delta A_first A c"
_LAST = "b_last embedded_last b embedded c"
PRINTED = "a printed tableau"
"""Replaces the name of a call if data are a table."""
NDSOLVE = "coefficients of NDSolve"
"""Replaces it for the lists that a function of Mathematica returns."""
KPP = "arrays of KPP"
"""Replaces it for the arrays of a Rosenbrock method in KPP."""
NAMED = Signature([])
"""No call: only names are evidence for a table."""
PARTS = Signature(["A1", "b1", "c1", "A2", "b2", "c2"], "ark")
"""An explicit and an implicit part."""
DRIFT_FIRST = Signature(["drifts", "kicks"], "drift-first")
"""Weights of drifts and kicks, drifts first."""
SIGNATURES: Mapping[str, Signature] = {
    PRINTED: Signature([], is_guess=True),
    NDSOLVE: Signature(["A", "b", "c", "error"], is_guess=True),
    **_all("ARKodeButcherTable_Create", "stages order embedded_order c A b embedded", counts=(7,)),
    **_all(
        *("ARKodeSPRKTable_Alloc", "", "force-first"),
        named={"a": "drifts", "ahat": "kicks", "q": "order", "stages": "stages"},
    ),
    **_all("ARKodeSPRKTable_Create", "stages order drifts kicks", "force-first", counts=(4,)),
    **_all(
        *("TSRKRegister TSDIRKRegister", "title order stages A b c embedded dense_degree dense"),
        counts=(9,),
        **_PETSC,
    ),
    **_all(
        *("TSARKIMEXRegister", "title order stages A2 b2 c2 A1 b1 c1 embedded2 embedded1", "ark"),
        counts=(14,),
        **_PETSC,
    ),
    **_all(
        *("ESDIRKIMEXTableau", "A2 b2 A1 b1 c2 error2 error1 - order stages", "ark"),
        named={"ce": "c1"},
    ),
    **_all("MultiButcherTableau", "", "halves"),
    **dict.fromkeys(("IMEXButcher", "IMEXTableau"), PARTS),
    **_all(
        *("TSBasicSymplecticRegister", "title order stages drifts kicks", "drift-first"),
        counts=(5,),
        format="petsc",
    ),
    **_all("SymplecticTableau", "kicks drifts", "drift-first", counts=(2,)),
    **_all("ExplicitRKTableau ImplicitRKTableau", "A c b order"),
    **_all("RungeKuttaMethod ExplicitRungeKuttaMethod DiagonallyImplicitRKMethod", "A b c"),
    **_all("ExplicitRungeKuttaPair", "A b embedded"),
    **_all("AdditiveRungeKuttaMethod", "A b c", "lists"),
    **_all("Tableau TableauRK TableauERK TableauIRK TableauDIRK", "title order A b c"),
    **_all("TableauRKExplicit", "title order A b c", counts=(5, 6)),
    **_all("_ButcherTableau", "c A b error"),
    **_all("ExplicitRKSolver", "stages A b c", counts=(4,)),
    **_all("LowStorageRungeKutta2NTableau", "A b c", "2N"),
    **_all("LowStorageRK2NConstantCache", "A b_first b c", "2N"),
    **_all("LowStorageRK2CConstantCache", "A b_first b c", "2C"),
    **_all("LowStorageRK3SConstantCache", _THREE, "3S*"),
    **_all("LowStorageRK3SpConstantCache", f"{_THREE} embedded_first embedded", "3S*"),
    **_all(
        "LowStorageRK3SpFSALConstantCache", f"{_THREE} embedded_first embedded embedded_last", "3S*"
    ),
    **_all("LowStorageRK2RPConstantCache", f"A {_LAST}", "2R"),
    **_all("LowStorageRK3RPConstantCache", f"A A_2 {_LAST}", "3R"),
    **_all("LowStorageRK4RPConstantCache", f"A A_2 A_3 {_LAST}", "4R"),
    **_all("LowStorageRK5RPConstantCache", f"A A_2 A_3 A_4 {_LAST}", "5R"),
    **_all(
        *("TSRosWRegister", "title order stages A gamma b embedded dense_degree dense"),
        *("rosenbrock",),
        counts=(9,),
        format="petsc",
    ),
    **_all("RodasTableau", "A C gamma c d - b error", "transformed", counts=(8,)),
    KPP: Signature([], "kpp"),
    **_all(
        *("MRIStepCoupling_Alloc", "", "coupling"),
        named={"W": "omega", "G": "gamma", "type": "type"},
    ),
    **_all(
        "MRIStepCoupling_Create",
        "- stages order embedded_order omega gamma c",
        "coupling",
        counts=(7,),
    ),
    **_all("MRIStepCoupling_MIStoMRI", "", "slow", named={"base": "base"}),
    **_all("NystromVITableau", "A_q b_q b error_q error c", "nystrom"),
}
"""The calls that make tables, by name."""
OTHER_KINDS = (
    (re.compile(r"RosW|Rodas|Rosenbrock|ROS\d|ROW(?![a-z])"), "Rosenbrock"),
    (re.compile(r"MPRK|Patankar"), "modified Patankar"),
    (re.compile(r"MRI(?![a-z])|MIS(?:\d|toMRI)|MRAB|Multirate|MRTableau"), "multirate"),
    (re.compile(r"Nystr(?:o|ö|oe)m|RKN(?![a-z])|Nystrom"), "Nyström"),
    (re.compile(r"GLEE|GLLE|GLM(?![a-z])|GeneralLinear"), "general linear"),
    (re.compile(r"LowStorage|2[NR]S?\+?(?:$|_)|3S\*?|LSRK"), "low-storage"),
    (re.compile(r"SplittingStep|SplittingCoefficients"), "splitting"),
    (re.compile(r"ExpRK|ETDRK|Exponential(?!ly)"), "exponential"),
    (re.compile(r"S?ROCK|E?SERK\d|RKC(?![a-z])"), "stabilized"),
    (re.compile(r"R(?:o|oe|ö)ssler|Komori|(?:SRI|SRA)\w*(?:Tableau|Cache)"), "stochastic"),
    (re.compile(r"TSIRK|(?<!TR)BDF(?![a-z0-9]*Tableau)|Adams"), "multistep"),
)
"""Kinds of other methods, by the names of the calls that make their tables."""
MAKER = re.compile(
    r"\w*(?:Tableau|Register|_Create|_Alloc|Coupling|Cache|MIStoMRI|ssler|Komori)\w*"
)
"""Names of calls that make tables."""
CONSTRUCTOR = re.compile(rf"{MAKER.pattern}|construct[A-Z]\w*")
"""Names of functions that make tables."""


def other_kind(name: str) -> str:
    """The kind of the table of another call; empty if it may be Runge–Kutta.

    >>> other_kind("TSRosWRegister"), other_kind("TSRKRegister"), other_kind("MPRK22ConstantCache")
    ('Rosenbrock', '', 'modified Patankar')
    """
    if not MAKER.fullmatch(name):
        return ""
    return kind_of(name)


def kind_of(title: str) -> str:
    """The kind of other methods that a title names; empty for none."""
    return next((kind for pattern, kind in OTHER_KINDS if pattern.search(title)), "")
