"""What the names of arrays tell: matrix, weights, nodes, and which of them belong together."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from garkcli.frozen import Mutable, field
from garkcli.sources.found import FoundTable, Row, Rows, Unreadable, unlike_a_table
from garkcli.sources.scalars import Value, is_matrix, is_row, rows_of, whole
from garkcli.sources.shaping import difference, square, weights

_WORDS: Mapping[str, tuple[str, ...]] = {
    "A": ("A", "a", "Amat", "amat", "beta", "β", "a_lower", "A_matrix"),
    "b": ("b", "B", "bvec", "b_sol", "c_sol", "weights", "α", "b_vec"),
    "c": ("c", "C", "cvec", "nodes", "alpha", "c_vec", "abscissae"),
    "embedded": (
        *("bhat", "b_hat", "bh", "bembed", "bstar", "b_star", "btilde"),
        *("b_tilde", "b_embedded", "bemb", "b_err_weights", "b_low_order"),
        *("embedded", "b2", "bhat_vec", "d", "αEEst", "alphaEEst", "b̂"),
        *("bEEst", "α̂", "b_low", "b_lower"),
    ),
    "error": ("E", "e", "evec", "b_error", "b_err", "c_error", "err"),
    "dense": ("P", "dense", "binterp", "binterpt"),
    "order": ("order", "q", "ord"),
    "embedded_order": (
        *("embedded_order", "error_estimator_order", "p", "adaptiveorder"),
        *("order_embedded", "embeddedOrder", "orderhat"),
    ),
    "stages": ("stages", "s", "n_stages", "nstages"),
    "title": ("name", "title"),
    "fsal": ("fsal", "FSAL", "is_fsal"),
}
ROLES = {word: role for role, words in _WORDS.items() for word in words}
"""From the name of an array to what it is."""
_PREFIX = re.compile(r"(?P<word>[AaBbCcEd]|bhat|bh|Amat|bembed|order)_(?P<stem>\w+)")
_SUFFIX = re.compile(
    r"(?P<stem>\w+?)_(?P<word>A|a|b|B|c|C|E|bhat|b_hat|bembed|b2|order"
    r"|embedded_order|embedded|nodes|weights|stages|fsal|name)"
)
MAX_NAME = 200


def role_of(name: str) -> tuple[str, str] | None:
    """The stem of a name and what the array is; None where the name tells nothing.

    >>> role_of("rk4_A"), role_of("b_heun"), role_of("bhat"), role_of("velocity")
    (('rk4', 'A'), ('heun', 'b'), ('', 'embedded'), None)
    """
    if name in ROLES:
        return "", ROLES[name]
    if len(name) > MAX_NAME:
        return None
    for pattern in (_SUFFIX, _PREFIX):
        found = pattern.fullmatch(name)
        if found:
            return found["stem"], ROLES[found["word"]]
    return None


class Group(Mutable):
    """The arrays and numbers of one scope whose names have one stem.

    Attributes:
        line: where the first of them stands.
        values: what they are, by role.
        lines: where each of them stands.
    """

    line: int
    values: dict[str, Value] = field(default_factory=dict)

    @property
    def is_complete(self) -> bool:
        """Whether a matrix and weights are there."""
        return "A" in self.values and "b" in self.values


class Scope(Mutable):
    """What is assigned in a part of a source: a function, a class, a block, the whole.

    Attributes:
        title: what it is called.
        groups: by stem, those that are not closed yet.
        closed: groups whose arrays were assigned anew.
    """

    title: str = ""
    groups: dict[str, Group] = field(default_factory=dict)
    closed: list[tuple[str, Group]] = field(default_factory=list)

    def add(self, name: str, value: Value, line: int) -> None:
        """Note that a name has a value from a line on."""
        told = role_of(name)
        if told is None:
            return
        stem, role = told
        role = _by_shape(role, value)
        if not role:
            return
        group = self.groups.setdefault(stem, Group(line))
        is_changed = group.values.get(role) is value
        if role in group.values and group.is_complete and not is_changed:
            self.closed.append((stem, group))
            group = Group(line)
            self.groups[stem] = group
        group.values[role] = value

    def tables(self, source: str, format: str) -> Iterator[FoundTable]:
        """The groups that are methods by their names and shapes; then those by their names alone,
        with what is wrong with their shapes.
        """
        unlike = []
        everything = [*self.closed, *self.groups.items()]
        for stem, group in everything:
            name = stem or self.title
            table = _table(group, source, format, name)
            if table is not None and table.trouble:
                unlike.append(table)
            elif table is not None:
                yield table
        yield from unlike


def _by_shape(role: str, value: Value) -> str:
    """The role that goes with the shape; empty where none does."""
    is_number = whole(value) is not None
    if role in {"order", "embedded_order", "stages"}:
        return role if is_number else ""
    if role in {"title", "fsal"}:
        return role if isinstance(value, str) else ""
    if role in {"A", "dense"}:
        return role if isinstance(value, list) and value else ""
    is_vector = is_row(value) or _is_column(value)
    if is_vector:
        return role
    # a matrix called B or c is none of the weights or nodes
    return ""


def _is_column(value: Value) -> bool:
    if not is_matrix(value) or not isinstance(value, list):
        return False
    rows = [row for row in value if isinstance(row, list)]
    is_thin = all(len(row) == 1 for row in rows)
    return len(rows) == 1 or is_thin


def _table(group: Group, source: str, format: str, name: str) -> FoundTable | None:
    if not group.is_complete:
        return None
    values = group.values
    told = values.get("title")
    title = told if isinstance(told, str) else name
    try:
        b = weights(values["b"])
        A = square(values["A"], len(b))
        c = _optional(values, "c", len(b))
        if c is not None and len(c) != len(b):
            raise Unreadable(f"{len(c)} nodes for {len(b)} stages")
        embedded = _embedded(values, b)
        dense = _dense(values, len(b))
    except Unreadable as error:
        trouble = f"arrays called A and b do not fit together: {error.message}"
        return unlike_a_table(source, group.line, format, title, trouble)
    return FoundTable(
        source,
        group.line,
        format,
        title,
        ((A,),),
        (b,),
        (c,),
        embedded=embedded,
        dense=dense,
        order=whole(values.get("order")),
        embedded_order=whole(values.get("embedded_order")),
        is_sure=False,
    )


def _dense(values: Mapping[str, Value], stages: int) -> tuple[Rows, ...] | None:
    """A row of coefficients for each stage, where that is what it is."""
    value = values.get("dense")
    if not isinstance(value, list) or len(value) != stages:
        return None
    return (rows_of(value),)


def _optional(values: Mapping[str, Value], role: str, stages: int) -> Row | None:
    if role not in values:
        return None
    row = weights(values[role])
    if len(row) == stages - 1 and role == "c":
        # c2 … cs, as some codes have it
        return ("0", *row)
    return row


def _embedded(values: Mapping[str, Value], b: Row) -> Rows | None:
    if "embedded" in values:
        row = weights(values["embedded"])
        return (row,) if len(row) == len(b) else None
    if "error" not in values:
        return None
    error = weights(values["error"])
    if len(error) != len(b):
        return None
    return (difference(b, error),)
