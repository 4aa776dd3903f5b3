"""Spec files of sweeps: families × stages × transfer rules × values of parameters, and criteria."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from flint import fmpq

from garkcli.errors import ExpressionError
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.rewriting import roots_in
from garkcli.glossary.key import SWEEP_FILE, FileKind, KeyMeaning
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import MappingNode, Node, ScalarNode, one_line, shortened, unquoted
from garkcli.grammar.reading import read_text
from garkcli.grammar.source import Source
from garkcli.methodfile.expectations import claims
from garkcli.sweep.columns import columns, kind_of
from garkcli.sweep.methods import METHODS, NAME, STARTS, TRANSFER, MethodsReader, rational, span
from garkcli.sweep.plan import Criteria, Plan, RowCondition

MOST_METHODS = 10_000_000
MOST_VALUES = 1_000_000
FREE = "free"
"""The value of a parameter that is left to the search."""
_CONDITION = re.compile(r"(>=|<=|>|<|=)?\s*([-+0-9./eE]+)")


def _value(at: Any, node: Node, text: str, where: str) -> fmpq | None:
    try:
        expression = parse(text)
        if any(roots_in(expression)):
            message = f"{where}: a rational number is expected"
            at.source.fault(node, message, "write 1/3 or 0.25", code="wrong-value")
            return None
        value = Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        at.source.expression_fault(node, where, error)
        return None
    assert isinstance(value, fmpq)
    return value


def _number(at: Any, node: Node, where: str) -> fmpq | None:
    text = at.source.scalar(node, where)
    return None if text is None else _value(at, node, text, where)


_RATIONAL = rational(_number)
_STEPS = g.mapping(
    g.Key("from: 0", _RATIONAL, "The first of equidistant values.", is_needed=True),
    g.Key("to: 1", _RATIONAL, "The last of equidistant values.", is_needed=True),
    g.Key(
        "steps: 4",
        g.count(1, MOST_VALUES),
        "How many steps lead from the first of equidistant values to the last.",
        is_needed=True,
    ),
    form="write {from: 0, to: 1, steps: 10}",
)
_VALUES = g.one_or_more(_RATIONAL)


def _grid(at: Any, node: Node, where: str) -> list[fmpq]:
    """Reads the values of a parameter; equidistant ones include both ends."""
    if not isinstance(node, MappingNode):
        return _VALUES.read(at, node, where) or []
    ends: g.ReadMapping = _STEPS.read(at, node, where)
    if len(ends) < 3:
        return []
    first, last, steps = (ends[key] for key in ("from", "to", "steps"))
    return [first + (last - first) * fmpq(k, steps) for k in range(steps + 1)]


def _parameters(at: Any, node: Node, where: str) -> dict[str, tuple[str, ...] | None]:
    """Reads the values of each parameter as text; None if they are left to the search."""
    grids: dict[str, tuple[str, ...] | None] = {}
    for name, values in at.source.mapping(node, where, ()).items():
        place = f"{where}: {unquoted(name)}"
        items = values.value if isinstance(values.value, list) else [values]
        if not NAME.fullmatch(name):
            message = f"{place} cannot be the name of a parameter"
            at.source.fault(values, message, "use letters, digits and _", code="name-taken")
        elif [x.value for x in items if isinstance(x, ScalarNode)] == [FREE]:
            grids[name] = None
        else:
            grids[name] = tuple(str(x) for x in dict.fromkeys(_grid(at, values, place)))
    return grids


_GRID = g.ValueKind(
    lambda: {"anyOf": [{"const": FREE}, _STEPS.schema(), *_VALUES.schema()["anyOf"]]}, _grid
)
_SEARCH = g.mapping(
    g.Key(
        "seeds: 1..100",
        span(0, 9, "write 1..100"),
        "The seeds of the searches: one number, or a range, each a method of its own.",
        is_needed=True,
    ),
    g.Key("starts: 20", g.count(1), "How many starts the search of each seed has.", STARTS),
    g.Key(
        "order: 4",
        g.count(1),
        "The order that is searched for; by default that of the file's design.",
    ),
    form="write {seeds: 1..100, starts: 20}",
)


_BOUND: g.Schema = {"type": ["number", "string"], "pattern": r"^(>=|<=|>|<|=)?\s*[-+0-9./eE]+$"}


def _bound(at: Any, node: Node, where: str) -> tuple[str, float] | None:
    text = at.source.scalar(node, where)
    if text is None:
        return None
    parts = _CONDITION.fullmatch(text)
    if parts is None:
        message = f"{where}: {shortened(text)} is not a condition"
        at.source.fault(node, message, 'write 4 or ">= 4"', code="wrong-value")
        return None
    value = _value(at, node, parts[2], where)
    if value is None:
        return None
    with suppress(OverflowError):
        bound = int(value.p) / int(value.q)
        if bound or not value:  # the nearest float, 0 for 0 alone
            return parts[1] or "=", bound
    message = f"{where}: {shortened(parts[2])} is beyond the numbers of a column"
    at.source.fault(node, message, "write 0, or a number up to 1e308", code="wrong-value")
    return None


def _truth(at: Any, node: Node, where: str) -> tuple[str, bool] | None:
    flag = g.FLAG.read(at, node, where)
    return None if flag is None else ("=", flag)


_OWN = {
    "error": "The 2-norm of the error coefficients of the first order whose conditions fail.",
    "error-largest": "The largest error coefficient of the first order whose conditions fail.",
    "pair-error": "The 2-norm of the error coefficients of the symplectic pair.",
    "pair-p-stable": "Whether the symplectic pair is P-stable.",
    "phase-order": "The order of the phase lag on the harmonic oscillator.",
    "phase-constant": "The size of the constant of the phase lag on the harmonic oscillator.",
    "stages": "The stages of all colours together.",
    "colours": "How many colours the method has.",
}
"""The columns that are not claims."""
_EXAMPLES = {"stages": '"<= 6"', "colours": "2", "phase-order": '">= 4"'}


def _conditions() -> Iterator[g.Key]:
    claimed = {key.name: key.text.partition(" It is claimed as ")[0] for key in claims()}
    by_kind = {
        "truth": (g.ValueKind(g.FLAG.schema, _truth), "true"),
        "count": (g.ValueKind(lambda: _BOUND, _bound), '">= 1"'),
        "number": (g.ValueKind(lambda: _BOUND, _bound), '"< 0.01"'),
    }
    for name in (*(x for x in columns() if x not in _OWN), *_OWN):
        kind, example = by_kind[kind_of(name)]
        if name in _OWN:
            yield g.Key(f"{name}: {_EXAMPLES.get(name, example)}", kind, _OWN[name])
        else:
            shown = "true" if kind_of(name) == "truth" else '">= 1"'
            yield g.Key(f"{name}: {shown}", kind, claimed[name], is_listed=False)


@cache
def _file() -> g.ValueKind:
    some_columns = g.one_or_more(g.word(lambda: columns().keys()))
    return g.mapping(
        g.Key(
            "name: Gauss and Lobatto",
            g.ValueKind(lambda: {"type": "string"}, g.TEXT.read),
            "The name of the sweep.",
        ),
        g.Key(
            "methods: [{family: [gauss, radau-iia], stages: 1..3}]",
            METHODS,
            "The diagonal methods, one entry per colour: every family with every number of stages. "
            "Members that do not exist are left out.",
        ),
        g.Key(
            "transfer: [collocation, {interpolation: tau, collocation: 1 - tau}]",
            g.ValueKind(lambda: TRANSFER.schema()),
            "Rules for the blocks between the methods, one or a list, each tried. Weights of a "
            "combination may use the parameters. With search, ? is any transfer whose pair has the "
            "order, drawn by each seed.",
        ),
        g.Key(
            "files: [sdirk.gark.yaml]",
            g.ValueKind(g.one_or_more(g.ValueKind(lambda: {"type": "string"})).schema),
            "Method files, looked for beside the spec file, or names of the catalogue. Their "
            "parameters and unknowns take the values of parameters.",
        ),
        g.Key(
            "parameters: {tau: {from: 0, to: 1, steps: 4}}",
            g.ValueKind(
                lambda: {"type": "object", "additionalProperties": _GRID.schema()},
                _parameters,
                _STEPS.inside,
            ),
            "For each name a list of rational numbers, equidistant ones by from, to and steps "
            "with both ends, or free: looked for by search.",
        ),
        g.Key(
            "search: {seeds: 1..100}",
            _SEARCH,
            "How parameters and unknowns without values are searched for.",
        ),
        g.Key(
            "columns: [order, p-stable]",
            some_columns,
            "The columns of each method: one criterion or a list.",
            is_needed=True,
        ),
        g.Key(
            'where: {order: ">= 3"}',
            g.mapping(more=_conditions),
            "Which methods are kept: for columns true, false, a number, or a comparison. gark "
            "decides the conditions in their order, and stops at the first that fails.",
        ),
        g.Key(
            "best: [order, error]",
            some_columns,
            "Columns to sort by, the first counting most; each column knows what is better.",
        ),
        g.Key(
            "pareto: [order, implicit-stages]",
            some_columns,
            "Columns of the Pareto front: the methods that none surpasses in all of them.",
        ),
        form="write columns: [order, error]",
        rules=[
            g.Ways(
                "",
                ("methods", "files"),
                "no methods and no files",
                "write methods: [{family: gauss, stages: 1..4}], or files",
                is_one=False,
            ),
            g.KeyRelation(
                "transfer", "transfer without methods", "add methods", needs=("methods",)
            ),
        ],
    )


def load_plan(path: str) -> Plan:
    """Reads a spec file, and method files beside it; MethodFileError with all faults."""
    text, name = read_text(path, SWEEP_FILE)
    source = Source(name, text, SWEEP_FILE)
    root = source.compose()
    if root is None:
        raise source.error()
    said: g.ReadMapping = _file().read(SimpleNamespace(source=source), root, g.FILE)
    given = said.get("parameters", {})
    grids = {name: values for name, values in given.items() if values is not None}
    search: g.ReadMapping | None = said.get("search")
    if search is not None and "seeds" not in search:
        search = None
    methods = MethodsReader(source, grids, [x for x in given if x not in grids], search)
    before = len(source.faults)
    entries = said.get("methods", [])
    is_whole = "methods" not in said.nodes
    is_right = all(entry.is_right for entry in entries)
    if is_right and "methods" in said and len(entries) == len(said.nodes["methods"].value):
        methods.read(said.nodes["methods"], entries, said.get("transfer"))
        is_whole = True
    if "files" in said:
        methods.read_files(said["files"], Path(path).parent)
    if is_whole and methods.templates and len(source.faults) == before:
        _refuse_unused(source, said, methods)
    total = sum(x.count(grids) for x in methods.templates)
    if total > MOST_METHODS:
        message = f"{total} methods (limit {MOST_METHODS})"
        source.fault(root, message, "make several sweeps", code="too-many")
    source.close()
    conditions = tuple(
        RowCondition(column, sign, bound) for column, (sign, bound) in said.get("where", {}).items()
    )
    best, pareto = said.get("best", ()), said.get("pareto", ())
    asked = [*(x.column for x in conditions), *said.get("columns", ()), *best, *pareto]
    return Plan(
        one_line(said.get("name", "")) or Path(name).stem,
        tuple(methods.templates),
        grids,
        Criteria(tuple(dict.fromkeys(asked)), conditions),
        tuple(best),
        tuple(pareto),
    )


def _refuse_unused(source: Source, said: g.ReadMapping, methods: MethodsReader) -> None:
    """Reports parameters that no method has, and a search without unknowns."""
    used = {name for x in methods.templates for name in x.parameters}
    for name in methods.grids.keys() - used:
        message, cure = f"parameters: no method has {name}", "leave it out, or use it"
        source.fault(said.nodes["parameters"], message, cure, code="not-together")
    is_searched = any(x.order for x in methods.templates)
    # a parameter without a value is reported already
    if "search" in said.nodes and not is_searched and all(methods.grids.values()):
        message = "search: no method has an unknown that is left to it"
        cure = f"write parameters: {{tau: {FREE}}}, or a file with unknowns"
        source.fault(said.nodes["search"], message, cure, code="not-together")


def sweep_schema() -> dict[str, Any]:
    """Returns the JSON Schema of the spec files of sweeps.

    >>> sweep_schema()["type"]
    'object'
    """
    return g.file_schema("gark sweep file", "The methods of a sweep and their columns.", _file())


def told(kind: FileKind) -> Iterator[KeyMeaning]:
    return g.told(_file().inside(), kind.page)
