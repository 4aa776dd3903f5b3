"""``gark certificate --format coq``: a method as data for Coq, with what it has to prove.

The theory is in ``proofs/``, one file a step; ``docs/certificate.md`` says how to run it. Every
colour has a stage space of its own here, also where colours share stages.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from math import lcm

from flint import fmpq, fmpq_poly

from garkcli.check.analysis import MethodProof
from garkcli.errors import MethodError
from garkcli.exact.field import Number, coordinates
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
Print Assumptions it_is_the_conjugate.
"""
_ORDER = """\
Theorem order_of_{label} : has_order {name} {order}.
Proof.
  apply has_order_by with (F := {label}_trees) (G := {label}_branches).
  vm_cast_no_check (eq_refl true).
Qed.
Print Assumptions order_of_{label}.
"""
_NO_HIGHER = """\
Theorem {label}_has_no_higher_order : ~ has_order {name} {next}.
Proof. apply not_higher_by with (t := {tree}). vm_cast_no_check (eq_refl true). Qed.
Print Assumptions {label}_has_no_higher_order.
"""


def _comment(text: str) -> str:
    """Text that no comment ends with and no string begins with."""
    return re.sub(r"[^A-Za-z0-9 .,:+/-]", " ", text)


def _list(items: Iterable[str], separator: str = "; ") -> str:
    return f"[{separator.join(items)}]"


def _rational(x: fmpq) -> str:
    number = f"({x.p})" if x.p < 0 else str(x.p)
    return number if x.q == 1 else f"({number}#{x.q})"


def _polynomial(p: fmpq_poly) -> str:
    """The coefficients of a monic polynomial below the leading one."""
    return _list(map(_rational, p.coeffs()[:-1]))


def _data(name: str, tableau: Tableau) -> str:
    """The tableau as a ``method``."""
    degree = tableau.degree
    field = fmpq_poly([0, 1]) if tableau.field is None else tableau.field.modulus

    def number(x: Number) -> str:
        return _list(map(_rational, coordinates(x, degree)))

    def space(l: int) -> str:
        of = tableau.space(l)
        if isinstance(of, PolynomialSpace):
            return f"Modulo {_polynomial(of.modulus)}"
        return f"Points {of.stages}"

    def block(l: int, m: int) -> str:
        rows = tableau.block(l, m)
        if rows is None:
            return "None"
        return f"Some {_list((_list(map(number, row)) for row in rows), ';' + chr(10) + '    ')}"

    colours = range(tableau.size)
    weights = (f"({l}%nat, {_list(map(number, tableau.colours[l].b))})" for l in colours)
    blocks = (_list((block(l, m) for m in colours), ";\n   ") for l in colours)
    return (
        f"Definition {name} : method := {{|\n"
        f"  field := {_polynomial(field)};\n"
        f"  spaces := {_list(map(space, colours))};\n"
        f"  colours := {_list(weights)};\n"
        f"  blocks := {_list(blocks, ';' + chr(10) + '  ')} |}}.\n"
    )


def _order_of(label: str, name: str, proof: Proof) -> str:
    """That a method has its order, and no higher one."""
    order: Order = proof.order
    found = hulls(proof.tableau, order.order)
    parts = [
        _hulls(f"{label}_trees", found.trees),
        _hulls(f"{label}_branches", found.branches),
        _ORDER.format(label=label, name=name, order=order.order),
    ]
    if order.witness is not None:
        tree = _tree(order.witness.tree)
        parts.append(_NO_HIGHER.format(label=label, name=name, next=order.order + 1, tree=tree))
    return "\n".join(parts)


def _hulls(name: str, table: Iterable[Iterable[Hull | None]]) -> str:
    rows = (_list(map(_hull, row), ";\n    ") for row in table)
    kind = "list (list (option zhull))"
    return f"Definition {name} : {kind} := {_list(rows, ';' + chr(10) + '  ')}%Z.\n"


def _hull(hull: Hull | None) -> str:
    """The points over one denominator."""
    if hull is None:
        return "None"
    vectors = [hull.base, *(row for _, row in hull.directions)]
    common = lcm(*(int(x.q) for vector in vectors for x in vector))

    def whole(vector: Iterable[fmpq]) -> str:
        return _list(str((x * common).p) for x in vector)

    rows = _list(f"({pivot}%nat, {whole(row)})" for pivot, row in hull.directions)
    return f"Some {{| den := {common}; base := {whole(hull.base)}; dirs := {rows} |}}"


def _tree(tree: Tree) -> str:
    return f"(Node {tree.root} {_list(map(_tree, tree.branches))})"
