"""Method files as tests of pytest: each claim under ``expect`` is an item.

Nothing of gark is imported before an item is requested: by ``--gark``, by ``gark_files``, or by the
name of a file (docs/ci.md).

PYTEST_DONT_REWRITE: no assertion here is one of a test, and it may have been imported already.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import pytest

if TYPE_CHECKING:
    from garkcli.check.findings import Finding
    from garkcli.check.outcome import Outcome
    from garkcli.methodfile.build import MethodFile
    from garkcli.methodfile.description import ClaimText

    Load: TypeAlias = Callable[[str | Path], MethodFile]

Place: TypeAlias = tuple[int, int]
"""A line and a column, from 1."""
TOP: Place = (0, 0)
"""The place of items that are about a whole file."""
SUFFIX = ".gark.yaml"
READABLE = "readable"
"""The item of a file without claims, or that cannot be read."""
EVERY_VALUE = "every-value"
"""The item of a file with free parameters: all of its claims, on every value of them."""


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("gark", "method files of gark")
    group.addoption(
        "--gark",
        action="store_true",
        default=None,
        dest="gark",
        help=f"collect every *{SUFFIX}: a test for each claim",
    )
    group.addoption(
        "--no-gark",
        action="store_false",
        dest="gark",
        help="collect none, whatever gark_files says",
    )
    parser.addini(
        "gark_files",
        f"patterns of method files that are tests, such as methods/*{SUFFIX}",
        type="args",
        default=[],
    )
    parser.addini(
        "gark_require_claims", "fail method files that make no claim", type="bool", default=False
    )


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> GarkFile | None:
    if not file_path.name.endswith(SUFFIX) or not _is_wanted(file_path, parent):
        return None
    return GarkFile.from_parent(parent, path=file_path)


def _is_wanted(path: Path, parent: pytest.Collector) -> bool:
    config = parent.config
    asked: bool | None = config.getoption("gark")
    if asked is not None:
        return asked
    if parent.session.isinitpath(path):
        return True
    patterns: list[str] = config.getini("gark_files")
    if not patterns:
        return False
    relative = Path(_shown(path, config))
    return any(relative.match(pattern) for pattern in patterns)


def _shown(path: Path, config: pytest.Config) -> str:
    try:
        return path.relative_to(config.rootpath).as_posix()
    except ValueError:
        return path.as_posix()


class GarkFile(pytest.File):
    """One method file, checked once, when the first of its items runs."""

    def collect(self) -> Iterator[GarkItem]:
        is_first = True
        for name, place in self._claims():
            yield GarkItem.from_parent(self, name=name, place=place, is_first=is_first)
            is_first = False

    def _claims(self) -> list[tuple[str, Place]]:
        from garkcli.errors import MethodFileError
        from garkcli.methodfile.load import described, read_method_text

        try:
            text, source = read_method_text(str(self.path))
            reader, description = described(text, source, {})
        except MethodFileError:
            return [(READABLE, TOP)]
        if reader.numbers.free:
            return [(EVERY_VALUE, TOP)]
        return [(x.key, _place(x)) for x in description.claims] or [(READABLE, TOP)]

    @cached_property
    def outcome(self) -> Outcome:
        from garkcli.check.check_file import check_file
        from garkcli.frozen import replace

        outcome = check_file(str(self.path))
        needs_claims: bool = self.config.getini("gark_require_claims")
        return replace(outcome, needs_claims=needs_claims)


def _place(claim: ClaimText) -> Place:
    mark = claim.node.start_mark
    return mark.line + 1, mark.column + 1


class ClaimFails(Exception):
    """A claim of a file fails; its text is the explanation."""


class GarkItem(pytest.Item):
    def __init__(self, *, place: Place, is_first: bool, **settings: Any) -> None:
        super().__init__(**settings)
        self.place = place
        self.is_first = is_first
        # plugins such as pytest-lsp ask each item for the values of its fixtures
        self.funcargs: dict[str, object] = {}

    def runtest(self) -> None:
        """Skips an undecided claim; raises ClaimFails if it fails, or the file cannot be read."""
        from garkcli.check.findings import findings

        assert isinstance(self.parent, GarkFile)
        outcome = self.parent.outcome
        if not outcome.is_read and not self.is_first:
            # told of the method file, not of this one
            raise pytest.skip.Exception("the file cannot be read", _use_item_location=True)
        found = list(filter(self._is_about, findings(outcome)))
        if any(finding.remark.level == "error" for finding in found):
            raise ClaimFails("\n".join(self._text(finding, outcome) for finding in found))
        undecided = [x.remark.message for x in found if x.rule == "undecided"]
        if undecided:
            reason = "; ".join(undecided)
            raise pytest.skip.Exception(f"undecided: {reason}", _use_item_location=True)

    def _is_about(self, finding: Finding) -> bool:
        is_whole = self.place == TOP
        return (
            is_whole
            or finding.rule not in {"claim", "undecided"}
            or (finding.remark.line, finding.remark.column) == self.place
        )

    def _text(self, finding: Finding, outcome: Outcome) -> str:
        from garkcli.errors import excerpt, printable

        place = printable(_shown(self.path, self.config))
        remark = finding.remark
        lines = [f"{place}:{remark.line}:{remark.column}: {remark.message}"]
        source = outcome.text.splitlines()
        if 0 < remark.line <= len(source):
            lines += excerpt(source[remark.line - 1], remark.line, remark.column)
        if remark.help:
            lines.append(f"      help: {remark.help}")
        return "\n".join(lines)

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        if isinstance(excinfo.value, ClaimFails):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int, str]:
        line, _ = self.place
        return self.path, max(line - 1, 0), f"{self.path.name}: {self.name}"


@pytest.fixture(scope="session")
def gark_method(request: pytest.FixtureRequest) -> Load:
    """Loads a method once in a session, by a name of the catalogue or a path from the root."""
    from garkcli.methodfile.load import load

    root = request.config.rootpath
    loaded: dict[str, MethodFile] = {}

    def method(name: str | Path) -> MethodFile:
        at_root = root / name
        argument = str(at_root) if at_root.is_file() else str(name)
        if argument not in loaded:
            loaded[argument] = load(argument)
        return loaded[argument]

    return method
