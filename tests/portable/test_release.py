"""The release: one version everywhere, and records of what it was tried with."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

import yaml

from garkcli import __version__
from tests.portable.release import PYTHONS, Package, bill, read_report
from tests.portable.venvs import ROOT

REPORT = {
    "install": [
        {
            "metadata": {"name": "PyYAML", "version": "6.0.1", "license": "MIT"},
            "download_info": {
                "url": "https://example.org/x",
                "archive_info": {"hashes": {"sha256": "ab"}},
            },
        },
        {
            "metadata": {"name": "garkcli", "version": "1.0.0", "license": "a\nlong text"},
            "download_info": {"url": "file:///x", "archive_info": {}},
        },
    ]
}


def test_the_version_is_one() -> None:
    """That of the package, of the program, of the citation and of the list of changes, which has
    its date.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert project["version"] == cited["version"] == __version__
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    (dated,) = re.findall(
        rf"^## gark {re.escape(__version__)}, (\d{{4}}-\d\d-\d\d)$", changes, re.M
    )
    assert str(cited["date-released"]) == dated


def test_the_versions_of_python_are_declared() -> None:
    """Those that a release is tried with have their classifiers."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    declared = {x.rpartition(" ")[2] for x in project["classifiers"] if "Python :: 3." in x}
    assert declared >= set(PYTHONS)


def test_records_have_hashes_and_no_addresses(tmp_path: Path) -> None:
    """A requirement has the hash of its archive, the bill of materials the licence too; where they
    were fetched is in neither.
    """
    path = tmp_path / "report.json"
    path.write_text(json.dumps(REPORT), encoding="utf-8")
    own, other = read_report(path)
    assert (own.name, own.license) == ("garkcli", "")
    assert other.requirement == "PyYAML==6.0.1 \\\n    --hash=sha256:ab\n"
    text = bill([own, other], "3.11")
    document = json.loads(text)
    assert document["metadata"]["component"]["purl"] == "pkg:pypi/garkcli@1.0.0"
    (component,) = document["components"]
    assert component["hashes"] == [{"alg": "SHA-256", "content": "ab"}]
    assert component["licenses"] == [{"license": {"name": "MIT"}}]
    assert "://" not in text + other.requirement


def test_colorama_is_for_windows_alone() -> None:
    """The system of this machine does not decide for others."""
    package = Package("colorama", "0.4.6", "", frozenset({"cd", "ab"}))
    assert package.requirement == (
        'colorama==0.4.6 ; sys_platform == "win32"'
        " \\\n    --hash=sha256:ab \\\n    --hash=sha256:cd\n"
    )
