"""The names of the variables of a problem file, and what else would be called like them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.exact.formula import RESERVED
from garkcli.methodfile.formulas import bad_name
from garkcli.methodfile.problem_keys import KEYS
from garkcli.methodfile.source import Entries, Source
from garkcli.methodfile.words import shortened
from garkcli.problems.vectorfield import TIME

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
