#!/usr/bin/env python3
"""Decide the orders in a file of ``gark certificate`` again, trusting nobody.

    python3 referee.py PROOF.json…

Only the standard library is used, and no code of gark. What is checked, for the method, its
symplectic conjugate and its symplectic pair:

  1. Each listed tree u of order k meets its condition b·ψ(u) = 1/k. ψ(u) = γ/ρ 𝒜^[u] is the
     product, over the branches v of u, of A ρ(v) ψ(v).
  2. The listed trees of order k span all: products of a listed branch and a listed forest, of
     total order k − 1, lie in the affine hull of their ψ. ψ is affine in each branch, so by
     induction over k the hull holds ψ of every tree; conditions are affine, so all of them hold.
  3. The witness has one vertex more, and its condition fails.
  4. Conjugate and pair are those of the method: b_i b_j = b_i â_ij + b_j a_ji, as bilinear forms on
     stage values; the blocks of the pair that drive positions are those of the method.

A stage space is K^s, one number a stage, or K[x]/(M), stage values modulo the node polynomial M,
whose sign changes on a list of points show that the nodes are real and distinct. K is ℚ or ℚ(θ).

Exit code 0: every order is proved. 1: something is not. 2: no such file, or no proof in it.
"""

import json
import re
import sys
from fractions import Fraction
from itertools import pairwise

MOST_STAGES = 10_000
UNREADABLE = (ArithmeticError, AttributeError, LookupError, OSError, TypeError, ValueError)


class NotProved(Exception):
    """What does not hold."""


def demand(holds, what):
    if not holds:
        raise NotProved(what)


def evaluate(polynomial, x):
    total = Fraction(0)
    for a in reversed(polynomial):
        total = total * x + a
    return total


def bounds(polynomial, low, high):
    """Bounds of a polynomial on an interval, by Horner's scheme."""
    least = most = Fraction(0)
    for a in reversed(polynomial):
        ends = [least * low, least * high, most * low, most * high]
        least, most = min(ends) + a, max(ends) + a
    return least, most


def product_modulo(u, v, modulus):
    """The product of two polynomials modulo a monic one; coefficients lowest first."""
    n = len(modulus) - 1
    out = [Fraction(0)] * (2 * n - 1)
    for i, x in enumerate(u):
        for j, y in enumerate(v) if x else ():
            out[i + j] += x * y
    for k in range(2 * n - 2, n - 1, -1):
        for j in range(n):
            out[k - n + j] += -modulus[j] * out[k]
    return out[:n]


class Algebraic:
    """A number of ℚ(θ) by its coordinates in 1, θ, θ², …; rational ones may be plain fractions."""

    def __init__(self, field, coordinates):
        self.field, self.coordinates = field, coordinates

    def __add__(self, other):
        pairs = zip(self.coordinates, self.field.coordinates(other), strict=True)
        return Algebraic(self.field, [a + b for a, b in pairs])

    def __mul__(self, other):
        if not isinstance(other, Algebraic):
            return Algebraic(self.field, [a * other for a in self.coordinates])
        product = product_modulo(self.coordinates, other.coordinates, self.field.modulus)
        return Algebraic(self.field, product)

    __radd__, __rmul__ = __add__, __mul__

    def __bool__(self):
        return any(self.coordinates)

    def __eq__(self, other):
        return self.coordinates == self.field.coordinates(other)


class Field:
    """ℚ, or ℚ(θ) with θ the root of the modulus in an interval."""

    def __init__(self, data):
        self.degree = 1
        if data:
            self.modulus = [Fraction(a) for a in data["modulus"]]
            self.degree = len(self.modulus) - 1
            self.low, self.high = map(Fraction, data["theta_between"])
            ends = evaluate(self.modulus, self.low) * evaluate(self.modulus, self.high)
            slope = [k * a for k, a in enumerate(self.modulus)][1:]
            least, most = bounds(slope, self.low, self.high)
            demand(self.modulus[-1] == 1, "the modulus of the field is not monic")
            demand(ends < 0 < least * most, "not one root of the modulus in the interval of theta")

    def coordinates(self, number):
        if isinstance(number, Algebraic):
            return number.coordinates
        return [Fraction(number)] + [Fraction(0)] * (self.degree - 1)

    def read(self, data):
        if isinstance(data, str):
            return Fraction(data)
        demand(len(data) == self.degree > 1, "a number of another field")
        return Algebraic(self, [Fraction(x) for x in data])

    def is_nonzero(self, number):
        """Whether the value at θ is seen to differ from 0."""
        if self.degree == 1:
            return bool(number)
        least, most = bounds(self.coordinates(number), self.low, self.high)
        return least > 0 or most < 0


def dot(xs, ys):
    return sum((x * y for x, y in zip(xs, ys, strict=True) if x and y), Fraction(0))


def apply(block, vector):
    return [dot(row, vector) for row in block]


class Space:
    """The algebra of the stage values of a colour; a vector is a list of its coordinates."""

    def __init__(self, data):
        self.stages = data["stages"]
        demand(0 < self.stages <= MOST_STAGES, "an impossible number of stages")
        self.one = [Fraction(1)] * self.stages
        self.modulus = [Fraction(a) for a in data.get("modulus", [])]
        if self.modulus:
            points = [Fraction(x) for x in data["between_nodes"]]
            values = [evaluate(self.modulus, x) for x in points]
            changes = sum(a * b < 0 for a, b in pairwise(values))
            degree = len(self.modulus) - 1
            demand(points == sorted(points), "points between the nodes that do not ascend")
            demand(changes == degree == self.stages, "nodes that are not real and distinct")
            demand(self.modulus[-1] == 1, "a node polynomial that is not monic")
            self.one = [Fraction(k == 0) for k in range(self.stages)]

    def product(self, u, v):
        if self.modulus:
            return product_modulo(u, v, self.modulus)
        return [x * y for x, y in zip(u, v, strict=True)]

    def basis(self):
        return [[Fraction(i == j) for i in range(self.stages)] for j in range(self.stages)]


class Hull:
    """An affine hull over ℚ: rows (1, coordinates) in echelon form, by their pivots."""

    def __init__(self, field):
        self.field, self.rows = field, {}

    def rest(self, vector):
        row = [Fraction(1)]
        for x in vector:
            row += self.field.coordinates(x)
        for pivot, known in self.rows.items():
            if row[pivot]:
                factor = row[pivot]
                row = [a - factor * b if b else a for a, b in zip(row, known, strict=True)]
        return row

    def insert(self, vector):
        row = self.rest(vector)
        pivot = next((i for i, a in enumerate(row) if a), None)
        if pivot is not None:
            self.rows[pivot] = [a / row[pivot] for a in row]

    def holds(self, vector):
        is_everything = len(self.rows) == len(vector) * self.field.degree + 1
        return is_everything or not any(self.rest(vector))


def read_tree(text):
    """[[]_2,[]_1]_1 as (colour, branches), colours from 0; without a number it is the first."""
    stack = [[]]
    for token in re.findall(r"\[|\]_?\d*", text):
        if token == "[":
            stack.append([])
        else:
            branches = tuple(stack.pop())
            stack[-1].append((int(token[2:] or 1) - 1, branches))
    ((tree,),) = stack
    return tree


def order_of(tree):
    return 1 + sum(map(order_of, tree[1]))


def density(tree):
    product = order_of(tree)
    for branch in tree[1]:
        product *= density(branch)
    return product


class Tableau:
    def __init__(self, field, data):
        self.field, self.data, self.known = field, data, {}
        self.spaces = [Space(x) for x in data["spaces"]]
        self.colours = data["colours"]
        demand({c["drives"] for c in self.colours} in ({"y"}, {"q", "p"}), "colours drive nothing")
        known = range(1, len(self.spaces) + 1)
        demand(all(c["space"] in known for c in self.colours), "a colour without a stage space")
        self.b = [[field.read(x) for x in colour["b"]] for colour in self.colours]
        self.blocks = {}
        for block in data["blocks"]:
            k, m = block["space"] - 1, block["colour"] - 1
            is_place = k + 1 in known and 0 <= m < len(self.colours)
            demand(is_place and (k, m) not in self.blocks, "a block in no place of its own")
            rows = [[field.read(x) for x in row] for row in block["A"]]
            shape = {len(row) for row in rows}, len(rows)
            demand(shape == ({self.space(m).stages}, self.spaces[k].stages), "a block misfits")
            self.blocks[k, m] = rows

    def space(self, l):
        return self.spaces[self.colours[l]["space"] - 1]

    def block(self, l, m):
        """A^{l,m}; None where the stages of colour l do not see colour m."""
        return self.blocks.get((self.colours[l]["space"] - 1, m))

    def branch(self, l, tree):
        """What a branch adds to a vertex of colour l: A ρ ψ."""
        block, factor = self.block(l, tree[0]), order_of(tree)
        demand(block is not None, "a tree that the coupling graph does not have")
        return apply(block, [factor * x for x in self.psi(tree)])

    def psi(self, tree):
        if tree not in self.known:
            colour, branches = tree
            too_many = self.colours[colour]["linear"] and len(branches) > 1
            demand(not too_many, "several branches at a vertex of a linear colour")
            vector = self.space(colour).one
            for branch in branches:
                vector = self.space(colour).product(vector, self.branch(colour, branch))
            self.known[tree] = vector
        return self.known[tree]

    def value(self, tree):
        """b·ψ, which is 1/ρ where the order condition holds."""
        return dot(self.b[tree[0]], self.psi(tree))

    def prove(self):
        """Points 1, 2, 3. Returns the number of spanning trees."""
        listed = []
        for k, by_colour in enumerate(self.data["spanning"], start=1):
            demand(len(by_colour) == len(self.colours), "no trees for some colours")
            listed.append([[read_tree(text) for text in trees] for trees in by_colour])
            for l, trees in enumerate(listed[-1]):
                for tree in trees:
                    demand(tree[0] == l and order_of(tree) == k, "a tree in the wrong place")
                    demand(self.value(tree) == Fraction(1, k), f"a condition of order {k} fails")
                self.check_span(l, k, listed)
        demand(len(listed) == self.data["order"], "spanning trees of another order")
        if self.data["witness"]:
            self.check_witness(read_tree(self.data["witness"]["tree"]))
        return sum(len(trees) for by_colour in listed for trees in by_colour)

    def check_witness(self, tree):
        k, value = order_of(tree), self.value(tree)
        demand(k == self.data["order"] + 1, "the witness has another order")
        demand(self.field.is_nonzero(value + Fraction(-1, k)), "the witness does not fail")
        weight, required = (self.data["witness"][x] for x in ("value", "required"))
        is_told = value * Fraction(k, density(tree)) == self.field.read(weight)
        demand(is_told, "the witness has another value")
        demand(self.field.read(required) == Fraction(1, density(tree)), "it requires another one")

    def check_span(self, l, k, listed):
        """The hull of order k holds all products of listed branches and forests."""
        space, hull = self.space(l), Hull(self.field)
        for tree in listed[k - 1][l]:
            hull.insert(self.psi(tree))
        demand(k > 1 or hull.holds(space.one), "the tree of one vertex is missing")
        for j in range(1, k):
            is_alone = j == k - 1  # one branch; of several the smallest has half the order at most
            if not is_alone and (2 * j > k - 1 or self.colours[l]["linear"]):
                continue
            rests = [space.one] if is_alone else [self.psi(x) for x in listed[k - j - 1][l]]
            seen = [m for m in range(len(self.colours)) if self.block(l, m) is not None]
            for branch in (x for m in seen for x in listed[j - 1][m]):
                image = self.branch(l, branch)
                inside = all(hull.holds(space.product(image, rest)) for rest in rests)
                demand(inside, f"the listed trees of order {k}, colour {l + 1}, do not span")

    def pairs(self):
        """The colours l, m that the symplectic form pairs."""
        for l, one in enumerate(self.colours):
            for m, other in enumerate(self.colours):
                if {one["drives"], other["drives"]} in ({"q", "p"}, {"y"}):
                    yield l, m

    def kinds(self, drives=None):
        """What tells the colours apart but for their coefficients."""
        return [(drives or c["drives"], bool(c["linear"])) for c in self.colours]

    def check_form(self):
        """The symplectic form has a word on every block."""
        seen = {(self.colours[l]["space"] - 1, m) for l, m in self.pairs()}
        demand(seen >= self.blocks.keys(), "a block that the symplectic form does not know")

    def fits(self, l, m, forth, back):
        """Whether b_l(f · forth g) + b_m(back f · g) = b_l(f) b_m(g) for all stage values f, g."""
        if forth is None or back is None:
            return forth is back
        here, there = self.space(l), self.space(m)
        for i, f in enumerate(here.basis()):
            for j, g in enumerate(there.basis()):
                one = dot(self.b[l], here.product(f, apply(forth, g)))
                other = dot(self.b[m], there.product(apply(back, f), g))
                if one + other != self.b[l][i] * self.b[m][j]:
                    return False
        return True


def check_conjugate(method, other):
    demand(method.kinds() == other.kinds(), "the conjugate has other colours")
    method.check_form()
    other.check_form()
    for l in range(len(method.colours)):
        is_same = (method.space(l).modulus, method.b[l]) == (other.space(l).modulus, other.b[l])
        demand(is_same, "the conjugate has other weights or nodes")
    for l, m in method.pairs():
        holds = other.fits(l, m, other.block(l, m), method.block(m, l))
        demand(holds, f"the block {l + 1},{m + 1} of the conjugate is another one")


def check_pair(method, pair):
    of = [index - 1 for index in pair.data["colour_of"]]
    is_plain = method.kinds()[0][0] == "y"
    every = [method.kinds("q"), method.kinds("p")] if is_plain else [method.kinds()]
    wanted = sorted((i, *kind) for kinds in every for i, kind in enumerate(kinds))
    found = sorted((i, *kind) for i, kind in zip(of, pair.kinds(), strict=True))
    demand(found == wanted, "the pair has other colours")
    pair.check_form()
    for l in range(len(pair.colours)):
        here, there = pair.space(l).modulus, method.space(of[l]).modulus
        demand((here, pair.b[l]) == (there, method.b[of[l]]), "the pair has other weights or nodes")
        for m, other in enumerate(pair.colours):
            is_same = pair.block(l, m) == method.block(of[l], of[m])
            demand(other["drives"] != "q" or is_same, "the pair moves positions in another way")
    for l, m in pair.pairs():
        holds = pair.fits(l, m, pair.block(l, m), pair.block(m, l))
        demand(holds, "the pair is not symplectic")
        share = l != m and pair.colours[l]["space"] == pair.colours[m]["space"]
        demand(not share or pair.b[l] == pair.b[m], "two weights at one stage")


def referee(path):
    with open(path, encoding="utf-8") as file:
        data = json.load(file)
    demand(data["schema"] == "gark/certificate/1", "another kind of file")
    field = Field(data["field"])
    names = [name for name in ("method", "conjugate", "pair") if name in data]
    tableaus = {name: Tableau(field, data[name]) for name in names}
    demand("method" in data, "there is no method in it")
    print(f"{path}: {''.join(c if c.isprintable() else '?' for c in data['name'])}")
    for name, tableau in tableaus.items():
        if name != "method":
            check = check_pair if name == "pair" else check_conjugate
            check(tableaus["method"], tableau)
        count = tableau.prove()
        least = "" if data[name]["witness"] else "at least "
        linear = [str(l) for l, c in enumerate(tableau.colours, start=1) if c["linear"]]
        where = f", where the vector field is linear: {', '.join(linear)}" if linear else ""
        order = len(data[name]["spanning"])
        print(f"  {name}: order {least}{order}, proved by {count} trees{where}")


def main(paths):
    code = 0 if paths else 2
    print(end="" if paths else __doc__)
    for path in paths:
        try:
            referee(path)
        except NotProved as error:
            print(f"{path}: not proved: {error}")
            code = max(code, 1)
        except UNREADABLE as error:
            print(f"{path}: no proof can be read: {error!a}")
            code = 2
        except (MemoryError, RecursionError):
            print(f"{path}: no proof can be read: it is too large")
            code = 2
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
