"""A result told in every format by the same renderer."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from itertools import chain
from typing import Any, Generic, Never, TypeAlias, TypedDict, TypeVar, Unpack

from garkcli.frozen import Frozen
from garkcli.page.json_text import to_json
from garkcli.page.look import PLAIN, Look
from garkcli.page.schema import Schema, array, one_of, published
from garkcli.tableau.letters import Defined, with_letters
from garkcli.tableau.tableau import Tableau
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Level, Plot, Section, Stream
from garkcli.tell.outputs import body, labelled, many, one

Whole = TypeVar("Whole")
Labelled: TypeAlias = "tuple[str, list[tuple[str, str]]]"
Lines: TypeAlias = "tuple[Section[Any], Iterable[Any]]"
TABLES = ("markdown", "latex")
"""Several results are a table in these formats, unless everything is requested."""
NOTHING: Section[object] = Section()
CLOSED = {"additionalProperties": False}
FORMATS = ("text", "json", "markdown", "latex")


class DialectSigns(TypedDict, total=False):
    digits: int
    width: int
    colours: Sequence[str]
    names: Sequence[str]
    parameter: str
    places: int | None
    is_inserted: bool


def dialect_of(format: str = "text", look: Look = PLAIN) -> type[Plain]:
    if format == "latex":
        from garkcli.tell.latex import Latex

        return Latex
    if format == "markdown":
        from garkcli.tell.markdown import Markdown

        return Markdown
    if format == "html":
        from garkcli.tell.html import Html

        return Html
    if format == "text" and (look.is_drawn or look.has_colour):
        from garkcli.tell.terminal import Coloured, Terminal  # they need rich

        return Terminal if look.is_drawn else Coloured
    return Plain


class Report(Frozen, Generic[Whole]):
    """The report of a command: of each file a result, by the rows of its form.

    Attributes:
        forms: all sections that tell a result.
        key: of the list of results in JSON; empty for a single result, whose fields are at the top.
        tail: further fields of the document, of all results.
        is_open: whether the schema allows other fields.
        lines: the parts of a result that CSV has, with the section that tells them.
        letters: the method of a result in whose numbers roots of polynomials have letters.
        taken: letters that a text has for something else.
    """

    schema_name: str
    title: str
    forms: Callable[[], Iterable[Section[Never]]]
    form: Callable[[Whole], Section[Whole]]
    signs: Callable[[Whole], DialectSigns] = lambda _: {}
    key: str = "files"
    tail: Section[Sequence[Whole]] = NOTHING
    is_open: bool = False
    lines: Callable[[Whole], Lines] | None = None
    letters: Callable[[Whole], Tableau | None] = lambda _: None
    taken: str = ""

    @classmethod
    def only(
        cls,
        schema_name: str,
        title: str,
        section: Section[Whole],
        signs: Callable[[Whole], DialectSigns] = lambda _: {},
        lines: Callable[[Whole], Lines] | None = None,
        letters: Callable[[Whole], Tableau | None] = lambda _: None,
    ) -> Report[Whole]:
        """A report of one result, whose fields are at the top."""
        return cls(
            schema_name,
            title,
            lambda: [section],
            lambda _: section,
            signs,
            key="",
            lines=lines,
            letters=letters,
        )

    def render(
        self,
        wholes: Sequence[Whole],
        format: str = "text",
        look: Look = PLAIN,
        verbosity: int = 0,
        **signs: Unpack[DialectSigns],
    ) -> str:
        """All results in one of ``FORMATS``; verbosity −1 has the answers alone, 1 everything."""
        if format == "json":
            return self.json(wholes)
        if format == "csv":
            from garkcli.tell.csv import csv_text

            assert self.lines is not None
            return "".join(csv_text(*self.lines(x)) for x in wholes)
        level = Level.DETAIL if verbosity > 0 or format == "latex" else Level.USUAL
        if verbosity < 0:
            level = Level.HEADLINE
        if len(wholes) > 1 and verbosity == 0 and format in TABLES and self.columns(wholes[0]):
            return self.table(wholes, format)
        texts = (self._rendered(x, format, look, level, **signs) for x in wholes)
        return ("" if level == Level.HEADLINE and format == "text" else "\n").join(texts)

    def pieces(
        self,
        whole: Whole,
        format: str = "text",
        look: Look = PLAIN,
        verbosity: int = 0,
        **signs: Unpack[DialectSigns],
    ) -> Iterator[str]:
        """Yields the report in pieces as they are found; verbosity −1 leaves out the stream."""
        form = self.form(whole)
        streams = [row for row in form.rows if isinstance(row.kind.shown, Stream)]
        if not streams and format == "ndjson":
            yield _json_line(self.document([whole])) + "\n"
        elif not streams:
            brief = self.render([whole], format, look, verbosity, **signs)
            yield brief or self.render([whole], format, look, **signs)
        elif format == "json":
            yield from self._json_pieces(form, whole)
        elif format in ("csv", "ndjson"):
            from garkcli.tell.csv import csv_lines

            (row,) = streams
            shown, parts = row.kind.shown, row.fact(whole).value
            assert isinstance(shown, Stream)
            d = Plain(**self.signs(whole))
            if format == "csv":
                yield from csv_lines(shown.section, parts, d)
            else:
                yield from (_json_line(shown.section.data(x, d)) + "\n" for x in parts)
        else:
            if verbosity < 0:  # the stream is counted and not shown
                for row in streams:
                    deque(row.fact(whole).value, 0)
                form = Section([row for row in form.rows if row not in streams])
            level = Level.DETAIL if verbosity > 0 or format == "latex" else Level.USUAL
            d = self.dialect(whole, format, look, level < Level.DETAIL, **signs)
            yield from d.page(one(form, whole, d, level))

    def _json_pieces(self, form: Section[Whole], whole: Whole) -> Iterator[str]:
        """The document, with a line for each part of its stream."""
        d = Plain(**self.signs(whole))
        yield f'{{"schema": "{self.schema_name}"'
        for row in form.rows:
            if not isinstance(row.kind.shown, Stream):
                if fields := row.data(whole, d):
                    yield f", {_json_line(fields)[1:-1]}"
                continue
            yield f', "{row.key}": ['
            separator = "\n"
            for part in row.fact(whole).value:
                yield separator + _json_line(row.kind.shown.section.data(part, d))
                separator = ",\n"
            yield "\n]"
        yield "}\n"

    def dialect(
        self,
        whole: Whole,
        format: str,
        look: Look = PLAIN,
        is_brief: bool = True,
        **signs: Unpack[DialectSigns],
    ) -> Plain:
        merged: DialectSigns = {**self.signs(whole), **signs}
        return dialect_of(format, look)(look=look, is_brief=is_brief, **merged)

    def _rendered(
        self, whole: Whole, format: str, look: Look, level: Level, **signs: Unpack[DialectSigns]
    ) -> str:
        d = self.dialect(whole, format, look, level < Level.DETAIL, **signs)
        with self._lettered(whole) as d.letters:
            return "".join(d.page(one(self.form(whole), whole, d, level)))

    def _lettered(self, whole: Whole) -> AbstractContextManager[Defined]:
        return with_letters(self.letters(whole), taken=self.taken)

    def columns(self, whole: Whole) -> Sequence[str]:
        return self.form(whole).columns

    def table(self, wholes: Sequence[Whole], format: str) -> str:
        signs = self.dialect(wholes[0], format)
        return "".join(signs.page(many(self.form, wholes, lambda x: self.dialect(x, format))))

    def html(self, whole: Whole) -> str:
        """Returns HTML for notebooks, with pictures."""
        form, d = self.form(whole), self.dialect(whole, "html", is_brief=True)
        pictures = Section([row for row in form.rows if isinstance(row.kind.shown, Plot)])
        with self._lettered(whole) as d.letters:
            lines = one(form, whole, d), body(pictures, whole, d, Level.DETAIL, 1)
            return "".join(d.page(chain(*lines)))

    def labelled(
        self, whole: Whole, d: Plain, level: Level, without: Collection[str] = ()
    ) -> list[Labelled]:
        return list(labelled(self.form(whole), whole, d, level, without))

    def data(self, whole: Whole) -> dict[str, Any]:
        return self.form(whole).data(whole, Plain(**self.signs(whole)))

    def document(self, wholes: Sequence[Whole]) -> dict[str, Any]:
        results = [self.data(x) for x in wholes]
        if not self.key:
            return {"schema": self.schema_name, **results[0]}
        return {"schema": self.schema_name, self.key: results, **self.tail.data(wholes, Plain())}

    def json(self, wholes: Sequence[Whole]) -> str:
        return to_json(self.document(wholes)) + "\n"

    @property
    def schema(self) -> Schema:
        return published(self.title, one_or_more(self.documents))

    @property
    def documents(self) -> list[Schema]:
        results = [section.schema for section in self.forms()]
        if not self.key:
            return [self._document(x) for x in results]
        tail = self.tail.schema
        required = [self.key, *tail["required"]]
        properties = {self.key: array(one_or_more(results)), **tail["properties"]}
        return [self._document({"required": required, "properties": properties})]

    def _document(self, fields: Schema) -> Schema:
        schema = {
            "type": "object",
            "required": ["schema", *fields["required"]],
            "properties": {"schema": {"const": self.schema_name}, **fields["properties"]},
        }
        return schema if self.is_open else {**schema, **CLOSED}


def _json_line(data: dict[str, Any]) -> str:
    return to_json(data, indent=None)


def one_or_more(schemas: Sequence[Schema]) -> Schema:
    return schemas[0] if len(schemas) == 1 else one_of(*schemas)


class ListReport(Report[Whole]):
    """The JSON of a single result is a bare list."""

    def json(self, wholes: Sequence[Whole]) -> str:
        (found,) = self.data(wholes[0]).values()
        return to_json(found) + "\n"

    @property
    def schema(self) -> Schema:
        (section,) = self.forms()
        (schema,) = section.schema["properties"].values()
        return published(self.title, schema)
