"""Method files from path to method, with all faults of a file at once."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

from garkcli.doing import doing
from garkcli.errors import HasFreeParameters, MethodFileError, Remark
from garkcli.files import STDIN
from garkcli.frozen import replace
from garkcli.glossary.key import METHOD_FILE
from garkcli.grammar.nodes import one_line
from garkcli.grammar.source import Source
from garkcli.methodfile.bibliography import reference_of
from garkcli.methodfile.build import Builder, MethodFile, V, part_of
from garkcli.methodfile.description import Description, Form, left_behind, rules_of_blocks, works_of
from garkcli.methodfile.folders import SUFFIX
from garkcli.methodfile.naming import find_files, is_both, read_argument
from garkcli.methodfile.numbers import Numbers
from garkcli.methodfile.parameters import refuse_free
from garkcli.methodfile.reader import MethodReader
from garkcli.methodfile.values import Values
from garkcli.order import meant
from garkcli.reference import Work
from garkcli.remade import Remade

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.exact.field import Number
    from garkcli.exact.nodes import Expression
    from garkcli.tableau.box import Box, Make
    from garkcli.tableau.embedded import Further

NO_SETTINGS: Mapping[str, str] = {}
_READ: ContextVar[list[MethodFile] | None] = ContextVar("read", default=None)


@contextmanager
def noting() -> Iterator[list[MethodFile]]:
    methods: list[MethodFile] = []
    token = _READ.set(methods)
    try:
        yield methods
    finally:
        _READ.reset(token)


def noted(method: MethodFile) -> MethodFile:
    if (methods := _READ.get()) is not None:
        methods.append(method)
    return method


def load(path: str, settings: Mapping[str, str] = NO_SETTINGS) -> MethodFile:
    """A method file, standard input for ``-``, or a name; MethodFileError with all faults."""
    with doing(f"reading {path}"):
        return noted(loads(*read_method_text(path), settings))


def read_method_text(path: str) -> tuple[str, str]:
    """The text and the name of a method; MethodFileError if it does not exist, or is no text."""
    is_folder = path != STDIN and os.path.isdir(path)
    if is_folder and not is_both(path):
        raise MethodFileError(path, [_of_folder(path)])
    return read_argument(path)


def _of_folder(path: str) -> Remark:
    try:
        os.scandir(path).close()
    except OSError as error:
        message = f"this folder cannot be read: {error.strerror}"
        return Remark(message, "name the files", code="cannot-read")
    first = next(find_files([path]))
    if first == path:
        message, cure = (
            f"no {SUFFIX} files in this directory",
            "name the files, or end their names in .gark.yaml",
        )
        return Remark(message, cure, code="folder")
    message = "a directory, where one method file is expected"
    return Remark(message, f"name one, such as {first}", code="folder")


def loads(
    text: str, source: str = "<text>", settings: Mapping[str, str] = NO_SETTINGS
) -> MethodFile:
    """The method of a text with values for parameters; MethodFileError with all faults.

    >>> loads("methods: [{family: gauss, stages: 2}]").tableau.size
    1
    """
    reader, description = described(text, source, settings)
    if reader.numbers.free:
        raise _free(reader, description)
    made = built(reader, description, Values)
    rounded = None
    if description.tolerance is not None:
        from garkcli.methodfile.rounding import rounded_of  # few files are rounded

        rounded = rounded_of(made, reader.numbers, description.content, description.tolerance)
        rounded.refuse_keys(reader.source)
    method = MethodFile(
        source=source,
        text=text,
        name=one_line(description.name) or source,
        tableau=made.tableau,
        embedded=made.further.embedded,
        dense=made.further.dense,
        predictor=made.further.predictor,
        form=description.form,
        structure=description.structure,
        is_conjugate=description.is_conjugate,
        tolerance=(rounded and rounded.largest("")) or None,
        embedded_tolerance=(rounded and rounded.largest("embedded")) or None,
        dense_tolerance=(rounded and rounded.largest("dense")) or None,
        claims=description.claims,
        reference=description.reference,
        description=description.description,
        aliases=description.aliases,
        bibliography=description.bibliography,
        printed=made.values.printed,
        left_behind=left_behind(description.content),
        rules=rules_of_blocks(description),
    )
    file = text, source, dict(settings)
    if rounded is not None:

        def box() -> tuple[Box, Further]:
            file_box = rounded.box(made.text)
            return replace(file_box, make=Remade(file_box.make, _maker, *file)), made.further

        meant.remember(method.tableau, method.tolerance, Remade(box, _box, *file))

    def box_by_digits(radii_of: meant.Radii) -> tuple[Box, Further]:
        from garkcli.methodfile.rounding import box_of  # few files are rounded

        radii: list[fmpq] = []

        def kept(numbers: Sequence[tuple[Expression, Number]]) -> Sequence[fmpq]:
            radii[:] = radii_of(numbers)
            return radii

        digits_box = box_of(made, reader.numbers, description.content, kept)
        make = Remade(digits_box.make, _maker_by_digits, *file, radii)
        return replace(digits_box, make=make), made.further

    meant.remember_digits(method.tableau, Remade(box_by_digits, _box_by_digits, *file))
    return method


# another process reads the file again for what it is asked
def _box(*file: Any) -> Callable[[], tuple[Box, Further]]:
    return meant.remembered(loads(*file).tableau)


def _maker(*file: Any) -> Make:
    box, _ = _box(*file)()
    return box.make


def _box_by_digits(*file: Any) -> meant.ByRadii:
    return meant.remembered_digits(loads(*file).tableau)


def _maker_by_digits(text: str, source: str, settings: Any, radii: Sequence[fmpq]) -> Make:
    box, _ = _box_by_digits(text, source, settings)(lambda _: radii)
    return box.make


def works_in(text: str, source: str) -> tuple[Work, ...]:
    """Returns the publications; MethodFileError if neither reference nor parts can be read."""
    own = reference_of(text, source)
    return (own,) if own[0] else works_of(described(text, source, NO_SETTINGS)[1])


_OTHER_KINDS: dict[Form, str] = {
    "rosenbrock": "Rosenbrock",
    "nystrom": "Nyström",
    "nprk": "nonlinearly partitioned",
    "derivatives": "multiderivative",
}


def _free(reader: MethodReader, description: Description) -> MethodFileError:
    if reader.source.faults:
        return reader.source.error()
    kind = _OTHER_KINDS.get(description.form)
    if kind is not None:
        name = next(iter(reader.numbers.free))
        message = f"a {kind} method needs numbers, and {name} is free"
        cure = f"give it a value: --set {name}=1/2"
        if description.form in {"rosenbrock", "nystrom"}:
            cure += "; gark design finds values"
        reader.source.fault(description.node, message, cure, code="free-parameters")
        return reader.source.error()
    error = reader.source.error_with(lambda: refuse_free(reader.numbers))
    free = HasFreeParameters(error.source, error.faults, error.text)
    free.reading = reader, description
    return free


def described(
    text: str, source: str, settings: Mapping[str, str]
) -> tuple[MethodReader, Description]:
    """The description and its reader with the coefficients; MethodFileError if it is none."""
    reading = Source(source, text, METHOD_FILE)
    reader = MethodReader(reading, settings)
    description = reader.read()
    if description is None:
        if not reader.numbers.free:
            # what is wrong with the numbers is reported in the same run
            Values(reader.numbers)
        raise reading.error()
    return reader, description


def built(
    reader: MethodReader, description: Description, values_of: Callable[[Numbers], V]
) -> Builder[V]:
    text = part_of(reader.source, reader.numbers, description)
    reader.source.close()
    values = values_of(reader.numbers)
    reader.source.close()
    return Builder(text, values)
