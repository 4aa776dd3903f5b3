"""The facts about a file with free parameters for all their values, and its claims."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any

from garkcli.check.claims import Claim, agrees, capped, claim_of, claimed_text
from garkcli.check.every_facts import FamilyFact, fact_reason, find
from garkcli.check.every_family import EveryFamily, every_family
from garkcli.check.every_orders import EveryOrder, every_order
from garkcli.check.every_properties import find_property
from garkcli.design.ideal import Ideal
from garkcli.errors import ZeroWeight
from garkcli.exact.parametric import Parametric
from garkcli.frozen import Frozen, field, replace
from garkcli.methodfile.description import ClaimText
from garkcli.methodfile.expectations import OF_ORDERS, AtLeast
from garkcli.methodfile.family import FamilyFile, loads_family
from garkcli.order.simplifying import inconsistent_blocks, is_symplectic, simplifying
from garkcli.properties.registry import KEYS
from garkcli.reason import NO_REASON, Reason
from garkcli.tableau.conjugate import symplectic_defects
from garkcli.tableau.embedded import as_colours, with_weights
from garkcli.tableau.forms import pair, with_time
from garkcli.tableau.tableau import Tableau

TOLD = ("stiffly-accurate", "fsal", "symmetric")
"""Properties that are reported if they hold for all values."""


class EveryValue(Frozen):
    """The facts about a family for all parameters; ``inconsistent`` is as in ``Analysis``."""

    file: FamilyFile
    family: EveryFamily
    limit: int
    order: EveryOrder
    conjugate_order: EveryOrder | None
    pair_order: EveryOrder | None
    obstacle: Reason
    inconsistent: FamilyFact
    symplectic: FamilyFact
    embedded_order: EveryOrder | None = None
    _known: dict[str, FamilyFact] = field(default_factory=dict)

    def __reduce__(self) -> tuple[object, ...]:
        # polynomials of python-flint do not go between processes; files do
        file = self.file
        return _again, (file.text, file.source, dict(file.settings), self.limit)

    @property
    def parameters(self) -> tuple[str, ...]:
        return self.family.family.parameters

    @property
    def tableau(self) -> Tableau:
        return self.family.tableau

    @property
    def is_consistent(self) -> bool:
        """Whether the nodes are the row sums of all blocks, for all values."""
        return self.inconsistent.is_everywhere and not self.inconsistent.value

    @cached_property
    def nonautonomous_order(self) -> EveryOrder | None:
        """The order on problems ẏ = f(t, y); None if not applicable."""
        return self._with_time(self.order, self.file.tableau)

    @cached_property
    def embedded_nonautonomous_order(self) -> EveryOrder | None:
        rows = self.file.further.embedded
        if rows is None or self.embedded_order is None:
            return None
        return self._with_time(self.embedded_order, with_weights(self.file.tableau, rows))

    def _with_time(self, order: EveryOrder, tableau: Tableau) -> EveryOrder | None:
        timed = with_time(tableau)
        if timed is None or self.is_consistent:
            return None if timed is None else order
        return _order_with(self.file, timed, self.limit)

    @cached_property
    def _with_further(self) -> EveryFamily:
        """The family with a further colour for each row of embedded or dense weights."""
        if not self.file.further:
            return self.family
        whole = as_colours(self.file.tableau, self.file.further)
        return every_family(replace(self.file, tableau=whole))

    def verdict(self, key: str) -> FamilyFact:
        if key not in self._known:
            family = self._with_further if key == "reducible" else self.family
            self._known[key] = find_property(family, key, self.limit)
        return self._known[key]

    def simplifying(self, key: str) -> FamilyFact:
        """Returns B, C, D or a bound, after ``pair-`` of the pair; B involves no blocks."""
        if key not in self._known:
            limit, name = self.limit, key.removeprefix("pair-")
            letters = name if name in "BCD" else "BCD"

            def ask(tableau: Tableau) -> Any:
                of = tableau if name == key else pair(tableau)
                return getattr(simplifying(of, limit, letters), name.replace("-", "_"))

            self._known[key] = find(self.family, ask)
        return self._known[key]

    @property
    def holding(self) -> list[str]:
        facts = {key: self.verdict(key) for key in TOLD}
        return [key for key, fact in facts.items() if fact.is_everywhere and fact.value is True]


def every_value(file: FamilyFile, limit: int) -> EveryValue:
    """Returns the facts for all values; MethodError as of ``every_family``."""
    family = every_family(file)
    conjugate, both, obstacle = None, None, NO_REASON
    order = every_order(family, "method", limit)
    try:
        conjugate = every_order(family, "conjugate", limit)
        both = every_order(family, "pair", limit)
    except ZeroWeight as error:
        obstacle = error.reason
    rows = file.further.embedded
    embedded = None if rows is None else _order_with(file, with_weights(file.tableau, rows), limit)
    return EveryValue(
        file=file,
        family=family,
        limit=limit,
        order=order,
        conjugate_order=conjugate,
        pair_order=both,
        obstacle=obstacle,
        inconsistent=find(family, inconsistent_blocks),
        symplectic=_symplectic(family),
        embedded_order=embedded,
    )


def _order_with(file: FamilyFile, tableau: Tableau, limit: int) -> EveryOrder:
    return every_order(every_family(replace(file, tableau=tableau)), "method", limit)


def _again(text: str, source: str, settings: dict[str, str], limit: int) -> EveryValue:
    return every_value(loads_family(text, source, settings, is_design=False), limit)


def _symplectic(family: EveryFamily) -> FamilyFact:
    fact = find(family, is_symplectic)
    if fact.value is not False or not fact.open:
        return fact
    # what is zero where a method is symplectic
    numbers: list[object] = [*symplectic_defects(family.tableau)]
    if any(x and not isinstance(x, Parametric) for x in numbers):
        return FamilyFact(False)
    zeros = [x.numerator for x in numbers if isinstance(x, Parametric)]
    ideal = Ideal(family.ring, family.poles).with_zeros([*family.relations, *zeros])
    if ideal.is_everything:
        return FamilyFact(False)
    return FamilyFact(False, zeros=family.common_zeros(ideal.polynomials))


def verify_every(claims: Sequence[ClaimText], facts: EveryValue) -> tuple[Claim, ...]:
    return tuple(_held_against(claim, facts) for claim in claims)


def _held_against(claim: ClaimText, facts: EveryValue) -> Claim:
    fact = _fact(claim.key, facts)
    text = str(fact_reason(fact, next(iter(facts.parameters), ""), claimed_text))
    return claim_of(claim, text, _holds(claim, fact, facts.limit))


def _fact(key: str, facts: EveryValue) -> FamilyFact:
    if key in KEYS:
        return facts.verdict(key)
    if key in ("B", "C", "D") or key.endswith("bound"):
        return facts.simplifying(key)
    value: EveryOrder | FamilyFact | None = getattr(facts, key.replace("-", "_"))
    return value.fact if isinstance(value, EveryOrder) else value or FamilyFact(None)


def _holds(claim: ClaimText, fact: FamilyFact, limit: int) -> bool | None:
    wanted = claim.value
    if fact.is_undecided and not fact.differs:
        return None
    if fact.is_undecided or fact.where is not None:
        return False
    values = [fact.value, *(value for _, value in ((*fact.special, *fact.elsewhere)))]
    answers = [agrees(wanted, capped(value, limit)) for value in values]
    if False in answers:
        return False
    if None in answers or fact.unknown:
        return None
    if not fact.open and not fact.zeros:
        return True
    # where polynomials are zero more conditions hold, never less
    if claim.key in OF_ORDERS and _is_bound(wanted):
        return True
    return False if fact.zeros else None


def _is_bound(wanted: object) -> bool:
    if isinstance(wanted, list):
        return all(x is None or _is_bound(x) for x in wanted)
    return isinstance(wanted, AtLeast)
