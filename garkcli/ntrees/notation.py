"""Reads and writes trees in bracket notation, and their order conditions in text and LaTeX.

A tree is its branches in brackets, larger ones first, then its root's colour: ``[[]_2,[]_2]_1``.
Text counts colours from 1, code from 0; this module converts.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from garkcli.errors import TreeError
from garkcli.ntrees.tree import Tree

MAX_LENGTH = 20_000
MAX_VERTICES = 1000
"""Most vertices of a text; σ and γ have less than the 4300 digits that Python writes."""
MAX_DEPTH = 150
"""Vertices from the root to a leaf; keeps recursion far from Python's limit."""
MAX_COLOUR = 32_767
"""Columns of the tree table hold no larger colour."""

LETTERS = "lmnuvwxyzpqrst"
"""Names of the vertices of a shape, in the paper's order; beyond them primes are added."""

_BLANK = re.compile(r"\s*")
_DIGITS = re.compile(r"[0-9]*")


class NotationError(TreeError):
    """A text that is not a tree, with the cure ``help`` and the ``offset`` of the fault."""

    code = "no-such-tree"

    def __init__(self, message: str, help: str, offset: int, *, code: str = "") -> None:
        super().__init__(message, help, code=code)
        self.offset = offset

    def __str__(self) -> str:
        return f"{self.message} at character {self.offset + 1}; {self.help}"


def parse_tree(text: str) -> Tree:
    """Parses bracket notation; blanks are free, and all colours may be omitted (all 1).

    Args:
        text: the branches of a vertex in brackets, then its colour, counted from 1.

    Raises:
        TreeError: no tree; the message and ``offset``, from 0, say where. A tree has at most 1000
            vertices, at most 150 of them on a path.

    >>> parse_tree("[[]_2, []_2]_1")
    <Tree [[]_2,[]_2]_1>
    >>> parse_tree("[[]]").order
    2
    """
    if len(text) > MAX_LENGTH:
        cure = f"write one of at most {MAX_LENGTH} characters"
        raise NotationError("the tree is too long", cure, MAX_LENGTH, code="too-many")
    return _Reader(text).read()


class _Reader:
    """Parses from left to right, with a stack of open brackets instead of recursion."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.position = 0
        self.vertices = 1
        self.coloured: bool | None = None  # settled by the first vertex closed

    def read(self) -> Tree:
        self._take("[", "a tree begins with '['", "write a tree as [[]_2,[]_2]_1")
        stack: list[list[Tree]] = [[]]  # for each open bracket the branches read so far
        while True:
            opens = self._next() == "["
            if opens and not stack[-1]:
                self._open(stack)
                continue
            cure = "branches are separated by commas and closed by ']'"
            self._take("]", "',' or ']' is missing", cure)
            branches = stack.pop()
            tree = Tree(self._colour(), branches)
            if not stack:
                break
            stack[-1].append(tree)
            if self._next() == ",":
                self.position += 1
                self._open(stack)
        if self.position < len(self.text):
            raise NotationError("text after the end of the tree", "give one tree", self.position)
        return tree

    def _open(self, stack: list[list[Tree]]) -> None:
        at = self.position
        self._take("[", "a branch is missing", "a branch is a tree, such as []_1")
        if len(stack) >= MAX_DEPTH:
            cure = f"at most {MAX_DEPTH} vertices may follow each other"
            raise NotationError("the tree is too deep", cure, at, code="too-many")
        self.vertices += 1
        if self.vertices > MAX_VERTICES:
            cure = f"at most {MAX_VERTICES} vertices are read"
            raise NotationError("the tree is too large", cure, at, code="too-many")
        stack.append([])

    def _next(self) -> str:
        blank = _BLANK.match(self.text, self.position)
        if blank:
            self.position = blank.end()
        start = self.position
        return self.text[start : start + 1]

    def _take(self, sign: str, message: str, cure: str) -> None:
        if self._next() != sign:
            raise NotationError(message, cure, self.position)
        self.position += 1

    def _colour(self) -> int:
        """The colour, from 0; 0 if colours are omitted."""
        start = self.position
        coloured = self._next() == "_"
        if self.coloured is None:
            self.coloured = coloured
        if coloured != self.coloured:
            message = "only some of the vertices have colours"
            cure = "give every vertex a colour, as []_1, or none"
            at = self.position if coloured else start
            raise NotationError(message, cure, at)
        if not coloured:
            return 0
        self.position += 1
        self._next()
        digits = _DIGITS.match(self.text, self.position)
        number = digits.group() if digits else ""
        if not number:
            message = "a colour is missing after '_'"
            raise NotationError(message, "colours are numbers from 1", self.position)
        # the length comes first: Python reads no integer of many thousands of digits
        is_short = len(number) <= len(str(MAX_COLOUR))
        if not is_short or not 1 <= int(number) <= MAX_COLOUR:
            cure = f"colours are numbers from 1 to {MAX_COLOUR}"
            raise NotationError("no such colour", cure, self.position)
        self.position += len(number)
        self._next()
        return int(number) - 1


def written_order(tree: Tree) -> list[Tree]:
    return sorted(tree.branches, key=lambda u: -u.order)


def format_tree(tree: Tree, colours: bool | Sequence[str] = True) -> str:
    """The bracket text, which ``parse_tree`` reads; names of colours replace their numbers."""
    inside = ",".join([format_tree(u, colours) for u in written_order(tree)])
    return f"[{inside}]_{_name(tree, colours)}" if colours else f"[{inside}]"


def shortest(tree: Tree) -> str:
    """The bracket text, without colours if all are the first."""
    return format_tree(tree, colours=bool(tree.colours - {0}))


def format_latex(tree: Tree, colours: bool | Sequence[str] = True) -> str:
    r"""The paper's notation: τ^{[l]} for a single vertex of colour l, else [u_1, …, u_m]^{[l]}.

    >>> print(format_latex(Tree(0, [Tree(0), Tree(1)])))
    [\tau^{[1]},\tau^{[2]}]^{[1]}
    """
    branches = [format_latex(u, colours) for u in written_order(tree)]
    text = r"\tau"
    if branches:
        inside = ",".join(branches)
        text = f"[{inside}]"
    return f"{text}^{{[{_name(tree, colours)}]}}" if colours else text


def _name(tree: Tree, colours: bool | Sequence[str]) -> str:
    return str(tree.root + 1) if isinstance(colours, bool) else colours[tree.root]


def vertex_letters(tree: Tree) -> tuple[str, ...]:
    """A letter for each vertex, the root first, in the paper's order l, m, n, u, v, w, …

    >>> vertex_letters(Tree(0, [Tree(0), Tree(0)]))
    ('l', 'm', 'n')
    """
    letters = []
    for i in range(tree.order):
        primes, which = divmod(i, len(LETTERS))
        letters.append(LETTERS[which] + "'" * primes)
    return tuple(letters)


def condition_text(tree: Tree, letters: Sequence[str] | None = None, colours: bool = True) -> str:
    """The order condition b^T 𝒜^[u] = 1/γ(u) of a tree (the paper's eq. bA) in plain text.

    ``letters`` name the vertices in the order of writing, the root first: the condition of a shape.

    >>> u = Tree(0, [Tree(1), Tree(0, [Tree(1)])])
    >>> condition_text(u)
    'b{1}ᵀ((A{1,1}A{1,2}𝟙) ⊙ (A{1,2}𝟙)) = 1/8'
    >>> condition_text(u, colours=False)
    'bᵀ((AA𝟙) ⊙ (A𝟙)) = 1/8'
    >>> condition_text(u, vertex_letters(u))
    'b{l}ᵀ((A{l,m}A{m,n}𝟙) ⊙ (A{l,u}𝟙)) = 1/8'
    """
    root, weight = _Formula("A{%s,%s}" if colours else "A", "𝟙", " ⊙ ", letters).of(tree)
    density = tree.density
    required = "1" if density == 1 else f"1/{density}"
    return f"{f'b{{{root}}}' if colours else 'b'}ᵀ{weight} = {required}"


def condition_latex(tree: Tree, letters: Sequence[str] | None = None, colours: bool = True) -> str:
    r"""The order condition of a tree as in the paper's Table 1; ``\mathbbm`` is of package bbm.

    >>> print(condition_latex(Tree(0, [Tree(1)])))
    {b^{\{1\}}}^T A^{\{1,2\}} \mathbbm{1}^{\{2\}} = \frac12
    >>> print(condition_latex(Tree(0, [Tree(0)]), colours=False))
    b^T A \mathbbm{1} = \frac12
    """
    block, one = (r"A^{\{%s,%s\}} ", r"\mathbbm{1}^{\{%s\}}") if colours else ("A ", r"\mathbbm{1}")
    root, weight = _Formula(block, one, r" \odot ", letters).of(tree)
    required = _latex_inverse(tree.density)
    weights = rf"{{b^{{\{{{root}\}}}}}}^T" if colours else "b^T"
    return f"{weights} {weight} = {required}"


def _latex_inverse(density: int) -> str:
    if density == 1:
        return "1"
    if density < 10:
        return rf"\frac1{density}"
    return rf"\frac1{{{density}}}"


class _Formula:
    """Writes 𝒜^[u], eqs. (Ataul) and (Au), with the given signs."""

    def __init__(self, block: str, one: str, times: str, letters: Sequence[str] | None) -> None:
        self.block = block
        self.one = one
        self.times = times
        self.names: Iterator[str] | None = None
        if letters is not None:
            self.names = iter(letters)

    def of(self, tree: Tree) -> tuple[str, str]:
        """The name of the root, and 𝒜^[u]; ValueError for too few letters."""
        name = str(tree.root + 1)
        if self.names is not None:
            name = next(self.names, "")
        if not name:
            raise ValueError("each vertex needs a letter; vertex_letters gives one per vertex")
        if not tree.branches:
            one = self.one
            if "%" in one:
                one = one % name
            return name, one
        factors: list[str] = []
        for u in written_order(tree):
            below, vector = self.of(u)
            block = self.block % (name, below) if "%" in self.block else self.block
            factors.append(block + vector)
        if len(factors) == 1:
            return name, factors[0]
        product = self.times.join([f"({factor})" for factor in factors])
        return name, f"({product})"
