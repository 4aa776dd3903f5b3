"""What the failing conditions tell, for machines: fields of ``gark check --format json``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from garkcli.exact.display import to_text
from garkcli.page.record import Field, Record, inside
from garkcli.page.schema import (
    COUNT,
    EXACT,
    FLAG,
    INTEGER,
    POSITION,
    SIZE,
    TEXT,
    Schema,
    array,
    nullable,
)
from garkcli.trees.notation import format_tree

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.check.outcome import Outcome
    from garkcli.exact.field import Number
    from garkcli.order.blame import Blame
    from garkcli.order.constants import ErrorConstants, Norms
    from garkcli.order.repairs import Repair
    from garkcli.order.suggestion import Misprint, Suggestion

BLOCK: Schema = {**array(POSITION), "minItems": 1, "maxItems": 2}
"""The colours of a block A^{l,m}, or the one of weights b^{l}."""
_CLAIMS: Schema = {"enum": ["order", "conjugate-order", "pair-order"]}


def blocks(found: Sequence[tuple[int, int]]) -> list[list[int]]:
    """Blocks (l, m) with colours counted from 1."""
    return [_block(l, m) for l, m in found]


def _block(*colours: int | None) -> list[int]:
    return [l + 1 for l in colours if l is not None]


def _is_of_weights(repair: Repair) -> bool:
    return repair.m is None or repair.i is None


def _weights(repair: Repair) -> list[int] | None:
    return _block(repair.l, repair.m) if _is_of_weights(repair) else None


def _matrix(repair: Repair) -> list[int] | None:
    return None if _is_of_weights(repair) else _block(repair.l, repair.m)


def _row(repair: Repair) -> int | None:
    return None if repair.i is None else repair.i + 1


_REPAIR: Record[Repair] = Record(
    Field("b", BLOCK, _weights, is_optional=True),
    Field("A", BLOCK, _matrix, is_optional=True),
    Field("row", nullable(INTEGER), _row),
    Field("entry", POSITION, lambda x: x.j + 1),
    Field("old", EXACT, lambda x: to_text(x.old)),
    Field("new", EXACT, lambda x: to_text(x.new)),
)


def _repairs(found: Blame | Misprint) -> list[dict[str, Any]]:
    return [_REPAIR.data(repair) for repair in found.repairs]


def _culprit(blame: Blame) -> list[int] | None:
    return None if blame.culprit is None else _block(*blame.culprit)


_BLAME: Record[Blame] = Record(
    Field("of", _CLAIMS, lambda x: x.of),
    Field("order", POSITION, lambda x: x.order),
    Field("failing", COUNT, lambda x: x.failing),
    Field("conditions", COUNT, lambda x: x.total),
    Field("only_coupling", FLAG, lambda x: x.only_coupling),
    Field("culprit", nullable(BLOCK), _culprit),
    Field("in_every", array(BLOCK), lambda x: blocks(x.in_every)),
    Field("in_none", array(BLOCK), lambda x: blocks(x.in_none)),
    Field("repairs", array(_REPAIR.schema), _repairs),
    Field("restores", array(TEXT), lambda x: list(x.restores)),
)
_MISPRINT: Record[Misprint] = Record(
    Field("order", COUNT, lambda x: x.order),
    Field("residual", SIZE, lambda x: float(x.residual.upper())),
    Field("explained", SIZE, lambda x: float(x.explained.upper())),
    Field("repairs", array(_REPAIR.schema), _repairs),
)
_SUGGESTION: Record[Suggestion] = Record(
    Field("line", TEXT, lambda x: x.line),
    Field("order", COUNT, lambda x: x.order),
    Field("rounding", SIZE, lambda x: float(x.rounding.upper())),
    Field("genuine", SIZE, lambda x: float(x.genuine.upper())),
)


def _exact(number: Number | None) -> str | None:
    return None if number is None else to_text(number)


def _worst(norms: Norms) -> str | None:
    return None if norms.worst is None else format_tree(norms.worst)


_NORMS: Record[Norms] = Record(
    Field("trees", COUNT, lambda x: x.trees),
    Field("two_norm_squared", nullable(TEXT), lambda x: _exact(x.two_squared)),
    Field("two_norm", SIZE, lambda x: x.two),
    Field("inf_norm", SIZE, lambda x: x.largest),
    Field("worst", nullable(TEXT), _worst),
    Field("worst_value", nullable(TEXT), lambda x: _exact(x.worst_value)),
)
_CONSTANTS: Record[ErrorConstants] = Record(
    Field("order", POSITION, lambda x: x.order),
    Field("exact", FLAG, lambda x: x.is_exact),
    Field("all", _NORMS.schema, lambda x: _NORMS.data(x.all)),
    Field("coupling", _NORMS.schema, lambda x: _NORMS.data(x.coupling)),
)


def _analysis(outcome: Outcome) -> Analysis | None:
    return outcome.analysis


HINTS: tuple[Field[Outcome], ...] = (
    _BLAME.optional("blame", lambda x: x.blame),
    *inside(_analysis, [_MISPRINT.optional("misprint", lambda x: x.misprint)]),
    _CONSTANTS.optional("error_constants", lambda x: x.constants),
    *inside(
        _analysis, [_SUGGESTION.optional("suggestion", lambda x: x.suggestion)]
    ),
)
"""Each is left out where there is nothing to say."""
