"""Letters for roots of degree 3 and more, each written out once in a text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from types import MappingProxyType

from garkcli.exact.nodes import AlgebraicRoot

DIAGONAL = "γ"
"""The letter of the entry on the diagonal of A."""
LETTERS: Mapping[str, str] = {
    "γ": r"\gamma ", "ξ": r"\xi ", "η": r"\eta ", "ζ": r"\zeta ", "κ": r"\kappa ", "μ": r"\mu ",
}  # fmt: skip
"""Letters with their commands in LaTeX; a further root is written out each time."""
NAMES: Mapping[str, str] = {letter: x.strip(" \\") for letter, x in LETTERS.items()}
"""Letters as names of parameters."""
NOTHING: Mapping[str, str] = MappingProxyType({})


class Letters:
    """The letters of one text, as its roots occur; ``of`` has those that have occurred."""

    def __init__(
        self,
        diagonal: AlgebraicRoot | None = None,
        written: Mapping[str, str] = NOTHING,
        taken: str = "",
    ) -> None:
        """``diagonal`` has the letter γ; ``taken`` are the letters that the text uses."""
        self.of: dict[AlgebraicRoot, str] = {}
        self._diagonal = None if DIAGONAL in taken else diagonal
        self._written = written
        self._free = [letter for letter in LETTERS if letter not in {*taken, DIAGONAL}]

    def letter(self, root: AlgebraicRoot, latex: bool = False) -> str | None:
        if root not in self.of:
            if root == self._diagonal:
                self.of[root] = DIAGONAL
            elif self._free:
                self.of[root] = self._free.pop(0)
            else:
                return None
        letter = self.of[root]
        return LETTERS[letter] if latex else self._written.get(letter, letter)


_letters: ContextVar[Letters | None] = ContextVar("letters", default=None)


@contextmanager
def lettered(letters: Letters | None) -> Iterator[None]:
    token = _letters.set(letters)
    try:
        yield
    finally:
        _letters.reset(token)


def letters_now() -> Letters | None:
    return _letters.get()


def letter_of(root: AlgebraicRoot, latex: bool = False) -> str | None:
    letters = _letters.get()
    return None if letters is None else letters.letter(root, latex)
