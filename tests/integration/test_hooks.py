"""The pre-commit hook and the GitHub action, by running what they run."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from tests.cli.harness import gark
from tests.portable.release import LOCK, SYSTEMS, requirements
from tests.whole import in_whole

ROOT = Path(__file__).resolve().parents[2]
GOOD = "methods/collocation.gark.yaml"
BAD = "tests/examples/failing/collocation-misprinted.gark.yaml"


def run(command: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run a shell command as the two integrations do, with the installed ``gark`` on the path."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "PYTHONPATH": str(ROOT), **variables}
    return subprocess.run(
        ["bash", "-euo", "pipefail", "-c", command],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
    )


@pytest.mark.parametrize(("file", "code"), [(GOOD, 0), (BAD, 1)])
def test_pre_commit_hook(file: str, code: int) -> None:
    """The hook's entry passes a right file and fails a wrong one, and its pattern picks method
    files alone.
    """
    (hook,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text())
    assert re.search(hook["files"], file)
    assert not re.search(hook["files"], "docker-compose.yaml")
    command = " ".join([hook["entry"], *hook["args"]])
    assert run(f"{command} {file}").returncode == code


@in_whole
def test_a_file_that_is_called_like_an_option(tmp_path: Path) -> None:
    """The hook and the action check a file whose name begins with a dash."""
    (hook,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text())
    odd = tmp_path / "--version.gark.yaml"
    odd.write_text("methods: [{family: gauss, stages: 2}]\nexpect: {order: 4}\n")
    done = run(f"cd {tmp_path} && {' '.join([hook['entry'], *hook['args']])} {odd.name}")
    assert (done.returncode, "order: 4" in done.stdout) == (0, True)
    step = yaml.safe_load((ROOT / "action.yml").read_text())["runs"]["steps"][-1]
    variables = {
        "FILES": odd.name,
        "ARGUMENTS": "",
        "RUNNER_TEMP": str(installed(tmp_path, "bin/gark")),
        "GITHUB_STEP_SUMMARY": str(tmp_path / "summary.md"),
    }
    done = run(f"cd {tmp_path}\n{step['run']}", **variables)
    assert done.returncode == 0, done.stderr


def test_the_python_of_the_other_steps_is_left_alone() -> None:
    """Python is set up without changing the environment, and gark lives in a folder of its own."""
    steps = yaml.safe_load((ROOT / "action.yml").read_text())["runs"]["steps"]
    (python,) = [step for step in steps if "setup-python" in step.get("uses", "")]
    assert python["with"]["update-environment"] is False
    scripts = "".join(step.get("run", "") for step in steps)
    assert "GITHUB_PATH" not in scripts
    assert "GITHUB_ENV" not in scripts
    assert '-m venv "$RUNNER_TEMP/gark"' in scripts


def installed(temporary: Path, command: str) -> Path:
    """The folder of a runner in which the action has put the program."""
    program = temporary / "gark" / command
    program.parent.mkdir(parents=True)
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m garkcli "$@"\n')
    program.chmod(0o755)
    return temporary


@in_whole
@pytest.mark.parametrize(
    ("file", "code", "command"), [(GOOD, 0, "Scripts/gark.exe"), (BAD, 1, "bin/gark")]
)
def test_action(file: str, code: int, command: str, tmp_path: Path) -> None:
    """The action's last step passes a right file, and annotates the line of a wrong claim; either
    way the summary has the table. The program is where venv puts it on Windows, or elsewhere.
    """
    action = yaml.safe_load((ROOT / "action.yml").read_text())
    step = action["runs"]["steps"][-1]
    inputs = {name: x["default"] for name, x in action["inputs"].items()} | {"files": file}
    variables = {
        name: re.sub(r"\$\{\{ inputs\.([a-z-]+) \}\}", lambda match: inputs[match[1]], text)
        for name, text in step["env"].items()
    } | {
        "RUNNER_TEMP": str(installed(tmp_path, command)),
        "GITHUB_STEP_SUMMARY": str(tmp_path / "summary.md"),
    }
    result = run(step["run"], **variables)
    assert result.returncode == code, result.stderr
    line = (ROOT / BAD).read_text().splitlines().index("expect: {order: 4}") + 1
    assert (f"::error file={BAD},line={line}," in result.stdout) == bool(code)
    summary = (tmp_path / "summary.md").read_text(encoding="utf-8")
    assert summary == gark("check", file, "--format", "markdown").out


@pytest.mark.parametrize(
    ("version", "what", "place"),
    [("", "/the/checkout", "bin"), ("1.0.0", "garkcli==1.0.0", "Scripts")],
)
def test_action_installs_this_project(version: str, what: str, place: str, tmp_path: Path) -> None:
    """What the action installs is the directory it lies in, and that directory is the project; a
    release where one is asked for; either after its dependencies, which are taken by hashes.
    """
    folder = tmp_path / "gark" / place
    folder.mkdir(parents=True)
    python = folder / "python"
    python.write_text('#!/bin/sh\necho "$*"\n')
    python.chmod(0o755)
    action = yaml.safe_load((ROOT / "action.yml").read_text())
    install = next(step for step in action["runs"]["steps"] if step.get("name") == "install")
    assert install["env"]["VERSION"] == "${{ inputs.version }}"
    assert action["inputs"]["version"]["default"] == ""
    done = run(
        install["run"],
        PYTHON=str(python),
        VERSION=version,
        RUNNER_TEMP=str(tmp_path),
        GITHUB_ACTION_PATH="/the/checkout",
    )
    *_, needed, own, last = done.stdout.splitlines()
    assert needed.startswith("-m pip install --quiet --require-hashes --only-binary :all:")
    assert needed.endswith(f"/the/checkout/{LOCK.name}")
    assert own == f"-m pip install --quiet --no-deps --no-build-isolation {what}"
    assert last == "-m pip check"
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert 'name = "garkcli"' in project


def test_steps_of_the_action_are_pinned() -> None:
    """What the action uses of others is named by a commit, which nobody can move."""
    action = yaml.safe_load((ROOT / "action.yml").read_text())
    used = [step["uses"] for step in action["runs"]["steps"] if "uses" in step]
    assert used
    assert all(re.fullmatch(r"[\w/-]+@[0-9a-f]{40}", x) for x in used)


def test_the_action_has_hashes_of_all_that_gark_needs() -> None:
    """Every dependency, those of ``audit`` and the build are there with a version that is new
    enough and hashes; there is no address.
    """
    text = LOCK.read_text(encoding="utf-8")
    entries = re.findall(
        r"^([\w.-]+)==([\w.]+)(?: ; sys_platform == \"win32\")?((?: \\\n    --hash=sha256:[0-9a-f]{64})+)$",
        text,
        re.MULTILINE,
    )
    assert "://" not in text
    versions = {canonical(name): version for name, version, _ in entries}
    assert len(versions) == text.count("==") - text.count('" ')
    for line in requirements():
        name, least = re.fullmatch(r"([\w-]+)>=([\w.]+)", line).groups()
        assert numbers(versions[canonical(name)]) >= numbers(least), name
    compiled = [x for x in entries if x[0] == "python-flint"]
    # a wheel may be for several versions of Python, and is for one system
    assert compiled[0][2].count("--hash") >= len(SYSTEMS)


def canonical(name: str) -> str:
    """A name as the index writes it."""
    return name.lower().replace("_", "-")


def numbers(version: str) -> list[int]:
    """The numbers of a version."""
    return [int(x) for x in version.split(".")]
