#!/usr/bin/env python3
"""Decide the orders in a file of ``gark export --to certificate`` again, trusting nobody.

    python3 referee.py PROOF.json…

With the standard library alone, and no code of gark; for a method, its conjugate and its pair:

  1. Each listed tree u of order k meets its condition b·ψ(u) = 1/k. ψ(u) = γ/ρ 𝒜^[u] is the
     product, over the branches v of u, of A ρ(v) ψ(v).
  2. The listed trees of order k span all: products of a listed branch and a listed forest, of
     total order k − 1, lie in the affine hull of their ψ. ψ is affine in each branch, so by
     induction over k the hull holds ψ of every tree; conditions are affine, so all of them hold.
     Where a vertex counts w orders, k (k − 1) ⋯ is in the place of k, and k − w of k − 1; where the
     exact solution has no such tree, b·ψ(u) = 0, and (0, ψ) is in the place of (1, ψ).
  3. The witness has one vertex more, and its condition fails.
  4. The conjugate is that of the method: b_i b_j = b_i â_ij + b_j a_ji, as bilinear forms on
     stage values. The pair is made here, of A where positions are driven and Â where momenta are.

A stage space is K^s, one number a stage, or K[x]/(M), stage values modulo the node polynomial M,
whose sign changes on a list of points show that the nodes are real and distinct. K is ℚ(θ), and ℚ
is ℚ(0). Everything is written over ℚ: a number of K is the list of its coordinates in 1, θ, θ², …,
a vector the list of all coordinates of its numbers, a map the matrix that acts on such lists.

Of a method with rounded numbers it proves that one method within their radii has the order:

  1. Around a point near the print, number k is centre_k + width_k ε_k, |ε_k| ≤ 1, within its
     radius. The conditions of all trees up to the order are F = c + G ε + ρ there, |ρ_i| ≤ r_i.
  2. Let ε = W η with Σ_j |W_kj| ≤ 1, |η_j| ≤ 1, and M = G W. Where |c_i| + Σ_{j≠i} |M_ij| + r_i
     ≤ |M_ii| for all i, η_i − F_i / M_ii maps the cube into itself. By L. E. J. Brouwer it has a
     fixed point, and there F = 0: all conditions hold. (Where M_ii = 0, F_i is 0 anyway.)
  3. The sum of the witness, of conditions up to one order more, is zero nowhere within the radii:
     no method there has that order.

Exit code 0: every order is proved. 1: something is not. 2: no such file, no proof in it, or one
beyond the limits below, which keep a small file from filling the memory or taking hours.
"""

import json
import re
import sys
from fractions import Fraction
from itertools import chain, pairwise, product
from math import perm, prod

MOST_BYTES, MOST_COLOURS, MOST_DEGREE = 50_000_000, 100, 60
MOST_VALUES = 10_000  # rational numbers of a stage value, in all spaces together
MOST_NUMBERS = 4_000_000  # rational numbers of all matrices of a tableau
# of rounded numbers, so that a proof takes a minute or so at most
MOST_BYTES_ROUNDED, MOST_DIGITS, MOST_ORDER, MOST_TREES = 5_000_000, 300, 60, 2_000
MOST_STEPS = 10_000_000  # trees × (trees + entries of matrices) × numbers
PRINTED = "printed", "radius", "centre", "width"
FIELD, LINEAR = (frozenset({0, 1, 2}), 1, True), (frozenset({0, 1}), 1, True)


class NotProved(Exception):
    """What does not hold."""


def demand(holds, what):
    if not holds:
        raise NotProved(what)


def limit(count, most, what):
    if not 0 < count <= most:
        raise ValueError(f"{count} {what} (limit {most})")


def rational(text):
    """A fraction as gark writes it; with an exponent a short text could be a number without end."""
    is_one = re.fullmatch("-?[0-9]{1,4300}([/.][0-9]{1,4300})?", text)
    demand(is_one, "a number that is no fraction")
    return Fraction(text)


def bounds(polynomial, low, high):
    """Bounds of a polynomial on an interval, by Horner's scheme; its value where low is high."""
    least = most = Fraction(0)
    for a in reversed(polynomial):
        ends = [least * low, least * high, most * low, most * high]
        least, most = min(ends) + a, max(ends) + a
    return least, most


def reduced(polynomial, modulus):
    """A polynomial modulo a monic one, coefficients lowest first."""
    rest = list(polynomial)
    while len(rest) >= len(modulus):
        top = rest.pop()
        for j, a in enumerate(reversed(modulus[:-1]), start=1):
            rest[-j] -= a * top
    return rest


def apply(rows, vector):
    terms = ([a * x for a, x in zip(row, vector, strict=True) if a and x] for row in rows)
    return [sum(parts, Fraction(0)) for parts in terms]


class Field:
    """ℚ(θ), with θ the root of the modulus in an interval."""

    def __init__(self, data):
        self.modulus = [rational(a) for a in data["modulus"]]
        self.degree = len(self.modulus) - 1
        limit(self.degree, MOST_DEGREE, "as degree of the field")
        self.low, self.high = map(rational, data["theta_between"])
        slope = [k * a for k, a in enumerate(self.modulus)][1:]
        ends = [bounds(self.modulus, x, x)[0] for x in (self.low, self.high)]
        demand(self.modulus[-1] == 1, "the modulus of the field is not monic")
        is_one = ends[0] * ends[1] < 0 < prod(bounds(slope, self.low, self.high))
        demand(is_one, "not one root of the modulus in the interval of theta")

    def number(self, data):
        given = data if isinstance(data, list) else [data]
        demand(len(given) in (1, self.degree), "a number of another field")
        return [rational(x) for x in given] + [Fraction(0)] * (self.degree - len(given))

    def times(self, number):
        """The map x → number · x."""
        shifted = [[Fraction(0)] * k + number for k in range(self.degree)]
        return list(zip(*(reduced(column, self.modulus) for column in shifted), strict=True))

    def matrix(self, data):
        rows = [zip(*(self.times(self.number(x)) for x in row), strict=True) for row in data]
        return [list(chain(*parts)) for row in rows for parts in row]


class Form:
    """centre + Σ_k slopes_k ε_k + ρ for all |ε_k| ≤ 1, where |ρ| ≤ rest."""

    def __init__(self, centre, slopes=None, rest=Fraction(0)):
        self.centre, self.slopes, self.rest = Fraction(centre), slopes or {}, rest
        self.reach = rest + sum(map(abs, self.slopes.values()))

    def joined(self, a, other, b, centre, rest):
        """A form with the slopes of a · self + b · other."""
        slopes = {k: a * x for k, x in self.slopes.items()}
        for k, x in other.slopes.items():
            slopes[k] = slopes.get(k, 0) + b * x
        return Form(centre, slopes, rest)

    def __add__(self, other):
        other = form(other)
        return self.joined(1, other, 1, self.centre + other.centre, self.rest + other.rest)

    def __mul__(self, other):
        other = form(other)
        a, b = self.centre, other.centre
        rest = abs(a) * other.rest + abs(b) * self.rest + self.reach * other.reach
        return self.joined(b, other, a, a * b, rest)

    __radd__, __rmul__ = __add__, __mul__

    def __sub__(self, other):
        return self + -1 * form(other)

    def inverse(self):
        """1/x = 1/c − (x − c)/c² + (x − c)²/(c² x)."""
        c, least = self.centre, abs(self.centre) - self.reach
        demand(least > 0, "a division by what may be zero")
        slopes = {k: -x / c**2 for k, x in self.slopes.items()}
        return Form(1 / c, slopes, (self.rest + self.reach**2 / least) / c**2)


def form(x):
    return x if isinstance(x, Form) else Form(x)


class Printed(Field):
    """ℚ where k is printed number k, of a centre and a width, and [sign, x, y] is made of two."""

    def __init__(self, numbers):
        super().__init__({"modulus": ["0", "1"], "theta_between": ["-1", "1"]})
        self.forms = [Form(x, {k: width} if width else {}) for k, (x, width) in enumerate(numbers)]

    def number(self, data):
        return [self.value(data)]

    def value(self, data):
        if isinstance(data, str):
            return rational(data)
        if isinstance(data, int):
            demand(0 < data <= len(self.forms), "a number that is not printed")
            return self.forms[data - 1]
        sign, x, y = data[0], *map(self.value, data[1:])
        demand(sign in {"+", "-", "*", "/"}, "a sign that is none")
        if sign in "+-":
            return form(x) + y if sign == "+" else form(x) - y
        return form(x) * (y if sign == "*" else form(y).inverse())


class Space:
    """The algebra of the stage values of a colour."""

    def __init__(self, field, data):
        self.field, self.stages = field, data["stages"]
        limit(self.stages, MOST_VALUES, "stages")
        self.size = self.stages * field.degree
        self.modulus = [rational(a) for a in data.get("modulus", [])]
        self.places = range(0, self.size, field.degree)
        self.one = self.unit(self.places[:1] if self.modulus else self.places)
        if self.modulus:
            points = [rational(x) for x in data["between_nodes"]]
            values = (bounds(self.modulus, x, x)[0] for x in points)
            changes = sum(a * b < 0 for a, b in pairwise((x > 0) - (x < 0) for x in values))
            demand(points == sorted(points) and self.modulus[-1] == 1, "nodes without an order")
            demand(changes == self.stages == len(self.modulus) - 1, "nodes not real and distinct")

    def unit(self, places):
        return [Fraction(i in places) for i in range(self.size)]

    def product(self, u, v):
        """In ℚ[θ] stage by stage, or in ℚ[x, θ], a row a stage or a power of x; then reduced."""
        d = self.field.degree
        rows = [[Fraction(0)] * (2 * d - 1) for _ in range(2 * self.stages - 1)]
        for i, x in enumerate(u):
            stage = i // d
            seen = range(self.size) if self.modulus else range(stage * d, (stage + 1) * d)
            for j in seen if x else ():
                row = stage + j // d if self.modulus else stage
                rows[row][i % d + j % d] += x * v[j]
        rows = [reduced(row, self.field.modulus) for row in rows]
        if self.modulus:
            columns = zip(*rows, strict=True)
            rows = zip(*(reduced(column, self.modulus) for column in columns), strict=True)
        return list(chain(*rows))[: self.size]


class Hull:
    """The span of rows (1, vector), or (0, vector), in echelon form, by their pivots."""

    def __init__(self):
        self.rows = {}

    def rest(self, row):
        for pivot, known in self.rows.items():
            factor = row[pivot]
            if factor:
                row = [a - factor * b if b else a for a, b in zip(row, known, strict=True)]
        return row

    def insert(self, row):
        row = self.rest(row)
        pivot = next((i for i, a in enumerate(row) if a), None)
        if pivot is not None:
            self.rows[pivot] = [a / row[pivot] for a in row]

    def holds(self, row):
        return len(self.rows) == len(row) or not any(self.rest(row))


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


def ordered(tree):
    """The tree with its branches in order, so that equal ones are equal."""
    return tree[0], tuple(sorted(map(ordered, tree[1])))


def forests(trees, size):
    """All branches of a size together, of trees with their sizes, the largest first."""
    if not size:
        yield ()
    for i, (n, tree) in enumerate(trees):
        if n <= size:
            yield from ((tree, *rest) for rest in forests(trees[i:], size - n))


def words(kind):
    branches = " or ".join(("no", "one", "several")[n] for n in sorted(kind[0]))
    return f"{branches}, {kind[1]}, {'in' if kind[2] else 'not in'} the solution"


class Tableau:
    """By colours: what they drive, kinds of vertices, spaces, weights; A^{l,m} where m is seen.
    A kind is (numbers of branches, 2 for more; orders that it counts; whether it is exact).
    """

    def __init__(self, field, drives, kinds, spaces, weights, blocks):
        self.field, self.drives, self.kinds = field, drives, kinds
        self.spaces, self.b, self.blocks, self.known = spaces, weights, blocks, {}
        self.colours = range(len(drives))

    def order_of(self, tree):
        return self.kinds[tree[0]][1] + sum(map(self.order_of, tree[1]))

    def factor(self, tree):
        """Its order, as often as the root counts, each time one less."""
        return perm(self.order_of(tree), self.kinds[tree[0]][1])

    def density(self, tree):
        return self.factor(tree) * prod(map(self.density, tree[1]))

    def exact(self, tree):
        """1, or 0 where the exact solution has no such tree."""
        return self.kinds[tree[0]][2] * prod(map(self.exact, tree[1]))

    def branch(self, l, tree):
        """What a branch adds to a vertex of colour l: A ρ ψ."""
        demand((l, tree[0]) in self.blocks, "a tree that the coupling graph does not have")
        return apply(self.blocks[l, tree[0]], [self.factor(tree) * x for x in self.psi(tree)])

    def psi(self, tree):
        if tree not in self.known:
            l, branches = tree
            is_one = min(len(branches), 2) in self.kinds[l][0]
            demand(is_one, "a vertex with branches that its colour does not have")
            vector = self.spaces[l].one
            for branch in branches:
                vector = self.spaces[l].product(vector, self.branch(l, branch))
            self.known[tree] = vector
        return self.known[tree]

    def defect(self, tree):
        """b·ψ − 1/ρ, which is 0 where the order condition holds."""
        first, *others = apply(self.b[tree[0]], self.psi(tree))
        return [first - Fraction(self.exact(tree), self.factor(tree)), *others]

    def assumed(self):
        """Colours that are linear, or free of what others drive, by words or for want of blocks."""
        found = {"linear": [l for l in self.colours if self.kinds[l] == LINEAR]}
        for m in self.colours:
            blind = [l for l in self.colours if (l, m) not in self.blocks]
            found[f"free of what {m + 1} drives"] = blind
        shown = [f"{x}: {', '.join(str(l + 1) for l in found[x])}" for x in found if found[x]]
        fields = f", where the vector field is {'; '.join(shown)}" if shown else ""
        own = [f"{l + 1}: {words(kind)}" for l, kind in enumerate(self.kinds)]
        is_plain = {*self.kinds} <= {FIELD, LINEAR}
        return fields if is_plain else f"{fields}; branches, orders: {'; '.join(own)}"

    def prove(self, data):
        """Points 1, 2, 3. Returns the number of spanning trees."""
        listed = []
        for k, by_colour in enumerate(data["spanning"], start=1):
            demand(len(by_colour) == len(self.colours), "no trees for some colours")
            listed.append([[read_tree(text) for text in trees] for trees in by_colour])
            for l, trees in enumerate(listed[-1]):
                for tree in trees:
                    demand(tree[0] == l and self.order_of(tree) == k, "a tree in the wrong place")
                    demand(not any(self.defect(tree)), f"a condition of order {k} fails")
                self.check_span(l, k, listed)
        demand(len(listed) == data["order"], "spanning trees of another order")
        if data["witness"]:
            self.check_witness(data["witness"], data["order"] + 1)
        return sum(len(trees) for by_colour in listed for trees in by_colour)

    def check_span(self, l, k, listed):
        """The hull of order k holds all products of listed branches and forests."""
        space, hull = self.spaces[l], Hull()
        arity, weight, is_exact = self.kinds[l]
        for tree in listed[k - 1][l]:
            hull.insert([Fraction(self.exact(tree)), *self.psi(tree)])
        if k == weight and 0 in arity:
            demand(hull.holds([is_exact, *space.one]), "the tree of one vertex is missing")
        seen = [m for m in self.colours if (l, m) in self.blocks]

        def branches(j):
            trees = (x for m in seen for x in listed[j - 1][m])
            return [(self.exact(x), self.branch(l, x)) for x in trees]

        for rest in range(k - weight):
            rests, j = [(1, space.one)], k - weight - rest
            if rest:  # several branches, of which the smallest has half the order at most
                rests = [(self.exact(x), self.psi(x)) for x in listed[weight + rest - 1][l]]
                rests += [] if 1 in arity else branches(rest)
            if (2 if rest else 1) in arity and (not rest or j <= rest):
                for (one, image), (other, vector) in product(branches(j), rests):
                    row = [Fraction(one * other * is_exact), *space.product(image, vector)]
                    inside = hull.holds(row)
                    demand(inside, f"the listed trees of order {k}, colour {l + 1}, do not span")

    def all_trees(self, order):
        """All trees up to an order that have a condition."""
        known = []
        for n in range(1, order + 1):
            smaller = known[::-1]
            for l in self.colours:
                arity, weight, _ = self.kinds[l]
                seen = [x for x in smaller if (l, x[1][0]) in self.blocks]
                if 2 not in arity:
                    seen = [x for x in seen if x[0] == n - weight]
                for branches in forests(seen, n - weight) if n >= weight else ():
                    if min(len(branches), 2) in arity:
                        known.append((n, ordered((l, branches))))
                        limit(len(known), MOST_TREES, "trees")
        return [tree for _, tree in known]

    def check_witness(self, data, k):
        tree = read_tree(data["tree"])
        demand(self.order_of(tree) == k, "the witness has another order")
        least, most = bounds(self.defect(tree), self.field.low, self.field.high)
        demand(least > 0 or most < 0, "the witness does not fail")
        scale = Fraction(self.factor(tree), self.density(tree))
        weight = [x * scale for x in apply(self.b[tree[0]], self.psi(tree))]
        demand(self.field.number(data["value"]) == weight, "the witness has another value")
        required = Fraction(self.exact(tree), self.density(tree))
        demand(rational(data["required"]) == required, "it requires another one")

    def pairs(self):
        """The colours l, m that the symplectic form pairs; it has a word on every block."""
        both = [(l, m) for l in self.colours for m in self.colours]
        found = [(l, m) for l, m in both if {self.drives[l], self.drives[m]} in ({"q", "p"}, {"y"})]
        known = {(self.spaces[l], m) for l, m in found}
        demand({(self.spaces[l], m) for l, m in self.blocks} <= known, "a block of no pair")
        return found


def read_kind(colour):
    """What the vertices of a colour are like."""
    own = colour.get("vertices")
    if own is None:
        return LINEAR if colour["linear"] else FIELD
    arity, weight = frozenset(own["branches"]), own["weight"]
    demand(arity <= {0, 1, 2} and weight in range(1, 10), "vertices of no kind")
    return arity, weight, bool(own["in_solution"])


def read_tableau(field, data):
    colours, spaces, degree = data["colours"], data["spaces"], field.degree
    limit(len(colours), MOST_COLOURS, "colours")
    limit(sum(x["stages"] for x in spaces) * degree, MOST_VALUES, "numbers of a stage value")
    matrices = chain.from_iterable(x["A"] for x in data["blocks"]), (c["b"] for c in colours)
    limit(sum(map(len, chain(*matrices))) * degree**2, MOST_NUMBERS, "numbers of matrices")
    spaces = [Space(field, x) for x in spaces]
    drives, kinds = [c["drives"] for c in colours], list(map(read_kind, colours))
    places = [c["space"] - 1 for c in colours]
    demand(set(drives) in ({"y"}, {"q", "p"}), "colours drive nothing")
    demand(set(places) <= set(range(len(spaces))), "a colour without a stage space")
    of_colours, weights = [spaces[k] for k in places], [field.matrix([c["b"]]) for c in colours]
    blocks = {}
    for block in data["blocks"]:
        k, m = block["space"] - 1, block["colour"] - 1
        rows, places_of_k = field.matrix(block["A"]), [l for l, x in enumerate(places) if x == k]
        is_new = m in range(len(colours)) and not any((l, m) in blocks for l in places_of_k)
        demand(is_new and places_of_k, "a block in no place of its own")
        shape = len(rows), {len(row) for row in rows}
        demand(shape == (spaces[k].size, {of_colours[m].size}), "a block misfits")
        blocks |= {(l, m): rows for l in places_of_k}
    return Tableau(field, drives, kinds, of_colours, weights, blocks)


def check_conjugate(method, other):
    """Whether b_l(f · Â g) + b_m(A f · g) = b_l(f) b_m(g) for all stage values f, g."""
    demand((method.drives, method.kinds) == (other.drives, other.kinds), "other colours")
    for l, m in method.pairs() + other.pairs():
        here, there = method.spaces[l], method.spaces[m]
        is_same = (here.modulus, method.b[l]) == (other.spaces[l].modulus, other.b[l])
        demand(is_same, "the conjugate has other weights or nodes")
        forth, back = other.blocks.get((l, m)), method.blocks.get((m, l))
        demand((forth is None) == (back is None), "the conjugate has other blocks")
        for f in map(here.unit, zip(here.places)) if forth else ():
            weight = method.field.times(apply(method.b[l], f))
            for g in map(there.unit, zip(there.places)):
                one = apply(method.b[l], here.product(f, apply(forth, g)))
                two = apply(method.b[m], there.product(apply(back, f), g))
                both = [x + y for x, y in zip(one, two, strict=True)]
                holds = both == apply(weight, apply(method.b[m], g))
                demand(holds, f"the block {l + 1},{m + 1} of the conjugate is another one")


def pair_of(method, conjugate):
    """A colour of ẏ drives positions, and as one more colour momenta."""
    halves = "qp" if method.drives[0] == "y" else [""]
    colours = [(half or method.drives[l], l) for half in halves for l in method.colours]
    blocks = {}
    for i, (_, l) in enumerate(colours):
        for j, (driven, m) in enumerate(colours):
            given = method.blocks if driven == "q" else conjugate.blocks
            if (l, m) in given:
                blocks[i, j] = given[l, m]
    for l, m in method.pairs() if halves == [""] else ():
        is_one = method.spaces[l] is method.spaces[m]
        demand(not is_one or method.b[l] == method.b[m], "two weights at one stage")
    parts = ([part[l] for _, l in colours] for part in (method.kinds, method.spaces, method.b))
    return Tableau(method.field, [driven for driven, _ in colours], *parts, blocks)


def prove_existence(data):
    """Points 1, 2, 3 of rounded numbers. Returns what is proved."""
    text, method, order = json.dumps(data), data["method"], data["method"]["order"]
    listed = len(method["conditions"]) + len(method["witness"] or ())
    entries = sum(len(row) for x in method["blocks"] for row in x["A"])
    limit(len(text), MOST_BYTES_ROUNDED, "bytes")
    limit(max(map(len, re.findall("[0-9]+", text))), MOST_DIGITS, "digits of a number")
    limit(order, MOST_ORDER, "as order")
    limit(listed, MOST_TREES, "trees")
    limit(listed * (listed + entries) * len(data["numbers"]), MOST_STEPS, "steps")
    given = [[rational(x[key]) for key in PRINTED] for x in data["numbers"]]
    for printed, radius, centre, width in given:
        inside = 0 <= width <= radius - abs(centre - printed)
        demand(inside, "the method that is proved to exist is not within the radii")
    here = read_tableau(Printed([x[2:] for x in given]), method)
    trees = [ordered(read_tree(x["tree"])) for x in method["conditions"]]
    W = [[rational(a) for a in x["W"]] for x in method["conditions"]]
    demand({len(column) for column in W} == {len(given)}, "W misfits")
    inside = all(sum(map(abs, row)) <= 1 for row in zip(*W, strict=True))
    demand(inside, "W leaves the box around the method")
    # colours with the same stages and weights have the same conditions
    colours = zip(method["colours"], here.kinds, strict=True)
    parts = [(x["space"], kind, x["b"]) for x, kind in colours]
    needed = (x for x in here.all_trees(order) if parts.index(parts[x[0]]) == x[0])
    demand(set(needed) <= set(trees), "a condition is left out")
    for i, tree in enumerate(trees):
        row = form(here.defect(tree)[0])
        image = [abs(sum(a * column[k] for k, a in row.slopes.items())) for column in W]
        most = abs(row.centre) + row.rest + sum(image) - image[i]
        demand(most <= image[i], f"a condition of order {here.order_of(tree)} may fail")
    proved = f"order {order} of one within the radii, proved by {len(trees)} trees"
    if method["witness"]:
        there, missed = read_tableau(Printed([x[:2] for x in given]), method), Form(0)
        for x in method["witness"]:
            tree = read_tree(x["tree"])
            demand(there.order_of(tree) <= order + 1, "the witness has another order")
            missed += rational(x["factor"]) * form(there.defect(tree)[0])
        demand(abs(missed.centre) > missed.reach, "the witness may vanish")
        proved += f"; order {order + 1} of none"
    return proved + here.assumed()


def referee(path):
    with open(path, encoding="utf-8") as file:
        text = file.read(MOST_BYTES + 1)
    limit(len(text), MOST_BYTES, "bytes")
    data = json.loads(text)
    demand(data["schema"] == "gark/certificate/1", "another kind of file")
    print(f"{path}: {''.join(c if c.isprintable() else '?' for c in data['name'])}")
    demand("method" in data, "there is no method in it")
    if "numbers" in data:
        print(f"  method: {prove_existence(data)}")
        return
    field = Field(data["field"] or {"modulus": ["0", "1"], "theta_between": ["-1", "1"]})
    method = tableau = read_tableau(field, data["method"])
    for name in [name for name in ("method", "conjugate", "pair") if name in data]:
        if name == "conjugate":
            tableau = conjugate = read_tableau(field, data[name])
            check_conjugate(method, conjugate)
        if name == "pair":
            demand("conjugate" in data, "a pair without the conjugate that it is made of")
            tableau = pair_of(method, conjugate)
        where, count = tableau.assumed(), tableau.prove(data[name])
        least = "" if data[name]["witness"] else "at least "
        print(f"  {name}: order {least}{data[name]['order']}, proved by {count} trees{where}")


def main(paths):
    code = 0 if paths else 2
    print(end="" if paths else __doc__)
    for path in paths:
        try:
            referee(path)
        except NotProved as error:
            print(f"{path}: not proved: {error}")
            code = max(code, 1)
        except Exception as error:
            print(f"{path}: no proof can be read: {error!a}")
            code = 2
    return code


if __name__ == "__main__":
    sys.stdout.reconfigure(errors="backslashreplace")
    sys.exit(main(sys.argv[1:]))
