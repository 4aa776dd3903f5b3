"""The reader of method files: checks every key and word, and collects all faults."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Literal, cast

from garkcli.errors import did_you_mean
from garkcli.frozen import replace
from garkcli.glossary.key import METHOD_FILE
from garkcli.grammar import keys as g
from garkcli.grammar.keys import FILE, entries_in
from garkcli.grammar.nodes import Extent, MappingNode, Node, extent, key_of, keys_of, node_at
from garkcli.grammar.source import Entries, Source
from garkcli.methodfile import description as d
from garkcli.methodfile.file_keys import BESIDE_FORM, FORM, KEYS, KEYS_OF_METHOD, elsewhere
from garkcli.methodfile.numbers import Numbers, NumbersReader
from garkcli.methodfile.parameters import refuse_unknown_settings
from garkcli.methodfile.spelled_out import tableau, tableau_of

if TYPE_CHECKING:
    from garkcli.methodfile.constructed.parts import Open, Opened
    from garkcli.methodfile.shapes import Shaped
    from garkcli.methodfile.tolerance import Tolerance
    from garkcli.methodfile.wishes import Wishes


_EXAMPLE = "write for instance {family: rk4}, {A: …, b: …} or a name of the catalogue"


class ContentReader(NumbersReader):
    """``shaped`` is the tableau of ``unknown``; ``tolerance`` is None for exact coefficients."""

    def __init__(self, numbers: Numbers, opened: Open) -> None:
        super().__init__(numbers)
        self._open = opened
        self.shaped: Shaped | None = None
        self.tolerance: Tolerance | None = None

    def read(self, root: MappingNode, entries: Entries) -> d.Description | None:
        is_conjugate = bool(self._value("conjugate", entries))
        form = self._form(root, entries)
        if form is None:
            return None
        for rule in BESIDE_FORM:
            rule.refuse(self.source, root, FILE, entries, form)
        if form == "unknown":
            from garkcli.methodfile.shapes import shaped  # few files have it

            # the key as it is there, misspelt perhaps
            self.shaped = shaped(self, key_of(root, entries[form]), entries[form])
            if self.shaped is None:
                return None
            form, entries = self.shaped.form, {**entries, **self.shaped.entries}
        structure = self._structure(form, entries)
        content = self._content(form, structure, entries)
        if content is None:
            return None
        if is_conjugate:
            texts = content.beside
            further = [x.node for x in texts if x.node is not None]
            further += [x.predictor.node for x in texts if x.predictor is not None]
            for place in further[:1]:
                message = "conjugate: the symplectic conjugate has no embedded weights, dense "
                message += "output or predictor"
                self.source.fault(place, message, "leave them out", code="not-together")
        place = next(entries[key] for key in (form, "unknown", "b") if key in entries)
        return d.Description(form, content, place, structure, is_conjugate)

    def _form(self, root: Node, entries: Entries) -> d.Form | Literal["unknown"] | None:
        """The form of the coefficients; A, b and c at the top are those of a tableau."""
        given = FORM.given(entries)
        if not given:
            begun = [home.key for key, home in elsewhere().items() if key in keys_of(root)]
            if not {"transfer", *d.FORMS}.isdisjoint(begun):
                return None  # such a key was noted with its cure, which is where to begin
        before = len(self.source.faults)
        FORM.refuse(self.source, root, FILE, entries)
        if given and len(self.source.faults) == before:
            return cast("d.Form", "tableau" if given[0] in d.PLAIN else given[0])  # or "unknown"
        return None

    def _structure(self, form: d.Form, entries: Entries) -> d.Structure:
        """Reports a structure that does not go with the form."""
        word = self._value("structure", entries)
        is_of_flows = form == "splitting" and "of" not in keys_of(entries[form])
        is_split = is_of_flows or (self.shaped is not None and form == "prk")
        if "structure" not in entries:
            return "separable" if is_split else "general"
        cure = ""
        if form == "splitting" and word != "general":
            if not is_of_flows or word == "semi-separable":
                cure = "a splitting without of is separable or nystrom"
        elif self.shaped is not None and (word == "semi-separable" or form != "prk"):
            cure = "leave it out"
        if cure and word != "general":
            message = f"structure does not go with {form}"
            self.source.fault(entries["structure"], message, cure, code="not-together")
        return cast("d.Structure", word or "general")

    def _value(self, key: str, entries: Entries) -> Any:
        return KEYS[key].kind.read(self, entries[key], key) if key in entries else None

    def _inside(self, node: Node, where: str) -> d.Description | None:
        reader = ContentReader(self.numbers, self._open)
        reader.tolerance = self.tolerance
        if isinstance(node, MappingNode) and "family" in keys_of(node):
            root = node_at({"methods": node}, node)
            assert isinstance(root, MappingNode)
            return reader.read(root, {"methods": node})
        keys = {key: KEYS[key] for key in KEYS_OF_METHOD}
        entries = entries_in(self.source, node, where, keys, elsewhere, _EXAMPLE)
        return reader.read(node, entries) if isinstance(node, MappingNode) else None

    def _content(self, form: d.Form, structure: d.Structure, entries: Entries) -> d.Content | None:
        if form not in entries:
            return tableau_of(self, entries, entries.get("linear"))
        node = entries[form]
        if form == "methods":
            from garkcli.methodfile.diagonal import methods  # which loads every family

            return methods(self, node, structure, entries.get("transfer"))
        if form == "tableau":
            return tableau(self, node, entries.get("linear"))
        # rare forms
        if form in d.CONSTRUCTIONS:
            from garkcli.methodfile.constructed.parts import PartReader

            inside = self._inside, self._open
            parts = PartReader(self.numbers, *inside, self.tolerance, structure)
            construction: d.ConstructionText | None = KEYS[form].kind.read(parts, node, form)
            return construction
        if form == "prk":
            from garkcli.methodfile.ark_prk import prk

            return prk(self, node, structure)
        content: d.Content | None = g.declared(*_READERS[form])(self, node)
        return content


_READERS = {
    form: (f"garkcli.methodfile.{module}", function)
    for form, module, function in (
        ("ark", "ark_prk", "ark"),
        ("shu-osher", "registers", "shu_osher"),
        ("low-storage", "registers", "low_storage"),
        ("rosenbrock", "rosenbrock", "rosenbrock"),
        ("nystrom", "nystrom", "nystrom"),
        ("nprk", "nprk", "nprk"),
        ("derivatives", "derivatives", "derivatives"),
    )
}
"""The functions that read rare forms, imported when they are needed."""
_ABOUT = (
    *("gark", "name", "description", "aliases", "reference", "tolerance", "expect"),
    "parameters",
)


class MethodReader(NumbersReader):
    """Reads one file; ``inside`` has the methods being read that refer to it."""

    def __init__(
        self, source: Source, settings: Mapping[str, str], inside: tuple[str, ...] = ()
    ) -> None:
        self.source = source
        self.numbers = Numbers(source, settings=settings)
        self.content = ContentReader(self.numbers, self._opened)
        self._inside = inside
        self.keys: frozenset[str] = frozenset()
        self.design: Node | None = None
        self.wishes: Wishes | None = None
        self._entries: Entries = {}
        self._root: MappingNode | None = None

    def read(self) -> d.Description | None:
        source = self.source
        root = source.compose()
        if root is None:
            return None
        entries = entries_in(source, root, FILE, KEYS, elsewhere)
        self.keys = frozenset(entries)
        self.design = entries.get("design")
        self._entries = entries
        self._root = root
        said = {
            key: KEYS[key].kind.read(self, entries[key], key) for key in _ABOUT if key in entries
        }
        tolerance: Tolerance | None = said.get("tolerance")
        self.content.tolerance = tolerance
        description = self.content.read(root, entries)
        if description is None:
            return None
        if self.numbers.settings:
            refuse_unknown_settings(self.numbers)
        if self.design is not None:
            from garkcli.methodfile.wishes import read_wishes  # few files have it

            self.wishes = read_wishes(self, self.design)
        if self.content.shaped is not None:
            self._refuse_unused(self.content.shaped.layout.unknowns)
        tolerance = self._tolerance(tolerance, description.content)
        reference, bibliography = said.get("reference", ("", None))
        return replace(
            description,
            name=said.get("name") or "",
            description=said.get("description") or "",
            tolerance=tolerance,
            rounding=None if tolerance is None else tolerance.largest(self.numbers.entries),
            claims=said.get("expect", ()),
            aliases=said.get("aliases", ()),
            reference=reference,
            bibliography=bibliography,
        )

    @staticmethod
    def _tolerance(own: Tolerance | None, content: d.Content) -> Tolerance | None:
        inside = content.tolerance if isinstance(content, d.ConstructionText) else None
        if own is not None or not inside:
            return own
        from garkcli.methodfile.tolerance import same_for_all  # few files are rounded

        return same_for_all(inside)

    def _refuse_unused(self, unknowns: Iterable[str]) -> None:
        for name, node in self.numbers.places.items():
            if name not in self.numbers.used:
                message = f"parameters: {name} is not an unknown of the shape, and not used"
                cure = did_you_mean(name, unknowns)
                self.source.fault(node, message, cure, code="unknown-word")

    @property
    def shaped(self) -> Shaped | None:
        return self.content.shaped

    def _opened(self, name: str) -> Opened:
        from garkcli.methodfile.constructed.parts import Opened
        from garkcli.methodfile.naming import read_argument

        text, method = read_argument(f"catalogue:{name}")
        source = Source(method, text, METHOD_FILE)
        if method in self._inside:
            message, cure = f"{method} is made from itself", "name another method"
            source.fault(None, message, cure, code="made-from-itself")
            raise source.error()
        reader = MethodReader(source, {}, (*self._inside, method))
        description = reader.read()
        if description is None:
            raise source.error()
        return Opened(source, reader.numbers, description)

    def place_of(self, key: str) -> Extent | None:
        node = self._entries.get(key)
        if node is None or self._root is None:
            return None
        return extent(self.source.text, key_of(self._root, node), node)
