"""Certificates for Coq: a method as data, with what it has to prove.

The theory is in ``proofs/``, one file a step; ``docs/certificate.md`` says how to run it. Every
colour has a stage space of its own here, also where colours share stages.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from math import lcm

from flint import fmpq, fmpq_poly, fmpz

from garkcli.check.analysis import MethodProof
from garkcli.errors import MethodError
from garkcli.exact.field import Number, coordinates, flat
from garkcli.exact.matrix import Vector, apply
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import Order, Proof
from garkcli.order.hulls import Hull, hulls
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau
from garkcli.version import __version__


def coq_proof(proof: MethodProof) -> str:
    """A file for ``coqc``: the method, its conjugate and its pair, their orders and no higher ones.

    Raises:
        MethodError: a colour is linear, which the theory does not know.
    """
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
    """Text that no comment ends with and no string begins with."""
    return re.sub(r"[^A-Za-z0-9 .,:+/-]", " ", text)


def _list(items: Iterable[str], separator: str = "; ") -> str:
    return f"[{separator.join(items)}]"


def _integer(x: int) -> str:
    """Long ones in hexadecimal digits, which Coq reads in a time proportional to their number."""
    return str(x) if abs(x) < 10**40 else hex(x)


def _rational(x: fmpq) -> str:
    number = f"({_integer(int(x.p))})" if x.p < 0 else _integer(int(x.p))
    return number if x.q == 1 else f"({number}#{_integer(int(x.q))})"


def _polynomial(p: fmpq_poly) -> str:
    """The coefficients of a monic polynomial below the leading one."""
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
    """The tableau as a ``method``."""
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
    """Statement and proof of an order, and that there is no higher one."""
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
    """The point and the directions, each in integers of its own."""
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
    """The tree with ψ at each vertex, and ρ A^{l,m} ψ where the vertex is a branch."""

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
