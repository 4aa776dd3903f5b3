"""The result for one file: its analysis, its verified claims, or its faults."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

from garkcli.check.analysis import Analysis
from garkcli.check.claims import Claim
from garkcli.check.pair_reasons import rule_reasons
from garkcli.errors import Remark, counted, printable
from garkcli.frozen import Frozen
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.check.every_value import EveryValue
    from garkcli.check.nystrom import NystromAnalysis
    from garkcli.check.rare_kinds import DerivativesAnalysis, InfinitesimalAnalysis, NprkAnalysis
    from garkcli.check.remark import RoundingHint
    from garkcli.check.rosenbrock import RosenbrockAnalysis
    from garkcli.methodfile.description import BlockRule
    from garkcli.order.blame import Blame
    from garkcli.order.constants import ErrorConstants
    from garkcli.order.suspects import SuspectedNumber

    OtherAnalysis: TypeAlias = (
        RosenbrockAnalysis
        | NystromAnalysis
        | NprkAnalysis
        | DerivativesAnalysis
        | InfinitesimalAnalysis
    )


class Outcome(Shown, Frozen):
    """The result of checking one file.

    Attributes:
        file: its path as given, or ``<stdin>``.
        name: the name in the file, or its path.
        structure: the structure of the vector fields.
        analysis: None if the file cannot be read as a method.
        claims: every claim of the file.
        faults: why the file cannot be read; empty if it can.
        text: of the file, for showing lines of it.
        blame: the likely cause of an order below its claim, or None.
        remark: the remark on its digits, or None.
        misprints: numbers of a method of another kind of which one seems wrong.
        constants: the error constants at the first failing order, if wanted.
        needs_claims: whether a file without claims fails.
        needed: the required claims.
        is_crash: whether the program failed, not the file; ``faults`` say how.
        wants_properties: whether to show all properties.
        every: the facts about a file with free parameters, in place of an analysis.
        rosenbrock: the analysis of a Rosenbrock method.
        nystrom: the analysis of a Nyström method.
        nprk: the analysis of a nonlinearly partitioned method.
        derivatives: the analysis of a multiderivative method.
        infinitesimal: the analysis of a multirate method with exact fast solutions.
        left_behind: further weights of the underlying methods that it lacks.
        rules: the rules of blocks between diagonal methods.

    >>> from garkcli import check_file
    >>> outcome = check_file("rk4")
    >>> outcome.ok, [(x.claim, x.holds) for x in outcome.claims]
    (True, [('order', True), ('symplectic', True)])
    """

    file: str
    name: str
    structure: str = "general"
    analysis: Analysis | None = None
    claims: tuple[Claim, ...] = ()
    faults: tuple[Remark, ...] = ()
    text: str = ""
    blame: Blame | None = None
    remark: RoundingHint | None = None
    misprints: tuple[SuspectedNumber, ...] = ()
    constants: ErrorConstants | None = None
    is_crash: bool = False
    needs_claims: bool = False
    needed: tuple[str, ...] = ()
    wants_properties: bool = False
    every: EveryValue | None = None
    rosenbrock: RosenbrockAnalysis | None = None
    nystrom: NystromAnalysis | None = None
    nprk: NprkAnalysis | None = None
    derivatives: DerivativesAnalysis | None = None
    infinitesimal: InfinitesimalAnalysis | None = None
    left_behind: tuple[str, ...] = ()
    rules: tuple[BlockRule, ...] = ()

    @property
    def of_other_kind(self) -> OtherAnalysis | None:
        """The analysis of a method that is not a GARK method, or None."""
        analysis = self.rosenbrock or self.nystrom or self.nprk
        return analysis or self.derivatives or self.infinitesimal

    @property
    def found(self) -> Analysis | EveryValue | OtherAnalysis | None:
        """The analysis of the method, or the facts for all values of its parameters."""
        return self.analysis or self.every or self.of_other_kind

    @cached_property
    def about_rules(self) -> tuple[str, ...]:
        """Whether the rules of blocks preserve the order of the pair, each as a sentence."""
        if self.analysis is None or not self.rules:
            return ()
        return tuple(rule_reasons(self.analysis, self.rules))

    @property
    def failed_claims(self) -> tuple[Claim, ...]:
        """The claims that do not hold."""
        return tuple(claim for claim in self.claims if claim.holds is False)

    @property
    def undecided_claims(self) -> tuple[Claim, ...]:
        """The claims that neither hold nor fail."""
        return tuple(claim for claim in self.claims if claim.holds is None)

    @property
    def is_open(self) -> bool:
        """Whether no claim fails and one is undecided."""
        return self.is_read and self.exit_code == 3

    @property
    def is_read(self) -> bool:
        """Whether the file could be read, as a method or as a family."""
        return self.found is not None

    @property
    def makes_no_claim(self) -> bool:
        """Whether the file is a method without claims."""
        return self.is_read and not self.claims

    @property
    def lacks(self) -> tuple[str, ...]:
        """The claims that are required and missing, each as a remark."""
        if not self.is_read:
            return ()
        if self.needs_claims and not self.claims:
            return ("the file makes no claim",)
        return tuple(f"the file does not claim {key}" for key in self.keys_lacking)

    @property
    def keys_lacking(self) -> tuple[str, ...]:
        """The required claims that the file does not make."""
        made = {claim.claim for claim in self.claims}
        return tuple(key for key in self.needed if key not in made)

    @property
    def ok(self) -> bool:
        """Whether the file is a method, all claims hold, and the required claims are there."""
        return self.exit_code == 0

    @property
    def exit_code(self) -> int:
        """0 if all claims hold, 1 if one fails, 2 for faults, 3 if undecided or crashed."""
        if not self.is_read:
            return 3 if self.is_crash else 2
        if self.lacks or self.failed_claims:
            return 1
        return 3 if self.undecided_claims else 0

    def __repr__(self) -> str:
        said = counted(len(self.faults), "fault")
        if self.is_read:
            said = counted(len(self.claims), "claim")
        for claims, what in ((self.failed_claims, "failed"), (self.undecided_claims, "undecided")):
            if claims:
                said += f", {len(claims)} {what}"
        return f"<Outcome {printable(self.name)}: {said}>"
