"""Remarks in every format: rows for JSON, labels for people, excerpts, Markdown, GitHub, SARIF."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from garkcli.bridges.finding import CODES
from garkcli.check.findings import Aside, Finding
from garkcli.errors import Remark, excerpt, printable
from garkcli.frozen import replace
from garkcli.glossary.faults import findings_of
from garkcli.page.json_text import to_json
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Row, Rows, Section, maybe
from garkcli.tell.kinds import POSITION, TEXT, choice
from garkcli.tell.parts import parts
from garkcli.version import __version__

MESSAGE: Row[Remark] = Row("message", TEXT, lambda x: x.message)
HELP: Row[Remark] = Row("help", TEXT, lambda x: x.help)
AT: Rows[Remark] = (
    maybe("line", POSITION, lambda x: x.line or None),
    maybe("column", POSITION, lambda x: x.column or None),
    Row("code", TEXT, lambda x: x.code),
)
FAULT: Section[Remark] = Section(AT, MESSAGE, HELP)
"""The place is null for the whole file."""
FINDING: Section[Remark] = Section(
    AT, Row("level", choice("error", "warning", "hint"), lambda x: x.level), MESSAGE, HELP
)
OF_TABLE: Section[Remark] = Section(
    Row("code", choice(*CODES), lambda x: x.code),
    Row("level", choice("error", "warning", "note"), lambda x: x.level),
    MESSAGE,
    HELP,
)


class FailedRun(NamedTuple):
    name: str
    faults: Sequence[Remark]


FAILURE: Section[FailedRun] = Section(
    Row("name", TEXT, lambda x: x.name), Row("errors", parts(FAULT), lambda x: x.faults)
)


def remark_rows(remarks: Sequence[Remark], d: Plain) -> list[tuple[str, str]]:
    """Returns rows with levels and codes, cures below; usual hints have neither code nor cure."""
    found: list[tuple[str, str]] = []
    for x in remarks:
        level = d.bad(x.level) if x.level == "error" else d.note(x.level)
        message = d.reason(x.reason) if isinstance(x, Aside) else d.prose(x.message)
        if x.level == "hint" and d.is_brief:
            found.append((level, message))
            continue
        found.append((level, f"{message} ({x.code})"))
        found += [("help", d.prose(x.help))] if x.help else []
    return found


def fault_rows(faults: Sequence[Remark], d: Plain) -> list[tuple[str, str]]:
    placed = [
        replace(x, message=f"line {x.line}, column {x.column}: {x.message}") if x.line else x
        for x in faults
    ]
    return remark_rows(placed, d)


def lines(remarks: Sequence[Remark], file: str, text: str, d: Plain) -> Iterator[str]:
    source = text.splitlines()
    for x in remarks:
        place = printable(file)
        if x.line:
            place += f":{x.line}:{x.column}"
        yield from d.message(f"{place}: {d.bad('error')}[{x.code}]: {printable(x.message)}")
        if 0 < x.line <= len(source):
            yield from excerpt(source[x.line - 1], x.line, x.column, d.bad("^"))
        if x.help:
            yield from d.message(f"      {d.note('help')}: {printable(x.help)}", hanging=12)


def items(finding: Finding) -> Iterator[str]:
    x = finding.remark
    level = "" if x.level == "error" else f"{x.level}: "
    place = f"`{_code(finding.file)}:{x.line}:{x.column}`"
    yield f"- {place}: {level}{table_cell(x.message)} (`{x.code}`)"
    if x.help:
        yield f"  - {table_cell(x.help)}"


def table_cell(text: str) -> str:
    """A text that does not end its cell of a table."""
    text = printable(text.replace("\n", " "))
    return text.replace("\\", "\\\\").replace("|", "\\|").replace("<", "&lt;")


def _code(text: str) -> str:
    text = printable(text.replace("\n", " "))
    return text.replace("`", "'").replace("|", "\\|")


def _with_cure(remark: Remark) -> str:
    return f"{remark.message}; {remark.help}" if remark.help else remark.message


_COMMANDS = {"error": "error", "warning": "warning", "note": "notice", "hint": "notice"}


def annotation(finding: Finding) -> str:
    x = finding.remark
    place = f"file={_property_of_command(finding.file)},line={x.line},col={x.column}"
    title = _property_of_command(f"gark: {finding.rule}")
    return f"::{_COMMANDS[x.level]} {place},title={title}::{_text_of_command(_with_cure(x))}"


def commands_off(text: str) -> str:
    """Switches workflow commands off: names of files come from strangers."""
    from hashlib import sha256  # few runs

    token = sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
    return f"::stop-commands::{token}\n{text}::{token}::\n"


def _text_of_command(text: str) -> str:
    """Line ends by their numbers, other signs by name."""
    return printable(text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A"))


def _property_of_command(text: str) -> str:
    """Colons and commas end a property."""
    return _text_of_command(text).replace(":", "%3A").replace(",", "%2C")


def log_of(found: Sequence[Finding], command: str) -> str:
    kinds = findings_of(command)
    rules = [
        {
            "id": code,
            "shortDescription": {"text": kind.text},
            "help": {"text": f"{kind.cure} gark explain {code} says what it means."},
        }
        for code, kind in kinds.items()
    ]
    places = list(kinds)
    log = {
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [
            {
                "tool": {"driver": {"name": "gark", "version": __version__, "rules": rules}},
                "columnKind": "unicodeCodePoints",
                "results": [_result(x, places.index(x.rule)) for x in found],
            }
        ],
    }
    return to_json(log) + "\n"


def _result(finding: Finding, place: int) -> dict[str, object]:
    x = finding.remark
    region = {"startLine": x.line, "startColumn": x.column}
    code = {"properties": {"code": x.code}} if x.code != finding.rule else {}
    return {
        "ruleId": finding.rule,
        "ruleIndex": place,
        "level": "note" if x.level == "hint" else x.level,
        "message": {"text": printable(_with_cure(x))},
        "locations": [
            {
                "physicalLocation": {
                    "artifactLocation": {"uri": _uri(finding.file)},
                    "region": region,
                }
            }
        ],
        "partialFingerprints": {"gark/v1": finding.fingerprint},
        **code,
    }


def _uri(path: str, separator: str = os.sep) -> str:
    r"""A path for SARIF, with slashes on every system.

    >>> _uri(r"tables\my rk.gark.yaml", "\\")
    'tables/my%20rk.gark.yaml'
    """
    from urllib.parse import quote

    return quote(path.replace(separator, "/"), safe="/", errors="replace")
