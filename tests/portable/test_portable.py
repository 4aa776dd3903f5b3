"""What ``make portable`` runs, without running it."""

from __future__ import annotations

import math
import os
import random
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

from tests.portable import circumstances as module
from tests.portable.circumstances import circumstances, other_pythons
from tests.portable.no_unix import put_into
from tests.portable.noise import UNITS, arrays_off, off
from tests.portable.run import Outcome, chosen, table
from tests.portable.venvs import BARE, EXTRAS, MSOLVE, ROOT, NotHad, Venv, floors, version_of

NEWEST = Venv(sys.executable, "newest")


def test_every_dependency_has_a_floor() -> None:
    """Those of the program and of its tests, each once."""
    names = [re.split("[=;]", line)[0].lower() for line in floors()]
    assert {"click", "matplotlib", "numpy", "python-flint", "pyyaml", "sympy"} < {*names}
    assert {"hypothesis", "jsonschema", "pytest", "pytest-xdist"} < {*names}
    assert len(names) == len({*names})
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    groups = declared["optional-dependencies"]
    lines = [x for name in (*EXTRAS, "test") for x in groups[name] if not x.startswith("garkcli")]
    assert len(names) == len({*declared["dependencies"], *lines})


def test_every_extra_of_users_is_tried() -> None:
    """In one circumstance at least: what a page or an error names is installed by pip."""
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    ours = {"bench", "browser", "dev", "docs", "fuzz", "mutants", "test"}
    assert {*declared["optional-dependencies"]} - ours == {*EXTRAS, MSOLVE}


def test_tools_of_the_bare_circumstance_are_declared() -> None:
    """They are some of the test tools, and none is what an extra brings."""
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"][
        "optional-dependencies"
    ]
    tools = {line.partition(">=")[0] for line in declared["test"]}
    brought = {line.partition(">=")[0] for name in EXTRAS for line in declared[name]}
    assert {*BARE} <= tools - brought


@pytest.fixture
def _no_other_pythons(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody looks for them, which starts each."""
    monkeypatch.setenv("GARK_PYTHONS", sys.executable)


@pytest.mark.usefixtures("_no_other_pythons")
def test_all_paths_are_there() -> None:
    """What a circumstance tests is part of the suite; names are different."""
    found = list(circumstances())
    assert all((ROOT / path).exists() for x in found for path in x.tests)
    assert len({x.name for x in found}) == len(found)
    assert all(x.venv.folder.parent.name == ".portable" for x in found)


@pytest.mark.usefixtures("_no_other_pythons")
def test_beginnings_choose() -> None:
    """Several words, each the beginning of several names; a word of no name is said."""
    assert [x.name for x in chosen("floors,newest")] == ["newest", "floors"]
    assert len(chosen("")) == len(list(circumstances()))
    with pytest.raises(SystemExit, match="no circumstance begins with 'flor'"):
        chosen("floors,flor")


def test_pythons_that_do_not_run_are_left_out(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Also this one's own version; nothing is looked for beyond what was asked for."""
    old, broken = tmp_path / "old", tmp_path / "broken"
    old.write_text("#!/bin/sh\necho 3.9\n")
    broken.write_text("#!/bin/sh\nexit 127\n")
    for path in (old, broken):
        path.chmod(0o755)
    asked = ":".join([sys.executable, str(old), str(broken), str(tmp_path / "none")])
    monkeypatch.setenv("GARK_PYTHONS", asked)
    assert other_pythons() == []
    with pytest.raises(NotHad, match="does not run"):
        version_of(str(broken))
    newer = tmp_path / "newer"
    newer.write_text("#!/bin/sh\necho 3.99\n")
    newer.chmod(0o755)
    monkeypatch.setenv("GARK_PYTHONS", f"{asked}:{newer}")
    assert other_pythons() == [str(newer)]


def test_a_circumstance_that_does_not_hold_is_not_had(monkeypatch: pytest.MonkeyPatch) -> None:
    """A kernel that numpy does not take, features that stay, a locale that nobody has: said."""
    python = Path(sys.executable)
    monkeypatch.setattr(module, "_asked", lambda *_: "Haswell")
    kernel = module._kernel("HASWELL")
    assert kernel(python) == {"OPENBLAS_CORETYPE": "HASWELL"}
    with pytest.raises(NotHad, match="numpy computes with Haswell"):
        module._kernel("NEHALEM")(python)
    with pytest.raises(NotHad, match="numpy uses Haswell"):
        module._no_simd(python)
    monkeypatch.undo()
    monkeypatch.setattr(module, "LOCALES", ("xx_XX.none",))
    with pytest.raises(NotHad, match=r"none of xx_XX\.none is installed"):
        module._locale(python)
    with pytest.raises(NotHad, match="signal 11"):
        module._asked(python, "import os; os.kill(os.getpid(), 11)", {})


def test_what_could_not_be_had_is_no_failure() -> None:
    """But no test at all is one, and so is one that fails; the table has a line for each."""
    runs = [Outcome("a", 5), Outcome("b", 0), Outcome("c", 4, 1), Outcome("d", note="not")]
    assert [x.is_good for x in runs] == [True, False, False, True]
    assert [line.split()[0] for line in table(runs).splitlines()] == ["circumstance", *"abcd"]


def test_what_windows_lacks_is_taken_away(tmp_path: Path) -> None:
    """In a process that finds the file among its packages, and in those that it starts; this one
    keeps what it has.
    """
    put_into(tmp_path)
    program = (
        "import os, signal, multiprocessing\n"
        "try: import resource\n"
        "except ImportError: print('none')\n"
        "print(hasattr(os, 'fork'), hasattr(signal, 'SIGHUP'))\n"
        "print(multiprocessing.get_start_method())\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == ["none", "False", "False", "spawn"]


def test_no_type_of_click_has_a_parameter() -> None:
    """In its oldest declared version they are no generic classes: to subscript one is an error."""
    for path in (ROOT / "garkcli" / "cli").glob("*.py"):
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"^class .*click\.\w+\[", text, re.M), path


def test_noise_is_small_and_there() -> None:
    """Floats and arrays are off by some units of the last place, not all of them by none; whole
    numbers and zeros stay.
    """
    choose = random.Random(1)
    found = [off(choose, 1.5) for _ in range(50)]
    assert len({*found}) > 2
    assert max(abs(x - 1.5) for x in found) <= UNITS * math.ulp(1.5)
    assert (off(choose, 3), off(choose, 0.0)) == (3, 0.0)
    ones, rank = arrays_off(choose, (np.ones(50), 3))
    assert rank == 3
    assert 0 < np.abs(ones - 1).max() <= 2 * UNITS * 2.0**-52
