"""The settings of a project: ``.gark.toml``, or ``[tool.gark]`` of pyproject.toml."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from garkcli.errors import UsageProblem, printable
from garkcli.files import STDIN, is_elsewhere, is_inside, read_bytes
from garkcli.frozen import Frozen, field, replace

if TYPE_CHECKING:
    from garkcli.glossary.key import FileKind, KeyMeaning
    from garkcli.grammar.keys import ValueKind

OWN = ".gark.toml"
SHARED = "pyproject.toml"
MOST_BYTES = 1_000_000


class Project(Frozen):
    """``paths`` are checked if none are named; ``needed`` are required claims."""

    file: str = ""
    paths: tuple[str, ...] = ()
    require_claims: bool = False
    needed: tuple[str, ...] = ()
    defaults: Mapping[str, Any] = field(default_factory=dict)


def find_project() -> Project:
    """Looks for settings from the current folder up to the root of the repository. Raises
    UsageProblem if a file cannot be read, MethodFileError with all faults.
    """
    for folder in _folders():
        for name in (OWN, SHARED):
            path = os.path.join(folder, name)
            text = _text(path, name) if os.path.isfile(path) else None
            if text is not None:
                table = _table(path, name, text)
                if table is not None:
                    return _project(path, folder, text, table)
        if os.path.exists(os.path.join(folder, ".git")):
            break
    return Project()


def _folders() -> Iterator[str]:
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


def _text(path: str, name: str) -> str | None:
    """Returns a file, None if it has no settings for gark; UsageProblem if it cannot be read."""
    try:
        data = read_bytes(path, MOST_BYTES)
        if name == SHARED and re.search(_TOOL, data, re.MULTILINE) is None:
            return None  # to parse TOML takes longer than all else that is done of it
        if len(data) <= MOST_BYTES:
            return data.decode("utf-8")
    except (OSError, ValueError) as error:
        raise _not_toml(path, error) from None
    message = f"{printable(os.path.relpath(path))}: more than {MOST_BYTES} bytes"
    raise UsageProblem(message, "split it", code="file-too-large")


_TOOL = (
    rb"tool[\"' \t]*\.[\"' \t]*gark"
    rb"|^[ \t]*\[[ \t]*[\"']?tool[\"']?[ \t]*\]|^[ \t]*[\"']?tool[\"']?[ \t]*="
)


_DEEP = r"(?<![\w\"'-])(?:[\w\"'-]++[ \t]*+\.[ \t]*+){100}"
"""A key of a hundred names with dots between: tomllib takes quadratic time."""


def _not_toml(path: str, error: Exception) -> UsageProblem:
    message = f"{printable(os.path.relpath(path))}: {error}"
    return UsageProblem(message, "fix the file, TOML is expected", code="project-file")


def _table(path: str, name: str, text: str) -> dict[str, Any] | None:
    """The settings for gark, or None; UsageProblem unless the file is TOML."""
    import tomllib

    try:
        if re.search(_DEEP, text) is not None:
            raise RecursionError
        whole = tomllib.loads(text)
    except RecursionError:
        raise _not_toml(path, ValueError("nested too deeply")) from None
    except ValueError as error:
        raise _not_toml(path, error) from None
    if name == OWN:
        return whole
    tools = whole.get("tool")
    table = tools.get("gark") if isinstance(tools, dict) else None
    if table is None or isinstance(table, dict):
        return table
    message = f"{printable(os.path.relpath(path))}: tool.gark is not a table"
    raise UsageProblem(message, "write its keys below [tool.gark]", code="project-file")


def _project(path: str, folder: str, text: str, table: dict[str, Any]) -> Project:
    from garkcli.glossary.key import PROJECT_FILE
    from garkcli.grammar.keys import FILE
    from garkcli.grammar.source import Source
    from garkcli.grammar.tables import read_settings
    from garkcli.methodfile.naming import fixed_part

    file = os.path.relpath(path)
    where = FILE if os.path.basename(path) == OWN else "[tool.gark]"
    # no line of a file elsewhere is shown
    source = Source(file, "" if is_elsewhere(path) else text, PROJECT_FILE)
    found = read_settings(source, table, _kind(), where)
    # dots take back the name before them, a pattern too: test the path that gark reads
    paths = {os.path.normpath(os.path.join(folder, x)): x for x in found.get("paths", ())}
    for place, given in paths.items():
        if not is_inside(fixed_part(place), folder):
            message = f"paths: {printable(given)} leads out of the project"
            cure = "name files and folders of the project"
            source.fault(found.nodes["paths"], message, cure, code="elsewhere")
    source.close()
    required = found.get("require-claims", False)
    names = {"format": "format", "max-order": "max_order", "jobs": "jobs"}
    return Project(
        file,
        tuple(map(_from_here, paths)),
        required is True,
        tuple(required) if isinstance(required, list) else (),
        {names[key]: found[key] for key in names if key in found},
    )


def _from_here(path: str) -> str:
    """Relative to the current folder, if it can be, and never a name of the catalogue or ``-``."""
    try:
        here = os.path.relpath(path)
    except ValueError:
        return path
    is_there = here != STDIN and os.path.lexists(here)
    return here if is_there or os.path.dirname(here) else os.path.join(os.curdir, here)


def _kind() -> ValueKind:
    from garkcli.cli.project_file import file_of
    from garkcli.report.check_formats import FORMATS

    return file_of(("auto", *FORMATS))


def project_schema() -> dict[str, Any]:
    """The JSON Schema of ``.gark.toml``, as plain data.

    >>> project_schema()["type"]
    'object'
    """
    from garkcli.grammar.keys import file_schema

    return file_schema("gark project file", "What gark check does in a project.", _kind())


def told(kind: FileKind) -> Iterator[KeyMeaning]:
    from garkcli.grammar.keys import told

    for key in told(_kind().inside(), kind.page):
        yield replace(key, example=key.example.replace(": ", " = ", 1))
