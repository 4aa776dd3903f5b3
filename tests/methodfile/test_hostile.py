"""Files made to exhaust, crash or mislead the program, each in a process of its own with little
time and memory.
"""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import pytest

from garkcli import loads
from garkcli.check import analysis
from garkcli.errors import MethodFileError
from tests.cli.harness import ROOT, Run
from tests.cli.harness import gark as call
from tests.whole import IS_WHOLE, in_whole

resource = pytest.importorskip("resource", reason="no limits on processes here")

SECONDS = 15.0
"""Processor time that no answer may take, so that a busy machine does not matter."""
PATIENCE = 60.0
"""After so many seconds of anything a test gives up."""
MEGABYTES = 1500
FAILING = "tests/examples/failing/collocation-misprinted.gark.yaml"


def _limited() -> None:
    with suppress(ValueError, OSError):  # macOS has the limit and refuses it
        resource.setrlimit(resource.RLIMIT_AS, (MEGABYTES << 20, MEGABYTES << 20))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def environment() -> dict[str, str]:
    """That of a plain terminal of 80 columns."""
    return {**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "80", "OPENBLAS_NUM_THREADS": "1"}


def gark(*arguments: str, cwd: Path = ROOT) -> subprocess.CompletedProcess[str]:
    """A run within the limits."""
    done = subprocess.run(
        [sys.executable, "-m", "garkcli", *arguments],
        cwd=cwd,
        env=environment(),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=PATIENCE,
        preexec_fn=_limited,  # no threads here
    )
    return subprocess.CompletedProcess(
        done.args,
        done.returncode,
        done.stdout.decode(errors="replace"),
        done.stderr.decode(errors="replace"),
    )


def refused(run: subprocess.CompletedProcess[str] | Run) -> str:
    """The message of a run that refuses its file: exit code 2, words, and no traceback.

    The run is a process, or a call in this one where limits change nothing.
    """
    if isinstance(run, Run):
        run = subprocess.CompletedProcess("gark", int(str(run.code)), run.out, run.err)
    text = run.stdout + run.stderr
    assert "Traceback" not in text
    assert "internal fault" not in text
    assert run.returncode == 2, text[-500:]
    assert "error[" in text or "Error: " in text or "gark: " in text
    return text


def number(text: str) -> str:
    """A method with one coefficient in quotes."""
    return f"methods: [{{A: [['{text}']], b: [1]}}]\n"


def bomb(levels: int, width: int) -> str:
    """Anchors of anchors: ``width`` to the power of ``levels`` values."""
    lines = ["name: bomb", "a0: &a0 [1/2, 1/2]"]
    lines += [f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * width)}]" for k in range(1, levels)]
    return "\n".join([*lines, f"methods: *a{levels - 1}\n"])


def wide(stages: int) -> str:
    """A b of many stages with an A of one."""
    return f"methods: [{{A: [[1/2]], b: [{', '.join(['1'] * stages)}]}}]\n"


def free(count: int, entry: str, more: str = "") -> str:
    """A family with one coefficient in quotes, which has so many parameters x0, x1, …"""
    names = ", ".join(f"x{k}: free" for k in range(count))
    return f"parameters: {{{names}{more}}}\nA: [['{entry}']]\nb: [1]\n"


def summed(count: int, term: str = "x{}") -> str:
    """A sum of terms, one for each parameter."""
    return "+".join(term.format(k) for k in range(count))


def many(first: str, stages: int = 80) -> str:
    """A matrix whose entries are a parameter p and a number, all different."""
    numbers = range(stages)
    rows = "".join(f"- [{', '.join(f'p+{stages * i + j}' for j in numbers)}]\n" for i in numbers)
    weights = ", ".join([f"1/{stages}"] * stages)
    return f"parameters: {{{first}}}\nA:\n{rows}b: [{weights}]\n"


HOSTILE: dict[str, str | bytes] = {
    "aliases of aliases": bomb(12, 12),
    "a few aliases, used often": bomb(4, 90),
    "aliases in a matrix": "x: &r ["
    + "1," * 600
    + "1]\nmethods: [{A: ["
    + "*r," * 1200
    + "*r], b: [1]}]\n",
    "100 KB of brackets": "methods: " + "[" * 100_000,
    "100 KB of balanced brackets": "methods: " + "[" * 50_000 + "]" * 50_000,
    "100 KB of braces": "{a: " * 25_000 + "}" * 25_000,
    "100 KB of dashes": "- " * 50_000,
    "100 KB of question marks": "? " * 50_000,
    "100 KB of parentheses": number("(" * 50_000 + "1" + ")" * 50_000),
    "minus signs": number("-" * 90_000 + "1"),
    "square roots of square roots": number("sqrt(" * 40 + "2" + ")" * 40),
    "many square roots": number(
        "+".join(f"sqrt({p})" for p in (2, 3, 5, 7, 11, 13, 17, 19, 23, 29))
    ),
    "a long sum": number("+".join(["1/3"] * 30_000)),
    "9**9**9": number("9**9**9"),
    "(9**999)**999": number("(9**999)**999"),
    "9^99999999": number("9^99999999"),
    "1e999999999": number("1e999999999"),
    "1e-999999999": number("1e-999999999"),
    "a number of 5000 digits": number("7" * 5000),
    "a number of 1 MB": number("7" * 1_000_000),
    "a large root": number("root(2, 99999999)"),
    "a tolerance of 10**-999999999": "methods: [{family: rk4}]\ntolerance: 1e-999999999\n",
    "a claim of many digits": f"methods: [{{family: rk4}}]\nexpect: {{order: {'9' * 10_000}}}\n",
    "stages of many digits": f"methods: [{{family: gauss, stages: {'9' * 10_000}}}]\n",
    "10000 stages of a family": "methods: [{family: gauss, stages: 10000}]\n",
    "4000 weights and one stage": wide(4_000),
    "4000 rows of one entry": f"methods: [{{A: [{', '.join(['[1]'] * 4_000)}], b: [1]}}]\n",
    "4000 colours of nothing": f"tableau: {{A: [{', '.join(['[null]'] * 4_000)}], b: [[1]]}}\n",
    "4000 unknown keys": "".join(f"key{k}: 1\n" for k in range(4_000)),
    "4000 doubled keys": "name: a\n" * 4_000,
    "parameters of parameters": "parameters: {p0: 2, "
    + ", ".join(f"p{k}: p{k - 1}*p{k - 1}" for k in range(1, 60))
    + "}\n"
    + number("p59"),
    "a recursive anchor": "methods: &m [*m]\n",
    "a recursive mapping": "methods: &m {family: *m}\n",
    "an anchor as its own key": "&m {*m : 1}\n",
    "a merge of itself": "&m\n<<: *m\nmethods: 1\n",
    "binary junk": bytes(range(256)) * 40,
    "noughts": bytes(10_000),
    "invalid UTF-8": b"name: \xc3\x28\nmethods: 1\n",
    "UTF-16": "methods: [{family: rk4}]\n".encode("utf-16"),
    "half a surrogate": b'name: "\xed\xa0\x80"\n',
    "5 MB of blanks": b" " * 5_000_000,
    "import": number('__import__("os").system("echo pwned")'),
    "a bare import": "methods: [{A: [[__import__('os')]], b: [1]}]\n",
    "a lambda": number("(lambda: 1)()"),
    "attributes": number("(1).__class__"),
    "a Python tag": "methods: !!python/object/apply:os.system ['echo pwned']\n",
    ".nan": "methods: [{A: [[.nan]], b: [1]}]\n",
    ".inf": "methods: [{A: [[.inf]], b: [1]}]\n",
    "nan": number("nan"),
    "inf": number("-inf"),
    "Arabic digits": number("١/٢"),
    "superscripts": number("2²"),
    "fullwidth digits": number("１/２"),
    "a true minus": number("−1"),
    "Arabic stages": "methods: [{family: gauss, stages: ٢}]\n",
    "an empty file": b"",
    "a power of a sum of parameters": free(30, f"({summed(30)})**20"),
    "a product of sums of parameters": free(30, "*".join(f"(1+x{k})" for k in range(30))),
    "a sum of fractions in parameters": free(30, summed(30, "1/(1+x{})")),
    "powers of powers of a sum": free(2, "(((1+x0+x1)**6)**6)**5"),
    "powers in parameters": free(3, "c", ", a: (1+x0+x1+x2)**9, b: (a+1)**9, c: (b+1)**9"),
    "a power of the root of a sum": free(29, f"sqrt(1+{summed(29)})**64"),
    "long coefficients, many of them": many("p: ((10**64)**64)**4"),
}
if IS_WHOLE:  # seconds before it is refused
    HOSTILE["long polynomials, many of them"] = many("x: free, y: free, z: free, p: (1+x+y+z)**20")


ONE_BY_ONE = """
import json, os, resource, sys
from garkcli.cli import main
from garkcli.check import check_file as check

megabytes, *files = sys.argv[1:]
# what a first run loads, here and not in every child: a good file and a bad one
for first in ("good.yaml", "bad.yaml"):
    try:
        main(["check", first, "-o", first + ".report"])
    except SystemExit:
        pass
for file in files:
    child = os.fork()
    if child == 0:
        limit = int(megabytes) << 20
        try:
            resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        except (ValueError, OSError):
            pass  # macOS has the limit and refuses it
        resource.setrlimit(resource.RLIMIT_CPU, (10, 10))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        report = os.open(file + ".report", os.O_CREAT | os.O_WRONLY, 0o600)
        os.dup2(report, 1)
        os.dup2(report, 2)
        try:
            main(["check", file])
        except SystemExit as end:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(int(end.code or 0))  # without taking down all that is loaded
    _, status, usage = os.wait4(child, 0)
    seconds = usage.ru_utime + usage.ru_stime
    unit = 2**20 if sys.platform == "darwin" else 1024
    answer = [os.waitstatus_to_exitcode(status), seconds, usage.ru_maxrss / unit]
    print(json.dumps(answer), flush=True)
"""
"""Checks files one after the other, each in a process of its own that has the program loaded
already.
"""


@dataclass(frozen=True)
class Answer:
    """What became of one file; ``seconds`` of processor time."""

    code: int
    seconds: float
    megabytes: float
    text: str


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Answer]:
    """The answers to all hostile files."""
    folder = tmp_path_factory.mktemp("hostile")
    names = {what: f"m{k}.gark.yaml" for k, what in enumerate(HOSTILE)}
    for what, content in HOSTILE.items():
        (folder / names[what]).write_bytes(
            content.encode() if isinstance(content, str) else content
        )
    (folder / "good.yaml").write_text(number("1/2 - sqrt(3)/6"))
    (folder / "bad.yaml").write_text(number("1/"))
    command = [sys.executable, "-c", ONE_BY_ONE, str(MEGABYTES), *names.values()]
    done = subprocess.run(
        command, cwd=folder, env=environment(), capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    found = [json.loads(line) for line in done.stdout.splitlines()]
    texts = [(folder / f"{name}.report").read_text(errors="replace") for name in names.values()]
    return {what: Answer(*x, text) for what, x, text in zip(HOSTILE, found, texts, strict=True)}


@pytest.mark.parametrize("what", HOSTILE)
def test_a_hostile_file_is_refused(what: str, answers: dict[str, Answer]) -> None:
    """Exit code 2 and a message, soon, in little memory; nothing in the file was executed."""
    answer = answers[what]
    assert "Traceback" not in answer.text
    assert answer.code == 2, answer.text[-500:]
    assert re.match(r"m[0-9]+\.gark\.yaml(:[0-9]+:[0-9]+)?: error\[[a-z0-9-]+\]: .", answer.text)
    assert answer.seconds < SECONDS
    assert answer.megabytes < 1000
    lines = answer.text.splitlines()
    assert "pwned" not in lines
    assert max(map(len, lines)) < 12_000


def test_a_tag_runs_nothing(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """A Python tag on a coefficient changes nothing: the text is read as the number it is."""
    (tmp_path / "m.gark.yaml").write_text(
        "methods: [{A: [[!!python/object/apply:os.system 'echo pwned']], b: [1]}]\n"
    )
    assert "pwned" not in refused(call("check", "m.gark.yaml", cwd=tmp_path)).splitlines()
    assert capfd.readouterr() == ("", "")


def big_explicit(stages: int, entry: str) -> str:
    """An explicit method that is well formed: ``entry`` below the diagonal, equal weights."""
    rows = [f"[{', '.join([entry] * i + ['0'] * (stages - i))}]" for i in range(stages)]
    weights = ", ".join([f"1/{stages}"] * stages)
    return f"methods:\n- A: [{', '.join(rows)}]\n  b: [{weights}]\n"


@pytest.mark.parametrize(
    ("stages", "entry"), [(300, "1/300"), pytest.param(100, "'cbrt(2)/100'", marks=in_whole)]
)
def test_a_big_method_is_answered_or_refused(stages: int, entry: str, tmp_path: Path) -> None:
    """Hundreds of explicit stages, rational or not: an order or a refusal, in 15 seconds of work and
    500 MB.
    """
    file = tmp_path / "m.gark.yaml"
    file.write_text(big_explicit(stages, entry))
    # a process counts the memory of the one that started it, which is small here, unlike pytest
    script = (
        "import resource, subprocess, sys\n"
        "command = [sys.executable, '-m', 'garkcli', 'check', 'm.gark.yaml', '--format', 'json']\n"
        "done = subprocess.run(command)\n"
        "usage = resource.getrusage(resource.RUSAGE_CHILDREN)\n"
        "print(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, file=sys.stderr)\n"
        "sys.exit(done.returncode)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script],
        cwd=tmp_path,
        env=environment(),
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        preexec_fn=_limited,
    )
    assert done.returncode in {0, 2}, done.stderr[-500:]
    assert ('"order": 1,' if done.returncode == 0 else '"errors"') in done.stdout
    seconds, megabytes = map(float, done.stderr.split()[-2:])
    assert seconds < SECONDS
    assert megabytes < 500


# -- things that are no files
# -------------------------------------------------------------------------------------


@in_whole
def test_what_is_no_file_is_refused(tmp_path: Path) -> None:
    """A directory without methods, a missing file, a FIFO nobody writes to, a socket's place and a
    device.
    """
    os.mkfifo(tmp_path / "fifo.gark.yaml")
    (tmp_path / "folder").mkdir()
    (tmp_path / "loop.gark.yaml").symlink_to("loop.gark.yaml")
    (tmp_path / "dangling.gark.yaml").symlink_to("nowhere")
    names = (
        "fifo.gark.yaml",
        "folder",
        "nowhere.gark.yaml",
        "loop.gark.yaml",
        "dangling.gark.yaml",
    )
    for name in names:
        assert name in refused(call("check", name, cwd=tmp_path))
    assert "/dev/zero" in refused(gark("check", "/dev/zero", cwd=tmp_path))
    assert "fifo.gark.yaml" in refused(gark("check", ".", "-j", "2", cwd=tmp_path))


@pytest.mark.parametrize("command", ["tableau", "conjugate", "converge", "conditions"])
def test_other_commands_refuse_them_too(command: str, tmp_path: Path) -> None:
    """Every command that reads a method refuses a FIFO, a bomb and junk on standard input."""
    os.mkfifo(tmp_path / "fifo.gark.yaml")
    (tmp_path / "bomb.gark.yaml").write_text(bomb(12, 12))
    options = ("-n", "2") if command == "conditions" else ()
    for name in ("fifo.gark.yaml", "bomb.gark.yaml"):
        refused(call(command, name, *options, cwd=tmp_path))
    refused(call(command, "-", *options, stdin=bytes(range(256))))


@in_whole
def test_an_endless_standard_input_is_refused() -> None:
    """Standard input is read to its limit and not to its end."""
    with Path("/dev/zero").open("rb") as endless:
        done = subprocess.run(
            [sys.executable, "-m", "garkcli", "check", "-"],
            stdin=endless,
            env=environment(),
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            preexec_fn=_limited,
        )
    assert "more than" in refused(done)


@in_whole
def test_a_name_with_an_odd_byte_is_only_a_name(tmp_path: Path) -> None:
    """A file name that is no UTF-8 is checked, and reported in every format."""
    (Path(os.fsdecode(bytes(tmp_path) + b"/a\xff\nb.gark.yaml"))).write_text(
        "methods: [{family: rk4}]\nexpect: {order: 5}", encoding="utf-8"
    )
    process = gark("check", ".", cwd=tmp_path)
    assert (process.returncode, process.stderr) == (1, "")
    for format in ("text", "json", "sarif", "junit", "github", "markdown"):
        run = call("check", ".", "--format", format, cwd=tmp_path, encoding="utf-8")
        assert (run.code, run.err) == (1, "")


# -- where a report goes
# ------------------------------------------------------------------------------------------

RUNS = [("check", FAILING), ("trees", "-N", "3", "-n", "8"), ("list",), ("schema",)]


@in_whole
@pytest.mark.parametrize("arguments", RUNS[:2], ids=lambda arguments: arguments[0])
def test_a_full_disk_is_said(arguments: tuple[str, ...]) -> None:
    """A full disk under stdout is exit code 2 and one line that says so, whether a report is written
    at once or as it is made.
    """
    command = [sys.executable, "-m", "garkcli", *arguments]
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        done = subprocess.run(
            command, cwd=ROOT, env=environment(), stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert (done.returncode, done.stderr) == (
        2,
        "gark: the report cannot be written: No space left on device\n",
    )


@pytest.mark.parametrize("arguments", RUNS, ids=lambda arguments: arguments[0])
def test_a_full_disk_under_a_file_is_said(arguments: tuple[str, ...]) -> None:
    """So it is with -o."""
    run = call(*arguments, "-o", "/dev/full")
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith("gark: cannot write /dev/full: No space left on device\n")


def test_a_place_that_cannot_be_written_is_said(tmp_path: Path) -> None:
    """A missing directory, a directory and a file where a directory should be: exit code 2, nothing
    left.
    """
    (tmp_path / "file").write_text("kept")
    for place in ("nowhere/report", ".", "file/report"):
        run = call("list", "-o", place, cwd=tmp_path)
        assert refused(run).startswith(f"gark: cannot write {place}: ")
    assert [x.name for x in tmp_path.iterdir()] == ["file"]
    assert (tmp_path / "file").read_text() == "kept"


@in_whole
def test_a_file_limit_leaves_nothing_half_written(tmp_path: Path) -> None:
    """Where the disk ends in the middle of a report, the old report stays whole and nothing else is
    left.
    """

    def small() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

    (tmp_path / "trees.csv").write_text("old\n")
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "garkcli",
            "trees",
            "-N",
            "3",
            "-n",
            "7",
            "--format",
            "csv",
            "-o",
            "trees.csv",
        ],
        cwd=tmp_path,
        env={**environment(), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        preexec_fn=small,
    )
    assert done.returncode == 2, done.stderr
    assert "cannot write trees.csv" in done.stderr
    assert [x.name for x in tmp_path.iterdir()] == ["trees.csv"]
    assert (tmp_path / "trees.csv").read_text() == "old\n"


def interrupted(arguments: Sequence[str], cwd: Path, ready: str) -> tuple[int, str]:
    """Exit code and stderr of a run that gets ^C once ``ready`` is true, with its workers, as from
    a terminal.
    """
    running = subprocess.Popen(
        [sys.executable, "-m", "garkcli", *arguments],
        cwd=cwd,
        env=environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        # what is started in the background of a script ignores ^C, and so do its children
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    with running:
        try:
            deadline = time.monotonic() + PATIENCE
            while (
                time.monotonic() < deadline
                and running.poll() is None
                and not _ready(running.pid, cwd, ready)
            ):
                time.sleep(0.01)
            assert running.poll() is None, "the work was done before it could be interrupted"
            os.killpg(running.pid, signal.SIGINT)
            _, err = running.communicate(timeout=PATIENCE)
        finally:
            running.kill()
    return running.returncode, err


def _ready(pid: int, cwd: Path, ready: str) -> bool:
    """Whether a temporary file has been begun, or workers have been started."""
    if ready == "file":
        return any(x.name.startswith(".") and x.stat().st_size > 0 for x in cwd.iterdir())
    children = Path(f"/proc/{pid}/task/{pid}/children")
    return len(children.read_text(encoding="utf-8").split()) >= 2


@in_whole
@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="needs /proc to see workers")
def test_an_interrupt_ends_workers(tmp_path: Path) -> None:
    """^C during a check of many files by two workers: exit code 130, no traceback, no worker and no
    file left.
    """
    # minutes of work in all, so that none of it is done before a busy machine gets to the ^C
    methods = "[{family: gauss, stages: 90}, {family: lobatto-iiia, stages: 91}]"
    slow = f"methods: {methods}\ntransfer: collocation\n"
    for k in range(40):
        (tmp_path / f"m{k}.gark.yaml").write_text(slow)
    code, err = interrupted(("check", "-j", "2", ".", "-o", "report"), tmp_path, "workers")
    assert (code, err.strip()) == (130, "")
    assert {x.suffix for x in tmp_path.iterdir()} == {".yaml"}


@in_whole
def test_an_interrupt_leaves_no_file(tmp_path: Path) -> None:
    """^C during a long listing into a file: exit code 130, no traceback, no file under any name."""
    arguments = ("trees", "-N", "4", "-n", "9", "--yes", "--format", "csv", "-o", "trees.csv")
    code, err = interrupted(arguments, tmp_path, "file")
    assert (code, err.strip()) == (130, "")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "arguments",
    [pytest.param("check methods -v -j 2", marks=in_whole), "trees -N 3 -n 8 --format csv"],
)
def test_a_reader_that_goes_away(arguments: str) -> None:
    """``| head -1`` of any long report ends quietly, with a line on stdout and nothing on
    stderr.
    """
    command = f'"{sys.executable}" -m garkcli {arguments} | head -1'
    done = subprocess.run(
        command, shell=True, cwd=ROOT, env=environment(), capture_output=True, text=True, timeout=30
    )
    assert done.stdout.count("\n") == 1
    assert done.stderr == ""


# -- faults of our own
# --------------------------------------------------------------------------------------------


BREAKING = (
    "import sys\n"
    "import garkcli.check.analysis as check\n"
    "def order_of(*_): raise RuntimeError('broken\\nin two lines')\n"
    "check.order_of = order_of\n"
    "from garkcli.cli import main\n"
    "main(sys.argv[1:])\n"
)
"""A program whose order finder is broken."""


def order_of(*_: object) -> object:
    """An order finder that is broken."""
    raise RuntimeError("broken\nin two lines")


def told_of_each_file(run: Run) -> None:
    """A fault of the program is told of every file that meets it, and the exit code is 3."""
    assert run.code == 3
    lines = run.out.splitlines()
    told = [
        line
        for line in lines
        if line.endswith("error[internal-fault]: internal fault: RuntimeError: broken")
    ]
    helps = [line for line in lines if "please report it" in line]
    files = (ROOT / "methods").rglob("*.gark.yaml")
    # steps of Nyström methods are not analysed there
    count = sum("\nnystrom:" not in file.read_text(encoding="utf-8") for file in files)
    assert len(told) == len(helps) == count
    assert "Traceback" not in run.out + run.err


def test_a_fault_of_our_own(monkeypatch: pytest.MonkeyPatch) -> None:
    """The others are gone on with."""
    monkeypatch.setattr(analysis, "order_of", order_of)
    told_of_each_file(call("check", "methods"))


@in_whole
def test_a_fault_of_our_own_in_a_worker() -> None:
    """As in the program itself."""
    command = [sys.executable, "-c", BREAKING, "check", "methods", "-j", "2"]
    done = subprocess.run(
        command, cwd=ROOT, env=environment(), capture_output=True, text=True, timeout=PATIENCE
    )
    told_of_each_file(Run(done.returncode, done.stdout, done.stderr))


def test_a_fault_of_our_own_in_full(monkeypatch: pytest.MonkeyPatch) -> None:
    """``--debug`` shows the traceback of the fault."""
    monkeypatch.setattr(analysis, "order_of", order_of)
    monkeypatch.setattr(sys, "argv", ["gark", "--debug"])  # a check of one file looks there
    run = call("--debug", "check", "methods/rectangular.gark.yaml")
    assert run.code == 3
    assert run.err.startswith("Traceback")
    assert "in order_of" in run.err
    assert "RuntimeError: broken" in run.err


@pytest.mark.parametrize("text", ["null", "1", "{a: 1}"])
def test_a_matrix_that_is_no_list_is_one_fault(text: str) -> None:
    """It is not counted as a matrix without rows as well."""
    with pytest.raises(MethodFileError) as caught:
        loads(f"A: {text}\nb: [1]\n")
    (fault,) = caught.value.faults
    assert "a list is expected" in fault.message
