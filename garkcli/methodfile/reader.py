"""YAML nodes to a ``Description``: every key, shape and word checked, faults collected as they are
met.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Literal, cast

from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.errors import LimitExceeded, UnknownFamily, nearest
from garkcli.exact.expression import read_decimal
from garkcli.families.registry import FAMILIES, require_member
from garkcli.methodfile import expectations
from garkcli.methodfile.description import (
    FORMS,
    MAX_ENTRIES,
    PLAIN,
    STRUCTURES,
    ArkText,
    ButcherText,
    Description,
    FamilyText,
    Form,
    MethodsText,
    PrkText,
    Structure,
    TableauText,
    TransferText,
    block_name,
    of_colour,
)
from garkcli.methodfile.expectations import NUMBERS
from garkcli.methodfile.numbers import Numbers
from garkcli.methodfile.parameters import (
    read_parameters,
    refuse_unknown_settings,
)
from garkcli.methodfile.source import Source, keys_of, shortened
from garkcli.methodfile.spelled_out import SpelledOutReader, are_too_many
from garkcli.transfer import RULES

if TYPE_CHECKING:
    from garkcli.methodfile.shaped import Shaped

KEYS = (
    "gark",
    "name",
    "description",
    "reference",
    *FORMS,
    *PLAIN,
    "unknown",
    "design",
    "transfer",
    "structure",
    "conjugate",
    "linear",
    "parameters",
    "tolerance",
    "expect",
)
"""The keys of a method file."""
_START = "give A and b, or one of the keys methods, tableau, ark, prk"
_CURES = (
    dict.fromkeys(
        (*NUMBERS, "symplectic"),
        "claims go under expect, for instance expect: {order: 4}",
    )
    | dict.fromkeys(
        ("family", "stages"), "write methods: [{family: gauss, stages: 2}]"
    )
    | dict.fromkeys(("blocks", "default"), "it goes under transfer")
    | dict.fromkeys(("q", "p"), "it goes under prk: {q: {A, b}, p: {A, b}}")
    | dict.fromkeys(
        ("bhat", "b_hat", "bh", "b2", "b*", "b^"),
        "embedded weights make another method: give it a file of its own",
    )
    | dict.fromkeys(RULES, "write it under transfer")
)
"""Keys that are expected elsewhere than at the top of the file, and where."""
_DECIMAL = re.compile(
    r"([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?", re.ASCII
)


_METHODS = "write a list: [{family: gauss, stages: 2}, …]"


def _written_out(node: ScalarNode) -> str:
    """The cure for a method that is a mere word."""
    word = nearest(str(node.value), FAMILIES) or "gauss"
    family = FAMILIES[word]
    if family.smallest == family.largest:
        return f"write {{family: {word}}}"
    return f"write for instance {{family: {word}, stages: {max(2, family.smallest)}}}"


class Reader:
    """Reads one file."""

    def __init__(self, source: Source, settings: Mapping[str, str]) -> None:
        self.source = source
        self.numbers = Numbers(source, settings=settings)
        self.spelled_out = SpelledOutReader(source, self.numbers)
        self.shaped: Shaped | None = None
        self.keys: frozenset[str] = frozenset()
        self.design: Node | None = None
        self._root: Node | None = None

    def read(self) -> Description | None:
        """The description; None, with faults noted in the source, where there is none."""
        source = self.source
        root = source.compose()
        if root is None:
            return None
        keys = keys_of(root)
        if keys & {"hamiltonian", "lagrangian"} and not keys & set(FORMS):
            cure = "give it beside a method file: gark converge METHOD --problem FILE"
            source.fault(
                root, "this is a problem file, not a method file", cure
            )
            return None
        entries = source.mapping(root, "the file", KEYS, _CURES)
        self.keys = frozenset(entries)
        self.design = entries.get("design")
        self._root = root
        self._version(entries.get("gark"))
        text = {}
        for key in ("name", "description", "reference"):
            if key in entries:
                text[key] = source.scalar(entries[key], key) or ""
        tolerance = self._tolerance(entries.get("tolerance"))
        is_conjugate = self._is_conjugate(entries.get("conjugate"))
        claims = expectations.read(source, entries.get("expect"))
        read_parameters(self.numbers, entries.get("parameters"))
        form = self._form(root, entries)
        if form is None:
            return None
        if form == "unknown":
            self.shaped = self._shaped(root, entries)
            if self.shaped is None:
                return None
            form = self.shaped.form
        self._refuse_misplaced(form, entries)
        structure = self._structure(form, entries)
        content = self._content(form, structure, entries)
        if content is None:
            return None
        refuse_unknown_settings(self.numbers)
        return Description(
            form=form,
            content=content,
            node=self._node_of(form, entries),
            structure=structure,
            is_conjugate=is_conjugate,
            tolerance=tolerance,
            claims=claims,
            **text,
        )

    def _node_of(self, form: Form, entries: dict[str, Node]) -> Node:
        """Where the coefficients stand."""
        for key in (form, "unknown"):
            if key in entries:
                return entries[key]
        return entries["b"]

    def _shaped(self, root: Node, entries: dict[str, Node]) -> Shaped | None:
        """``unknown`` of the file."""
        from garkcli.methodfile.shaped import ShapeReader  # few files have it

        if "parameters" in entries:
            message = "parameters do not go with unknown: its unknowns have their names"
            cure = "leave them out, or spell the tableau out with them"
            self.source.fault(entries["parameters"], message, cure)
        content = entries["unknown"]
        # the key as it stands there, misspelt perhaps
        key = next(x for x, y in root.value if y is content)
        return ShapeReader(self.source, self.numbers).read(key, content)

    def design_place(self) -> tuple[int, int] | None:
        """From where to where ``design: …`` stands; None where there is none."""
        if self.design is None or self._root is None:
            return None
        key = next(x for x, y in self._root.value if y is self.design)
        start = key.start_mark.index
        end = self.design.end_mark.index
        return start, start + len(self.source.text[start:end].rstrip())

    def _version(self, node: Node | None) -> None:
        if node is not None and self.source.scalar(node, "gark") != "1":
            message = "gark: this program reads version 1 of the format"
            self.source.fault(node, message, "write gark: 1")

    def _tolerance(self, node: Node | None) -> fmpq | None:
        """A rational number between 0 and 1; no parameters, as it is no coefficient."""
        if node is None:
            return None
        text = self.source.scalar(node, "tolerance")
        if text is None:
            return None
        try:
            value = read_decimal(text) if _DECIMAL.fullmatch(text) else None
        except LimitExceeded:
            value = None
        if value is None or not 0 < value < 1:
            wanted = "a decimal number between 0 and 1 is expected"
            message = f"tolerance: {wanted}, not {shortened(text)}"
            self.source.fault(node, message, "for instance 1e-13")
            return None
        return value

    def _form(
        self, root: Node, entries: dict[str, Node]
    ) -> Form | Literal["unknown"] | None:
        """Which form the coefficients have; A, b and c at the top are those of a tableau."""
        present: list[str] = [
            key for key in (*FORMS, "unknown") if key in entries
        ]
        plain = [key for key in PLAIN if key in entries]
        if plain:
            present.append(plain[0])
        for key in present[1:]:
            message = (
                f"{key}: the coefficients are given by {present[0]} already"
            )
            cure = f"keep one of {', '.join(present)}"
            self.source.fault(entries[key], message, cure)
        if not present:
            # a key that belongs elsewhere was noted with its cure, which is where to begin
            if not keys_of(root) & set(_CURES):
                self.source.fault(root, "no coefficients", _START)
            return None
        if len(present) > 1:
            return None
        if not plain:
            return cast("Form", present[0])  # or "unknown"
        missing = [key for key in ("A", "b") if key not in entries]
        if missing:
            message = (
                f"{' and '.join(missing)} missing beside {', '.join(plain)}"
            )
            self.source.fault(
                entries[plain[0]], message, "give A, b and perhaps c"
            )
            return None
        return "tableau"

    def _structure(self, form: Form, entries: dict[str, Node]) -> Structure:
        node = entries.get("structure")
        word = None
        if node is not None:
            word = self.source.choice(node, "structure", STRUCTURES)
        if (
            node is not None
            and form in {"tableau", "ark"}
            and word != "general"
        ):
            cure = "use methods, tableau or prk"
            if form == "tableau":
                cure = "write absent blocks as null"
            self.source.fault(node, f"structure does not go with {form}", cure)
        if node is not None and form == "prk" and word == "semi-separable":
            message = (
                "a prk cannot be semi-separable: that takes two Hamiltonians"
            )
            self.source.fault(node, message, "use methods")
        if self.shaped is not None and form == "prk" and word is None:
            return "separable"
        return cast("Structure", word or "general")

    def _is_conjugate(self, node: Node | None) -> bool:
        if node is None:
            return False
        return (
            self.source.choice(node, "conjugate", ("true", "false")) == "true"
        )

    def _refuse_misplaced(self, form: Form, entries: dict[str, Node]) -> None:
        for key, home in (("transfer", "methods"), ("linear", "tableau")):
            if key in entries and form != home:
                message = f"{key} goes with {home}, not with {form}"
                self.source.fault(entries[key], message, "leave it out")

    def _content(
        self, form: Form, structure: Structure, entries: dict[str, Node]
    ) -> MethodsText | TableauText | ArkText | PrkText | None:
        if self.shaped is not None:
            return self.shaped.content
        if form not in entries:
            return self.spelled_out.tableau_of(entries, entries.get("linear"))
        node = entries[form]
        if form == "methods":
            return self._methods(node, structure, entries.get("transfer"))
        if form == "tableau":
            return self.spelled_out.tableau(node, entries.get("linear"))
        from garkcli.methodfile.ark_prk import (
            ArkReader,
            PrkReader,
        )  # rare forms

        if form == "ark":
            return ArkReader(self.source, self.numbers).read(node)
        return PrkReader(self.source, self.numbers).read(node, structure)

    def _methods(
        self, node: Node, structure: Structure, transfer: Node | None
    ) -> MethodsText | None:
        source = self.source
        if keys_of(node) & {"A", "b", "family", "stages"}:
            items = [node]  # one method needs no brackets around it
        else:
            items = source.items(node, "methods", _METHODS)
        if are_too_many(source, items, node):
            return None
        methods = [
            self._method(item, l) for l, item in enumerate(items, start=1)
        ]
        if not items and isinstance(node, SequenceNode):
            cure = "list at least one diagonal method"
            source.fault(node, "methods is empty", cure)
        if structure != "general" and len(items) != 2:
            message = (
                f"structure: {structure} is for two colours, not {len(items)}"
            )
            source.fault(node, message)
        if len(items) > 1 and transfer is None:
            cure = "write transfer: collocation (or interpolation)"
            source.fault(
                node, "two colours or more need a transfer rule", cure
            )
        rules = TransferText(None, {})
        if transfer is not None:
            from garkcli.methodfile.transfers import TransferReader

            reader = TransferReader(source, self.numbers)
            rules = reader.read(transfer, len(items))
        found = tuple(method for method in methods if method is not None)
        if not found or len(found) < len(methods):
            return None
        if self._is_too_large(found, node):
            return None
        return MethodsText(found, rules)

    def _is_too_large(
        self, methods: Sequence[FamilyText | ButcherText], node: Node
    ) -> bool:
        """Note blocks between the methods that together have too many entries to be made."""
        stages = [
            x.stages if isinstance(x, FamilyText) else len(x.b)
            for x in methods
        ]
        inside = sum(s * s for s in stages)
        entries = sum(stages) ** 2 - inside
        if entries <= MAX_ENTRIES:
            return False
        where = "in the blocks between the methods"
        message = f"{entries} entries {where} (limit {MAX_ENTRIES})"
        self.source.fault(node, message, "use fewer methods, or fewer stages")
        return True

    def _method(self, node: Node, l: int) -> FamilyText | ButcherText | None:
        keys, where = keys_of(node), f"method {l}"
        if isinstance(node, ScalarNode):
            message = f"{where}: a mapping is expected here"
            self.source.fault(node, message, _written_out(node))
            return None
        # of anything but a mapping there are no keys
        if "stages" in keys and not keys & {"family", "A", "b"}:
            cure = "write for instance family: gauss"
            self.source.fault(node, f"{where}: family missing", cure)
            return None
        if "family" not in keys and isinstance(node, MappingNode):
            k = l - 1
            names = (block_name(k, k), of_colour("b", k), of_colour("c", k))
            return self.spelled_out.butcher(node, where, names)
        before = len(self.source.faults)
        form = "write for instance {family: gauss, stages: 2}"
        keys_of_family = ("family", "stages", "name")
        entries = self.source.mapping(node, where, keys_of_family, form=form)
        if "family" not in entries or len(self.source.faults) > before:
            return None
        return self._family(node, where, entries)

    def _family(
        self, node: Node, where: str, entries: dict[str, Node]
    ) -> FamilyText | None:
        """A member of a family, which exists."""
        name = self.source.scalar(entries["family"], f"{where}, family")
        has_stages = "stages" in entries
        stages = None
        if has_stages:
            node_of_stages = entries["stages"]
            stages = self.source.whole(
                node_of_stages, f"{where}, stages", smallest=1
            )
        if name is None or (
            name in FAMILIES and has_stages and stages is None
        ):
            return None
        try:
            return FamilyText(node, name, require_member(name, stages))
        except UnknownFamily as error:
            at_stages = name in FAMILIES and has_stages
            place = entries["stages" if at_stages else "family"]
            self.source.fault(place, error.message, error.help)
            return None
