"""Functions in steps that are no vector fields: sums, copies, output, mathematics."""

from __future__ import annotations

import re

from garkcli.sources import ir


def callee_name(callee: ir.Expr) -> str:
    return callee.name.lower() if isinstance(callee, ir.Name | ir.Field) else ""


def is_sum(expr: object) -> bool:
    """Whether it is a sum or a difference."""
    return isinstance(expr, ir.Binary) and expr.sign in {"+", "-", ".+", ".-"}


def tells(name: str) -> bool:
    """Whether a function stores or prints its arguments without changing them."""
    return name.lower() in TELLING or name.startswith(("set_", "setState", "setTime"))


def operation_of(name: str) -> str | None:
    """The sign of a function that is an operation on vectors, ``multiplyByScalar``, ``vec_add``."""
    return OPERATIONS.get(_OF_VECTORS.sub("", name))


_OF_VECTORS = re.compile(r"_|scalar|vectors?|vec|arrays?|by|assign|self|inplace")
TELLING = {
    *("print", "println", "printf", "fprintf", "disp", "append", "push", "push_back", "add"),
    *("push!", "emplace_back", "write", "writeln"),
}
"""Functions that store or print their arguments without changing them."""
TEXTS = {"to_string", "tostring", "str", "string", "repr", "num2str", "sprintf", "sprint"}
"""Functions whose value is a text."""
APPENDING = {"append", "push_back", "emplace_back", "push", "add"}
"""Methods that put a value behind the end of a list."""
DOTS = {"dot", "matmul", "inner", "tensordot"}
"""Products of lists."""
COPIES = {"memcpy", "dbl_memcpy", "copyto!", "set", "copy", "assign"}
"""Functions that assign their second argument to their first."""
OPERATIONS = {
    **dict.fromkeys(("add", "plus", "sum", "vadd"), "+"),
    **dict.fromkeys(("sub", "subtract", "minus"), "-"),
    **dict.fromkeys(("mul", "multiply", "times", "scale", "scaled", "mult"), "*"),
    **dict.fromkeys(("divide", "div"), "/"),
}
"""Functions and methods that are operations on vectors, without words such as ``vector``."""
SHAPES = {"reshape", "flatten", "ravel", "squeeze"}
"""Methods that return a vector in another shape."""
CHANGING = {
    *("match statement", "where statement", "forall statement", "goto statement"),
    *("select type statement", "select rank statement"),
}
"""Statements that change values in ways that are not followed."""
SUMS = {
    (name, len(roles.split())): roles
    for name, roles in (
        *(("add", "x x ="), ("add", "x * x ="), ("add", "* x * x ="), ("vecwaxpy", "= * x x")),
        *(("vecaxpy", "+ * x"), ("n_vlinearsum", "* x * x ="), ("axpy!", "* x +")),
    )
}
"""Functions that add vectors, by name and number of arguments: of MFEM, PETSc and SUNDIALS."""
MATHEMATICS = {
    *("min", "max", "minimum", "maximum", "fmin", "fmax", "amin", "amax", "clamp", "clip"),
    *("hypot", "atan2", "arctan2", "pow", "power", "mod", "rem", "div", "fmod", "copysign"),
    *("dot", "cross", "kron", "norm", "axpy", "isclose", "allclose", "merge", "ifelse", "where"),
}
"""Functions of two numbers in various languages."""
_OF_NUMBERS = {
    *("exp", "log", "log2", "log10", "log1p", "expm1", "sqrt", "cbrt", "square", "abs", "fabs"),
    *("sin", "cos", "tan", "asin", "acos", "atan", "arcsin", "arccos", "arctan", "sinh", "cosh"),
    *("tanh", "erf", "erfc", "sign", "floor", "ceil", "round", "trunc", "real", "imag", "conj"),
    *("isnan", "isfinite", "isinf", "any", "all", "len", "size", "length", "shape", "ndim", "type"),
}
"""Functions of one number in various languages: seldom vector fields."""
OF_ARRAYS = {
    *("zeros", "ones", "empty", "zeros_like", "ones_like", "empty_like", "eye", "diag", "arange"),
    *("linspace", "range", "enumerate", "zip", "map", "next", "iter", "sorted", "isinstance"),
    *("getattr", "reshape", "ravel", "concatenate", "hstack", "vstack", "stack", "moveaxis"),
    *("transpose", "squeeze", "atleast_1d", "broadcast_to", "broadcast_arrays", "expand_dims"),
    *("prod", "cumsum", "mean", "argmax", "argmin", "argsort", "unique", "nonzero", "searchsorted"),
}
"""Functions of arrays, whose values may have slopes that they are given."""
ELEMENTARY = _OF_NUMBERS | OF_ARRAYS
NO_SLOPES = MATHEMATICS | TELLING | SHAPES
NO_VALUES = {"True", "False", "true", "false", "np", "numpy", "xp", "jnp", "math", "Math", "torch"}
"""Names that stand for no value of a step: modules."""
