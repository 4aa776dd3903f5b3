"""docs/ci.md is true: its commands run, its files load, its workflows name what exists."""

from __future__ import annotations

import json
import re
import shlex
import shutil
import xml.etree.ElementTree as ET
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import yaml

from garkcli import load
from garkcli.methodfile.load import loads
from garkcli.report.check_formats import FORMATS
from garkcli.tableau.tableau import Method
from tests.cli.harness import gark
from tests.whole import IS_WHOLE

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "ci.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)
METHOD_FILES = [
    text
    for language, text in BLOCKS
    if language == "yaml" and re.search("^methods:", text, re.MULTILINE)
]
WORKFLOWS = [
    yaml.safe_load(text)
    for language, text in BLOCKS
    if language == "yaml" and text not in METHOD_FILES
]
PRINTED = re.compile(r"^(?:\s*- |\s*run: |)(gark .*)$", re.MULTILINE)


def commands() -> list[str]:
    """Every ``gark`` command of the page, in its order: in shell blocks, in workflows, in running
    text.
    """
    shell = [line for language, text in BLOCKS if language == "sh" for line in text.splitlines()]
    steps = [step for workflow in WORKFLOWS for step in scripts(workflow)]
    spoken = [x for x in re.findall(r"`(gark [^`]+)`", PAGE) if x != "gark check"]
    return [
        x.partition(" >>")[0].strip() for x in [*shell, *steps, *spoken] if x.startswith("gark ")
    ]


def scripts(part: Any) -> list[str]:
    """The commands under ``run`` and ``script`` of a workflow."""
    if isinstance(part, list):
        return [x for item in part for x in scripts(item)]
    if not isinstance(part, dict):
        return []
    own = [part["run"]] if isinstance(part.get("run"), str) else list(part.get("script", []))
    return own + [x for value in part.values() for x in scripts(value)]


def uses(part: Any) -> list[dict[str, Any]]:
    """The steps of a workflow that use an action."""
    if isinstance(part, list):
        return [x for item in part for x in uses(item)]
    if not isinstance(part, dict):
        return []
    return [part] * ("uses" in part) + [x for value in part.values() for x in uses(value)]


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project with a few methods, where all commands have run in the order of the page."""
    folder = tmp_path_factory.mktemp("project")
    (folder / "methods").mkdir()
    for name in ("collocation", "stoermer-verlet", "rectangular"):
        shutil.copy(ROOT / f"methods/{name}.gark.yaml", folder / "methods")
    return folder


def test_the_page_has_its_commands() -> None:
    """Shell blocks, workflows and running text all show commands, and every line that looks like
    one is run.
    """
    found = commands()
    assert len(found) >= 10
    shown = {x.partition(" >>")[0].strip() for x in PRINTED.findall(PAGE)}
    assert shown <= set(found)
    assert {"check", "energy", "schema"} == {shlex.split(x)[1] for x in found}


@pytest.mark.every_case  # one writes what another reads
@pytest.mark.parametrize("command", commands())
def test_a_command_runs(command: str, project: Path) -> None:
    """Each command of the page, in the order of the page, ends with exit code 0 and writes what it
    says.
    """
    arguments = shlex.split(command)[1:]
    run = gark(*arguments, cwd=project)
    wrote = arguments[arguments.index("-o") + 1] if "-o" in arguments else ""
    assert (run.code, run.err) == (0, f"wrote {wrote}\n" if wrote else ""), command
    if wrote:
        text = (project / wrote).read_text(encoding="utf-8")
        assert (
            ET.fromstring(text).tag == "testsuites"
            if text.startswith("<?xml")
            else json.loads(text)
        )
    else:
        assert run.out or "--quiet" in arguments


@pytest.mark.parametrize("text", METHOD_FILES)
def test_a_method_file_loads(text: str, tmp_path: Path) -> None:
    """Each method file of the page is a method whose claims hold."""
    assert loads(text).claims
    (tmp_path / "m.gark.yaml").write_text(text)
    assert gark("check", "m.gark.yaml", cwd=tmp_path).code == 0


def test_a_test_of_ones_own_passes() -> None:
    """The tests that the page shows pass with a solver whose table is right, and one of them fails
    with one that is wrong.
    """
    (text,) = [text for language, text in BLOCKS if language == "python"]

    def loaded(name: str) -> Method:
        in_a_project = {"methods/dirk.gark.yaml": "bogacki-shampine-3"}
        return load(in_a_project.get(name, name))

    def passes(b: list[float]) -> None:
        table = SimpleNamespace(A=[[0, 0], [2 / 3, 0]], b=b, c=[0, 2 / 3])
        names: dict[str, Any] = {"solver": table}
        exec(text, names)
        tests = [names[x] for x in names if x.startswith("test_")]
        assert tests
        for test in tests:
            test(loaded)

    passes([1 / 4, 3 / 4])
    with pytest.raises(AssertionError):
        passes([1 / 2, 1 / 2])


def test_settings_of_an_editor_name_the_schema() -> None:
    """The file of the schema in them is the one that a command of the page writes."""
    (text,) = [text for language, text in BLOCKS if language == "json"]
    written = {x.split(" -o ")[1] for x in commands() if "schema -o" in x}
    assert set(json.loads(text)["yaml.schemas"]) == written


def test_every_format_has_its_row() -> None:
    """The table of formats is the list of formats."""
    table = PAGE.partition("## Formats")[2].partition("##")[0]
    assert sorted(re.findall(r"^\| `(\w+)`", table, re.MULTILINE)) == sorted(["auto", *FORMATS])


def test_every_exit_code_has_its_row(tmp_path: Path) -> None:
    """The table of docs/command-line.md is that of the program, and the first three are met."""
    page = (ROOT / "docs" / "command-line.md").read_text(encoding="utf-8")
    table = page.partition("## Exit codes")[2].partition("##")[0]
    assert re.findall(r"^\| (\d+) \|", table, re.MULTILINE) == ["0", "1", "2", "3", "130", "141"]
    for code, text in enumerate(("", "expect: {order: 3}", "expct: {order: 2}")):
        (tmp_path / "m.gark.yaml").write_text(f"methods: [{{family: gauss, stages: 1}}]\n{text}\n")
        assert gark("check", ".", cwd=tmp_path).code == code


def test_the_action_is_used_as_it_is() -> None:
    """The step with our action gives only inputs that the action has."""
    action = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))
    (step,) = [x for x in uses(WORKFLOWS) if x["uses"].startswith("OWNER/gark@")]
    assert set(step["with"]) <= set(action["inputs"])
    files = step["with"]["files"] if IS_WHOLE else "methods/rk4.gark.yaml"
    assert gark("check", files, *shlex.split(step["with"]["arguments"])).code == 0


def test_the_hook_exists() -> None:
    """The hook that the page names is one that the repository offers."""
    offered = {
        hook["id"]
        for hook in yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    }
    named = {hook["id"] for x in WORKFLOWS for repo in x.get("repos", []) for hook in repo["hooks"]}
    assert named
    assert named <= offered


def test_the_distribution_has_the_name_that_is_installed() -> None:
    """What the page installs with pip is called so in pyproject.toml."""
    names = set(re.findall(r"pip install (\S+)", PAGE))
    assert {f'name = "{name}"' for name in names} <= set(
        (ROOT / "pyproject.toml").read_text(encoding="utf-8").splitlines()
    )
    assert names
