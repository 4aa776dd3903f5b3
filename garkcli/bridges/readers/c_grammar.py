"""What C and C++ write around numbers: functions of roots, casts, macros, constants of headers."""

from __future__ import annotations

from garkcli.bridges.readers.grammar import Grammar
from garkcli.bridges.readers.scalars import Scalar, Value, number

_ROOTS = {
    "sqrt": "sqrt",
    "sqrtl": "sqrt",
    "sqrtf": "sqrt",
    "cbrt": "cbrt",
    "sunrsqrt": "sqrt",
    "sunsqrt": "sqrt",
    "petscsqrtreal": "sqrt",
    "petscsqrtscalar": "sqrt",
    "pow": "power",
    "petscpowreal": "power",
    "sunrpoweri": "power",
    "sunpowi": "power",
}
_PASSED = (
    *("SUN_RCONST", "RCONST", "ARK_RCONST", "REAL", "REAL_C", "sunrealtype"),
    *("realtype", "double", "float", "long", "int", "PetscReal", "PetscInt"),
    *("PetscRealConstant", "real", "Real", "T", "Scalar", "amrex", "const", "RC", "GARK_REAL_C"),
    *("value_type", "real_t", "_rt", "number", "size_t", "unsigned", "auto"),
)
GRAMMAR = Grammar(
    lists={"{": "}"},
    roots=_ROOTS,
    passed=frozenset(_PASSED),
    has_indices=True,
    nothing=frozenset({"NULL", "nullptr", "PETSC_NULL", "PETSC_NULLPTR"}),
)
CONSTANTS: dict[str, Value] = {
    "ZERO": number("0"),
    "ONE": number("1"),
    "TWO": number("2"),
    "HALF": Scalar("1/2", 1),
    "SUN_RCONST_ZERO": number("0"),
    "NULL": None,
    "nullptr": None,
}
"""Constants that headers define and whose values their names tell."""
