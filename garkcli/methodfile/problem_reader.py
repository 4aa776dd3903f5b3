"""YAML nodes to a ``ProblemText``: every key and name checked, faults collected as they are met."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.methodfile.description import FORMS as METHOD_FORMS
from garkcli.methodfile.formulas import Formulas
from garkcli.methodfile.grammar import FILE, entries_in
from garkcli.methodfile.nodes import keys_of
from garkcli.methodfile.problem_keys import FORM, FORMS, KEYS, MAX_INVARIANTS, SOLUTION, START
from garkcli.methodfile.problem_text import DEFAULT_T_END, STIFFNESS, ProblemText, Side, Sides
from garkcli.methodfile.source import Entries, Source
from garkcli.methodfile.variables import Variables, read_variables
from garkcli.methodfile.words import one_line


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
