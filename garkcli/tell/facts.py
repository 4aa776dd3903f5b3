"""A result described once: rows declare what is found, kinds what a value is.

A ``Section`` is the one declaration of a result. Its JSON, its JSON Schema and everything that a
person reads come from it. Rows are declared before there is a result, and asked when it is
reported: what lies too deep is not computed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import IntEnum
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpq

from garkcli.frozen import Frozen, replace
from garkcli.page.schema import Schema, array, nullable, one_of
from garkcli.reason import NO_REASON, Reason

if TYPE_CHECKING:
    from garkcli.plots.scene import Scene
    from garkcli.tell.dialect import Plain


class Level(IntEnum):
    """How far down a fact is reported: in the first sentence, usually, with -v, to programs
    alone.
    """

    HEADLINE = 0
    USUAL = 1
    DETAIL = 2
    DATA = 3


class Said(Frozen):
    """A value with its kind: what a reason is made of."""

    kind: Kind
    value: Any

    def words(self, dialect: Plain) -> str:
        """The value in the signs of a dialect."""
        assert self.kind.words is not None
        return self.kind.words(self.value, dialect)

    def __str__(self) -> str:
        from garkcli.tell.dialect import Plain

        return self.words(Plain())


class Status(Frozen):
    """How a value is known. These are no alternatives: a rounded order can be all three.

    Attributes:
        within: the rounding for which it holds; None for exactly.
        at_least: whether it may be larger.
        open: what is undecided, and why.
    """

    within: fmpq | None = None
    at_least: bool = False
    open: Reason = NO_REASON


SURE = Status()


class Answer(Frozen):
    """A value that comes with more than itself.

    Attributes:
        value: None where there is none, or none is decided.
        status: how it is known.
        reason: why it is so.
        level: where it is reported, if not where its row says.
        more: what its kind needs besides, such as a witness.
        names: of the colours in trees, where they are not numbers.
    """

    value: Any
    status: Status = SURE
    reason: Reason = NO_REASON
    level: Level | None = None
    more: Any = None
    names: Sequence[str] = ()


Words: TypeAlias = "Callable[[Any, Plain], str]"
Getter: TypeAlias = "Callable[[Any], Any] | str | None"


class Beside(Frozen):
    """A field of JSON beside that of a row, from its answer.

    Attributes:
        name: ``*`` in it is what is before the last word of the row's key.
        schema: of its values.
        data: from the answer; None where there is none.
        is_optional: whether it is left out then; otherwise it is null.
    """

    name: str
    schema: Schema
    data: Callable[[Answer, Plain], Any]
    is_optional: bool = True


class Kind(Frozen):
    """What a value is: its schema, its JSON, its words in a dialect.

    Attributes:
        schema: of its JSON.
        data: the value for programs.
        words: the value in the signs of a dialect; None for what only programs read.
        answer_words: the whole answer in words, status and all, where words and status are one.
        phrase: the same as a part of a sentence, from the label; None for label and words.
        cell: the same in a table, where that is shorter.
        lines: a picture of the value, for outputs with room.
        draw: the value in finished lines of the output.
        scene: a picture of the value, which each output draws in its way.
        rows: the value as labels with words, among those of other facts.
        is_data: whether programs get it; pictures and rows of words are for people alone.
        beside: further fields of JSON.
        section: of a value that has facts of its own.
        is_list: whether the value is a list of such.
        is_stream: whether that is reported while it is found.
        by: the heading of a part of such a list, where parts have headings on a terminal.
        is_never_empty: whether that has an entry at least.
        most: of a list that is always a table, so many rows of it are usual; 0 for all.
        absent: what a table has where there is no value.
        csv: the value in CSV where that is not the one of JSON: a cell, or cells by their columns.
    """

    schema: Schema
    data: Callable[[Any, Plain], Any] = lambda value, _: value
    words: Words | None = None
    answer_words: Callable[[Answer, Plain], str] | None = None
    phrase: Callable[[str, Answer, Plain], str] | None = None
    cell: Words | None = None
    lines: Callable[[Any, Plain], list[str]] | None = None
    draw: Callable[[Any, Plain], list[str]] | None = None
    scene: Callable[[Any], Scene] | None = None
    rows: Callable[[Any, Plain], list[tuple[str, str]]] | None = None
    is_data: bool = True
    beside: tuple[Beside, ...] = ()
    section: Section | None = None
    is_list: bool = False
    is_stream: bool = False
    by: Callable[[Any, Plain], str] | None = None
    is_never_empty: bool = False
    most: int | None = None
    absent: str = ""
    csv: Callable[[Any], str | Mapping[str, str]] | None = None

    @property
    def is_below(self) -> bool:
        """Whether it has lines of its own, below the other facts."""
        shown = self.lines, self.draw, self.scene, self.most
        return self.is_stream or any(x is not None for x in shown)

    def __call__(self, value: Any) -> Said:
        """A value of this kind in a reason."""
        return Said(self, value)


class Fact(Frozen):
    """An answer under its row: all that an output gets."""

    row: Row
    answer: Answer
    level: Level

    @property
    def value(self) -> Any:
        """The value of the answer."""
        return self.answer.value

    @property
    def is_something(self) -> bool:
        """Whether there is anything to say."""
        answer = self.answer
        if answer.value is None:
            return bool(answer.reason or answer.status.open)
        return not (isinstance(answer.value, (tuple, list, str)) and not answer.value)


class Row(Frozen):
    """What is declared of a fact.

    Attributes:
        key: its name in JSON; its label and its sentence are found by it.
        kind: of its values.
        get: the value, or an ``Answer``, of what the section describes; a text for a path of
            attributes and places, such as ``rows.0.value``, along which None stays None, or a dot
            for what is described itself; None for the attribute of the key.
        level: where it is reported, or that from its answer.
        has_null: whether there may be no value.
        is_optional: whether JSON leaves it out then.
        label: where it is not the one of the key.
        line: facts with the same word here share a line of the usual text.
        is_short: whether other rows tell it where everything is reported.
    """

    key: str
    kind: Kind
    get: Getter = None
    level: Level | Callable[[Answer], Level] = Level.USUAL
    has_null: bool = False
    is_optional: bool = False
    label: str | None = None
    line: str = ""
    is_short: bool = False

    def answer(self, whole: Any) -> Answer:
        """What is so of a result."""
        found = self.value(whole)
        return found if isinstance(found, Answer) else Answer(found)

    def value(self, whole: Any) -> Any:
        """What ``get`` gets."""
        if callable(self.get):
            return self.get(whole)
        path = self.get or self.key
        if path.isidentifier():  # most are, and lists of trees are long
            return getattr(whole, path)
        for name in path.split("."):
            if whole is not None and name:
                whole = whole[int(name)] if name.isdecimal() else getattr(whole, name)
        return whole

    def fact(self, whole: Any) -> Fact:
        """The same with the level where it is reported."""
        answer = self.answer(whole)
        level = answer.level
        if level is None:
            level = self.level(answer) if callable(self.level) else self.level
        return Fact(self, answer, level)

    def of(self, part: Callable[[Any], Any]) -> Row:
        """The same of a part; none where there is no part."""

        def get(whole: Any) -> Any:
            one = part(whole)
            return None if one is None else self.value(one)

        return replace(self, get=get)

    def fields(self) -> Iterator[tuple[str, Schema, bool]]:
        """The fields of JSON: name, schema, whether it is always there."""
        kind = self.kind
        if not kind.is_data:
            return
        schema = kind.schema if kind.section is None else kind.section.schema
        if kind.is_list:
            schema = {**array(schema), **({"minItems": 1} if kind.is_never_empty else {})}
        yield self.key, nullable(schema) if self.has_null else schema, not self.is_optional
        for field in kind.beside:
            yield field.name.replace("*", self._stem), field.schema, not field.is_optional

    def data(self, whole: Any, dialect: Plain) -> dict[str, Any]:
        """Its fields for a result."""
        kind = self.kind
        if not kind.is_data:
            return {}
        answer = self.answer(whole)
        if answer.value is None and self.is_optional:
            return {}
        found = {self.key: None if answer.value is None else self._plain(answer.value, dialect)}
        for field in kind.beside:
            value = None if answer.value is None else field.data(answer, dialect)
            if value is not None or not field.is_optional:
                found[field.name.replace("*", self._stem)] = value
        return found

    @property
    def _stem(self) -> str:
        return self.key.rpartition("order")[0]

    def _plain(self, value: Any, dialect: Plain) -> Any:
        kind, section = self.kind, self.kind.section
        if section is None:
            return (
                [kind.data(x, dialect) for x in value]
                if kind.is_list
                else kind.data(value, dialect)
            )
        return (
            [section.data(x, dialect) for x in value]
            if kind.is_list
            else section.data(value, dialect)
        )


def maybe(key: str, kind: Kind, get: Getter = None, level: Any = Level.USUAL, **more: Any) -> Row:
    """A row whose value may be none: null in JSON."""
    return Row(key, kind, get, level, has_null=True, **more)


def optional(
    key: str, kind: Kind, get: Getter = None, level: Any = Level.USUAL, **more: Any
) -> Row:
    """A row that JSON leaves out where there is no value."""
    return Row(key, kind, get, level, is_optional=True, **more)


class Section:
    """Rows in order: all that is reported of a kind of result.

    Attributes:
        rows: what is declared.
        title: of a part among others, and of a result: what it is about, such as the file.
        columns: keys of the rows that tell it in a line of a table.
        is_cut: whether the last words of such a line may be cut.
    """

    def __init__(
        self,
        *rows: Row,
        title: Callable[[Any, Plain], str] | None = None,
        columns: Sequence[str] = (),
        is_cut: bool = False,
    ) -> None:
        self.rows = rows
        self.title = title
        self.columns = columns
        self.is_cut = is_cut

    def facts(self, whole: Any, level: Level = Level.DATA) -> Iterator[Fact]:
        """The facts down to a level; what lies deeper by its row is not asked for."""
        for row in self.rows:
            if callable(row.level) or row.level <= level:
                yield row.fact(whole)

    def named(self, whole: Any, keys: Iterable[str]) -> dict[str, Fact]:
        """The facts of some rows."""
        return {row.key: row.fact(whole) for row in self.rows if row.key in keys}

    def data(self, whole: Any, dialect: Plain) -> dict[str, Any]:
        """The result as plain data."""
        found: dict[str, Any] = {}
        for row in self.rows:
            found.update(row.data(whole, dialect))
        return found

    def columns_of(self, level: Level) -> list[Row]:
        """The rows that a part of a stream has as columns, down to a level."""
        if level == Level.DATA:
            return [row for row in self.rows if row.kind.is_data]
        is_deep = level >= Level.DETAIL
        found = [x for x in self.rows if not (x.is_short and is_deep)]
        return [x for x in found if not callable(x.level) and x.level <= level]

    @property
    def schema(self) -> Schema:
        """The JSON Schema of such data."""
        fields = [field for row in self.rows for field in row.fields()]
        return {
            "type": "object",
            "required": [name for name, _, is_required in fields if is_required],
            "properties": {name: schema for name, schema, _ in fields},
            "additionalProperties": False,
        }


class Choice(Section):
    """One of several sections, by what it tells.

    Args:
        of: the one for a value.
        sections: all of them.
    """

    def __init__(self, of: Callable[[Any], Section], *sections: Section) -> None:
        super().__init__()
        self._of = of
        self._sections = sections

    def facts(self, whole: Any, level: Level = Level.DATA) -> Iterator[Fact]:
        return self._of(whole).facts(whole, level)

    def data(self, whole: Any, dialect: Plain) -> dict[str, Any]:
        return self._of(whole).data(whole, dialect)

    @property
    def schema(self) -> Schema:
        return one_of(*(section.schema for section in self._sections))


def via(get: Callable[[Any], Any], rows: Iterable[Row]) -> list[Row]:
    """Rows of a part as rows of its owner."""
    return [row.of(get) for row in rows]
