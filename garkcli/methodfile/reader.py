"""YAML nodes to a ``Description``: every key, shape and word checked, faults collected as they are
met.
"""

from __future__ import annotations

import re
from typing import cast

from flint import fmpq
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.errors import LimitExceeded
from garkcli.exact.expression import read_decimal
from garkcli.methodfile import expectations
from garkcli.methodfile.description import (
    FORMS,
    STRUCTURES,
    ArkText,
    BlockText,
    ButcherText,
    Description,
    FamilyText,
    Form,
    MatrixText,
    MethodsText,
    PrkText,
    RuleText,
    Structure,
    TableauText,
    TransferText,
)
from garkcli.methodfile.numbers import Numbers, read_parameters
from garkcli.methodfile.source import Source, keys_of
from garkcli.methodfile.spelled_out import SpelledOutReader
from garkcli.transfer import PAIR_RULES, RULES

KEYS = (
    "gark",
    "name",
    "description",
    "reference",
    *FORMS,
    "transfer",
    "structure",
    "conjugate",
    "linear",
    "parameters",
    "tolerance",
    "expect",
)
"""The keys of a method file."""
ALL_RULES = (*RULES, *PAIR_RULES)
_DECIMAL = re.compile(r"([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?", re.ASCII)
_BLOCK = re.compile(r"\s*([1-9][0-9]{0,3})\s*,\s*([1-9][0-9]{0,3})\s*")


class Reader:
    """Reads one file."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.numbers = Numbers(source)
        self.spelled_out = SpelledOutReader(source, self.numbers)

    def read(self) -> Description | None:
        """The description; None, with faults noted in the source, where there is none."""
        source = self.source
        root = source.compose()
        if root is None:
            return None
        if keys_of(root) & {"hamiltonian", "lagrangian"} and not keys_of(root) & set(FORMS):
            cure = "give it beside a method file: gark converge METHOD --problem FILE"
            source.fault(root, "this is a problem file, not a method file", cure)
            return None
        entries = source.mapping(root, "the file", KEYS)
        version = entries.get("gark")
        if version is not None and source.scalar(version, "gark") != "1":
            source.fault(
                version, "gark: this program reads version 1 of the format", "write gark: 1"
            )
        text = {
            key: source.scalar(entries[key], key) or ""
            for key in ("name", "description", "reference")
            if key in entries
        }
        tolerance = self._tolerance(entries.get("tolerance"))
        is_conjugate = self._is_conjugate(entries.get("conjugate"))
        claims = expectations.read(source, entries.get("expect"))
        read_parameters(self.numbers, entries.get("parameters"))
        form = self._form(root, entries)
        if form is None:
            return None
        self._refuse_misplaced(form, entries)
        structure = self._structure(form, entries)
        content = self._content(form, structure, entries)
        if content is None:
            return None
        return Description(
            form=form,
            content=content,
            node=entries[form],
            structure=structure,
            is_conjugate=is_conjugate,
            tolerance=tolerance,
            claims=claims,
            **text,
        )

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
            message = f"tolerance: a decimal number between 0 and 1 is expected, not {text!r}"
            self.source.fault(node, message, "for instance 1e-13")
            return None
        return value

    def _form(self, root: Node, entries: dict[str, Node]) -> Form | None:
        present = [key for key in FORMS if key in entries]
        if len(present) == 1:
            return present[0]
        if not present:
            self.source.fault(root, "no coefficients", f"give one of the keys {', '.join(FORMS)}")
        for key in present[1:]:
            message = f"{key}: the coefficients are given by {present[0]} already"
            self.source.fault(entries[key], message, f"keep one of {', '.join(present)}")
        return None

    def _structure(self, form: Form, entries: dict[str, Node]) -> Structure:
        node = entries.get("structure")
        word = self.source.choice(node, "structure", STRUCTURES) if node is not None else None
        if node is not None and form in {"tableau", "ark"} and word != "general":
            cure = (
                "write absent blocks as null"
                if form == "tableau"
                else "use methods, tableau or prk"
            )
            self.source.fault(node, f"structure does not go with {form}", cure)
        if node is not None and form == "prk" and word == "semi-separable":
            self.source.fault(
                node, "a prk cannot be semi-separable: that takes two Hamiltonians", "use methods"
            )
        return cast("Structure", word or "general")

    def _is_conjugate(self, node: Node | None) -> bool:
        return (
            node is not None and self.source.choice(node, "conjugate", ("true", "false")) == "true"
        )

    def _refuse_misplaced(self, form: Form, entries: dict[str, Node]) -> None:
        for key, home in (("transfer", "methods"), ("linear", "tableau")):
            if key in entries and form != home:
                self.source.fault(
                    entries[key], f"{key} goes with {home}, not with {form}", "leave it out"
                )

    def _content(
        self, form: Form, structure: Structure, entries: dict[str, Node]
    ) -> MethodsText | TableauText | ArkText | PrkText | None:
        node = entries[form]
        if form == "methods":
            return self._methods(node, structure, entries.get("transfer"))
        if form == "tableau":
            return self.spelled_out.tableau(node, entries.get("linear"))
        if form == "ark":
            return self.spelled_out.ark(node)
        return self.spelled_out.prk(node, structure)

    def _methods(
        self, node: Node, structure: Structure, transfer: Node | None
    ) -> MethodsText | None:
        items = self.source.items(node, "methods")
        methods = [self._method(item, l) for l, item in enumerate(items, start=1)]
        if not items and isinstance(node, SequenceNode):
            self.source.fault(node, "methods is empty", "list at least one diagonal method")
        if structure != "general" and len(items) != 2:
            self.source.fault(node, f"structure: {structure} is for two colours, not {len(items)}")
        if len(items) > 1 and transfer is None:
            cure = "write transfer: collocation (or interpolation)"
            self.source.fault(node, "two colours or more need a transfer rule", cure)
        rules = (
            self._transfer(transfer, len(items)) if transfer is not None else TransferText(None, {})
        )
        found = tuple(method for method in methods if method is not None)
        return MethodsText(found, rules) if found and len(found) == len(methods) else None

    def _method(self, node: Node, l: int) -> FamilyText | ButcherText | None:
        keys, where = keys_of(node), f"method {l}"
        if isinstance(node, MappingNode) and keys & {"stages"} and not keys & {"family", "A", "b"}:
            self.source.fault(node, f"{where}: family missing", "write for instance family: gauss")
            return None
        if "family" not in keys and isinstance(node, MappingNode):
            return self.spelled_out.butcher(
                node, where, (f"A^{{{l},{l}}}", f"b^{{{l}}}", f"c^{{{l}}}")
            )
        before = len(self.source.faults)
        entries = self.source.mapping(node, where, ("family", "stages", "name"))
        if "family" not in entries or len(self.source.faults) > before:
            return None
        name = self.source.scalar(entries["family"], f"{where}, family")
        stages = None
        if "stages" in entries:
            stages = self.source.whole(entries["stages"], f"{where}, stages", smallest=1)
            if stages is None:
                return None
        return FamilyText(node, name, stages) if name is not None else None

    def _transfer(self, node: Node, colours: int) -> TransferText:
        keys = keys_of(node)
        if not keys & {"default", "blocks"}:
            return TransferText(self._rule(node, "transfer"), {})
        entries = self.source.mapping(node, "transfer", ("default", "blocks"))
        default = (
            self._rule(entries["default"], "transfer, default") if "default" in entries else None
        )
        blocks: dict[tuple[int, int], BlockText] = {}
        if "blocks" in entries:
            for key, value in self.source.mapping(
                entries["blocks"], "transfer, blocks", ()
            ).items():
                place = _BLOCK.fullmatch(key)
                l, m = (int(place[1]) - 1, int(place[2]) - 1) if place else (0, 0)
                if l == m or max(l, m) >= colours:
                    message = f"transfer, blocks: {key!r} names no off-diagonal block of {colours} colours"
                    self.source.fault(
                        value, message, 'write for instance "1,2" for the block A^{1,2}'
                    )
                    continue
                where = f"A^{{{l + 1},{m + 1}}}"
                if (l, m) in blocks:
                    self.source.fault(
                        value, f"transfer, blocks: {where} is given twice", "keep one of them"
                    )
                block = (
                    MatrixText(value, self.numbers.matrix(value, where))
                    if isinstance(value, SequenceNode)
                    else self._rule(value, where)
                )
                if block is not None:
                    blocks[l, m] = block
        return TransferText(default, blocks)

    def _rule(self, node: Node, where: str) -> RuleText | None:
        if isinstance(node, ScalarNode):
            rule = self.source.choice(node, where, ALL_RULES)
            return RuleText(node, ((rule, None),)) if rule else None
        mixed = sorted(keys_of(node) & set(PAIR_RULES))
        if mixed:
            message = (
                f"{where}: {mixed[0]} makes both blocks of a pair of colours and cannot be combined"
            )
            self.source.fault(node, message, f"write {mixed[0]} on its own")
            return None
        entries = self.source.mapping(node, where, RULES)
        if not entries:
            if isinstance(node, MappingNode) and not node.value:
                self.source.fault(node, f"{where}: no rule", f"one of: {', '.join(ALL_RULES)}")
            return None
        terms = (
            (rule, self.numbers.entry(x, f"{where}, weight of {rule}"))
            for rule, x in entries.items()
        )
        return RuleText(node, tuple(terms))
