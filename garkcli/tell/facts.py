"""A result described once: rows declare what is found, kinds what a value is and how it is shown.

A ``Section`` is the one declaration of a result of a type, which mypy checks each row against. The
JSON of the result, its JSON Schema and every text come from it. Rows are declared before there is
a result, and asked when it is reported: what lies too deep is not computed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from copy import copy
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeAlias, TypedDict, TypeVar, Unpack

from garkcli.frozen import Frozen
from garkcli.page.schema import Schema, array, nullable, one_of
from garkcli.reason import NO_REASON, Reason
from garkcli.tell.dialect import SURE, Plain, Status

if TYPE_CHECKING:
    from garkcli.order.certificate import Witness
    from garkcli.plots.scene import Scene


T = TypeVar("T")
U = TypeVar("U")
V = TypeVar("V")
T_in = TypeVar("T_in", contravariant=True)
V_in = TypeVar("V_in", contravariant=True)
V_out = TypeVar("V_out", covariant=True)
Wording: TypeAlias = "Callable[[T, Plain], str]"
Labelling: TypeAlias = "Callable[[T, Plain], Iterable[tuple[str, str]]]"
Phrasing: TypeAlias = "Callable[[str, T, Answer[T], Plain], str]"


class Display(Frozen, Generic[V_in]):
    pass


class Words(Display[V_in]):
    """``whole`` is the answer with status and reason, ``phrase`` a part of a sentence in place of
    label and words, ``absent`` the cell of a table without a value.
    """

    words: Wording[V_in]
    whole: Callable[[V_in, Answer[V_in], Plain], str] | None = None
    phrase: Phrasing[V_in] | None = None
    absent: str = ""


class Labels(Display[V_in]):
    rows: Labelling[V_in]


class Below(Display[V_in]):
    """A display in lines of its own, below the other facts."""


class TextPicture(Below[V_in]):
    lines: Callable[[V_in, Plain], Sequence[str]]


class Drawing(Below[V_in]):
    draw: Callable[[V_in, Plain], Iterable[str]]


class Plot(Below[V_in]):
    scene: Callable[[V_in], Scene]


class OnePart(Display[T]):
    """One line of facts, or ``words``; with -v each fact alone."""

    section: Section[T]
    words: Wording[T] | None = None
    phrase: Phrasing[T] | None = None

    def values(self, value: T) -> Sequence[T]:
        return [value]


class ManyParts(Display[Sequence[T]]):
    """A line ``words`` for all parts; ``most`` rows are usual, 0 for all, None for a line."""

    section: Section[T]
    words: Wording[Sequence[T]] | None = None
    most: int | None = None

    def values(self, value: Sequence[T]) -> Sequence[T]:
        return value


class Stream(Below[Iterable[T]]):
    """A line for each part as soon as it is found, on a terminal below headings by ``by``."""

    section: Section[T]
    by: Wording[T] | None = None


class Level(IntEnum):
    """First lines, usual reports, those with -v, those for programs."""

    HEADLINE = 0
    USUAL = 1
    DETAIL = 2
    DATA = 3


class Answer(Frozen, Generic[V_out]):
    """``value`` is None if there is none, or none is decided; ``level`` replaces that of the row;
    ``witness`` is for orders whose value has none; ``names`` are of colours in trees.
    """

    value: V_out | None
    status: Status = SURE
    reason: Reason = NO_REASON
    level: Level | None = None
    witness: Witness | None = None
    names: Sequence[str] = ()


class Described(Protocol[V_in]):
    @property
    def schema(self) -> Schema: ...

    def data(self, value: V_in, dialect: Plain, /) -> object: ...


class FieldBeside(Frozen, Generic[V]):
    """A field beside another; ``*`` in its name is the key of the row up to the last ``order``."""

    name: str
    schema: Schema
    data: Callable[[Answer[V], Plain], object]
    is_optional: bool = True


class Json(Frozen, Generic[V_in]):
    """A value as JSON.

    Attributes:
        data: makes the JSON; without it the value is JSON already.
        csv: a cell, or cells by their columns, if they are not made of the JSON.
    """

    schema: Schema
    data: Callable[[V_in, Plain], object] = lambda value, _: value
    beside: tuple[FieldBeside[V_in], ...] = ()
    csv: Callable[[V_in], str | Mapping[str, str]] | None = None


class Several(Frozen, Generic[T]):
    section: Section[T]
    is_never_empty: bool = False

    @property
    def schema(self) -> Schema:
        least = {"minItems": 1} if self.is_never_empty else {}
        return {**array(self.section.schema), **least}

    def data(self, values: Iterable[T], dialect: Plain, /) -> object:
        return [self.section.data(x, dialect) for x in values]


class Kind(Frozen, Generic[V_in]):
    """A kind of values, with its form for programs and its form for people, each or None."""

    what: Described[V_in] | None
    shown: Display[V_in] | None = None

    def words(self, value: V_in, dialect: Plain) -> str:
        assert isinstance(self.shown, Words)
        return self.shown.words(value, dialect)

    def __call__(self: Kind[V], value: V) -> Said[V]:
        """A value of this kind in a reason."""
        return Said(self, value)


class Said(Frozen, Generic[V]):
    kind: Kind[V]
    value: V

    def words(self, dialect: Plain) -> str:
        return self.kind.words(self.value, dialect)

    def __str__(self) -> str:
        return self.words(Plain())


class Fact(Frozen):
    row: Row[Any]
    answer: Answer[Any]
    level: Level

    @property
    def value(self) -> Any:
        return self.answer.value

    @property
    def shown(self) -> Display[Any] | None:
        return self.row.kind.shown

    @property
    def is_below(self) -> bool:
        """Whether it has lines of its own, below the other facts."""
        shown = self.shown
        return isinstance(shown, Below) or (isinstance(shown, ManyParts) and shown.most is not None)

    @property
    def is_something(self) -> bool:
        answer = self.answer
        if answer.value is None:
            return bool(answer.reason or answer.status.open)
        return not (isinstance(answer.value, (tuple, list, str)) and not answer.value)


class RowOptions(TypedDict, total=False):
    label: str | None
    line: str
    is_short: bool


class Row(Generic[T_in]):
    """The declaration of a fact of a result.

    Attributes:
        key: its name in JSON; its label and its sentence are found by it.
        has_null: whether there may be no value.
        is_optional: whether JSON leaves it out then.
        label: if it is not that of the key.
        line: facts with the same word here share a line of the usual text.
        is_short: whether other rows tell it where everything is reported.
    """

    has_null: bool = False
    is_optional: bool = False

    def __init__(
        self,
        key: str,
        kind: Kind[V],
        get: Callable[[T_in], V | Answer[V] | None],
        level: Level | Callable[[Answer[V]], Level] = Level.USUAL,
        label: str | None = None,
        line: str = "",
        is_short: bool = False,
    ) -> None:
        self.key = key
        self.kind: Kind[Any] = kind
        self.get: Callable[[T_in], Any] = get
        self.level = level
        self.label = label
        self.line = line
        self.is_short = is_short

    def but(self, **changes: object) -> Row[T_in]:
        found = copy(self)
        vars(found).update(changes)
        return found

    def answer(self, whole: T_in) -> Answer[Any]:
        found = self.get(whole)
        return found if isinstance(found, Answer) else Answer(found)

    def fact(self, whole: T_in) -> Fact:
        """The answer with the level where it is reported."""
        answer = self.answer(whole)
        level = answer.level
        if level is None:
            level = self.level(answer) if callable(self.level) else self.level
        return Fact(self, answer, level)

    def fields(self) -> Iterator[tuple[str, Schema, bool]]:
        what = self.kind.what
        if what is None:
            return
        schema = nullable(what.schema) if self.has_null else what.schema
        yield self.key, schema, not self.is_optional
        for field in self._beside:
            yield self._name(field), field.schema, not field.is_optional

    def data(self, whole: T_in, dialect: Plain) -> dict[str, object]:
        what = self.kind.what
        if what is None:
            return {}
        answer = self.answer(whole)
        is_none = answer.value is None
        if is_none and self.is_optional:
            return {}
        found = {self.key: None if is_none else what.data(answer.value, dialect)}
        for field in self._beside:
            value = None if is_none else field.data(answer, dialect)
            if value is not None or not field.is_optional:
                found[self._name(field)] = value
        return found

    @property
    def _beside(self) -> tuple[FieldBeside[Any], ...]:
        what = self.kind.what
        return what.beside if isinstance(what, Json) else ()

    def _name(self, field: FieldBeside[Any]) -> str:
        return field.name.replace("*", self.key.rpartition("order")[0])


Rows: TypeAlias = "Sequence[Row[T]]"


class maybe(Row[T_in]):  # noqa: N801 -- it is called like a function
    has_null = True


class optional(Row[T_in]):  # noqa: N801
    """Left out of JSON without a value."""

    is_optional = True


def itself(
    key: str, kind: Kind[T], level: Level = Level.USUAL, **placed: Unpack[RowOptions]
) -> Row[T]:
    """A row whose value is the result."""
    return Row(key, kind, lambda whole: whole, level, **placed)


def via(get: Callable[[T], U | None], rows: Iterable[Row[U]]) -> Rows[T]:
    """Rows of a part as rows of its owner, without values if there is no part."""

    def of(row: Row[U]) -> Row[T]:
        found: Row[Any] = copy(row)
        found.get = lambda whole: None if (part := get(whole)) is None else row.get(part)
        return found

    return [*map(of, rows)]


class Section(Generic[T_in]):
    """All that is reported of a type of result, in order; ``columns`` tell it in a line of a table,
    whose last words may be cut if ``is_cut``.
    """

    def __init__(
        self,
        *rows: Row[T_in] | Iterable[Row[T_in]],
        title: Callable[[T_in, Plain], str] | None = None,
        columns: Sequence[str] = (),
        is_cut: bool = False,
    ) -> None:
        self.rows = [row for x in rows for row in ([x] if isinstance(x, Row) else x)]
        self.title = title
        self.columns = columns
        self.is_cut = is_cut

    def facts(self, whole: T_in, level: Level = Level.DATA) -> Iterator[Fact]:
        """The facts down to a level; rows that lie deeper are not asked."""
        for row in self.rows:
            if callable(row.level) or row.level <= level:
                yield row.fact(whole)

    def named(self, whole: T_in, keys: Iterable[str]) -> dict[str, Fact]:
        return {row.key: row.fact(whole) for row in self.rows if row.key in keys}

    def data(self, whole: T_in, dialect: Plain, /) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for row in self.rows:
            found.update(row.data(whole, dialect))
        return found

    def columns_of(self, level: Level) -> Rows[T_in]:
        if level == Level.DATA:
            return [row for row in self.rows if row.kind.what is not None]
        is_deep = level >= Level.DETAIL
        found = [x for x in self.rows if not (x.is_short and is_deep)]
        return [x for x in found if not callable(x.level) and x.level <= level]

    @property
    def schema(self) -> Schema:
        fields = [field for row in self.rows for field in row.fields()]
        return {
            "type": "object",
            "required": [name for name, _, is_required in fields if is_required],
            "properties": {name: schema for name, schema, _ in fields},
            "additionalProperties": False,
        }


class SectionChoice(Section[T]):
    """``of`` chooses one of several sections for a value."""

    def __init__(self, of: Callable[[T], Section[T]], *sections: Section[T]) -> None:
        super().__init__()
        self._of = of
        self._sections = sections

    def facts(self, whole: T, level: Level = Level.DATA) -> Iterator[Fact]:
        return self._of(whole).facts(whole, level)

    def data(self, whole: T, dialect: Plain, /) -> dict[str, Any]:
        return self._of(whole).data(whole, dialect)

    @property
    def schema(self) -> Schema:
        return one_of(*(section.schema for section in self._sections))
