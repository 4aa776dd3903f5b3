"""The tableaus of steps that are written out as computations.

A function evaluates f several times, ``call f(t + h/2, x + h/2*k1, k2)`` or ``k2 = f(…)``, and adds
multiples of the slopes to its first value, at once or in loops over components. It is evaluated
again, with polynomials in the unknown names: the time, the value, the step and the slopes; all
paths through branches must give the same step. Nothing is guessed from names, and a computation
that does not fit gives no table.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence, Set
from contextlib import suppress
from itertools import pairwise

from garkcli.sources import ir
from garkcli.sources.evaluate import Evaluator, names_of, shown
from garkcli.sources.follower import Follower, counter_of, is_of_fortran
from garkcli.sources.polynomials import Place
from garkcli.sources.stages import NEAR, NoStep, Roles, terms_of
from garkcli.sources.step_hints import Hints, may_add_multiples
from garkcli.sources.step_words import callee_name, is_sum
from garkcli.sources.values import (
    ONE,
    ZERO,
    Array,
    Form,
    Number,
    SourceRecord,
    Space,
    Value,
    items_of,
    near,
)
from garkcli.sources.written_out import (
    is_written_out,
    with_calls,
    with_euler_steps,
    with_functions,
    with_one_function,
)

MAX_WAYS = 8
"""Most paths through a function."""
MAX_PATHS = 24
"""Most paths that are followed in the parts of a function."""
MAX_STATEMENTS = 400
"""Most statements of a function that is followed in several ways."""
MAX_STATEMENTS_OF_ONE_STAGE = 20
"""Most statements of a function in which a step of one stage is sought."""
MAX_NUMBERS = 6
"""Most numbers tried as the step."""
FEWEST_TURNS = 5
"""Fewest alternating calls of a splitting."""
Known = dict[tuple[int, ...], Hints]
"""Hints in some statements of a function, by the identities of these."""


def steps_of(body: ir.Body, space: Space, like: Evaluator, is_function: bool = True) -> list[Roles]:
    """A, b, c and the error of the distinct steps of a function: of all of it, or of the branches
    and the loops over time in it.

    Args:
        body: of the function.
        space: the names around it.
        like: an evaluator of its language.
        is_function: whether all of it may be a step, not only the parts.

    Raises:
        NoStep: there is none.
    """
    looks_like = False
    if not may_add_multiples(body, like.functions):
        raise NoStep
    if is_of_fortran(like):
        body = with_calls(body)
    body = with_euler_steps(body, like.functions)
    # functions that differ in numbers are one at several times, or components of one
    of_one = with_one_function(body, like.functions)
    for whole in [body] if of_one is body else [of_one, body]:
        for has_increments in (None, False, True):
            each = whole if has_increments is None else with_functions(whole, has_increments)
            is_plain = each is whole
            try:
                if each is not None:
                    return _steps_with_calls(each, space, like, is_function, is_plain)
            except NoStep as error:
                looks_like |= error.looks_like
    raise NoStep(looks_like)


def _steps_with_calls(
    body: ir.Body, space: Space, like: Evaluator, is_function: bool, is_plain: bool
) -> list[Roles]:
    """The steps in statements, unless ``is_plain`` those with vector fields written out."""
    known: Known = {}
    hints, count = _hints(body, like, known), sum(1 for _ in ir.statements(body))
    if not hints.fields or (count > MAX_STATEMENTS_OF_ONE_STAGE and not hints.of_stages):
        raise NoStep
    if not is_plain and not any(map(is_written_out, hints.fields)):
        raise NoStep
    modes = [("", False)]
    if count <= MAX_STATEMENTS:
        modes.append(("", True))
        # the step may be a number that is set around it
        modes += [(name, False) for name in _numbers_in(body, space) if hints.of_stages]
    looks_like = False
    helpers_seen: set[str] = set()
    for symbol, is_inlined in modes:
        if is_inlined and not helpers_seen:
            continue
        own = Space(space)
        own.update({symbol: Form({(symbol,): ONE})} if symbol else {})
        reader = _StepReader(own, like, helpers_seen if is_inlined else set(), known)
        try:
            if is_function:
                roles = reader.by_every_way(body)
                if count <= MAX_STATEMENTS_OF_ONE_STAGE or len(items_of(roles["b"])) > 1:
                    return [roles]
        except NoStep as error:
            looks_like |= error.looks_like
        distinct = {shown(SourceRecord("", x)): x for x in reader.in_parts(body)}
        looks_like |= reader.looks_like
        helpers_seen |= reader.helpers
        if distinct:
            return [*distinct.values()]
    raise NoStep(looks_like)


def splitting_of(body: ir.Body, space: Space, like: Evaluator) -> Roles:
    """The weights of two functions called in alternation with parts of one step, ``x.drift(0.5*h);
    x.kick(h)``; those of the first one count as drifts.

    Raises:
        NoStep: there are no such calls.
    """
    calls: list[tuple[str, ir.Expr]] = []
    for statement in body:
        match statement:
            case ir.Do(value=ir.Call(callee, (part,), ())) if name := callee_name(callee):
                calls.append((name, part))
    if len(calls) < FEWEST_TURNS:
        raise NoStep
    follower, names = Follower(like, ()), Space(space)
    turns: list[tuple[str, Place, Value]] = []
    for name, part in calls:
        form = terms_of(follower.value(part, names)) or {}
        turns += [(name, at, x) for at, x in form.items() if at and len(form) == 1]
    callees = list(dict.fromkeys(name for name, _, _ in turns))
    are_in_turns = all(x[0] != y[0] for x, y in pairwise(turns))
    if len(turns) < FEWEST_TURNS or len(callees) != 2 or not are_in_turns:
        raise NoStep
    drifts, kicks = ([x for name, _, x in turns if name == callee] for callee in callees)
    if len({at for _, at, _ in turns}) > 1 or any(
        abs(near(*x) - 1) > NEAR for x in (drifts, kicks)
    ):
        raise NoStep
    kicks += [ZERO] * (len(drifts) - len(kicks))
    return {"drifts": Array([*drifts]), "kicks": Array([*kicks])}


class _StepReader:
    """Reads the steps of statements.

    Args:
        space: the names around them.
        like: an evaluator of their language.
        inlined: the functions of the source that are followed.
        known: the hints in them so far.

    Attributes:
        looks_like: whether a part of them looks like a step.
        helpers: the functions on all paths that would be followed.
        is_open: whether nothing says which result of the last step is the step.
    """

    def __init__(self, space: Space, like: Evaluator, inlined: Set[str], known: Known) -> None:
        self._space = space
        self._like = like
        self._inlined = frozenset(inlined)
        self._known = known
        self._paths = 0
        self.looks_like = False
        self.helpers: set[str] = set()
        self.is_open = False

    def by_every_way(self, body: ir.Body, counters: Sequence[str] = ()) -> Roles:
        """The common step of all paths through some statements. A path without a step is left out,
        unless branches have sums.

        Raises:
            NoStep: there is none.
        """
        by_content: dict[object, Roles] = {}
        guesses: set[object] = set()
        is_lost = is_idle = False
        arms = (arm for x in body if isinstance(x, ir.Branch) for arm in x.arms)
        have_sums = any(map(_has_sums, arms))
        for way in reversed(_ways(body)):
            self._paths += 1
            if self._paths > MAX_PATHS:
                raise NoStep
            hints = _hints(way, self._like, self._known)
            if not hints.are_any or (is_lost and have_sums and not hints.of_stages):
                # this path is no step; without one elsewhere it need not look like one
                is_lost = True
                continue
            follower = self._follower(way, counters)
            try:
                try:
                    roles = follower.roles(Space(self._space))
                except NoStep:
                    if not follower.may_ignore_others or not hints.of_stages:
                        raise
                    follower = self._follower(way, counters, ignores_others=True)
                    roles = follower.roles(Space(self._space))
            except NoStep as error:
                if error.is_idle:
                    # the step is rejected
                    is_idle |= error.looks_like
                    continue
                if error.looks_like:
                    raise
                is_lost = True
            else:
                content = shown(SourceRecord("", roles))
                by_content[content] = roles
                if follower.is_open:
                    guesses.add(content)
                self._like.followed |= follower.followed
            finally:
                self.helpers |= follower.helpers
        sure = [y for x, y in by_content.items() if x not in guesses]
        for x in guesses:
            if any(_has_result(y, by_content[x]) for y in sure):
                # the step is rejected
                del by_content[x]
        if len(by_content) != 1 or (is_lost and have_sums):
            raise NoStep(looks_like=is_idle or bool(by_content), is_idle=is_idle)
        content, roles = by_content.popitem()
        self.is_open = content in guesses
        if is_lost and len(items_of(roles["b"])) < 2:
            raise NoStep
        return roles

    def _follower(
        self, way: Sequence[ir.Statement], counters: Sequence[str], ignores_others: bool = False
    ) -> Follower:
        return Follower(self._like, way, counters, ignores_others, self._inlined)

    def in_parts(self, body: ir.Body, counters: Sequence[str] = ()) -> Iterator[Roles]:
        """The steps with several stages in branches and in loops over time."""
        for i, statement in enumerate(body):
            parts: Iterable[tuple[ir.Body, Sequence[str]]] = ()
            if isinstance(statement, ir.Branch):
                parts = ((_plain(arm), counters) for arm in statement.arms)
            elif isinstance(statement, ir.Loop):
                parts = [(statement.body, (*counters, *_counted(statement)))]
            for inside, names in parts:
                if not _hints(inside, self._like, self._known).of_stages:
                    continue
                try:
                    roles = self.by_every_way(inside, names)
                except NoStep as error:
                    found = [*self.in_parts(inside, names)]
                    self.looks_like |= error.looks_like and not found
                    yield from found
                else:
                    if self.is_open and isinstance(statement, ir.Loop) and not statement.name:
                        # a step that is tried again; what follows may take a result
                        with suppress(NoStep):
                            roles = self.by_every_way((*inside, *body[i + 1 :]), names)
                    if len(items_of(roles["b"])) > 1:
                        yield roles


def _has_result(roles: Roles, other: Roles) -> bool:
    """Whether the result of another step is one of the two results of a step."""
    results = [shown(roles[x]) for x in ("b", "embedded") if x in roles]
    return shown(roles["A"]) == shown(other["A"]) and shown(other["b"]) in results


def _hints(body: Sequence[ir.Statement], like: Evaluator, known: Known) -> Hints:
    key = tuple(map(id, body))
    if key not in known:
        known[key] = Hints(body, like.functions, like.has_whole_quotients)
    return known[key]


def _plain(arm: ir.Body) -> ir.Body:
    """The statements of an arm, also of a case of a switch."""
    return arm[0].body if len(arm) == 1 and isinstance(arm[0], ir.Scope) else arm


def _numbers_in(body: ir.Body, space: Space) -> list[str]:
    """Names of numbers that are factors in some statements."""
    names: dict[str, None] = {}
    for x in ir.parts_of(body):
        match x:
            case ir.Binary("*" | "/", left, right):
                names |= {y.name: None for y in (left, right) if isinstance(y, ir.Name)}
    found = [x for x in names if isinstance(space.find(x), Number)]
    return found if len(found) <= MAX_NUMBERS else []


def _counted(loop: ir.Loop) -> Iterator[str]:
    """The counters of a loop."""
    if loop.name:
        yield loop.name
    for x in loop.body:
        yield from counter_of(x)


def _ways(body: ir.Body) -> list[list[ir.Statement]]:
    """The paths through some statements, without arms that return; with too many paths branches
    stay.
    """
    found: list[list[ir.Statement]] = [[]]
    for i, statement in enumerate(body):
        arms: list[list[ir.Statement]] = [[statement]]
        if isinstance(statement, ir.Branch):
            inside = [_plain(x) for x in statement.arms]
            staying = [x for x in inside if not (x and isinstance(x[-1], ir.Return))]
            is_total = statement.is_total
            if not staying and not _has_sums(body[i + 1 :]):
                # a step that is accepted is returned
                accepted = [x for x in inside if _has_sums(x[-1:])]
                others = [x for x in inside if x and not _has_sums(x[-1:])]
                if any(_has_multiples(x[-1:], body[:i]) for x in others):
                    # so is another one
                    accepted = inside
                staying, is_total = accepted or staying, is_total or bool(accepted)
            arms = [way for arm in staying for way in _ways(arm)]
            if not is_total:
                arms.append([])
        if len(found) * len(arms) > MAX_WAYS:
            arms = [[statement]]
        found = [[*way, *arm] for way in found for arm in arms]
    return found


def _has_multiples(body: ir.Body, before: ir.Body) -> bool:
    """Whether a value is a multiple of another one that a function gave before."""
    assigned = [x for x in ir.statements(before) if isinstance(x, ir.Assign)]
    called = [x for x in assigned if any(isinstance(y, ir.Call) for y in x.parts)]
    names = {name for x in called for name in names_of(x.target)}
    products = (x for x in ir.parts_of(body) if isinstance(x, ir.Binary))
    return any(isinstance(y, ir.Name) and y.name in names for x in products for y in ir.inside(x))


def _has_sums(body: ir.Body) -> bool:
    return any(map(is_sum, ir.parts_of(body)))
