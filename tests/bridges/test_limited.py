"""Sources are read by a process that a limit of time ends, as grammars in C hear of nothing."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

import garkcli.bridges.audit
from garkcli import audit, import_methods
from garkcli.bridges import limited
from garkcli.bridges.audit import Audited
from garkcli.crew import processes
from garkcli.report.audited import FORMATS
from garkcli.sources.found import FoundTable
from garkcli.sources.languages import c
from garkcli.sources.lowering import Lowering
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole, sample

KUTTA = "A = [[], [0.5], [-1, 2]]\nb = [1/6, 2/3, 1/6]\nc = [0, 0.5, 1]\n"
LONG = "A = [1 ...\n" * 20_000
"""MATLAB that its grammar takes some ten seconds for, whatever the machine."""
WHY = "was not read: the parser took longer than 0 s"


@pytest.fixture
def sources(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """A source that takes long between two that do not, which have some time all the same."""
    texts = {"a.py": KUTTA, "long.m": LONG, "z.py": KUTTA}
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    monkeypatch.setattr(limited, "_seconds", lambda x: 0.3 if x.size > 1000 else 60)
    return [str(tmp_path / name) for name in texts]


@pytest.mark.parametrize("jobs", [1, 2])
def test_an_audit_goes_on_behind_a_source_that_takes_too_long(
    jobs: int, sources: list[str]
) -> None:
    """The process that read it is ended, another one reads the rest; the source is a warning."""
    found = list(audit(sources, jobs=jobs))
    assert [x.table.source for x in found] == sources
    assert [x.is_read for x in found] == [True, False, True]
    assert [x.findings for x in found if x.is_read] == [(), ()]
    (finding,) = found[1].findings
    assert (finding.code, finding.level, finding.message) == ("unread", "warning", WHY)


def _broken(text: str, source: str) -> list[FoundTable]:
    return [] if text == KUTTA else [[][len(source)]]


def test_a_fault_in_one_source_is_a_note_there(sources: list[str]) -> None:
    (found,) = limited.read_within_limits(sources, _broken)
    assert found.source == sources[1]
    assert "internal fault: IndexError" in found.trouble


SLOW = "slow"


def _slowly(table: FoundTable) -> str:
    """As a judge that works without end on one table, and waits for long at another one."""
    while table.name == SLOW:
        pass
    time.sleep(0.5 if table.name == "idle" else 0)
    return f"{table.name} judged"


def _read(text: str, source: str) -> list[FoundTable]:
    return [FoundTable(source, 1, "", name, (), ()) for name in text.split()]


def test_one_table_that_takes_too_long_does_not_cost_the_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its time is its own, and that of the processor: who waits for that is not late."""
    monkeypatch.setattr(limited, "JUDGING_SECONDS", 0.2)
    monkeypatch.setattr(limited, "SMALL", 0)
    path = tmp_path / "a.py"
    path.write_text(f"first {SLOW} idle last")
    given = limited.judged_within_limits(
        [str(path)], _read, _slowly, lambda table, seconds: f"{table.name} {seconds}"
    )
    idle = "idle judged" if sys.platform == "linux" else "idle longer than 0 s"
    assert list(given) == ["first judged", "slow longer than 0 s", idle, "last judged"]


def test_a_table_that_takes_too_long_is_a_note(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The source is read, and its other tables are judged."""
    monkeypatch.setattr(limited, "JUDGING_SECONDS", 0.3)
    monkeypatch.setattr(limited, "SMALL", 0)
    judging = garkcli.bridges.audit._audit

    def slow(table: FoundTable) -> Audited | None:
        while table.name == "Second":
            pass
        return judging(table)

    monkeypatch.setattr(garkcli.bridges.audit, "_audit", slow)
    path, arrays = tmp_path / "a.py", KUTTA.replace("\n", "\n    ")
    path.write_text(f"class First:\n    {arrays}\nclass Second:\n    {arrays}")
    first, second = audit([str(path)])
    assert (first.is_read, second.is_read, second.looks_like) == (True, False, True)
    (finding,) = second.findings
    assert (finding.code, finding.level) == ("unjudged", "note")
    assert finding.message == "read, not judged: judging took longer than 0 s"


@in_whole
def test_it_is_told_in_every_format(sources: list[str]) -> None:
    """It is no error, but ``--strict`` fails on it; a source of its own is none that can be read."""
    text = gark("audit", *sources)
    assert (text.code, text.err) == (0, "")
    assert text.out.split("\n")[0] == "2 tables in 2 files, none wrong; 1 source was not read"
    assert f"long.m\n    warning  {WHY}\n" in text.out
    for format in sample(sorted(FORMATS.keys() - {"auto"}), 3):
        run = gark("audit", *sources, "--strict", "--format", format)
        assert (run.code, WHY in run.out, "long.m" in run.out) == (1, True, True), format
    assert gark("audit", sources[1]).code == 2


@in_whole
def test_an_import_goes_on(sources: list[str]) -> None:
    """Its methods are those of the other sources; the report and the notes have the reason."""
    assert [str(method.name) for method in import_methods(*sources)] == ["a", "z"]
    run = gark("import", *sources, "--format", "json")
    assert (run.code, run.err) == (0, f"{sources[1]} {WHY}\n")
    notes = {x["source"]: x["notes"] for x in json.loads(run.out)["methods"]}
    assert notes[sources[1]] == [WHY]
    run = gark("import", "-", stdin=LONG)
    assert run.code == 2
    assert run.err.startswith(f"gark: <stdin> {WHY}\nhelp: ")


@in_whole
def test_the_same_is_found_apart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another process, forked or not, finds what this one finds, of streams too."""
    path = tmp_path / "kutta.py"
    path.write_text(KUTTA)
    here, stream = gark("import", str(path)), gark("audit", "-", stdin=KUTTA)
    monkeypatch.setattr(limited, "SMALL", 0)
    assert gark("import", str(path)) == here
    assert gark("audit", "-", stdin=KUTTA) == stream
    monkeypatch.setattr(processes, "start_method", lambda: "spawn")
    assert gark("import", str(path)) == here


@in_whole
def test_a_program_is_not_run_again(tmp_path: Path) -> None:
    """A process that is not forked would run the program that calls gark, where it does not ask for
    its name.
    """
    (tmp_path / "kutta.py").write_text(KUTTA)
    program = tmp_path / "program.py"
    program.write_text(
        "from garkcli import import_methods\nfrom garkcli.bridges import limited\n"
        "from garkcli.crew import processes\nlimited.SMALL = 0\n"
        "processes.start_method = lambda: 'spawn'\nprint(import_methods('kutta.py'))\n"
    )
    run = subprocess.run(
        [sys.executable, str(program)],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (run.stdout, run.stderr) == ("[<MethodFile kutta: 1 colour, stages 3>]\n", "")


def test_limits_grow_with_sources() -> None:
    """A megabyte has more time than a kilobyte, and both have some."""
    seconds = [
        limited._seconds(limited.SourceToRead("x", size)) for size in (0, 1000, 10**6, 4 * 10**6)
    ]
    assert seconds == [20, 20, 40, 100]


@pytest.mark.parametrize(
    ("text", "length"),
    [
        ("double b = 1; /* " * 9, 14),
        ("/* a */ x; /* b", 11),
        ("/*/ x", 0),
        ("s = \"/*\"; // /*\nt = '\"'; /* a */ y = '/*';", 42),
    ],
)
def test_a_comment_that_never_ends_is_left_out(
    text: str, length: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its grammar takes time like the cube of what is in it; texts and other comments stay."""
    given: list[bytes] = []
    parse = Lowering.parse
    monkeypatch.setattr(Lowering, "parse", lambda self, x: given.append(x) or parse(self, x))
    c.CLowering(text, c.CPP).module()
    assert [len(x) for x in given] == [length]
