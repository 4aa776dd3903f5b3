"""The tolerance of each number of a file, by its place."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from flint import fmpq

from garkcli.errors import did_you_mean
from garkcli.exact.field import ZERO
from garkcli.exact.nodes import Expression
from garkcli.grammar.nodes import Node, shortened
from garkcli.methodfile import description as d
from garkcli.methodfile.numbers import Coefficient
from garkcli.methodfile.printed import fewest_digits, unit_of
from garkcli.methodfile.tolerance import DIGITS, OTHERS, Tolerance


class NumberTolerances:
    """Embedded weights and dense output have tolerances of their own, other numbers those of their
    colour, or else that of the others.
    """

    def __init__(
        self, tolerance: Tolerance, content: d.Content, entries: Sequence[Coefficient]
    ) -> None:
        self.tolerance = tolerance
        self.names = _names(content)
        self._kinds: dict[int, str] = {}
        self._keys: dict[int, str] = {}
        for kind, l, entry in content.places():
            self._kinds[id(entry)] = kind
            own = [kind, *self.names[l]] if l is not None else [kind]
            self._keys[id(entry)] = next((x for x in own if x in tolerance.offs), OTHERS)
        self._fewest = fewest_digits(x.expression for x in entries) if tolerance.is_of_digits else 0

    def kind_of(self, entry: Coefficient) -> str:
        """The kind of weights of an entry; empty for A, b and c."""
        return self._kinds.get(id(entry), "")

    def key_of(self, entry: Coefficient) -> str:
        return self._keys.get(id(entry), OTHERS)

    def radius(self, entry: Coefficient, part: Expression) -> fmpq:
        off = self.tolerance.offs.get(self.key_of(entry), ZERO)
        if isinstance(off, fmpq):
            return off
        return unit_of(part, self._fewest)

    def refusals(self, used: Iterable[str]) -> Iterator[tuple[Node | None, str, str, str]]:
        """The faults of keys: node, message, cure, kind; ``used`` keys apply to rounded numbers."""
        known = [OTHERS, *d.BESIDE, *(name for names in self.names for name in names)]
        for key, node in self.tolerance.places.items():
            if key not in known:
                message = f"tolerance: the method has no part {shortened(key)}"
                yield node, message, did_you_mean(key, known), "unknown-key"
            elif l := self._named_like(key):
                message = f"tolerance: {key} may mean colour {l}, whose method has this name"
                yield node, message, "give the method another name", "name-taken"
            elif key in self.tolerance.offs and key not in used:
                message = f"tolerance: {key} has no rounded number"
                yield node, message, "leave it out: short fractions and roots are exact", "empty"
        if self.tolerance.offs == {OTHERS: DIGITS} and OTHERS not in used:
            message = "tolerance: digits is about decimals, and the file has none"
            yield None, message, "leave it out, or write a number such as 1e-13", "empty"

    def _named_like(self, key: str) -> int | None:
        """The colour, counted from 1, whose name is a key with another meaning."""
        taken = {OTHERS, *d.BESIDE, *(x for names in self.names for x in names[:1])}
        named = (l for l, names in enumerate(self.names, start=1) if key in names[1:])
        return next((l for l in named if key in taken and key != str(l)), None)


def _names(content: d.Content) -> list[tuple[str, ...]]:
    """The number of each colour in the file, and its name if it has one."""
    names = content.names
    if names is None:
        return []
    numbered = enumerate(names, start=1)
    return [(str(l), name) if name else (str(l),) for l, name in numbered] if names else [()]
