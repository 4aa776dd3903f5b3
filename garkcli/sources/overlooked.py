"""Scopes with numbers like those of a method that nothing else reports: they are reported, never
skipped silently.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from garkcli.sources import ir
from garkcli.sources.evaluate import names_of
from garkcli.sources.naming import speaks
from garkcli.sources.scalar_names import ARRAYS, family_of
from garkcli.sources.signatures import CONSTRUCTOR
from garkcli.sources.values import Number, literal

_STEPS = re.compile(r"step|advance|attempt", re.IGNORECASE)
_SLOPES = re.compile(r"(?<![^\W_])(?:k_?[12]|h|dt)(?!\w)|[sS]tep")
"""Names in steps."""
_MEMBER = re.compile(r"(?P<stem>(?:[a-zA-Z]*_)?[kKfl]\w{0,2}?)_?(?P<number>[1-7])")
_SLOPE = re.compile(r"\w{0,3}[kKfF]\w{0,2}|\w*(?:slope|stage)s?")
"""Names of slopes with numbers, and of arrays of slopes."""
OTHERS = re.compile(
    r"interp|dense|distch|plot|test|control|error|rhs|jac|size|example|demo|main$|(?:^|_)oc_|_obj$",
    re.IGNORECASE,
)
"""Names of scopes with other numbers than those of a step."""
ABOVE = 8
"""Lines above a scope that may describe it."""
FEWEST_NUMBERED = 4
"""Fewest terms with names that differ in numbers."""
WIDEST = 500
"""Characters read of a line, as many scopes may share one."""


def overlooked(
    body: ir.Body,
    text: str,
    source: str,
    told: Iterable[int],
    used: Collection[str],
    lost: Mapping[tuple[str, int], str],
) -> Iterator[ir.Scope]:
    """The scopes with several fractions: with names of coefficients and words for methods, or with
    the name of a method or a step.

    Args:
        body: of the source.
        text: of the source.
        source: its name.
        told: the lines of its tables.
        used: the sizes of the numbers of its tables.
        lost: why scopes are not read, by their kinds and lines: they take too much work or look
            like steps.
    """
    module = ir.Scope("module", re.split(r"[/\\]", source)[-1], body, 1)
    placed = sorted(_placed(body, (module,)), key=lambda x: x[0].line)
    begins = [statement.line for statement, _ in placed]
    known: set[int] = set()
    for line in told if placed else ():
        around = placed[max(bisect_right(begins, line), 1) - 1][1]
        known |= {id(x) for x in around[1:] or around}
    inside: dict[int, tuple[ir.Scope, list[ir.Statement]]] = {}
    for statement, around in placed:
        inside.setdefault(id(around[-1]), (around[-1], []))[1].append(statement)
    lines = [x[:WIDEST] for x in text.split("\n")]
    for key, (scope, own) in inside.items():
        first = max(0, scope.line - ABOVE)
        words = text if scope is module else "\n".join(lines[first : own[-1].line + 1])
        # names of a function are not visible elsewhere
        elsewhere = () if scope.kind == "function" else used
        is_lost = (scope.kind, scope.line) in lost
        is_other = key in known or (not is_lost and OTHERS.search(scope.name))
        if not is_other and _is_method(scope, own, words, elsewhere, is_lost):
            yield scope


def _placed(
    body: ir.Body, around: tuple[ir.Scope, ...]
) -> Iterator[tuple[ir.Statement, tuple[ir.Scope, ...]]]:
    """All statements with the scopes around them, a scope with itself."""
    for x in body:
        inner = (*around, x) if isinstance(x, ir.Scope) and x.kind != "entry" else around
        yield x, inner
        for part in x.arms if isinstance(x, ir.Branch) else (getattr(x, "body", ()),):
            yield from _placed(part, inner)


def _is_method(
    scope: ir.Scope, own: Sequence[ir.Statement], words: str, used: Collection[str], is_lost: bool
) -> bool:
    """Whether a scope may be a method, by its numbers and names, and words around them."""
    named: dict[str, set[str]] = {}
    numbers: list[str] = []
    for x in own:
        sizes = list(map(sized, _fractions(getattr(x, "parts", ()))))
        numbers += sizes
        for name in names_of(x.target) if isinstance(x, ir.Assign) and sizes else ():
            named.setdefault(family_of(name), set()).update(y for y in sizes if y not in used)
    named.pop("", None)
    unused = [x for x in numbers if x not in used]
    if 2 * len(unused) < len(numbers) or not own:
        return False
    maker = CONSTRUCTOR.fullmatch(scope.name)
    title = maker or speaks(scope.title)
    # a module has other numbers, too
    count, least = len({*unused}), 8 if scope.kind == "module" else 3 if maker else 4
    are_many = count >= least or (least < 8 and count > 1 and count + len(unused) > 6)
    is_named = title or (scope.kind == "function" and _STEPS.search(scope.title))
    has_names = len(set().union(*named.values())) > 3 and (
        title or len(named) > 1 or not named.keys().isdisjoint(ARRAYS.values())
    )
    if is_lost and (len(named) > 1 or _SLOPES.search(words)):
        return True
    is_method = is_lost or has_names or (are_many and is_named) or _adds_stages(own, bool(title))
    return bool(is_method and (title or speaks(words)))


def _adds_stages(own: Iterable[ir.Statement], is_titled: bool) -> bool:
    """Whether a sum has several members of a family: ``k1 + 2*k2``, ``k[0] + k[1]``; beside the
    name of a method four numbers of any name.
    """
    least = 2 if is_titled else 3
    for x in (x for statement in own for x in getattr(statement, "parts", ())):
        if isinstance(x, ir.Binary) and x.sign in {"+", ".+"}:
            families = Counter(stem for stem, _ in {*_members(x)})
            if max(families.values(), default=0) >= least:
                return True
            any_names = (
                {y.name for y in ir.inside(x) if isinstance(y, ir.Name)} if is_titled else ()
            )
            numbered = Counter(y.rstrip("0123456789") for y in any_names if y[-1:].isdigit())
            if max(numbered.values(), default=0) >= FEWEST_NUMBERED:
                return True
    return False


def _members(expr: ir.Expr) -> Iterator[tuple[str, str]]:
    """The names with numbers in an expression, as stems and numbers."""
    for x in ir.inside(expr):
        match x:
            case ir.Name(name) | ir.Field(name=name) if match := _MEMBER.fullmatch(name):
                yield match["stem"], match["number"]
            case ir.Index(ir.Name(name), (ir.Literal(number), *_)) if _SLOPE.fullmatch(name):
                yield name, number


def sized(x: float) -> str:
    """A number by its size, so that numbers equal up to rounding and sign are equal."""
    return f"{abs(x):.9g}"


def _fractions(parts: Iterable[object]) -> Iterator[float]:
    """The numbers and roots among expressions that are not integers; ``h/6`` gives 1/6."""
    for x in parts:
        match x:
            case ir.Literal():
                value = _near(x)
            case ir.Call(ir.Name(name="sqrt"), (of,)):
                value = abs(_near(of)) ** 0.5
            case ir.Binary("/" | "÷", left, right) if under := _near(right):
                value = (_near(left) or 1) / under
            case _:
                continue
        if not value.is_integer():
            yield value


def _near(expr: ir.Expr) -> float:
    """The size of a number through signs and conversions; 0 for other expressions."""
    while isinstance(expr, ir.Unary) or (isinstance(expr, ir.Call) and len(expr.args) == 1):
        expr = expr.of if isinstance(expr, ir.Unary) else expr.args[0]
    value = literal(expr.text, 0) if isinstance(expr, ir.Literal) else None
    return value.near if isinstance(value, Number) else 0.0
