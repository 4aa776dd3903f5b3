"""Problem files: a Hamiltonian, a Lagrangian or right-hand sides with their initial values, every
fault of the text at once.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.exact.formula import RESERVED
from garkcli.methodfile.description import FORMS as METHOD_FORMS
from garkcli.methodfile.formulas import Formulas, bad_name
from garkcli.methodfile.load import read_text
from garkcli.methodfile.sides import STIFFNESS, Sides, SidesMaker, read_sides
from garkcli.methodfile.source import PROBLEM_FILE, Source, keys_of
from garkcli.methodfile.terms import Maker, ProblemText
from garkcli.methodfile.words import one_line, shortened
from garkcli.problems.vectorfield import TIME

if TYPE_CHECKING:
    from garkcli.problems.problem import Problem

KEYS = (
    "gark",
    "name",
    "description",
    "reference",
    "variables",
    "parameters",
    "hamiltonian",
    "lagrangian",
    "rhs",
    "initial",
    "exact",
    "t_end",
    "invariants",
)
"""The keys of a problem file."""
FORMS = ("hamiltonian", "lagrangian", "rhs")
"""Those of which a file has one."""
_WITH_ARTICLE = {
    "hamiltonian": "a hamiltonian",
    "lagrangian": "a lagrangian",
    "rhs": "an rhs",
}
DEFAULT_T_END = fmpq(2)
"""The final time of a convergence test where the file gives none."""
MAX_VARIABLES = 64
"""Most degrees of freedom."""
MAX_TERMS = 64
"""Most terms."""
MAX_INVARIANTS = 10
"""Most invariants."""


def load_problem(path: str, stiffness: fmpq | None = None) -> Problem:
    """Read one problem file, or standard input for ``-``.

    Args:
        path: of the file.
        stiffness: the value of its parameter of this name, in place of its own.

    Raises:
        MethodFileError: every fault of the file, with positions.
    """
    return loads_problem(*read_text(path, PROBLEM_FILE), stiffness)


def loads_problem(
    text: str, source: str = "<text>", stiffness: fmpq | None = None
) -> Problem:
    """Read a problem file from its text; see ``load_problem``.

    Raises:
        MethodFileError: every fault of the text, with positions.

    >>> text = "{variables: [x], hamiltonian: px**2/2 - cos(x), initial: {x: 1, px: 0}}"
    >>> loads_problem(text).energy
    px**2/2 - cos(x)
    """
    reading = Source(source, text, PROBLEM_FILE)
    reader = _Reader(reading, stiffness)
    read = reader.read()
    if read is None:
        raise reading.error()
    if read.form == "rhs":
        return SidesMaker(reading, reader.formulas, read).problem()
    return Maker(reading, reader.formulas, read).problem()


class _Reader:
    """Reads what a file says, as far as no names but its own are needed."""

    def __init__(self, source: Source, stiffness: fmpq | None) -> None:
        self.source, self.stiffness = source, stiffness
        given = {} if stiffness is None else {STIFFNESS: stiffness}
        self.formulas = Formulas(source, given)

    def read(self) -> ProblemText | None:
        """The text; None where it makes no sense to go on."""
        source = self.source
        root = source.compose()
        if root is None:
            return None
        if keys_of(root) & set(METHOD_FORMS) and not keys_of(root) & set(
            FORMS
        ):
            source.fault(
                root,
                "this is a method file, not a problem file",
                "see docs/problem-file.md",
            )
            return None
        entries = source.mapping(root, "the file", KEYS)
        version = entries.get("gark")
        if version is not None and source.scalar(version, "gark") != "1":
            source.fault(
                version,
                "gark: this program reads version 1 of the format",
                "write gark: 1",
            )
        for key in ("description", "reference"):
            if key in entries:
                source.scalar(entries[key], key)
        before = len(source.faults)
        variables = self._variables(root, entries.get("variables"))
        form = self._form(root, entries)
        self._refuse_clashes(variables, form or "hamiltonian")
        are_named = len(source.faults) == before
        self.formulas.read_parameters(entries.get("parameters"))
        self._refuse_taken(variables, form, entries.get("parameters"))
        self._check_start(root, entries, variables, form)
        self._check_stiffness(root, form)
        if form is None:
            return None
        names = tuple(name for name, _ in variables)
        sides: Sides = ()
        if form == "rhs":
            known = names if are_named else ()
            sides = read_sides(source, entries[form], known, MAX_TERMS)
        return ProblemText(
            name=self._name(entries.get("name")),
            variables=names,
            are_named=are_named,
            form=form,
            terms=()
            if form == "rhs"
            else tuple(self._items(entries[form], form)),
            initial=entries.get("initial"),
            t_end=self._t_end(entries.get("t_end")),
            invariants=tuple(
                self._invariants(entries.get("invariants"), form)
            ),
            sides=sides,
            exact=entries.get("exact"),
        )

    def _check_start(
        self,
        root: Node,
        entries: dict[str, Node],
        variables: list[tuple[str, Node]],
        form: str | None,
    ) -> None:
        """Refuse a file without initial values, and a solution of what has none."""
        is_rhs = form == "rhs"
        if "initial" not in entries and not (is_rhs and "exact" in entries):
            self.source.fault(
                root, "initial missing", _initial_cure(variables, form)
            )
        if "exact" in entries and not is_rhs and form is not None:
            message = f"exact is for rhs, and this is a {form}"
            self.source.fault(entries["exact"], message, "leave it out")

    def _check_stiffness(self, root: Node, form: str | None) -> None:
        """Refuse a stiffness that would change nothing."""
        if self.stiffness is None:
            return
        if form is not None and form != "rhs":
            message = f"--stiffness is for rhs, and this is a {form}"
            self.source.fault(root, message, "leave it out")
        elif STIFFNESS not in self.formulas.values:
            cure = f"write parameters: {{{STIFFNESS}: 1}} and use it in rhs"
            message = f"--stiffness, but no parameter called {STIFFNESS}"
            self.source.fault(root, message, cure)

    def _name(self, node: Node | None) -> str:
        text = None if node is None else self.source.scalar(node, "name")
        return shown_name(text or Path(self.source.name).stem)

    def _variables(
        self, root: Node, node: Node | None
    ) -> list[tuple[str, Node]]:
        """The names of the positions that can be names, and where they stand."""
        if node is None:
            self.source.fault(
                root,
                "variables missing",
                "name the positions, for instance variables: [x, y]",
            )
            return []
        items = (
            [node]
            if isinstance(node, ScalarNode)
            else self.source.items(node, "variables")
        )
        if not items and isinstance(node, SequenceNode):
            self.source.fault(
                node, "variables is empty", "name at least one position"
            )
        if len(items) > MAX_VARIABLES:
            self.source.fault(
                node,
                f"{len(items)} variables (limit {MAX_VARIABLES})",
                "use fewer",
            )
            return []
        found: dict[str, Node] = {}
        for item in items:
            name = self.source.scalar(item, "variables")
            if name is None:
                continue
            why = "is named twice" if name in found else bad_name(name)
            if why:
                self.source.fault(
                    item,
                    f"variables: {shortened(name)} {why}",
                    "choose another name",
                )
            else:
                found[name] = item
        return list(found.items())

    def _refuse_clashes(
        self, variables: list[tuple[str, Node]], form: str
    ) -> None:
        """Refuse a variable that is the momentum or velocity of another, or has one with a name of
        the formulas: the momentum of ``i`` would be π.
        """
        derived = _derived(variables, form)
        for name, node in variables:
            if form != "rhs" and f"p{name}" in RESERVED:
                self.source.fault(
                    node,
                    f"variables: the momentum of {name} would be p{name}, "
                    f"which has a meaning already",
                    "choose another name",
                )
            if name in derived:
                self.source.fault(
                    node,
                    f"variables: {name} is {derived[name]}",
                    "choose another name",
                )

    def _refuse_taken(
        self,
        variables: list[tuple[str, Node]],
        form: str | None,
        node: Node | None,
    ) -> None:
        """Refuse a parameter that is called like a variable, or like what belongs to one."""
        taken = {
            **_derived(variables, form or "hamiltonian"),
            **{name: "a variable" for name, _ in variables},
        }
        for key, _ in node.value if isinstance(node, MappingNode) else ():
            if isinstance(key, ScalarNode) and key.value in taken:
                message = (
                    f"parameters: {key.value} is {taken[key.value]} already"
                )
                self.source.fault(key, message, "choose another name")

    def _form(self, root: Node, entries: dict[str, Node]) -> str | None:
        present = [key for key in FORMS if key in entries]
        if not present:
            cure = "write one of them, a formula or a list with one for each colour"
            message = "no hamiltonian, no lagrangian and no rhs"
            self.source.fault(root, message, cure)
            return None
        if len(present) > 1:
            message = " and ".join(_WITH_ARTICLE[key] for key in present)
            self.source.fault(entries[present[1]], message, "keep one of them")
        return present[0]

    def _items(self, node: Node, form: str) -> list[tuple[Node, str]]:
        if isinstance(node, ScalarNode):
            return [(node, form)]
        items = self.source.items(node, form)
        if not items and isinstance(node, SequenceNode):
            self.source.fault(
                node, f"{form} is empty", "give a formula for each term"
            )
        if len(items) > MAX_TERMS:
            self.source.fault(
                node,
                f"{form}: {len(items)} terms (limit {MAX_TERMS})",
                "use fewer",
            )
            return []
        letter = form[0].upper()
        return [
            (item, f"{letter}{{{l}}}") for l, item in enumerate(items, start=1)
        ]

    def _t_end(self, node: Node | None) -> fmpq:
        if node is None:
            return DEFAULT_T_END
        found = self.formulas.constant(node, "t_end")
        if found is None:
            return DEFAULT_T_END
        if not isinstance(found[1], fmpq) or found[1] <= 0:
            self.source.fault(
                node,
                "t_end: a positive rational number is expected",
                "such as 2 or 5/2",
            )
            return DEFAULT_T_END
        return found[1]

    def _invariants(
        self, node: Node | None, form: str
    ) -> list[tuple[str, Node]]:
        entries = (
            {} if node is None else self.source.mapping(node, "invariants", ())
        )
        if len(entries) > MAX_INVARIANTS:
            self.source.fault(
                node,
                f"{len(entries)} invariants (limit {MAX_INVARIANTS})",
                "use fewer",
            )
            return []
        for name, value in entries.items():
            if form != "rhs" and name.lower() in {"energy", "h"}:
                self.source.fault(
                    value,
                    f"invariants: {name} is reported always",
                    "leave it out",
                )
        return [(shown_name(name), value) for name, value in entries.items()]


def _initial_cure(variables: list[tuple[str, Node]], form: str | None) -> str:
    values = []
    for name, _ in variables[:2]:
        values.append(
            f"{name}: 0" if form == "rhs" else f"{name}: 0, p{name}: 0"
        )
    return f"write initial: {{{', '.join(values)}}}"


def _derived(variables: list[tuple[str, Node]], form: str) -> dict[str, str]:
    """The names that variables bring with them, and what they are."""
    if form == "rhs":
        return {TIME: "time"}
    names = {f"p{name}": f"the momentum of {name}" for name, _ in variables}
    if form == "lagrangian":
        names |= {
            f"v{name}": f"the velocity of {name}" for name, _ in variables
        }
    return names


def shown_name(text: str) -> str:
    """A name as it is shown: one line of printable signs, not too long."""
    plain = one_line(text)
    return plain if len(plain) <= 60 else f"{plain[:59]}…"
