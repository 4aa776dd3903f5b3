"""Everything that holds for every value of the free parameters of a file, and its claims."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

from garkcli.check.analysis import inconsistent_blocks
from garkcli.check.claims import agrees, capped, claim_of, claimed_text
from garkcli.check.every_facts import Fact, fact_reason, find
from garkcli.check.every_family import EveryFamily, every_family
from garkcli.check.every_orders import EveryOrder, every_order
from garkcli.check.every_properties import find_property
from garkcli.check.outcome import Claim, Outcome
from garkcli.design.ideal import Ideal
from garkcli.doing import doing
from garkcli.errors import Fault, GarkError, HasFreeParameters, MethodFileError, ZeroWeight
from garkcli.exact.parametric import Parametric
from garkcli.frozen import Frozen, field, replace
from garkcli.methodfile.description import ClaimText
from garkcli.methodfile.expectations import OF_ORDERS, AtLeast, highest_order
from garkcli.methodfile.family import FamilyFile, family_of, loads_family, refuse_rounded
from garkcli.order.simplifying import is_symplectic, simplifying
from garkcli.properties.registry import KEYS
from garkcli.reason import NO_REASON, Reason
from garkcli.tableau.conjugate import symplectic_defects
from garkcli.tableau.embedded import as_colours, with_weights
from garkcli.tableau.forms import pair, with_time
from garkcli.tableau.tableau import Tableau

TOLD = ("stiffly-accurate", "fsal", "symmetric")
"""Properties that are reported where they hold for every value."""


class EveryValue(Frozen):
    """What holds for every value.

    Attributes:
        file: as it was read.
        family: with what the file fixes put in.
        limit: where the searches for orders and for B, C and D stop.
        order: that of the method.
        conjugate_order: that of its symplectic conjugate; None where a weight is zero.
        pair_order: that of the symplectic pair; None likewise.
        obstacle: why there is no conjugate; empty where there is one.
        inconsistent: the blocks with A^{l,m} 𝟙 ≠ c^{l}, as (l, m) counted from 0.
        symplectic: whether it is its own conjugate.
        embedded_order: the order with the embedded weights in place of b; None for none.
    """

    file: FamilyFile
    family: EveryFamily
    limit: int
    order: EveryOrder
    conjugate_order: EveryOrder | None
    pair_order: EveryOrder | None
    obstacle: Reason
    inconsistent: Fact
    symplectic: Fact
    embedded_order: EveryOrder | None = None
    _known: dict[str, Fact] = field(default_factory=dict)

    def __reduce__(self) -> tuple[object, ...]:
        # polynomials of python-flint do not go between processes; files do
        file = self.file
        return _again, (file.text, file.source, dict(file.settings), self.limit)

    @property
    def parameters(self) -> tuple[str, ...]:
        """The names of the free parameters."""
        return self.family.family.parameters

    @property
    def tableau(self) -> Tableau:
        """The method, its entries rational functions."""
        return self.family.tableau

    @property
    def is_consistent(self) -> bool:
        """Whether the nodes are the row sums of all blocks, for every value."""
        return self.inconsistent.is_everywhere and not self.inconsistent.value

    @cached_property
    def nonautonomous_order(self) -> EveryOrder | None:
        """The order on problems ẏ = f(t, y); None where that has no meaning."""
        return self._with_time(self.order, self.file.tableau)

    @cached_property
    def embedded_nonautonomous_order(self) -> EveryOrder | None:
        """The same with the embedded weights in place of b; None where there are none."""
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
        """The family with a colour more for each row of embedded or dense weights."""
        if not self.file.further:
            return self.family
        whole = as_colours(self.file.tableau, self.file.further)
        return every_family(replace(self.file, tableau=whole))

    def verdict(self, key: str) -> Fact:
        """What is true of a property; each is decided once."""
        if key not in self._known:
            family = self._with_further if key == "reducible" else self.family
            self._known[key] = find_property(family, key, self.limit)
        return self._known[key]

    def simplifying(self, key: str) -> Fact:
        """B, C, D or a bound by them; ``pair-`` before it asks for that of the pair.

        Each is a question of its own: B asks nothing of blocks.
        """
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
        """The reported properties that hold for every value."""
        found = {key: self.verdict(key) for key in TOLD}
        return [key for key, fact in found.items() if fact.is_everywhere and fact.value is True]


def every_value(file: FamilyFile, limit: int) -> EveryValue:
    """Decide what holds for every value of the parameters of a file.

    Args:
        file: with free parameters; what it asks of them under ``design`` is not meant.
        limit: where the searches for orders and for B, C and D stop.

    Raises:
        MethodError: it is asked of the parameters what is no value of one of them, or a root
            depends on them.
    """
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
    """The order of another tableau in the same parameters."""
    return every_order(every_family(replace(file, tableau=tableau)), "method", limit)


def _again(text: str, source: str, settings: dict[str, str], limit: int) -> EveryValue:
    return every_value(loads_family(text, source, settings, is_design=False), limit)


def _symplectic(family: EveryFamily) -> Fact:
    """Whether every value makes a symplectic method; else the common zeros of which polynomials."""
    found = find(family, is_symplectic)
    if found.value is not False or not found.open:
        return found
    # what is zero where a method is symplectic
    numbers: list[object] = [*symplectic_defects(family.tableau)]
    if any(x and not isinstance(x, Parametric) for x in numbers):
        return Fact(False)
    zeros = [x.numerator for x in numbers if isinstance(x, Parametric)]
    ideal = Ideal(family.ring, family.poles).with_zeros([*family.relations, *zeros])
    if ideal.is_everything:
        return Fact(False)
    return Fact(False, zeros=family.common_zeros(ideal.polynomials))


MOST_PARAMETERS = 30
"""Free parameters of a file that is checked: with 27 it takes ten seconds, with 35 minutes."""


@doing("what holds for every value of the parameters")
def check_every(
    file: HasFreeParameters, limit: int, want_constants: bool, settings: Mapping[str, str]
) -> Outcome:
    """Check a file whose parameters are free.

    Args:
        file: with its text.
        limit: where the search for orders stops, unless a claim of the file reaches further.
        want_constants: whether error constants were requested, which need values.
        settings: values of other parameters.
    """
    try:
        family = family_of(file, settings)
        refuse_rounded(family)
        count = len(family.parameters)
        if count > MOST_PARAMETERS:
            message = f"{count} free parameters (limit {MOST_PARAMETERS})"
            cure = "give values to some by --set; gark design asks for one order"
            return _refused(file, message, cure, "too-many")
        of_dense = [x for x in family.claims if x.key.startswith("dense")]
        if of_dense:
            name = family.parameters[0]
            message = f"{of_dense[0].key} is claimed, and {name} is free"
            cure = f"dense output is judged for values: --set {name}=1/2"
            return _refused(file, message, cure, "free-parameters")
        found = every_value(family, max(limit, highest_order(family.claims) + 1))
    except MethodFileError as error:
        return Outcome(file.source, file.source, faults=error.faults, text=file.text)
    except GarkError as error:
        return _refused(file, error.message, error.help, error.code)
    if want_constants:
        name = found.parameters[0]
        message = "error constants are numbers, and a parameter is free"
        return _refused(file, message, f"choose a value: --set {name}=1/2", "free-parameters")
    return Outcome(
        file=family.source,
        name=family.name,
        structure=family.structure,
        every=found,
        claims=verify_every(family.claims, found),
        text=file.text,
        left_behind=family.left_behind,
    )


def _refused(file: HasFreeParameters, message: str, cure: str, code: str) -> Outcome:
    """What gark does not decide for every value."""
    faults = (Fault(message, cure, code=code),)
    return Outcome(file.source, file.source, faults=faults, text=file.text)


def verify_every(claims: Sequence[ClaimText], found: EveryValue) -> tuple[Claim, ...]:
    """Hold each claim against what is true for every value."""
    return tuple(_held_against(claim, found) for claim in claims)


def _held_against(claim: ClaimText, found: EveryValue) -> Claim:
    fact = _fact(claim.key, found)
    text = str(fact_reason(fact, next(iter(found.parameters), ""), claimed_text))
    return claim_of(claim, text, _holds(claim, fact, found.limit))


def _fact(key: str, found: EveryValue) -> Fact:
    """What is true of the subject of a claim."""
    if key in KEYS:
        return found.verdict(key)
    if key in ("B", "C", "D") or key.endswith("bound"):
        return found.simplifying(key)
    value: EveryOrder | Fact | None = getattr(found, key.replace("-", "_"))
    return value.fact if isinstance(value, EveryOrder) else value or Fact(None)


def _holds(claim: ClaimText, fact: Fact, limit: int) -> bool | None:
    """Whether a claim is true for every value; None where that is undecided."""
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
    """Whether a claim says no more than how large numbers are at least."""
    if isinstance(wanted, list):
        return all(x is None or _is_bound(x) for x in wanted)
    return isinstance(wanted, AtLeast)
