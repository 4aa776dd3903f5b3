"""What a project wants of its method files: ``.gark.toml``, or ``[tool.gark]`` of pyproject."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from garkcli.errors import UsageProblem, did_you_mean
from garkcli.files import is_inside, read_bytes
from garkcli.frozen import Frozen, field
from garkcli.page.plain import printable

if TYPE_CHECKING:
    from garkcli.glossary.key import Files, Key

OWN = ".gark.toml"
SHARED = "pyproject.toml"
MOST_BYTES = 1_000_000


class Project(Frozen):
    """What a file of a project says.

    Attributes:
        file: its path; empty where there is none.
        paths: the method files, folders or patterns that are checked where none are named, from
            here.
        require_claims: whether a file without a claim fails.
        needed: claims without which a file fails.
        defaults: values of options that are not given, by their names.
    """

    file: str = ""
    paths: tuple[str, ...] = ()
    require_claims: bool = False
    needed: tuple[str, ...] = ()
    defaults: Mapping[str, Any] = field(default_factory=dict)


def find_project() -> Project:
    """The project of the folder we are in: the first file above that speaks of gark; folders above
    that of a repository are not looked at.

    Raises:
        UsageProblem: the file cannot be read, or says what means nothing.
    """
    for folder in _folders():
        for name in (OWN, SHARED):
            path = os.path.join(folder, name)
            if not os.path.isfile(path):
                continue
            table = _table(path, name)
            if table is not None:
                return _project(os.path.relpath(path), folder, table)
        if os.path.exists(os.path.join(folder, ".git")):
            break
    return Project()


def _folders() -> Iterator[str]:
    """The folder we are in, and those above it."""
    try:
        folder = os.getcwd()
    except OSError:  # it was removed
        return
    while True:
        yield folder
        above = os.path.dirname(folder)
        if above == folder:
            return
        folder = above


def _table(path: str, name: str) -> dict[str, Any] | None:
    """What a file says of gark; None where it does not."""
    import tomllib

    try:
        data = read_bytes(path, MOST_BYTES)
        if name == SHARED and b"gark" not in data:
            return None
        if len(data) > MOST_BYTES:
            message = f"{printable(path)}: more than {MOST_BYTES} bytes"
            raise UsageProblem(message, "split it", code="file-too-large")
        whole = tomllib.loads(data.decode("utf-8"))
    except (OSError, ValueError) as error:
        message = f"{printable(os.path.relpath(path))}: {error}"
        raise UsageProblem(
            message, "mend the file, TOML is expected", code="project-file"
        ) from None
    if name == OWN:
        return whole
    tools = whole.get("tool")
    table = tools.get("gark") if isinstance(tools, dict) else None
    if table is None or isinstance(table, dict):
        return table
    message = f"{printable(os.path.relpath(path))}: tool.gark is no table"
    raise UsageProblem(message, "write its keys below [tool.gark]", code="project-file")


def _project(file: str, folder: str, table: dict[str, Any]) -> Project:
    """The project that a table describes.

    Raises:
        UsageProblem: it has a key or a value that means nothing.
    """
    shown = printable(file)
    for key, value in table.items():
        if key not in KEYS:
            cure = did_you_mean(key, list(KEYS))
            raise UsageProblem(f"{shown}: no key {key!r}", cure, code="unknown-key")
        if not KEYS[key].is_right(value):
            cure = f"write {key} = {KEYS[key].example}"
            message = f"{shown}: {key} is not {KEYS[key].wanted}"
            raise UsageProblem(message, cure, code="wrong-value")
    from garkcli.methodfile.finding import fixed_part

    required = table.get("require-claims", False)
    paths = [os.path.join(folder, path) for path in table.get("paths", ())]
    for path, given in zip(paths, table.get("paths", ()), strict=True):
        if not is_inside(fixed_part(path), folder):
            message = f"{shown}: paths: {printable(given)} leads out of the project"
            raise UsageProblem(message, "name files and folders of the project", code="elsewhere")
    names = {"format": "format", "max-order": "max_order", "jobs": "jobs"}
    defaults = {names[key]: table[key] for key in names if key in table}
    return Project(
        file,
        tuple(map(_from_here, paths)),
        required is True,
        tuple(required) if isinstance(required, list) else (),
        defaults,
    )


def _from_here(path: str) -> str:
    """The path from the folder we are in, where there is one: on Windows not to another drive."""
    try:
        return os.path.relpath(path)
    except ValueError:
        return path


def _is_texts(value: object) -> bool:
    return isinstance(value, list) and all(isinstance(x, str) for x in value)


def _is_claims(value: object) -> bool:
    from garkcli.methodfile.expectations import CLAIMS

    if isinstance(value, bool):
        return True
    return isinstance(value, list) and all(x in CLAIMS for x in value)


def _is_format(value: object) -> bool:
    from garkcli.report.check_formats import FORMATS

    return isinstance(value, str) and value in {"auto", *FORMATS}


def _count(least: int, most: int) -> Callable[[object], bool]:
    def is_right(value: object) -> bool:
        is_number = isinstance(value, int) and not isinstance(value, bool)
        return is_number and value in range(least, most + 1)

    return is_right


class _Key(Frozen):
    """A key of the file of a project.

    Attributes:
        example: of its value.
        text: what it is, in whole sentences.
        wanted: what its value is, as messages say it.
        is_right: whether a value is one.
        default: what holds where it is left out; None where nothing does.
    """

    example: str
    text: str
    wanted: str
    is_right: Callable[[object], bool]
    default: object = None


KEYS = {
    "paths": _Key(
        '["methods"]',
        "The files, folders or patterns that gark check reads where none are named.",
        "a list of files, folders or patterns",
        _is_texts,
    ),
    "require-claims": _Key(
        '["order"]',
        "Whether a file without a claim fails; or a list of claims that every file has to make.",
        "true, false, or a list of claims",
        _is_claims,
        False,
    ),
    "format": _Key(
        '"github"',
        "The format of gark check without --format.",
        "a format of gark check",
        _is_format,
    ),
    "max-order": _Key(
        "12",
        "The order at which gark check stops looking where --max-order does not say.",
        "a number from 1 to 400",
        _count(1, 400),
        60,
    ),
    "jobs": _Key(
        "2",
        "How many processes gark check takes where --jobs does not say; 0 for one a processor.",
        "a number from 0 to 256",
        _count(0, 256),
        1,
    ),
}
"""The keys of the file of a project by name."""


def told(files: Files) -> Iterator[Key]:
    """What the report says of the keys."""
    from garkcli.glossary.key import Key  # only pages and explanations tell of keys

    for name, key in KEYS.items():
        yield Key(name, key.text, f"{name} = {key.example}", key.default, files.page)
