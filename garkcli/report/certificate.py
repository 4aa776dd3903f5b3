"""Certificates: proofs that can be checked without this package, as JSON, as text and for Coq.

The theory for Coq is in ``proofs/``; ``docs/certificate.md`` says how to run it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from math import lcm
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeAlias, TypeVar

from flint import fmpq, fmpq_poly, fmpz

from garkcli.check.analysis import MethodProof
from garkcli.errors import MethodError, counted
from garkcli.exact.cells import between
from garkcli.exact.display import to_ball
from garkcli.exact.enclosing import midpoint
from garkcli.exact.field import Number, NumberField, coordinates, flat
from garkcli.exact.matrix import Vector, apply
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots
from garkcli.exact.traces import rational_text
from garkcli.exact.traces import told as made_of
from garkcli.frozen import replace
from garkcli.ntrees.kind import FIELDS
from garkcli.ntrees.kind import VertexKind as VertexKind
from garkcli.ntrees.notation import format_tree
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import Order, Proof, Witness
from garkcli.order.hulls import Hull, hulls
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.reason import NO_REASON
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Colour, Tableau
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Rows, Section, itself, maybe, optional, via
from garkcli.tell.kinds import COUNT, INDEX, POSITION, TEXT, TREE, TRUTH, choice, order_answer
from garkcli.tell.parts import SAID, part, parts, rows_of, told
from garkcli.tell.report import Report
from garkcli.version import __version__

if TYPE_CHECKING:
    from garkcli.check.existing import ExistenceProof, PrintedNumber


HEADLINE, USUAL, DETAIL, DATA = Level
DIGITS_OF_ROOT = 100
"""Decimal places of the interval that determines the root θ."""
P = TypeVar("P")
Block: TypeAlias = "tuple[tuple[int, int], Sequence[Sequence[Number]]]"
"""The space and the colour between which it lies, and its entries."""


class In(NamedTuple, Generic[P]):
    part: P
    degree: int


def _signs(proof: Proof | ExistenceProof, d: Plain) -> Plain:
    return replace(d, colours=[colour.name for colour in proof.tableau.colours])


def _proved(proof: Proof, d: Plain) -> str:
    """``4, proved by 8 trees; order 5 fails at …``."""
    found = proof.order
    count = sum(len(trees) for by_colour in proof.spanning for trees in by_colour)
    order = d.known(str(found.order), order_answer(found).status)
    text = f"{order}, proved by {counted(count, 'tree')}"
    return text if found.witness is None else f"{text}; {_signs(proof, d).failure(found.witness)}"


def _tree_rows(proof: Proof, d: Plain) -> list[tuple[str, str]]:
    d = _signs(proof, d)
    return [
        (f"order {k}", ", ".join(d.tree(tree) for trees in by_colour for tree in trees))
        for k, by_colour in enumerate(proof.spanning, start=1)
    ]


def _texts(polynomial: fmpq_poly) -> list[str]:
    return [str(a) for a in polynomial.coeffs()]


def _theta_between(field: NumberField) -> list[str]:
    ball = to_ball(field.element(fmpq_poly([0, 1])), DIGITS_OF_ROOT + 10)
    near = midpoint(ball)
    unit = fmpq(1, 10**DIGITS_OF_ROOT)
    units = (near / unit).floor()
    rounded = unit * units
    low = rounded - unit
    return [str(low), str(rounded + 2 * unit)]


def _between_nodes(modulus: fmpq_poly) -> list[fmpq]:
    """Points to the left of the nodes, between neighbours, and to the right."""
    nodes = [root for root, _ in real_roots(Polynomial.from_flint(modulus))]
    gaps = zip([None, *nodes], [*nodes, None], strict=True)
    return [between(a, b) for a, b in gaps]


def _number(number: Number, degree: int) -> str | list[str]:
    return str(number) if degree == 1 else [str(x) for x in coordinates(number, degree)]


def _between(space: StageSpace) -> list[str] | None:
    if not isinstance(space, PolynomialSpace):
        return None
    return [str(x) for x in _between_nodes(space.modulus)]


def _modulus(space: StageSpace) -> list[str] | None:
    return None if not isinstance(space, PolynomialSpace) else _texts(space.modulus)


def _numbers(found: Iterable[Number], degree: int) -> list[str | list[str]]:
    return [_number(x, degree) for x in found]


RATIONAL: S.Schema = {"type": "string", "pattern": r"^-?\d+(/\d+)?$"}
NUMBER: S.Schema = S.one_of(RATIONAL, S.array(RATIONAL))
"""A rational number, or the coordinates of one of ℚ(θ)."""
RATIONALS: Kind[Sequence[str]] = Kind(Json(S.array(RATIONAL)))
NUMBERS: Kind[object] = Kind(Json(S.array(NUMBER)))
ROWS: Kind[object] = Kind(Json(S.array(S.array(NUMBER))))
ARITY: Kind[Sequence[int]] = Kind(Json(S.array(S.one_of({"enum": [0, 1, 2]}))))
VALUE: Kind[object] = Kind(Json(NUMBER))
REQUIRED: Kind[str] = Kind(Json(RATIONAL))
FIELD: Section[NumberField] = Section(
    Row("modulus", RATIONALS, lambda x: _texts(x.modulus)),
    Row("theta_between", RATIONALS, _theta_between),
)
STAGES: Row[StageSpace] = Row("stages", POSITION, lambda x: x.stages)
SPACE: Section[StageSpace] = Section(
    STAGES, optional("modulus", RATIONALS, _modulus), optional("between_nodes", RATIONALS, _between)
)
VERTICES: Section[VertexKind] = Section(
    Row("branches", ARITY, lambda x: sorted(x.arity)),
    Row("weight", POSITION, lambda x: x.weight),
    Row("in_solution", TRUTH, lambda x: x.is_exact),
)


def _own_kind(colour: Colour) -> VertexKind | None:
    """Returns the kind; None if the key ``linear`` determines it."""
    return None if colour.kind in FIELDS else colour.kind


OF_COLOUR: Rows[Colour] = (
    Row("name", TEXT, lambda x: x.name),
    Row("space", INDEX, lambda x: x.space),
    Row("drives", choice("y", "q", "p"), lambda x: x.part),
    Row("linear", TRUTH, lambda x: x.is_linear),
    optional("vertices", part(VERTICES), _own_kind),
)
OF_BLOCK: Rows[Block] = (
    Row("space", INDEX, lambda x: x[0][0]),
    Row("colour", INDEX, lambda x: x[0][1]),
)
COLOUR: Section[In[Colour]] = Section(
    via(lambda x: x.part, OF_COLOUR), Row("b", NUMBERS, lambda x: _numbers(x.part.b, x.degree))
)
BLOCK: Section[In[Block]] = Section(
    via(lambda x: x.part, OF_BLOCK),
    Row("A", ROWS, lambda x: [_numbers(row, x.degree) for row in x.part[1]]),
)
WITNESS: Section[In[Witness]] = Section(
    Row("tree", TREE, lambda x: x.part.tree),
    Row("value", VALUE, lambda x: _number(x.part.value, x.degree)),
    Row("required", REQUIRED, lambda x: str(x.part.required)),
)


def _blocks(tableau: Tableau) -> list[Block]:
    return sorted(tableau.blocks.items())


def _all(found: Iterable[P], tableau: Tableau) -> list[In[P]]:
    return [In(x, tableau.degree) for x in found]


def _witness(proof: Proof) -> In[Witness] | None:
    witness = proof.order.witness
    return None if witness is None else In(witness, proof.tableau.degree)


TREES: Kind[Sequence[Sequence[Sequence[Tree]]]] = Kind(
    Json(
        S.array(S.array(S.array(S.TEXT))),
        lambda spanning, _: [
            [[format_tree(tree) for tree in trees] for trees in by_colour] for by_colour in spanning
        ],
    )
)
TRUE_OF: Rows[Proof] = [
    Row("order", COUNT, lambda x: x.order.order, DATA),
    Row("spanning", TREES, lambda x: x.spanning, DATA),
    maybe("witness", part(WITNESS), _witness, DATA),
    itself("spanning_in_words", rows_of(_tree_rows), DETAIL),
]
TRUTH_OF = Section(TRUE_OF)
PROOF: Section[Proof] = Section(
    Row("spaces", parts(SPACE), lambda x: x.tableau.spaces, DATA),
    Row("colours", parts(COLOUR), lambda x: _all(x.tableau.colours, x.tableau), DATA),
    Row("blocks", parts(BLOCK), lambda x: _all(_blocks(x.tableau), x.tableau), DATA),
    TRUE_OF,
)


def _pair(proof: MethodProof) -> Proof | None:
    return None if proof.conjugate is None else proof.pair


EXACT: Section[MethodProof] = Section(
    Row("name", TEXT, lambda x: x.name, DATA),
    Row("version", TEXT, lambda _: __version__, DATA),
    maybe("field", part(FIELD), lambda x: x.method.tableau.field, DATA),
    Row("order", told(_proved), lambda x: x.method, HEADLINE),
    Row("conjugate_order", told(_proved), lambda x: x.conjugate),
    Row("pair_order", told(_proved), lambda x: x.pair),
    Row("method", part(PROOF), lambda x: x.method, DETAIL),
    optional("conjugate", part(PROOF), lambda x: x.conjugate, DETAIL),
    optional("pair", part(TRUTH_OF), _pair, DETAIL),
    optional("no_conjugate", TEXT, lambda x: str(x.obstacle) or None),
    title=lambda x, d: d.prose(x.name),
)


def _exists(proof: ExistenceProof, d: Plain) -> str:
    """``4: a method is proved to exist by 8 conditions``."""
    found = proof.order
    status = replace(order_answer(found).status, open=NO_REASON, at_least=proof.witness is None)
    order = d.known(str(found.order), status)
    count = counted(len(proof.conditions), "condition")
    return f"{order}: a method is proved to exist by {count}"


def _excluded(proof: ExistenceProof) -> str | None:
    order, count = proof.order.order + 1, len(proof.witness or ())
    if count:
        how = "a condition excludes" if count == 1 else f"{count} conditions together exclude"
        return f"no method within the tolerance has order {order}: {how} it"
    if proof.order.witness is None:
        return None
    return f"that order {order} fails is left out: it takes more than a sum of conditions"


def _condition_rows(proof: ExistenceProof, d: Plain) -> list[tuple[str, str]]:
    d = _signs(proof, d)
    trees = [tree for tree, _ in proof.conditions]
    orders = range(1, proof.order.order + 1)
    return [(f"order {k}", ", ".join(d.tree(u) for u in trees if u.order == k)) for k in orders]


DECIMAL: S.Schema = {"type": "string", "pattern": r"^-?\d+([/.]\d+)?$"}
MADE: S.Schema = S.one_of(DECIMAL, {"type": "integer"}, {"type": "array"})
"""A rational number, the number of a printed one, or [sign, one, other]."""
SHORT: Kind[fmpq] = Kind(Json(DECIMAL, lambda x, _: rational_text(x)))
SHORTS: Kind[Sequence[fmpq]] = Kind(
    Json(S.array(DECIMAL), lambda row, _: [rational_text(x) for x in row])
)
ENTRIES: Kind[Sequence[Number]] = Kind(
    Json(S.array(MADE), lambda row, _: [made_of(x) for x in row])
)
MATRIX: Kind[Sequence[Sequence[Number]]] = Kind(
    Json(S.array(S.array(MADE)), lambda rows, _: [[made_of(x) for x in row] for row in rows])
)
PRINTED: Section[PrintedNumber] = Section(
    Row("printed", SHORT, lambda x: x.printed),
    Row("radius", SHORT, lambda x: x.radius),
    Row("centre", SHORT, lambda x: x.centre),
    Row("width", SHORT, lambda x: x.width),
)
TRACED_COLOUR: Section[Colour] = Section(OF_COLOUR, Row("b", ENTRIES, lambda x: x.b))
TRACED_BLOCK: Section[Block] = Section(OF_BLOCK, Row("A", MATRIX, lambda x: x[1]))
CONDITION: Section[tuple[Tree, tuple[fmpq, ...]]] = Section(
    Row("tree", TREE, lambda x: x[0]), Row("W", SHORTS, lambda x: x[1])
)
FACTOR: Section[tuple[Tree, fmpq]] = Section(
    Row("tree", TREE, lambda x: x[0]), Row("factor", SHORT, lambda x: x[1])
)
EXISTING: Section[ExistenceProof] = Section(
    Row("spaces", parts(Section(STAGES)), lambda x: x.tableau.spaces, DATA),
    Row("colours", parts(TRACED_COLOUR), lambda x: x.tableau.colours, DATA),
    Row("blocks", parts(TRACED_BLOCK), lambda x: _blocks(x.tableau), DATA),
    Row("order", COUNT, lambda x: x.order.order, DATA),
    Row("conditions", parts(CONDITION), lambda x: x.conditions, DATA),
    maybe("witness", parts(FACTOR), lambda x: x.witness, DATA),
)
WITHIN: Section[ExistenceProof] = Section(
    Row("name", TEXT, lambda x: x.name, DATA),
    Row("version", TEXT, lambda _: __version__, DATA),
    itself("order", told(_exists), HEADLINE),
    Row("excluded", SAID, _excluded, label="next order"),
    Row("numbers", parts(PRINTED), lambda x: x.numbers, DATA),
    itself("method", part(EXISTING), DATA),
    itself("spanning_in_words", rows_of(_condition_rows), DETAIL),
    title=lambda x, d: d.prose(x.name),
)


def form(proof: MethodProof | ExistenceProof) -> Section[Any]:
    return EXACT if isinstance(proof, MethodProof) else WITHIN


REPORT: Report[MethodProof | ExistenceProof] = Report(
    "gark/certificate/1", "certificate of gark export", lambda: [EXACT, WITHIN], form, key=""
)


def coq_proof(proof: MethodProof) -> str:
    """Orders of method, conjugate and pair; MethodError for a linear colour."""
    tableau = proof.method.tableau
    tableau.demand_fields("a proof for Coq")
    if any(colour.is_linear for colour in tableau.colours):
        message = "a colour has a linear vector field, which the theory of Coq does not know"
        cure = "leave `linear` out, or take --format json"
        raise MethodError(message, cure, code="cannot-export")
    parts = [_HEAD.format(name=_comment(proof.name), version=__version__)]
    parts.append(_data("the_method", tableau))
    parts.append(_order_of("method", "the_method", proof.method))
    if tableau.is_partitioned:
        parts.append("(* The method is partitioned: its conjugate is left out. *)\n")
    elif proof.conjugate is None:
        parts.append("(* A weight is zero: the method has no symplectic conjugate. *)\n")
    else:
        parts.append(_data("the_conjugate", proof.conjugate.tableau))
        parts.append(_CONJUGATE)
        parts.append(_order_of("conjugate", "the_conjugate", proof.conjugate))
        if proof.pair is not None:
            parts.append("Definition the_pair := pair_of the_method the_conjugate.\n")
            parts.append(_order_of("pair", "the_pair", proof.pair))
    theorems = re.findall(r"^Theorem (\w+)", "\n".join(parts), re.MULTILINE)
    parts.append(_ASSUMPTIONS.format(theorems=", ".join(theorems)))
    return "\n".join(parts)


_HEAD = """\
(* {name}
   Written by gark {version}; proofs/README.md says how coqc checks it. *)

From Coq Require Import QArith ZArith List.
From Gark Require Import Trees Methods Check Pairs.
Import ListNotations.
Open Scope Q_scope.
"""
_CONJUGATE = """\
Theorem it_is_the_conjugate : is_conjugate the_method the_conjugate.
Proof. apply proved_conjugate; [reflexivity..|vm_cast_no_check (eq_refl true)]. Qed.
"""
_ORDER = """\
Theorem order_of_{label} : has_order {name} {order}.
Proof.
  apply has_order_by with (F := {label}_trees) (G := {label}_branches).
  vm_cast_no_check (eq_refl true).
Qed.
"""
_NO_HIGHER = """\
Theorem {label}_has_no_higher_order : ~ has_order {name} {next}.
Proof. apply not_higher_by with (t := {tree}). vm_cast_no_check (eq_refl true). Qed.
"""
_ASSUMPTIONS = """\
Definition all_theorems := ({theorems}).
Print Assumptions all_theorems.
"""


def _comment(text: str) -> str:
    return re.sub(r"[^A-Za-z0-9 .,:+/-]", " ", text)


def _list(items: Iterable[str], separator: str = "; ") -> str:
    return f"[{separator.join(items)}]"


def _integer(x: int) -> str:
    """Long integers in hexadecimal digits, which Coq reads in linear time."""
    return str(x) if abs(x) < 10**40 else hex(x)


def _rational(x: fmpq) -> str:
    number = f"({_integer(int(x.p))})" if x.p < 0 else _integer(int(x.p))
    return number if x.q == 1 else f"({number}#{_integer(int(x.q))})"


def _polynomial(p: fmpq_poly) -> str:
    return _list(map(_rational, p.coeffs()[:-1]))


class _Basis:
    """1, cθ, (cθ)², … with the least c > 0 that makes the polynomial of cθ one of integers."""

    def __init__(self, tableau: Tableau) -> None:
        modulus = fmpq_poly([0, 1]) if tableau.field is None else tableau.field.modulus
        unit = 1
        for j, x in enumerate(reversed(modulus.coeffs())):
            for prime, _ in fmpz(x.q).factor():
                while (unit**j * x).q % prime == 0:
                    unit *= int(prime)
        self.degree = tableau.degree
        self.scale = [fmpq(1, unit**e) for e in range(self.degree)]
        self.field = fmpq_poly([x * unit ** (self.degree - e) for e, x in enumerate(modulus)])

    def number(self, x: Number) -> str:
        coefficients = zip(coordinates(x, self.degree), self.scale, strict=True)
        return _list(_rational(y * scale) for y, scale in coefficients)

    def whole(self, vector: Sequence[fmpq]) -> tuple[list[int], int]:
        """Coordinates of stage values as integers, and their denominator."""
        scaled = [x * self.scale[i % self.degree] for i, x in enumerate(vector)]
        common = lcm(*(int(x.q) for x in scaled))
        return [int((x * common).p) for x in scaled], common


def _data(name: str, tableau: Tableau) -> str:
    basis = _Basis(tableau)

    def space(l: int) -> str:
        of = tableau.space(l)
        if isinstance(of, PolynomialSpace):
            return f"Modulo {_polynomial(of.modulus)}"
        return f"Points {of.stages}"

    def block(l: int, m: int) -> str:
        rows = tableau.block(l, m)
        if rows is None:
            return "None"
        lines = (_list(map(basis.number, row)) for row in rows)
        return f"Some {_list(lines, ';' + chr(10) + '    ')}"

    colours = range(tableau.size)
    weights = (f"({l}%nat, {_list(map(basis.number, tableau.colours[l].b))})" for l in colours)
    blocks = (_list((block(l, m) for m in colours), ";\n   ") for l in colours)
    return (
        f"Definition {name} : method := {{|\n"
        f"  field := {_polynomial(basis.field)};\n"
        f"  spaces := {_list(map(space, colours))};\n"
        f"  colours := {_list(weights)};\n"
        f"  blocks := {_list(blocks, ';' + chr(10) + '  ')} |}}.\n"
    )


def _order_of(label: str, name: str, proof: Proof) -> str:
    order: Order = proof.order
    basis = _Basis(proof.tableau)
    found = hulls(proof.tableau, order.order)
    parts = [
        _hulls(f"{label}_trees", found.trees, basis),
        _hulls(f"{label}_branches", found.branches, basis),
        _ORDER.format(label=label, name=name, order=order.order),
    ]
    if order.witness is not None:
        tree = _tree(order.witness.tree, proof.tableau, basis)
        parts.append(_NO_HIGHER.format(label=label, name=name, next=order.order + 1, tree=tree))
    return "\n".join(parts)


def _hulls(name: str, table: Iterable[Iterable[Hull | None]], basis: _Basis) -> str:
    rows = (_list((_hull(hull, basis) for hull in row), ";\n    ") for row in table)
    kind = "list (list (option zhull))"
    return f"Definition {name} : {kind} := {_list(rows, ';' + chr(10) + '  ')}%Z.\n"


def _hull(hull: Hull | None, basis: _Basis) -> str:
    if hull is None:
        return "None"
    base, den = basis.whole(hull.base)
    rows = [(pivot, basis.whole(row)[0]) for pivot, row in hull.directions]
    common = lcm(den, *(row[pivot] for pivot, row in rows))
    base = [x * (common // den) for x in base]
    dirs = (f"({p}%nat, {_integer(common // row[p])}, {_integers(row)})" for p, row in rows)
    return (
        f"Some {{| den := {_integer(common)}; base := {_integers(base)}; dirs := {_list(dirs)} |}}"
    )


def _integers(vector: Iterable[int]) -> str:
    return _list(map(_integer, vector))


def _tree(tree: Tree, tableau: Tableau, basis: _Basis) -> str:
    """The tree with ψ at each vertex, and ρ A^{l,m} ψ at each branch."""

    def text(vector: Vector) -> str:
        numbers, common = basis.whole(flat(vector, basis.degree))
        return f"({_integers(numbers)}%Z, {_integer(common)}%positive)"

    def vertex(u: Tree, below: int | None) -> tuple[str, Vector]:
        """The text of a branch, and what it contributes to the vertex below."""
        psi, branches = tableau.space(u.root).one, []
        for branch in u.branches:
            its_text, worth = vertex(branch, u.root)
            branches.append(its_text)
            psi = tableau.space(u.root).product(worth, psi)
        block = None if below is None else tableau.block(below, u.root)
        worth = psi if block is None else apply(block, [u.order * x for x in psi])
        beside = "([], 1%positive)" if block is None else text(worth)
        return f"(ZNode {u.root} {text(psi)} {beside}\n  {_list(branches)})", worth

    return vertex(tree, None)[0]
