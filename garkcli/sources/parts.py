"""Two matrices of one method by their names: an explicit and an implicit part of shared stages."""

from __future__ import annotations

import re
from collections.abc import Mapping

from garkcli.sources.values import ZERO, Array, Value, items_of, near

_NAME = re.compile(
    r"(?P<word>butcher|matrix|weights|nodes|[abc]|b_?hat|b_?embed)_?(?P<part>exp?|explicit|imp?|implicit)(?:_tableau)?",
    re.IGNORECASE,
)
_PAIR = {"A": "A", "H": "A2"}
"""Classes of Dedalus: A is explicit, H implicit, and the last rows are the weights."""
_ROLES = {"butcher": "A", "matrix": "A", "a": "A", "weights": "b", "b": "b", "nodes": "c", "c": "c"}
PLAIN = {"matrix": "A", "weights": "b", "nodes": "c"}
"""The part beside one that says which it is."""


def role_of_part(name: str) -> str:
    """What an array of one part of a method is; empty where its name does not tell.

    >>> role_of_part("a_exp"), role_of_part("bhatim"), role_of_part("exp")
    ('A', 'embedded2', '')
    """
    found = _NAME.fullmatch(name)
    if found is None:
        return ""
    role = _ROLES.get(found["word"].lower(), "embedded")
    return role if found["part"].lower().startswith("e") else f"{role}2"


def roles_of_parts(values: Mapping[str, Value]) -> dict[str, Value] | None:
    """The roles of the arrays of both parts; None where there are not two matrices.

    Missing weights are the last rows of the matrices, which have a row more than columns, or whose
    last node is 1.
    """
    found = {role_of_part(name): value for name, value in values.items()}
    found.pop("", None)
    if not {"A", "A2"} <= set(found) and "b" not in values and "c" in values:
        found = {role: values[name] for name, role in _PAIR.items() if name in values}
        found["c"] = values["c"]
        if near(*items_of(found["c"])[-1:]) != 1:
            return None
    if "matrix" in values:
        given = {role: values[name] for name, role in PLAIN.items() if name in values}
        found |= {role: x for role, x in given.items() if role != "A" and role not in found}
        found |= {f"{role}2": x for role, x in given.items() if f"{role}2" not in found}
    matrices = [found.get(x) for x in ("A", "A2")]
    if not all(isinstance(x, Array) and x.is_matrix for x in matrices):
        return None
    for role, weights in (("A", "b"), ("A2", "b2")):
        matrix = found[role]
        assert isinstance(matrix, Array)
        last = matrix.items[-1]
        if weights not in found:
            found[weights] = last
            if isinstance(last, Array) and len(last.items) < len(matrix.items):
                found[role] = Array(matrix.items[:-1])
    return found | {x: values[x] for x in ("order",) if x in values}


def with_hats(roles: Mapping[str, Value]) -> dict[str, Value]:
    """An implicit part and an explicit one with a hat as the roles of two parts; without the first
    stage, which only the explicit part has.
    """
    names = {"A2": "A", "b2": "b", "A": "A_hat", "b": "embedded", "c2": "c", "c": "c_hat"}
    names["order"] = "order"
    found = {role: roles[name] for role, name in names.items() if name in roles}
    stages = len(items_of(found["b"]))
    if len(items_of(found["A"])) + 1 == stages:
        found["A"] = Array([Array([]), *items_of(found["A"])])
    if stages == len(items_of(found["b2"])) + 1:
        rows = [Array([ZERO, *x.items]) for x in items_of(found["A2"]) if isinstance(x, Array)]
        found["A2"] = Array([Array([]), *rows])
        for role in ("b2", "c2"):
            if items_of(found.get(role)):
                found[role] = Array([ZERO, *items_of(found[role])])
    return found
