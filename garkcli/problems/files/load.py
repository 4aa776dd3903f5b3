"""Problem files: Hamiltonians, Lagrangians or right-hand sides; all faults at once."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from flint import fmpq

from garkcli.doing import doing
from garkcli.exact.formula import RESERVED
from garkcli.frozen import Frozen, replace
from garkcli.glossary.key import PROBLEM_FILE
from garkcli.grammar.keys import FILE, entries_in
from garkcli.grammar.nodes import MappingNode, Node, ScalarNode, SequenceNode, one_line, shortened
from garkcli.grammar.reading import read_text
from garkcli.grammar.source import Entries, Source
from garkcli.problems.files import keys
from garkcli.problems.files.formulas import FormulaReader, bad_name
from garkcli.problems.files.hamiltonians import HamiltonianMaker
from garkcli.problems.files.sides import SidesMaker
from garkcli.problems.vectorfield import TIME

if TYPE_CHECKING:
    from garkcli.problems.problem import Problem

_ANOTHER = "choose another name"


def load_problem(path: str, stiffness: fmpq | None = None) -> Problem:
    """Reads a problem file, or standard input for ``-``; MethodFileError with all faults."""
    with doing(f"reading {path}"):
        return loads_problem(*read_text(path, PROBLEM_FILE), stiffness)


def loads_problem(text: str, source: str = "<text>", stiffness: fmpq | None = None) -> Problem:
    """Reads the text of a problem file as ``load_problem`` does."""
    reading = Source(source, text, PROBLEM_FILE)
    reader = _ProblemReader(reading, stiffness)
    read = reader.read()
    if read is None:
        raise reading.error()
    if read.form == "rhs":
        return SidesMaker(reader.formulas, read).problem()
    return HamiltonianMaker(reader.formulas, read).problem()


class _Variables(Frozen):
    """The variables; ``places`` has well-formed names in the order of the file."""

    source: Source
    places: Entries
    form: str

    def refuse_clashes(self) -> None:
        """Reports variables derived from others, or with a momentum such as pi, that of i."""
        derived = self._derived()
        for name, node in self.places.items():
            if self.form != "rhs" and f"p{name}" in RESERVED:
                momentum = f"the momentum of {name} would be p{name}"
                message = f"variables: {momentum}, which has a meaning already"
                self.source.fault(node, message, _ANOTHER, code="name-taken")
            if name in derived:
                message = f"variables: {name} is {derived[name]}"
                self.source.fault(node, message, _ANOTHER, code="name-taken")

    def refuse_taken(self, parameters: Node | None) -> None:
        taken = self._derived() | dict.fromkeys(self.places, "a variable")
        for key, _ in parameters.value if isinstance(parameters, MappingNode) else ():
            if isinstance(key, ScalarNode) and key.value in taken:
                message = f"parameters: {key.value} is {taken[key.value]} already"
                self.source.fault(key, message, _ANOTHER, code="name-taken")

    def _derived(self) -> dict[str, str]:
        if self.form == "rhs":
            return {TIME: "time"}
        letters = {"p": "momentum"} | ({"v": "velocity"} if self.form == "lagrangian" else {})
        return {
            f"{letter}{name}": f"the {what} of {name}"
            for letter, what in letters.items()
            for name in self.places
        }

    def example_start(self) -> str:
        names = list(self.places)[:2]
        prefixes = [""] if self.form == "rhs" else ["", "p"]
        values = [f"{prefix}{name}: 0" for name in names for prefix in prefixes]
        return f"initial: {{{', '.join(values)}}}"


class _ProblemReader:
    """Reads a file as far as only its own names are needed."""

    def __init__(self, source: Source, stiffness: fmpq | None) -> None:
        self.source, self.stiffness = source, stiffness
        self.formulas = FormulaReader(
            source, {} if stiffness is None else {keys.STIFFNESS: stiffness}
        )

    def read(self) -> keys.ProblemText | None:
        source = self.source
        root = source.compose()
        if root is None:
            return None
        entries = entries_in(source, root, FILE, keys.KEYS)
        for key in ("gark", "description", "reference"):
            self._value(key, entries)
        form = next(iter(keys.FORM.given(entries)), None)
        before = len(source.faults)
        places = self._places(root, entries)
        variables = _Variables(source, places, form or "hamiltonian")
        keys.FORM.refuse(source, root, FILE, entries)
        variables.refuse_clashes()
        are_named = len(source.faults) == before
        parameters = entries.get("parameters")
        self.formulas.read_parameters(parameters)
        variables.refuse_taken(parameters)
        if form is not None:
            keys.SOLUTION.refuse(source, root, FILE, entries, form)
        start = {key: x for key, x in entries.items() if key != "exact" or form == "rhs"}
        replace(keys.START, cure=f"write {variables.example_start()}").refuse(
            source, root, FILE, start
        )
        self._check_stiffness(root, form)
        if form is None:
            return None
        items: list[Node] = self._value(form, entries) or []
        is_list = isinstance(entries[form], SequenceNode)
        letter = "f" if form == "rhs" else form[0].upper()
        is_one = isinstance(entries[form], ScalarNode) if form != "rhs" else not is_list
        wheres = [form if is_one else f"{letter}{{{l}}}" for l in range(1, len(items) + 1)]
        terms = tuple(zip(items, wheres, strict=True))
        known = tuple(places) if are_named else ()
        node = entries.get("name")
        text = None if node is None else self.source.scalar(node, "name")
        return keys.ProblemText(
            name=_shown_name(text or Path(self.source.name).stem),
            variables=tuple(places),
            are_named=are_named,
            form=form,
            terms=() if form == "rhs" else terms,
            initial=entries.get("initial"),
            t_end=self._t_end(entries.get("t_end")),
            invariants=tuple(self._invariants(entries, form)),
            sides=tuple(_side(source, *x, known) for x in terms) if form == "rhs" else (),
            exact=entries.get("exact"),
        )

    def _places(self, root: Node, entries: Entries) -> Entries:
        places: Entries = {}
        if "variables" not in entries:
            cure = "name the positions, for instance variables: [x, y]"
            self.source.fault(root, "variables missing", cure, code="missing-key")
        for item in self._value("variables", entries) or ():
            name = self.source.scalar(item, "variables")
            if name is None:
                continue
            why = "is named twice" if name in places else bad_name(name)
            if why:
                message = f"variables: {shortened(name)} {why}"
                self.source.fault(item, message, _ANOTHER, code="name-taken")
            else:
                places[name] = item
        return places

    def _check_stiffness(self, root: Node, form: str | None) -> None:
        if self.stiffness is None:
            return
        if form is not None and form != "rhs":
            message = f"--stiffness is for rhs, and this is a {form}"
            self.source.fault(root, message, "leave it out", code="other-problem")
        elif keys.STIFFNESS not in self.formulas.values:
            cure = f"write parameters: {{{keys.STIFFNESS}: 1}} and use it in rhs"
            message = f"--stiffness, but no parameter called {keys.STIFFNESS}"
            self.source.fault(root, message, cure, code="other-problem")

    def _value(self, key: str, entries: Entries) -> Any:
        return keys.KEYS[key].kind.read(self, entries[key], key) if key in entries else None

    def _t_end(self, node: Node | None) -> fmpq:
        constant = None if node is None else self.formulas.constant(node, "t_end")
        if constant is None:
            return keys.DEFAULT_T_END
        _, value = constant
        if isinstance(value, fmpq) and value > 0:
            return value
        message = "t_end: a positive rational number is expected"
        self.source.fault(node, message, "such as 2 or 5/2", code="wrong-value")
        return keys.DEFAULT_T_END

    def _invariants(self, entries: Entries, form: str) -> list[tuple[str, Node]]:
        node = entries.get("invariants")
        formulas = {} if node is None else self.source.mapping(node, "invariants", ())
        if len(formulas) > keys.MAX_INVARIANTS:
            message = f"{len(formulas)} invariants (limit {keys.MAX_INVARIANTS})"
            self.source.fault(node, message, "use fewer", code="too-many")
            return []
        for name, formula in formulas.items():
            if form != "rhs" and name.lower() in {"energy", "h"}:
                message = f"invariants: {name} is reported always"
                self.source.fault(formula, message, "leave it out", code="not-together")
        return [(_shown_name(name), x) for name, x in formulas.items()]


def _side(source: Source, node: Node, where: str, names: Sequence[str]) -> keys.Side:
    """Returns the right-hand sides of a term; a single formula belongs to the only variable."""
    if isinstance(node, ScalarNode) and len(names) == 1:
        return ((names[0], node, where),)
    if not isinstance(node, MappingNode):
        message = f"{where}: right-hand sides by the names of variables are expected"
        cure = f"write {{{', '.join(f'{name}: …' for name in names[:2])}}}"
        source.fault(node, message, cure, code="mapping-expected")
        return ()
    formulas = source.mapping(node, where, names).items()
    return tuple((name, formula, f"{where} of {name}") for name, formula in formulas)


def _shown_name(text: str) -> str:
    """Returns a name as one line of printable characters, shortened if long."""
    plain = one_line(text)
    return plain if len(plain) <= 60 else f"{plain[:59]}…"
