"""What became of one file: the analysis, its claims held against the truth, or its faults."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from garkcli.check.analysis import Analysis
from garkcli.errors import Fault, counted, printable
from garkcli.frozen import Frozen
from garkcli.reason import NO_REASON, Reason
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.check.derivatives import DerivativesAnalysis
    from garkcli.check.every_value import EveryValue
    from garkcli.check.infinitesimal import InfinitesimalAnalysis
    from garkcli.check.nprk import NprkAnalysis
    from garkcli.check.nystrom import NystromAnalysis
    from garkcli.check.remark import Remark
    from garkcli.check.rosenbrock import RosenbrockAnalysis
    from garkcli.methodfile.description import BlockRule
    from garkcli.order.blame import Blame
    from garkcli.order.constants import ErrorConstants

    OtherAnalysis: TypeAlias = (
        RosenbrockAnalysis
        | NystromAnalysis
        | NprkAnalysis
        | DerivativesAnalysis
        | InfinitesimalAnalysis
    )


class Claim(Frozen):
    """A claim of ``expect`` held against the truth.

    Attributes:
        claim: its key in ``expect``.
        expected: what the file says, as text.
        found: what is true, as text.
        holds: whether they agree; None where that is undecided.
        line: the line of the claim in the file, from 1.
        column: its column, from 1.
        reason: of a property that is claimed in vain, what speaks against it.
    """

    claim: str
    expected: str
    found: str
    holds: bool | None
    line: int
    column: int
    reason: Reason = NO_REASON

    @property
    def why(self) -> str:
        """The reason as text."""
        return str(self.reason)


class Outcome(Shown, Frozen):
    """One checked file.

    Attributes:
        file: its path as given, or ``<stdin>``.
        name: the name it gives itself, or its path.
        structure: which vector fields the problem has.
        analysis: the truth; None where the file cannot be read as a method.
        claims: every claim of the file.
        faults: why it cannot be read; empty where it can.
        text: the file as read, for showing lines of it.
        blame: where the order falls short of a claim, what the failing conditions tell; None
            otherwise.
        remark: what the digits of the file say of its rounding; None where they say nothing more.
        constants: the error constants at the first failing order, if wanted.
        needs_claims: whether a file that makes no claim fails.
        needed: claims without which a file fails.
        is_crash: whether the program failed, not the file; ``faults`` say how.
        wants_properties: whether to show all properties.
        every: what holds for every value, of a file with free parameters; it has no analysis.
        rosenbrock: the truth about a Rosenbrock method; it has no analysis.
        nystrom: the truth about a Nyström method; likewise.
        nprk: the truth about a nonlinearly partitioned method; likewise.
        derivatives: the truth about a multiderivative method; likewise.
        infinitesimal: the truth about a multirate method with the exact fast solution; likewise.
        left_behind: further weights of the methods that it is made from, in words.
        rules: what made blocks between diagonal methods.
    """

    file: str
    name: str
    structure: str = "general"
    analysis: Analysis | None = None
    claims: tuple[Claim, ...] = ()
    faults: tuple[Fault, ...] = ()
    text: str = ""
    blame: Blame | None = None
    remark: Remark | None = None
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
        """The analysis of a method that is no GARK method; None of one that is, or of none."""
        found = self.rosenbrock or self.nystrom or self.nprk
        return found or self.derivatives or self.infinitesimal

    @property
    def found(self) -> Analysis | EveryValue | OtherAnalysis | None:
        """What is true of the method, or for every value of its parameters; None for neither."""
        return self.analysis or self.every or self.of_other_kind

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
        """Whether the file could be read, as a method or as a family of them."""
        return self.found is not None

    @property
    def makes_no_claim(self) -> bool:
        """Whether the file is a method and nothing is claimed of it."""
        return self.is_read and not self.claims

    @property
    def lacks(self) -> tuple[str, ...]:
        """What the file would have to claim and does not, a remark each."""
        if not self.is_read:
            return ()
        if self.needs_claims and not self.claims:
            return ("the file makes no claim",)
        made = {claim.claim for claim in self.claims}
        return tuple(f"the file does not claim {key}" for key in self.needed if key not in made)

    @property
    def ok(self) -> bool:
        """Whether the file is a method, every claim holds, and there are those that are needed."""
        return self.exit_code == 0

    @property
    def exit_code(self) -> int:
        """0 where all holds, 1 where a claim fails, 2 where the file cannot be read, 3 where a
        claim is undecided and none fails, or the program failed.
        """
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
