"""Converts a method to another form, as a method file with the claims that still hold."""

from __future__ import annotations

from operator import ge

from garkcli.check.analysis import analyse_any
from garkcli.check.claims import verify
from garkcli.constructions.rosenbrock import is_rosenbrock
from garkcli.conversion.printed import InForm
from garkcli.conversion.recovered import RecoveredMethod, is_as_good, orders_of, recovered
from garkcli.conversion.rosenbrock import FORMS, text_in_form
from garkcli.conversion.sheet import CannotConvert, Place, Sheet, arranged
from garkcli.conversion.targets import RECOVERED, TARGETS, Target
from garkcli.doing import doing
from garkcli.errors import MethodFileError, UsageProblem, did_you_mean
from garkcli.exact.display import decimal
from garkcli.frozen import Frozen, replace
from garkcli.methodfile import writer
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.carried import claim_lines, lines_of
from garkcli.methodfile.expectations import highest_order
from garkcli.methodfile.load import loads
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.tolerance import within
from garkcli.tableau.garkmethod import GarkMethod, derived_name


def padded(sheet: Sheet, stages: int) -> Sheet:
    """The method with ``stages`` stages in each colour; new ones come first, with zeros.

    A new stage has node 0 and zero row and weights: its value is the old value. Being first, it
    keeps explicit methods explicit, diagonally implicit ones diagonally implicit, and last stages
    last. CannotConvert if a colour has more stages.
    """
    spaces: list[list[Place]] = []
    for k, space in enumerate(sheet.tableau.spaces):
        missing = stages - space.stages
        if missing < 0:
            message = f"a colour has {space.stages} stages, more than {stages}"
            cure = "--to canonical leaves out those without influence"
            raise CannotConvert(message, cure, code="too-many")
        places: list[Place] = [None] * missing
        places += [(k, i) for i in range(space.stages)]
        spaces.append(places)
    return arranged(sheet, spaces)


KEPT = ("description", "reference")
UNNAMED = "a method"
WIDER = (1, 10, 100, 1000)
"""Factors by which numbers of a form may be rounded more than the entries."""


class Converted(Frozen):
    """A converted method.

    Attributes:
        method: the method, read from the written text.
        left_out: the claims of the file that do not hold for it, or are not defined.
        loses_further: whether embedded weights, dense output or a predictor are lost.

    >>> from garkcli import convert, load
    >>> heun, made = load("heun"), convert("heun", to="shu-osher")
    >>> made.method.tableau == heun.tableau, made.loses_further
    (True, False)
    """

    method: MethodFile
    left_out: tuple[str, ...] = ()
    loses_further: bool = False

    def __repr__(self) -> str:
        return f"<Converted {self.method!r}>"


@doing("other form")
def convert(
    method: GarkMethod,
    to: str = "spelled-out",
    stages: int | None = None,
    digits: int | None = None,
    is_recognising: bool = False,
) -> Converted:
    """Converts a method to another form, one of ``TARGETS``.

    ``stages`` is the least number of stages of each colour, filled up by unused ones in front. For
    ``recovered`` there are ``digits`` digits after the point, by default 50, or as many as the
    tolerance has, and with ``is_recognising`` exact numbers replace decimals if all digits agree
    and no order falls. UsageProblem if there is no such form, or ``digits`` does not apply to it;
    CannotConvert if the method has no such form; ZeroWeight if a pair would divide by zero.

    >>> heun = loads("{A: [[0, 0], [1, 0]], b: [1/2, 1/2]}")
    >>> convert(heun, stages=3).method.A
    ((0, 0, 0), (0, 0, 0), (0, 1, 0))
    """
    if to not in TARGETS:
        raise UsageProblem(f"no form {to!r}", did_you_mean(to, TARGETS), code="unknown-word")
    goal = TARGETS[to]
    if to != RECOVERED and (digits is not None or is_recognising):
        message = f"the form {to} has the numbers of the file"
        raise UsageProblem(message, "leave out digits", code="not-together")
    source = method.source if isinstance(method, MethodFile) else ""
    name = UNNAMED if method.name in ("", source) else method.name
    if is_rosenbrock(method.tableau):
        _refuse_forms(to, stages)
        return _converted(text_in_form(method, to, name), method, goal)
    method.tableau.demand_fields("another form")
    found = recovered(method, digits, is_recognising) if to == RECOVERED else None
    sheet = goal.convert(method) if found is None else found.sheet
    if stages is not None:
        sheet = padded(sheet, stages)
    if not writer.can_spell_out(sheet.tableau):
        raise CannotConvert(
            "a method file spells out a GARK method or one pair (q, p), not"
            " this partitioned method",
            "--to gark has all of its colours",
        )
    if goal.makes_another:
        name = derived_name(goal.name, name)
    if goal.printed is not None:
        text = _printed(goal, goal.printed, method, sheet, name)
    elif found is None:
        tolerance = writer.tolerance_of_file(method, sheet.further)
        text = writer.write_method(sheet.tableau, name, tolerance, sheet.further)
    else:
        text = _written(replace(found, sheet=sheet), name)
    loses_further = method.further.kinds != sheet.further.kinds
    return replace(_converted(text, method, goal), loses_further=loses_further)


def _converted(text: str, method: GarkMethod, goal: Target) -> Converted:
    text = _with_head(text, method)
    if not isinstance(method, MethodFile):
        return Converted(loads(text))
    return _claimed(text, method, goal)


def _refuse_forms(to: str, stages: int | None) -> None:
    cure = f"--to {' or --to '.join(FORMS[1:])}"
    if to not in FORMS:
        raise CannotConvert(f"a Rosenbrock method has no form {to}", cure)
    if stages is not None:
        raise CannotConvert("a stage of a Rosenbrock method has a γ, which is not 0", cure)


def _printed(goal: Target, form: InForm, method: GarkMethod, sheet: Sheet, name: str) -> str:
    """Rounding is allowed as far as no order falls and no entry of A and b is farther off."""
    own = method.tolerance
    key, keys = form(sheet.tableau, own)
    tolerance = writer.tolerance_of_file(method, sheet.further)
    if own is None:
        return writer.write_form(key, keys, sheet.tableau, name, tolerance, sheet.further)
    orders = orders_of(method)
    for wider in WIDER:
        allowed = own * wider
        written = {**tolerance, "others": allowed} if isinstance(tolerance, dict) else allowed
        text = writer.write_form(key, keys, sheet.tableau, name, written, sheet.further)
        made = loads(text)
        pairs = zip(made.tableau.rows, sheet.tableau.rows, strict=True)
        gaps = (x - y for rows in pairs for x, y in zip(*rows, strict=True))
        if all(within(x, allowed) for x in gaps) and all(map(ge, orders_of(made), orders)):
            return text
    message = f"an order falls where numbers of the form {goal.name} are off by {decimal(allowed)}"
    raise CannotConvert(message, "--to spelled-out has every method")


def _written(found: RecoveredMethod, name: str) -> str:
    """Writes a recovered method with as many exact numbers as keep all orders."""
    proposals = {**found.proposals}
    while True:
        text = writer.write_tableau_file(
            found.sheet.tableau,
            name,
            found.tolerance_with(proposals),
            text=found.text_with(proposals),
            further=found.sheet.further,
        )
        if not proposals or _is_as_good(text, found):
            return text
        proposals.popitem()  # the longest says least


def _is_as_good(text: str, found: RecoveredMethod) -> bool:
    try:
        return is_as_good(loads(text), found)
    except MethodFileError:
        return False


def _with_head(text: str, method: GarkMethod) -> str:
    if not isinstance(method, MethodFile):
        return text
    version, name, *others = text.splitlines(keepends=True)
    return "".join([version, name, lines_of(method, KEPT), *others])


def _claimed(text: str, method: MethodFile, goal: Target) -> Converted:
    """A claim on a companion may become one on the method."""
    names = {claim.key: claim.key for claim in method.claims}
    if goal.claims:
        names = {old: goal.claims[old] for old in names if old in goal.claims}
    failing = _failing(loads(text + claim_lines(method, names)))
    held = {old: new for old, new in names.items() if new not in failing}
    lost = [claim.key for claim in method.claims if claim.key not in held]
    return Converted(loads(text + claim_lines(method, held)), tuple(lost))


def _failing(method: MethodFile) -> set[str]:
    if not method.claims:
        return set()
    reach = max(DEFAULT_LIMIT, highest_order(method.claims) + 1)
    analysis = analyse_any(method, reach)
    return {claim.claim for claim in verify(method.claims, analysis) if not claim.holds}
