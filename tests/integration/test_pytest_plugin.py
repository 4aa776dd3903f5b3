"""The plugin of pytest: method files as tests, asked for and not otherwise."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

import garkcli.pytest_plugin  # imported here, like what it imports
from garkcli import assert_order
from garkcli.check.check_file import check_file
from garkcli.check.findings import findings
from tests.cli.harness import ROOT
from tests.whole import in_whole

pytest_plugins = ["pytester"]
MODULE = garkcli.pytest_plugin.__name__
GOOD = "A: [[0, 0], [1/2, 0]]\nb: [0, 1]\nexpect: {order: 2, explicit: true}\n"
BAD = GOOD.replace("order: 2", "order: 3")
BROKEN = "A: [[0, 0], [1/2, 0]]\nb: [0, 1, 2]\nexpect: {order: 2, fsal: true}\n"
UNMADE = "A: [[0, 0], [1/2, 0]]\nb: [0, 1]\nconjugate: true\nexpect: {order: 2, fsal: true}\n"
SILENT = "A: [[0]]\nb: [1]\n"
FAMILY = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]\nexpect: {order: 2}\n"
OPEN = (
    "A: [[0.167, 3.333], [-1.333, 0.333]]\nb: [0.333, 0.667]\ntolerance: 1e-3\n"
    "expect: {p-stable: true, order: 2}\n"
)
"""Rounding leaves one claim undecided."""
FILES = {
    "good": GOOD,
    "bad": BAD,
    "broken": BROKEN,
    "unmade": UNMADE,
    "silent": SILENT,
    "family": FAMILY,
}


@pytest.fixture(scope="module", autouse=True)
def imported(tmp_path_factory: pytest.TempPathFactory) -> None:
    """All that the plugin imports.

    Modules that first appear during a test of pytester are taken away after it, and numpy cannot be
    imported twice.
    """
    folder = tmp_path_factory.mktemp("imported")
    for name, text in {**FILES, "open": OPEN}.items():
        path = folder / f"{name}.gark.yaml"
        path.write_text(text, encoding="utf-8")
        list(findings(check_file(str(path))))
    with pytest.raises(AssertionError):
        assert_order("rk4", 5)


@pytest.fixture
def project(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> pytest.Pytester:
    """A project with method files and one test, whose warnings are errors; no other plugin."""
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")
    for name, text in FILES.items():
        path = pytester.path / "methods" / f"{name}.gark.yaml"
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    (pytester.path / "methods" / "notes.yaml").write_text("a: 1\n")
    pytester.makeini("[pytest]\nfilterwarnings = error\n")
    pytester.makepyfile("def test_of_its_own():\n    assert True\n")
    return pytester


def run(project: pytest.Pytester, *arguments: str) -> pytest.RunResult:
    """What pytest does there with the plugin."""
    return project.runpytest_inprocess("-p", MODULE, *arguments)


def outcomes(result: pytest.RunResult) -> dict[str, int]:
    """How many passed, failed, were skipped."""
    return result.parseoutcomes()


def test_nothing_is_collected_unless_it_is_asked_for(project: pytest.Pytester) -> None:
    """A project that has the package installed, and method files, sees no new test."""
    assert outcomes(run(project)) == {"passed": 1}
    assert outcomes(run(project, "methods")) == {}


def test_each_claim_is_a_test(project: pytest.Pytester) -> None:
    """With --gark each claim is an item; one that fails shows the finding and its line, one that
    holds beside it passes. A file that cannot be read fails once.
    """
    result = run(project, "--gark", "-rs")
    assert outcomes(result) == {"passed": 5, "failed": 4, "skipped": 1}
    text = result.stdout.str()
    assert "bad.gark.yaml:3:17: order: expected 3, found 2; fails" in text
    assert "expect: {order: 3, explicit: true}" in text
    assert "explicit: expected" not in text
    assert text.count("b has 3 entries, A is 2 by 2") == 1
    assert "the file cannot be read" in text
    assert "order: expected 2, found 1; 2 where t = 1/2" in text
    assert "Traceback" not in text
    assert "pytest_plugin.py" not in text


def test_plugins_find_no_values_of_fixtures(project: pytest.Pytester) -> None:
    """Some, such as pytest-lsp, fail items without ``funcargs``."""
    hook = "import pytest\n\n@pytest.hookimpl\ndef pytest_runtest_call(item):\n"
    project.makeconftest(hook + "    assert item.funcargs == {}\n")
    assert outcomes(run(project, "methods/good.gark.yaml")) == {"passed": 2}


def test_an_undecided_claim_is_skipped_with_its_reason(project: pytest.Pytester) -> None:
    """It neither passes nor fails; the claim beside it is judged."""
    path = project.path / "open.gark.yaml"
    path.write_text(OPEN, encoding="utf-8")
    result = run(project, str(path), "-rs")
    assert outcomes(result) == {"passed": 1, "skipped": 1}
    result.stdout.fnmatch_lines(
        ["SKIPPED*open.gark.yaml:4: undecided: p-stable: *the coefficients are rounded"]
    )


def test_items_have_the_names_of_claims(project: pytest.Pytester) -> None:
    """They can be chosen by name, and by the path of their file alone."""
    path = "methods/good.gark.yaml"
    result = run(project, path, "-v")
    assert outcomes(result) == {"passed": 2}
    result.stdout.fnmatch_lines([f"*{path}::order PASSED*", f"*{path}::explicit PASSED*"])
    assert outcomes(run(project, f"{path}::order")) == {"passed": 1}
    chosen = run(project, "--gark", "-k", "explicit")
    assert outcomes(chosen) == {"passed": 2, "deselected": 8}


@in_whole
def test_settings_of_a_project(project: pytest.Pytester) -> None:
    """Patterns say which files are tests; --no-gark and --gark are stronger."""
    project.makeini(
        "[pytest]\nfilterwarnings = error\n"
        "gark_files = methods/g*.gark.yaml silent.gark.yaml\n"
        "gark_require_claims = true\n"
    )
    result = run(project)
    assert outcomes(result) == {"passed": 3, "failed": 1}
    assert "the file makes no claim" in result.stdout.str()
    assert outcomes(run(project, "--no-gark")) == {"passed": 1}
    assert outcomes(run(project, "--gark"))["failed"] == 5


def test_methods_for_tests(project: pytest.Pytester) -> None:
    """The fixture loads a file of the project, or a method of the catalogue, once."""
    project.makepyfile(
        """
        from garkcli import assert_order

        def test_methods(gark_method):
            good = gark_method("methods/good.gark.yaml")
            assert_order(good, 2)
            assert gark_method("methods/good.gark.yaml") is good
            assert_order(gark_method("rk4"), 4)

        def test_failure(gark_method):
            assert_order(gark_method("rk4"), 5)
        """
    )
    result = run(project)
    assert outcomes(result) == {"passed": 1, "failed": 1}
    text = result.stdout.str()
    assert "has order 4, not 5" in text
    assert "fails at order 5" in text
    assert "asserting.py" not in text


@in_whole
def test_a_fault_of_the_program_has_its_traceback(
    project: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is no finding is not shown as one."""

    def fails(path: str) -> None:
        raise RuntimeError(f"no judgement of {Path(path).name}")

    monkeypatch.setattr("garkcli.check.check_file.check_file", fails)
    result = run(project, "methods/good.gark.yaml")
    assert outcomes(result) == {"failed": 2}
    assert "RuntimeError: no judgement of good.gark.yaml" in result.stdout.str()


@in_whole
def test_it_is_registered_and_light() -> None:
    """The package names the plugin to pytest; as long as it is not used it imports nothing
    heavy.
    """
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    entry = settings["project"]["entry-points"]["pytest11"]
    assert entry == {"gark": MODULE}
    code = (
        f"import sys, {MODULE}\n"
        "heavy = {'flint', 'yaml', 'click', 'numpy', 'sympy'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, timeout=100
    )
    assert done.stdout == "[]\n", done.stderr


@in_whole
def test_workers_have_the_same_tests(project: pytest.Pytester) -> None:
    """In processes of pytest-xdist everything is as in one."""
    done = project.runpytest_subprocess(
        *("-p", MODULE, "-p", "xdist.plugin", "-n", "1", "--gark", "methods")
    )
    assert outcomes(done) == {"passed": 4, "failed": 4, "skipped": 1}
