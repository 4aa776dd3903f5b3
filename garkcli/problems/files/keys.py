"""The keys of problem files, and their JSON Schema (draft-07); the loader judges formulas."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from flint import fmpq

from garkcli.exact.formula import RESERVED
from garkcli.frozen import Frozen, replace
from garkcli.glossary.key import FileKind, KeyMeaning
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Node
from garkcli.problems.vectorfield import TIME

DEFAULT_T_END = fmpq(2)
STIFFNESS = "stiffness"
Side: TypeAlias = tuple[tuple[str, Node, str], ...]
Sides: TypeAlias = tuple[Side, ...]


class ProblemText(Frozen):
    """The content of a problem file, with formulas as nodes; ``sides`` is for ``rhs`` alone."""

    name: str
    variables: tuple[str, ...]
    are_named: bool
    form: str
    terms: tuple[tuple[Node, str], ...]
    initial: Node | None
    t_end: fmpq
    invariants: tuple[tuple[str, Node], ...]
    sides: Sides = ()
    exact: Node | None = None


FORMS = ("hamiltonian", "lagrangian", "rhs")
MAX_VARIABLES = 64
MAX_TERMS = 64
MAX_INVARIANTS = 10
_CLASHING = {name.removeprefix("p") for name in RESERVED if name.startswith("p")}


def _name_but(names: Iterable[str]) -> str:
    return f"^(?!({'|'.join(sorted(names))})$)[A-Za-z_][A-Za-z_0-9]{{0,29}}$"


def _names(pattern: str) -> g.ValueKind:
    name = g.ValueKind(lambda: {"type": "string", "pattern": pattern})
    return g.one_or_more(name, "variables", MAX_VARIABLES, True, {"uniqueItems": True})


_NAME = _name_but(RESERVED)
_SIGNS = r"^[-+*/^().,\sA-Za-z0-9_]+$"
_FORMULA = g.defined("formula")
_CONSTANT = g.defined("constant")
_BY_NAME = g.by_name(_FORMULA)
_TERMS = g.one_or_more(_FORMULA, "terms", MAX_TERMS, True)
_SIDE = g.ValueKind(lambda: {"anyOf": [_FORMULA.schema(), _BY_NAME.schema()]})
KEYS = {
    key.name: key
    for key in (
        g.Key(
            "gark: 1", g.VERSION, "The version of the format that a problem file is written in.", 1
        ),
        g.Key("name: Kepler", g.TEXT, "The name of the problem; by default that of its file."),
        g.Key("description: an orbit of eccentricity 3/5", g.TEXT, "A description of the problem."),
        g.Key(
            "reference: E. Hairer, S. Nørsett, G. Wanner, section II.10",
            g.TEXT,
            "The origin of the problem, in words.",
        ),
        g.Key(
            "variables: [x, y]",
            _names(_NAME),
            "The names of the positions, or of the unknowns of rhs. The momentum of x is called "
            "px, its velocity vx. A name has letters, digits and _, at most 30 of them; there are "
            "at most 64.",
            is_needed=True,
        ),
        g.Key(
            "hamiltonian: px**2/2 - cos(x)",
            _TERMS,
            "H in positions and momenta: a formula, or a list with one for each term, which are "
            "the colours of the method. A file has one of hamiltonian, lagrangian and rhs.",
            page="docs/problem-file.md#hamiltonian",
        ),
        g.Key(
            "lagrangian: vx**2/2 + cos(x)",
            _TERMS,
            "L in positions and velocities: a formula, or a list with one for each term.",
            page="docs/problem-file.md#lagrangian",
        ),
        g.Key(
            "rhs: {x: y, y: -x}",
            g.one_or_more(_SIDE, "terms", MAX_TERMS),
            "The derivative of each variable by its name, a formula in variables and t; or a list "
            "with such a mapping for each term.",
            page="docs/problem-file.md#rhs",
        ),
        g.Key(
            "initial: {x: 1, px: 0}",
            g.by_name(_CONSTANT),
            "The value of every variable at the start; of a Hamiltonian also of the momenta, of a "
            "Lagrangian of velocities or momenta. It may be left out beside exact.",
        ),
        g.Key(
            "exact: {x: cos(t), y: -sin(t)}",
            _BY_NAME,
            "The solution of rhs where it is known: a formula in t for each variable.",
        ),
        g.Key(
            "parameters: {e: 3/5}",
            g.by_name(_CONSTANT, propertyNames={"pattern": _NAME}),
            "Names that formulas are written with, each with a value, which may use the names "
            "before it.",
        ),
        g.Key(
            "t_end: 5/2",
            _CONSTANT,
            "The final time of a convergence test: a positive rational number.",
            2,
        ),
        g.Key(
            "invariants: {angular momentum: x*py - y*px}",
            g.by_name(_FORMULA, maxProperties=MAX_INVARIANTS),
            "First integrals besides H, each a name and a formula: in positions and momenta, or "
            "in the variables of rhs.",
        ),
    )
}
FORM = g.Ways(
    "the problem is",
    FORMS,
    "no hamiltonian, no lagrangian and no rhs",
    "write one of them, a formula or a list with one for each colour",
)
SOLUTION = g.KeyRelation("exact", "exact is for rhs, and this is a {way}", needs=("rhs",))
START = g.Ways("", ("initial", "exact"), "initial missing", is_one=False)


def problem_file_schema() -> g.Schema:
    """Returns the JSON Schema of problem files, with the meaning of each key.

    >>> problem_file_schema()["title"]
    'gark problem file'
    """
    of_momenta = _told_anew("variables", _names(_name_but({*RESERVED, *_CLASHING})))
    without_time = g.ValueKind(lambda: {"propertyNames": {"not": {"const": TIME}}})
    of_rhs = {
        "variables": _told_anew("variables", _names(_name_but({*RESERVED, TIME}))),
        "parameters": _told_anew("parameters", without_time),
    }
    of_names = g.OfSchema(
        {
            "if": g.required("rhs"),
            "then": {"properties": of_rhs},
            "else": {"properties": {"variables": of_momenta}},
        }
    )
    number: g.Schema = {"type": ["number", "string"], "pattern": _SIGNS}
    return g.file_schema(
        "gark problem file",
        "A Hamiltonian, a Lagrangian or right-hand sides, with initial values.",
        g.mapping(*KEYS.values(), rules=[FORM, SOLUTION, START, of_names]),
        definitions={
            "formula": {"description": "A formula such as px**2/2 - cos(x).", **number},
            "constant": {
                "description": "A number: 2, 0.1, 2/5, sqrt(2), pi/3, with parameters.",
                **number,
            },
        },
    )


def _told_anew(key: str, kind: g.ValueKind) -> g.Schema:
    return replace(KEYS[key], kind=kind).schema()


def told(kind: FileKind) -> Iterable[KeyMeaning]:
    return g.told(KEYS.values(), kind.page)
