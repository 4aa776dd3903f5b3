"""The program as a process: what only a real process shows."""

import os
import subprocess
import sys
from importlib.util import find_spec

import pytest

from tests.cli.harness import ROOT
from tests.whole import in_whole

FAILING = "tests/examples/failing/collocation-misprinted.gark.yaml"


def run(
    *arguments: str, python: tuple[str, ...] = ("-m", "garkcli")
) -> subprocess.CompletedProcess[str]:
    """Run the program with the interpreter of the tests."""
    command = [sys.executable, *python, *arguments]
    environment = {**os.environ, "COLUMNS": "80", "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=60
    )


@pytest.mark.parametrize(
    ("code", "arguments"),
    [
        (0, ("check", "methods/rectangular.gark.yaml")),
        (1, ("check", FAILING)),
        (2, ("check", "tests/examples/invalid/octal.gark.yaml")),
        (2, ("nonsense",)),
    ],
)
def test_exit_codes_of_the_process(code: int, arguments: tuple[str, ...]) -> None:
    """``python -m garkcli`` ends with the documented exit code and no traceback."""
    done = run(*arguments)
    assert done.returncode == code
    assert "Traceback" not in done.stderr


def test_check_imports_no_heavy_package() -> None:
    """``gark check`` on a file of families needs neither sympy nor numpy, nor what figures and pages are made
    with.
    """
    script = (
        "import sys\n"
        "from garkcli.cli import main\n"
        "try:\n"
        "    main(['check', 'methods/collocation.gark.yaml'])\n"
        "except SystemExit as end:\n"
        "    heavy = sorted({'sympy', 'numpy', 'matplotlib', 'mpmath', 'jinja2', 'latex2mathml'} & set(sys.modules))\n"
        "    print(end.code, heavy, file=sys.stderr)\n"
    )
    assert run(python=("-c", script)).stderr == "0 []\n"


RARE = {
    "garkcli.check.baseline",
    "garkcli.order.recovering",
    "garkcli.exact.tower",
    "garkcli.methodfile.ark_prk",
    "garkcli.methodfile.printed",
    "garkcli.order.blame",
    "garkcli.check.remark",
}
"""What few files need."""


def test_check_imports_what_the_file_needs() -> None:
    """Rules for rare forms, nested radicals, roundings and failures are left alone by a file of
    families whose claims hold.
    """
    script = (
        "import sys\n"
        "from garkcli.cli import main\n"
        "try:\n"
        "    main(['check', 'methods/collocation.gark.yaml'])\n"
        "except SystemExit:\n"
        f"    print(sorted({RARE!r} & set(sys.modules)), file=sys.stderr)\n"
    )
    assert run(python=("-c", script)).stderr == "[]\n"
    assert all(find_spec(name) for name in RARE)


def test_help_imports_no_mathematics() -> None:
    """``gark --help`` answers without loading the number library or the YAML reader."""
    script = (
        "import sys\n"
        "from garkcli.cli import main\n"
        "try:\n"
        "    main(['--help'])\n"
        "except SystemExit:\n"
        "    print(sorted({'flint', 'yaml', 'numpy', 'sympy'} & set(sys.modules)), file=sys.stderr)\n"
    )
    assert run(python=("-c", script)).stderr == "[]\n"


@in_whole
def test_a_fault_of_the_program_is_owned_up_to() -> None:
    """An exception that no room expects ends in exit code 3 and a request to report it, not in a
    traceback.
    """
    script = (
        "import garkcli.cli.looking_up\n"
        "from garkcli.tell.report import Report\n"
        "from garkcli.cli import main\n"
        "def broken(*_, **__): raise RuntimeError('broken')\n"
        "Report.render = broken\n"
        "main(['list'])\n"
    )
    done = run(python=("-c", script))
    assert done.returncode == 3
    assert done.stderr.startswith("gark: internal fault: RuntimeError: broken\n")
    assert "Traceback" not in done.stderr
