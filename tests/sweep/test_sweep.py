"""``gark sweep``: many methods, each row once, whatever ends the run."""

from __future__ import annotations

import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import jsonschema
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli import analyse, loads
from garkcli.constructions.rosenbrock import DAE_VIEWS, VIEWS
from garkcli.errors import MethodError, MethodFileError, UsageProblem
from garkcli.exact.apart import start_method
from garkcli.frozen import replace
from garkcli.order.constants import error_constants
from garkcli.plots.curves import sweep_scene
from garkcli.plots.scene import Curve
from garkcli.report.schemas import report_schema
from garkcli.stability.oscillator import usual_oscillator
from garkcli.sweep import run as running
from garkcli.sweep.columns import columns, kind_of
from garkcli.sweep.file import load_plan
from garkcli.sweep.plan import Plan, Point
from garkcli.sweep.report import SweepReport, best_first, kept, pareto_front
from garkcli.sweep.row import Row, row_of
from garkcli.sweep.store import RowStore
from garkcli.tableau.forms import pair
from tests.cli.harness import gark
from tests.had import needs_fifos, needs_locks
from tests.whole import at_most, in_whole

SPEC = """name: small
methods:
  - {family: [gauss, radau-iia], stages: 1..2}
  - {family: lobatto-iiia, stages: [2, 3]}
transfer: [collocation, {interpolation: tau, collocation: 1 - tau}]
parameters: {tau: {from: 0, to: 1, steps: 2}}
columns: [pair-order, p-stable, pair-p-stable, stages]
where: {order: ">= 2"}
best: [order, error]
pareto: [order, stages]
"""

STEPS = at_most(16, 40)
LONG = SPEC.replace("steps: 2", f"steps: {STEPS}").replace("p-stable, pair-p-stable, ", "")
"""144 methods, and 336 in ``make whole``."""
LONG = LONG.replace("best: [order, error]", "best: [order]")


@pytest.fixture
def spec(tmp_path: Path) -> Path:
    """A spec file of 32 methods."""
    path = tmp_path / "spec.yaml"
    path.write_text(SPEC, encoding="utf-8")
    return path


def rows_in(path: Path) -> list[Row]:
    """The rows of a file; each line is one."""
    return [json.loads(line) for line in path.read_text("utf-8").splitlines()]


def test_a_rule_with_its_degree_is_one_of_the_rules(tmp_path: Path) -> None:
    """The Legendre transfer with the degree that it takes, and with others: of these K = 0 loses
    the order of the pair.
    """
    rules = "[legendre, {rule: legendre, degree: 0}, {rule: legendre, degree: 1}]"
    methods = "[{family: rk4}, {family: gauss, stages: 2}]"
    path = tmp_path / "spec.yaml"
    path.write_text(f"methods: {methods}\ntransfer: {rules}\ncolumns: [pair-order]\n", "utf-8")
    assert gark("sweep", str(path)).code == 0
    found = {row["method"]: row["pair-order"] for row in rows_in(path.with_suffix(".jsonl"))}
    names = ("legendre", "legendre, degree 0", "legendre, degree 1")
    assert found == {f"rk4 4 + gauss 2; {x}": y for x, y in zip(names, (4, 2, 4), strict=True)}


@in_whole
def test_all_methods_once(spec: Path) -> None:
    """Families × stages × rules × values: a key each, and the verdicts of ``gark check``."""
    assert gark("sweep", str(spec)).code == 0
    rows = rows_in(spec.with_suffix(".jsonl"))
    assert len(rows) == len({row["key"] for row in rows}) == 2 * 2 * 2 * (1 + 3)
    for point in load_plan(str(spec)).points():
        (row,) = [x for x in rows if x["key"] == point.key]
        found = analyse(loads(point.template.text, settings=point.settings))
        assert row["order"] == found.order.order
        assert row["kept"] is (found.order.order >= 2)
        if row["kept"]:
            assert found.pair_order is not None
            assert row["pair-order"] == found.pair_order.order
            assert row["p-stable"] is found.subject.verdict("p-stable").value
            oscillator = usual_oscillator(pair(found.tableau))
            assert row["pair-p-stable"] is (None if oscillator is None else oscillator.is_p_stable)
        else:
            assert "pair-order" not in row


@in_whole
def test_resumed(spec: Path) -> None:
    """What is there is not done again; torn lines are; nothing is doubled; rows end up the same."""
    rows = spec.with_suffix(".jsonl")
    gark("sweep", str(spec))
    whole = rows.read_bytes()
    lines = whole.splitlines(keepends=True)
    refused = gark("sweep", str(spec))
    assert (refused.code, "--resume does what is missing" in refused.err) == (2, True)
    rows.write_bytes(b"".join(lines[:7]) + lines[7][:-5])
    resumed = gark("sweep", str(spec), "--resume")
    assert resumed.code == 0
    assert f"{len(lines) - 7} rows added" in resumed.err
    assert rows.read_bytes() == whole
    again = gark("sweep", str(spec), "--resume")
    assert "0 rows added" in again.err
    more = SPEC.replace("steps: 2", "steps: 4")
    spec.write_text(more, encoding="utf-8")
    grown = gark("sweep", str(spec), "--resume")
    assert "16 rows added" in grown.err


def row_like(key: str, order: int) -> Row:
    """A row as a file has it."""
    return {"key": key, "spec": "0", "kept": True, "method": key, "parameters": {}, "order": order}


@pytest.mark.parametrize(
    "line",
    [
        "[" * 100_000,
        "[1, 2]",
        '{"key": "a"}',
        json.dumps({**row_like("a", 1), "kept": "yes"}),
        json.dumps({**row_like("a", 1), "parameters": {"t": 1}}),
        json.dumps({**row_like("a", 1), "order": "4"}),
        json.dumps({**row_like("a", 1), "error": float("nan")}),
        json.dumps({**row_like("a", 1), "failure": []}),
    ],
)
def test_damaged_rows_are_refused(line: str, tmp_path: Path) -> None:
    """A line that is no row, whatever is wrong with it, is named: nothing is made of it."""
    path = tmp_path / "rows.jsonl"
    good = json.dumps(row_like("b", 1))
    path.write_text(f"{good}\n{line}\n", encoding="utf-8")
    with pytest.raises(UsageProblem, match="line 2: this is not a row"):
        RowStore(str(path), is_resumed=True)


@needs_fifos
def test_rows_are_a_regular_file(tmp_path: Path) -> None:
    """What is endless or never comes is not read; the null device has no rows and keeps none."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for path in ("/dev/zero", str(pipe)):
        with pytest.raises(UsageProblem, match="not a regular file"):
            RowStore(path, is_resumed=True)
    with RowStore(os.devnull, is_resumed=False) as store:
        store.add(row_like("a", 1))


@settings(max_examples=20)
@given(st.data())
def test_cut_anywhere(data: st.DataObject) -> None:
    """A file that was cut at any byte has, once resumed, each row once and no other."""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "rows.jsonl"
        rows = [row_like(f"{k}é", k) for k in range(6)]
        with RowStore(str(path), is_resumed=False) as store:
            for row in rows:
                store.add(row)
                store.add(row)
        whole = path.read_bytes()
        cut = data.draw(st.integers(0, len(whole)))
        path.write_bytes(whole[:cut])
        with RowStore(str(path), is_resumed=True) as store:
            for row in rows:
                store.add(row)
        assert path.read_bytes() == whole


@in_whole
def test_rows_of_others(spec: Path, tmp_path: Path) -> None:
    """Rows of other criteria, lines that are no rows, and files in use are refused."""
    gark("sweep", str(spec))
    spec.write_text(SPEC.replace("p-stable, pair-p-stable, ", ""), encoding="utf-8")
    other = gark("sweep", str(spec), "--resume")
    assert (other.code, "rows of another spec" in other.err) == (2, True)
    rows = tmp_path / "other.jsonl"
    rows.write_text("nothing\n", encoding="utf-8")
    no_row = gark("sweep", str(spec), "--resume", "--rows", str(rows))
    assert (no_row.code, "line 1: this is not a row" in no_row.err) == (2, True)
    gone = gark("sweep", str(spec), "--rows", str(tmp_path / "no" / "rows"))
    assert (gone.code, "cannot be written" in gone.err) == (2, True)


def test_numbers_that_are_too_large_are_told_as_such(spec: Path) -> None:
    """One fault each, which names the limit."""
    text = SPEC.replace("steps: 2", "steps: 10000000")
    text = text.replace("1..2", "1..3000")
    spec.write_text(text, encoding="utf-8")
    with pytest.raises(MethodFileError) as caught:
        load_plan(str(spec))
    first, second = (fault.message for fault in caught.value.faults)
    assert "'1..3000' is not a range" in first
    assert "a whole number of at most 6 digits" in second


@in_whole
@needs_locks
def test_a_file_in_use(tmp_path: Path) -> None:
    """Two processes do not write to one file."""
    path = str(tmp_path / "open.jsonl")
    script = (
        "import sys; from garkcli.sweep.store import RowStore\n"
        "with RowStore(sys.argv[1], False): print('open', flush=True); sys.stdin.read()"
    )
    command = [sys.executable, "-c", script, path]
    with subprocess.Popen(command, stdin=-1, stdout=-1) as process:
        assert process.stdout is not None
        process.stdout.readline()
        with pytest.raises(UsageProblem, match="another sweep"):
            RowStore(path, True)
        process.communicate()
    RowStore(path, True).__exit__(None, None, None)


@in_whole
def test_side_by_side(spec: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two processes have the rows of one; a method that ends its process gets a row, no other."""
    gark("sweep", str(spec))
    rows = spec.with_suffix(".jsonl")
    alone = {str(row["key"]): row for row in rows_in(rows)}
    rows.unlink()
    monkeypatch.setattr(running, "CHUNK", 3)
    assert gark("sweep", str(spec), "--jobs", "2").code == 0
    assert {str(row["key"]): row for row in rows_in(rows)} == alone
    if start_method() != "fork":
        return  # workers that are not forked do not see the change below
    rows.unlink()
    fatal = sorted(alone)[5]

    def ends(criteria: object, point: Point) -> Row:
        if point.key == fatal:
            os.kill(os.getpid(), signal.SIGKILL)
        return row_of(criteria, point)  # type: ignore[arg-type]

    monkeypatch.setattr(running, "row_of", ends)
    assert gark("sweep", str(spec), "--jobs", "2").code == 0
    found = {str(row["key"]): row for row in rows_in(rows)}
    assert "SIGKILL" in str(found.pop(fatal)["failure"])
    del alone[fatal]
    assert found == alone


@in_whole
@pytest.mark.skipif(os.name == "nt", reason="there are no such signals")
def test_killed_and_resumed(spec: Path) -> None:
    """A sweep that is killed while it writes goes on to the rows of one that was not; its workers
    end with it, and with them the pipe that they hold.
    """
    rows = spec.with_suffix(".jsonl")
    spec.write_text(LONG, encoding="utf-8")
    command = [sys.executable, "-m", "garkcli", "sweep", str(spec), "--jobs", "2"]
    with subprocess.Popen(command, stdout=-1, stderr=-3) as process:
        while process.poll() is None and not (rows.exists() and rows.stat().st_size):
            time.sleep(0.01)
        process.kill()
        process.communicate(timeout=100)
    count = len(rows.read_bytes().splitlines())
    assert count > 0
    resumed = gark("sweep", str(spec), "--resume")
    assert resumed.code == 0
    found = rows_in(rows)
    assert len({row["key"] for row in found}) == len(found) == 8 * (STEPS + 2)


def test_without_dask(spec: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is missing is said, with the cure."""
    monkeypatch.setitem(sys.modules, "dask.distributed", None)
    run = gark("sweep", str(spec), "--scheduler", "tcp://127.0.0.1:1")
    assert (run.code, "garkcli[cluster]" in run.err) == (2, True)


def test_without_pyarrow(spec: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same of Parquet."""
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    run = gark("sweep", str(spec), "--parquet", str(spec.with_suffix(".parquet")))
    assert (run.code, "garkcli[parquet]" in run.err) == (2, True)


def test_parquet(spec: Path) -> None:
    """The table has the rows of the CSV."""
    parquet = pytest.importorskip("pyarrow.parquet")
    path = spec.with_suffix(".parquet")
    run = gark("sweep", str(spec), "--parquet", str(path), "--format", "csv")
    table = parquet.read_table(path).to_pylist()
    lines = list(csv.DictReader(io.StringIO(run.out)))
    assert [row["key"] for row in table] == [row["key"] for row in lines]
    assert [row["order"] for row in table] == [int(row["order"]) for row in lines]


@in_whole
def test_reports(spec: Path) -> None:
    """JSON keeps its schema; CSV and JSON lines have all rows that are kept, best first."""
    data = json.loads(gark("sweep", str(spec), "--format", "json").out)
    jsonschema.validate(data, report_schema("sweep"))
    resumed = ("sweep", str(spec), "--resume", "--format")
    lines = list(csv.DictReader(io.StringIO(gark(*resumed, "csv").out)))
    rows = [json.loads(line) for line in gark(*resumed, "jsonl").out.splitlines()]
    assert [x["key"] for x in lines] == [x["key"] for x in rows]
    assert len(rows) == data["kept"]
    assert data["best"] == rows[:10]
    orders = [row["order"] for row in rows]
    assert orders == sorted(orders, reverse=True)
    text = gark("sweep", str(spec), "--resume").out
    assert f"small: 32 methods, {data['kept']} kept" in text
    assert max(map(len, text.splitlines())) <= 80
    told = gark(*resumed, "markdown").out
    assert "| number | order |" in told
    assert re.search(r"… \d+ more with -v", told)
    assert "more with -v" not in gark(*resumed, "markdown", "-v").out


@in_whole
def test_the_plot(spec: Path) -> None:
    """A point for each method that is kept, and one more for those of the front; the same bytes
    every time; what cannot be drawn is refused before the work.
    """
    first, second = spec.with_suffix(".svg"), spec.with_name("again.svg")
    assert gark("sweep", str(spec), "--plot", str(first)).code == 0
    assert gark("sweep", str(spec), "--resume", "--plot", str(second)).code == 0
    assert first.read_bytes() == second.read_bytes()
    rows = spec.with_suffix(".jsonl")
    report = SweepReport(
        str(spec), load_plan(str(spec)), {str(x["key"]): x for x in rows_in(rows)}, 1
    )
    (panel,) = sweep_scene(report).panels
    drawn = [curve.points for curve in panel.legend if isinstance(curve, Curve)]
    everything = [(x["order"], x["stages"]) for x in kept(report.done)]
    assert drawn == [everything, [(x["order"], x["stages"]) for x in report.front]]
    with pytest.raises(MethodError, match="nothing to draw"):
        sweep_scene(replace(report, rows={}))
    rows.unlink()
    assert gark("sweep", str(spec), "--plot", "figure.txt").code == 2
    spec.write_text(SPEC.replace("pareto: [order, stages]\n", ""), encoding="utf-8")
    refused = gark("sweep", str(spec), "--plot", str(first))
    assert (refused.code, "needs two columns" in refused.err) == (2, True)
    assert not rows.exists()


_ROWS = st.lists(
    st.tuples(st.integers(1, 4), st.sampled_from([0.5, 0.25, None]), st.integers(1, 3)), max_size=12
)


@given(_ROWS)
def test_the_front(values: list[tuple[int, float | None, int]]) -> None:
    """By its definition: none of it is surpassed, and whatever is not in it is."""
    rows: list[Row] = [
        {"key": str(k), "kept": True, "order": p, "error": e, "stages": s}
        for k, (p, e, s) in enumerate(values)
    ]
    by = ("order", "error", "stages")

    def surpasses(a: Row, b: Row) -> bool:
        pairs = [(-a["order"], -b["order"])]  # type: ignore[operator]
        pairs += [(a[x], b[x]) for x in by[1:]]  # type: ignore[misc]
        return all(x <= y for x, y in pairs) and any(x < y for x, y in pairs)

    complete = [row for row in rows if row["error"] is not None]
    front = pareto_front(rows, by)
    wanted = [x for x in complete if not any(surpasses(y, x) for y in complete)]
    assert {str(x["key"]) for x in front} == {str(x["key"]) for x in wanted}
    ordered = best_first(rows, by)
    assert len(ordered) == len(rows)
    missing = [row["error"] is None for row in ordered if row["order"] == 4]
    assert missing == sorted(missing)


def test_names_of_no_method_have_their_place(tmp_path: Path) -> None:
    """All of them, beside other faults: a key that looks like ``files``, columns that are missing."""
    spec = tmp_path / "spec.yaml"
    spec.write_text("families: [gauss, gaus-2, rk4]\n", "utf-8")
    run = gark("sweep", str(spec))
    places = re.findall(r"spec\.yaml:(\d+:\d+): error\[([\w-]+)\]", run.err)
    assert run.code == 2
    assert places == [
        ("1:1", "unknown-key"),
        ("1:1", "missing-key"),
        ("1:12", "missing-key"),
        ("1:19", "no-such-file"),
    ]


def test_files(tmp_path: Path) -> None:
    """Method files with parameters, free or with a value of their own; rounded ones are refused."""
    sdirk = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
    (tmp_path / "sdirk.yaml").write_text(sdirk, "utf-8")
    (tmp_path / "given.yaml").write_text(sdirk.replace("free", "1"), "utf-8")
    (tmp_path / "rounded.yaml").write_text("tolerance: 1e-3\nA: [[0.5]]\nb: [1.0]\n", "utf-8")
    spec = tmp_path / "spec.yaml"
    spec.write_text(
        "files: [sdirk.yaml, given.yaml, rounded.yaml]\n"
        "parameters: {g: [1/5, 1/4, 0.5]}\ncolumns: [order, a-stable, gamma]\n",
        "utf-8",
    )
    plan = load_plan(str(spec))
    rows = [row_of(plan.criteria, point) for point in plan.points()]
    assert [row.get("a-stable") for row in rows[:3]] == [False, True, True]
    assert [row.get("gamma") for row in rows[3:6]] == [0.2, 0.25, 0.5]
    assert rows[6]["failure"] == "its coefficients are rounded"
    assert len(kept(rows)) == 6


FAULTS = {
    "columns: [order]\n": "no methods and no files",
    "methods: [{family: gauss, stages: 2}]\n": "columns missing",
    "methods: [{family: gaus, stages: 2}]\ncolumns: [order]\n": "'gaus' is not known",
    "methods: [{family: lobatto-iiia, stages: 1}]\ncolumns: [order]\n": "no member of",
    "methods: [{family: gauss, stages: 3..1}]\ncolumns: [order]\n": "not a range",
    "methods: [{family: gauss, stages: 2}]\ncolumns: [ordr]\n": "'ordr' is not known",
    "methods: [{family: gauss, stages: 2}]\ntransfer: collocation\ncolumns: [order]\n": (
        "one method has no transfer"
    ),
    "methods: [{family: gauss, stages: 1}, {family: gauss, stages: 2}]\ncolumns: [order]\n": (
        "several methods need transfer"
    ),
    "methods: [{family: gauss, stages: 2}]\nparameters: {t: [1]}\ncolumns: [order]\n": (
        "no method has t"
    ),
    "methods: [{family: gauss, stages: 2}]\nparameters: {t: [sqrt(2)]}\ncolumns: [order]\n": (
        "a rational number is expected"
    ),
    "methods: [{family: gauss, stages: 2}]\ncolumns: [order]\nwhere: {order: many}\n": (
        "not a condition"
    ),
    "methods: [{family: gauss, stages: 2}]\ncolumns: [order]\nwhere: {error: 1e400}\n": (
        "beyond the numbers of a column"
    ),
    "methods: [{family: gauss, stages: 2}]\ncolumns: [order]\nwhere: {error: 1e-400}\n": (
        "beyond the numbers of a column"
    ),
    "methods: [{family: gauss, stages: 2}]\nparameters: {t: []}\ncolumns: [order]\n": (
        "t is empty"
    ),
    "methods: [{family: gauss, stages: 2}]\ncolumns: [order]\nwhere: {a-stable: 3}\n": (
        "is not known"
    ),
    "methods: [{family: gauss, stages: 1}, {family: gauss, stages: 2}]\n"
    "transfer: {collocation: tau}\ncolumns: [order]\n": "'tau'",
}


@pytest.mark.parametrize("text", FAULTS)
def test_faults(text: str, tmp_path: Path) -> None:
    """Each has its place and its message; nothing is written."""
    path = tmp_path / "spec.yaml"
    path.write_text(text, "utf-8")
    with pytest.raises(MethodFileError) as caught:
        load_plan(str(path))
    messages = [fault.message for fault in caught.value.faults]
    assert any(FAULTS[text] in message for message in messages), messages
    assert all(fault.line for fault in caught.value.faults)
    run = gark("sweep", str(path))
    assert (run.code, "Traceback" in run.err) == (2, False)
    assert not path.with_suffix(".jsonl").exists()


def test_a_grid_without_values_beside_a_search(tmp_path: Path) -> None:
    """It is one fault, whatever the files make of it; a name that no file can have is another."""
    family = "parameters: {s: free, t: free}\nA: [[s]]\nb: [t]\n"
    (tmp_path / "family.yaml").write_text(family, "utf-8")
    path = tmp_path / "spec.yaml"
    rest = "parameters: {s: free, t: []}\nsearch: {seeds: 1}\ncolumns: [order]\n"
    empty = "t is empty"
    for name, messages in (
        ("family.yaml", [empty]),
        (r'"a\0b.yaml"', ["no file has such a name", empty]),
    ):
        path.write_text(f"files: {name}\n{rest}", "utf-8")
        with pytest.raises(MethodFileError) as caught:
            load_plan(str(path))
        found = [x.message for x in caught.value.faults]
        assert [y in x for x, y in zip(found, messages, strict=True)] == [True] * len(messages)


@pytest.mark.parametrize("size", ["1e400", "1e-400"])
def test_values_beyond_floats(size: str, tmp_path: Path) -> None:
    """Such a column is a failure of its row, which a resumed sweep reads: neither infinite nor
    zero.
    """
    scaled = f"A: [[{size}]]\nb: [1]\n"
    (tmp_path / "scaled.yaml").write_text(scaled, "utf-8")
    spec = tmp_path / "spec.yaml"
    column = "error" if size == "1e400" else "gamma"
    spec.write_text(f"files: scaled.yaml\ncolumns: [{column}]\n", "utf-8")
    assert gark("sweep", str(spec)).code == 0
    row = json.loads(spec.with_suffix(".jsonl").read_text("utf-8"))
    assert "beyond the numbers of a column" in row["failure"]
    again = gark("sweep", str(spec), "--resume")
    assert (again.code, "0 rows added" in again.err) == (0, True)


def test_the_schema_of_spec_files() -> None:
    """It takes the spec of these tests and refuses slips that the loader refuses."""
    schema = json.loads(gark("schema", "--sweep").out)
    jsonschema.Draft7Validator.check_schema(schema)
    jsonschema.validate(yaml.safe_load(SPEC), schema)
    for text in list(FAULTS)[:3] + list(FAULTS)[5:6]:
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(yaml.safe_load(text), schema)
    assert gark("schema", "--sweep", "--problem").code == 2


def test_every_column_has_values(tmp_path: Path) -> None:
    """Each is computed for a method, and is of its kind."""
    path = tmp_path / "spec.yaml"
    names = ", ".join(columns())
    path.write_text(
        "methods: [{family: [gauss, lobatto-iiic], stages: 2}, {family: rk4}]\n"
        f"transfer: interpolation\ncolumns: [{names}]\n",
        "utf-8",
    )
    plan: Plan = load_plan(str(path))
    found = [row_of(plan.criteria, point) for point in plan.points()]
    path.write_text(
        f"methods: [{{family: [gauss, radau-iia, ssp2], stages: 1..2}}]\ncolumns: [{names}]\n",
        "utf-8",
    )
    plan = load_plan(str(path))
    found += [row_of(plan.criteria, point) for point in plan.points()]
    path.write_text(f"files: [ros3p]\ncolumns: [{', '.join(VIEWS | DAE_VIEWS)}]\n", "utf-8")
    plan = load_plan(str(path))
    found += [row_of(plan.criteria, point) for point in plan.points()]
    types = {"truth": (bool,), "count": (int, str), "number": (float, str)}
    for name in columns():
        values = [row.get(name) for row in found if row.get(name) is not None]
        assert values, name
        assert all(isinstance(x, types[kind_of(name)]) for x in values), name


ROS2 = """parameters: {g: free}
rosenbrock: {alpha: [[0, 0], [1, 0]], gamma: [[g, 0], [-2*g, g]], b: [1/2, 1/2]}
"""


def test_rosenbrock_methods(tmp_path: Path) -> None:
    """ROS2 for values of γ: A-stable from 1/4 on, order 2 with any matrix, and the error that gark
    check has; a column without meaning fails with the reason.
    """
    (tmp_path / "ros2.gark.yaml").write_text(ROS2, "utf-8")
    spec = tmp_path / "spec.yaml"
    grid = "files: [ros2.gark.yaml]\nparameters: {g: [1/8, 1/4, 1/2]}\n"
    wanted = "a-stable, w-order, index-1-order, error, stages, colours"
    spec.write_text(f"name: ROS2\n{grid}columns: [{wanted}]\nbest: [order]\n", "utf-8")
    plan = load_plan(str(spec))
    rows = [row_of(plan.criteria, point) for point in plan.points()]
    assert [row["a-stable"] for row in rows] == [False, True, True]
    for row, g in zip(rows, ("1/8", "1/4", "1/2"), strict=True):
        found = error_constants(loads(ROS2, settings={"g": g}).tableau, 3)
        assert found is not None
        assert row["error"] == pytest.approx(found.all.two, rel=1e-11)
        names = ("order", "w-order", "index-1-order", "stages", "colours")
        assert [row[name] for name in names] == [2, 2, 2, 2, 1]
    for column in ("stiffly-accurate", "phase-order", "pair-order", "bound", "symplectic"):
        spec.write_text(f"name: ROS2\n{grid}columns: [{column}]\nbest: [order]\n", "utf-8")
        plan = load_plan(str(spec))
        failures = {row_of(plan.criteria, point)["failure"] for point in plan.points()}
        assert failures == {f"{column} applies to Runge–Kutta methods only"}


def test_columns_of_rosenbrock_methods_of_others(tmp_path: Path) -> None:
    """Runge–Kutta methods have an order for f(t, y), and none with any matrix."""
    spec = tmp_path / "spec.yaml"
    columns_ = "[w-order, index-1-order, nonautonomous-order]"
    spec.write_text(f"name: one\nfiles: [rk4]\ncolumns: {columns_}\nbest: [order]\n", "utf-8")
    plan = load_plan(str(spec))
    [row] = [row_of(plan.criteria, point) for point in plan.points()]
    names = ("w-order", "index-1-order", "nonautonomous-order")
    assert [row[name] for name in names] == [None, None, 4]


def test_a_finished_sweep_is_told_again(tmp_path: Path) -> None:
    """In another format, and without work; with rows that are missing --resume is demanded."""
    spec = tmp_path / "spec.yaml"
    text = "methods: [{family: gauss, stages: 1..2}]\ncolumns: [order]\n"
    spec.write_text(text, encoding="utf-8")
    first, second = (
        gark("sweep", "spec.yaml", *x, cwd=tmp_path) for x in ((), ("--format", "csv"))
    )
    assert first.code == second.code == 0
    assert "0 rows added" in second.err
    assert len(second.out.splitlines()) == 3
    rows = (tmp_path / "spec.jsonl").read_bytes()
    for cut in (rows[: rows.index(b"\n") + 1], rows[:-9]):
        (tmp_path / "spec.jsonl").write_bytes(cut)
        refused = gark("sweep", "spec.yaml", cwd=tmp_path)
        assert (refused.code, "--resume adds the missing rows" in refused.err) == (2, True)
        assert (tmp_path / "spec.jsonl").read_bytes() == cut
