"""Problem files: a Hamiltonian, a Lagrangian or right-hand sides with their initial values, every
fault of the text at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.doing import doing
from garkcli.exact.formula import RESERVED
from garkcli.methodfile.description import FORMS as METHOD_FORMS
from garkcli.methodfile.formulas import Formulas, bad_name
from garkcli.methodfile.grammar import FILE, entries_in
from garkcli.methodfile.nodes import keys_of, one_line, shortened
from garkcli.methodfile.problem_keys import (
    DEFAULT_T_END,
    FORM,
    FORMS,
    KEYS,
    MAX_INVARIANTS,
    SOLUTION,
    START,
    STIFFNESS,
    ProblemText,
    Side,
    Sides,
)
from garkcli.methodfile.reading import read_text
from garkcli.methodfile.sides import SidesMaker
from garkcli.methodfile.source import PROBLEM_FILE, Entries, Source
from garkcli.methodfile.terms import Maker
from garkcli.problems.vectorfield import TIME

if TYPE_CHECKING:
    from garkcli.problems.problem import Problem


_ANOTHER = "choose another name"


@dataclass(frozen=True)
class Variables:
    """The variables of one file.

    Attributes:
        source: where faults are noted.
        places: where each name stands, in the order of the file; names only that can be names.
    """

    source: Source
    places: Entries

    def refuse_clashes(self, form: str) -> None:
        """Refuse a variable that is the momentum or velocity of another, or has one with a name of
        the formulas: the momentum of ``i`` would be π.
        """
        derived = self._derived(form)
        for name, node in self.places.items():
            if form != "rhs" and f"p{name}" in RESERVED:
                momentum = f"the momentum of {name} would be p{name}"
                message = f"variables: {momentum}, which has a meaning already"
                self.source.fault(node, message, _ANOTHER, code="name-taken")
            if name in derived:
                message = f"variables: {name} is {derived[name]}"
                self.source.fault(node, message, _ANOTHER, code="name-taken")

    def refuse_taken(self, form: str, parameters: Node | None) -> None:
        """Refuse a parameter that is called like a variable, or like what belongs to one."""
        if not isinstance(parameters, MappingNode):
            return
        taken = self._derived(form)
        taken |= dict.fromkeys(self.places, "a variable")
        for key, _ in parameters.value:
            if isinstance(key, ScalarNode) and key.value in taken:
                what = taken[key.value]
                message = f"parameters: {key.value} is {what} already"
                self.source.fault(key, message, _ANOTHER, code="name-taken")

    def _derived(self, form: str) -> dict[str, str]:
        """The names that variables bring with them, and what they are."""
        if form == "rhs":
            return {TIME: "time"}
        names: dict[str, str] = {}
        for name in self.places:
            names[f"p{name}"] = f"the momentum of {name}"
        if form == "lagrangian":
            for name in self.places:
                names[f"v{name}"] = f"the velocity of {name}"
        return names

    def example_start(self, form: str | None) -> str:
        """How the initial values of the first variables would be written."""
        values: list[str] = []
        for name in list(self.places)[:2]:
            values.append(f"{name}: 0")
            if form != "rhs":
                values.append(f"p{name}: 0")
        inside = ", ".join(values)
        return f"initial: {{{inside}}}"


def read_variables(source: Source, root: Node, node: Node | None) -> Variables:
    """The variables that ``node`` names; what is wrong with them is noted.

    Args:
        source: the file.
        root: of the file, the place of what is missing.
        node: one name or a list of them; None where the file has none.
    """
    places: Entries = {}
    found = Variables(source, places)
    if node is None:
        cure = "name the positions, for instance variables: [x, y]"
        source.fault(root, "variables missing", cure, code="missing-key")
        return found
    items: Sequence[Node] = KEYS["variables"].kind.read(found, node, "variables") or ()
    for item in items:
        name = source.scalar(item, "variables")
        if name is None:
            continue
        why = "is named twice" if name in places else bad_name(name)
        if why:
            message = f"variables: {shortened(name)} {why}"
            source.fault(item, message, _ANOTHER, code="name-taken")
        else:
            places[name] = item
    return found


class ProblemReader:
    """Reads what a file says, as far as no names but its own are needed.

    Args:
        source: the file, where faults are noted.
        stiffness: given in place of its own.

    Attributes:
        formulas: of the file, its parameters known once it is read.
    """

    def __init__(self, source: Source, stiffness: fmpq | None) -> None:
        self.source, self.stiffness = source, stiffness
        given = {} if stiffness is None else {STIFFNESS: stiffness}
        self.formulas = Formulas(source, given)

    def read(self) -> ProblemText | None:
        """The text; None where it makes no sense to go on."""
        source = self.source
        root = source.compose()
        if root is None or self._is_method_file(root):
            return None
        entries = entries_in(source, root, FILE, KEYS)
        for key in ("gark", "description", "reference"):
            self._value(key, entries)
        before = len(source.faults)
        variables = read_variables(source, root, entries.get("variables"))
        form = self._form(root, entries, variables)
        variables.refuse_clashes(form or "hamiltonian")
        are_named = len(source.faults) == before
        parameters = entries.get("parameters")
        self.formulas.read_parameters(parameters)
        variables.refuse_taken(form or "hamiltonian", parameters)
        self._check_stiffness(root, form)
        if form is None:
            return None
        names = tuple(variables.places)
        terms: list[tuple[Node, str]] = []
        sides: Sides = ()
        if form == "rhs":
            known = names if are_named else ()
            sides = read_sides(source, entries[form], self._value(form, entries), known)
        else:
            items: list[Node] = self._value(form, entries) or []
            is_one = isinstance(entries[form], ScalarNode)
            letter = form[0].upper()
            for l, item in enumerate(items, start=1):
                terms.append((item, form if is_one else f"{letter}{{{l}}}"))
        return ProblemText(
            name=self._name(entries.get("name")),
            variables=names,
            are_named=are_named,
            form=form,
            terms=tuple(terms),
            initial=entries.get("initial"),
            t_end=self._t_end(entries.get("t_end")),
            invariants=tuple(self._invariants(entries, form)),
            sides=sides,
            exact=entries.get("exact"),
        )

    def _is_method_file(self, root: Node) -> bool:
        """Note a file of the other kind."""
        keys = keys_of(root)
        if not keys & set(METHOD_FORMS) or keys & set(FORMS):
            return False
        message = "this is a method file, not a problem file"
        self.source.fault(root, message, "see docs/problem-file.md", code="other-file")
        return True

    def _form(self, root: Node, entries: Entries, variables: Variables) -> str | None:
        """Which of the three forms the file has; None where it has none.

        What does not go with it is noted.
        """
        FORM.refuse(self.source, root, FILE, entries)
        form = next(iter(FORM.given(entries)), None)
        if form is not None:
            SOLUTION.refuse(self.source, root, FILE, entries, form)
        start = {key: x for key, x in entries.items() if key != "exact" or form == "rhs"}
        cure = f"write {variables.example_start(form)}"
        replace(START, cure=cure).refuse(self.source, root, FILE, start)
        return form

    def _check_stiffness(self, root: Node, form: str | None) -> None:
        """Refuse a stiffness that would change nothing."""
        if self.stiffness is None:
            return
        if form is not None and form != "rhs":
            message = f"--stiffness is for rhs, and this is a {form}"
            self.source.fault(root, message, "leave it out", code="other-problem")
        elif STIFFNESS not in self.formulas.values:
            cure = f"write parameters: {{{STIFFNESS}: 1}} and use it in rhs"
            message = f"--stiffness, but no parameter called {STIFFNESS}"
            self.source.fault(root, message, cure, code="other-problem")

    def _name(self, node: Node | None) -> str:
        text = None if node is None else self.source.scalar(node, "name")
        return shown_name(text or Path(self.source.name).stem)

    def _value(self, key: str, entries: Entries) -> Any:
        """What stands under a key; None where nothing does, or a fault was noted."""
        return KEYS[key].kind.read(self, entries[key], key) if key in entries else None

    def _t_end(self, node: Node | None) -> fmpq:
        if node is None:
            return DEFAULT_T_END
        found = self.formulas.constant(node, "t_end")
        if found is None:
            return DEFAULT_T_END
        _, value = found
        if not isinstance(value, fmpq) or value <= 0:
            message = "t_end: a positive rational number is expected"
            self.source.fault(node, message, "such as 2 or 5/2", code="wrong-value")
            return DEFAULT_T_END
        return value

    def _invariants(self, entries: Entries, form: str) -> list[tuple[str, Node]]:
        """The first integrals that the file names, with their formulas."""
        node = entries.get("invariants")
        if node is None:
            return []
        formulas = self.source.mapping(node, "invariants", ())
        if len(formulas) > MAX_INVARIANTS:
            message = f"{len(formulas)} invariants (limit {MAX_INVARIANTS})"
            self.source.fault(node, message, "use fewer", code="too-many")
            return []
        for name, formula in formulas.items():
            if form != "rhs" and name.lower() in {"energy", "h"}:
                message = f"invariants: {name} is reported always"
                self.source.fault(formula, message, "leave it out", code="not-together")
        return [(shown_name(name), x) for name, x in formulas.items()]


def read_sides(
    source: Source, node: Node, items: Sequence[Node] | None, names: tuple[str, ...]
) -> Sides:
    """The right-hand sides of each term: variables, formulas, and what these are called.

    Args:
        source: where faults are noted.
        node: what ``rhs`` has.
        items: the terms in it; None where there are none, which is noted.
        names: of the variables; none where they have faults, and are not judged.
    """
    is_one = not isinstance(node, SequenceNode)
    wheres = ["rhs" if is_one else f"f{{{l}}}" for l in range(1, len(items or ()) + 1)]
    pairs = zip(items or (), wheres, strict=True)
    return tuple(_side(source, item, where, names) for item, where in pairs)


def _side(source: Source, node: Node, where: str, names: tuple[str, ...]) -> Side:
    """Of one term; a formula alone is that of the only variable."""
    if isinstance(node, ScalarNode) and len(names) == 1:
        return ((names[0], node, where),)
    if not isinstance(node, MappingNode):
        shown = [f"{name}: …" for name in names[:2]]
        example = ", ".join(shown)
        wanted = "right-hand sides by the names of variables are expected"
        message = f"{where}: {wanted}"
        source.fault(node, message, f"write {{{example}}}", code="mapping-expected")
        return ()
    side: list[tuple[str, Node, str]] = []
    for name, formula in source.mapping(node, where, names).items():
        side.append((name, formula, f"{where} of {name}"))
    return tuple(side)


def shown_name(text: str) -> str:
    """A name as it is shown: one line of printable signs, not too long."""
    plain = one_line(text)
    return plain if len(plain) <= 60 else f"{plain[:59]}…"


def load_problem(path: str, stiffness: fmpq | None = None) -> Problem:
    """Read one problem file, or standard input for ``-``.

    Args:
        path: of the file.
        stiffness: the value of its parameter of this name, in place of its own.

    Raises:
        MethodFileError: every fault of the file, with positions.
    """
    with doing(f"reading {path}"):
        return loads_problem(*read_text(path, PROBLEM_FILE), stiffness)


def loads_problem(text: str, source: str = "<text>", stiffness: fmpq | None = None) -> Problem:
    """Read a problem file from its text; see ``load_problem``.

    Raises:
        MethodFileError: every fault of the text, with positions.

    >>> text = "{variables: [x], hamiltonian: px**2/2 - cos(x), initial: {x: 1, px: 0}}"
    >>> loads_problem(text).energy
    px**2/2 - cos(x)
    """
    reading = Source(source, text, PROBLEM_FILE)
    reader = ProblemReader(reading, stiffness)
    read = reader.read()
    if read is None:
        raise reading.error()
    if read.form == "rhs":
        return SidesMaker(reading, reader.formulas, read).problem()
    return Maker(reading, reader.formulas, read).problem()
