"""The walk of ``make walk`` finds what a page shows and a shell does not print."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.cli.harness import ROOT
from tests.portable.walk import PAGES, walk

PAGE = """\
`m.yaml`:

```yaml
A: [[0]]
```

```console
$ cat m.yaml
A: [[0]]
$ printf 'one\\ntwo\\n' > two.txt; cat two.txt
one
...
```
"""


@pytest.mark.skipif(not shutil.which("sh"), reason="there is no shell")
def test_a_walk_finds_what_is_not_as_shown(tmp_path: Path) -> None:
    """A page that is right is passed; with another output, or a command that there is not, the
    command is told with what it printed.
    """
    page, folder = tmp_path / "page.md", tmp_path / "empty"
    folder.mkdir()
    page.write_text(PAGE, encoding="utf-8")
    assert walk(page, tmp_path, folder, "sh") == []
    page.write_text(PAGE.replace("one\n...", "two\n..."), encoding="utf-8")
    (wrong,) = walk(page, tmp_path, folder, "sh")
    assert wrong.endswith("cat two.txt\none\ntwo\n")
    page.write_text(PAGE.replace("cat m", "nothing m"), encoding="utf-8")
    (wrong,) = walk(page, tmp_path, folder, "sh")
    assert wrong.startswith("$ nothing m.yaml\n")


def test_pages_that_are_walked_are_there() -> None:
    """The README, and every tutorial that there is."""
    tutorials = (ROOT / "docs").rglob("tutorial-*.md")
    names = {x.relative_to(ROOT).as_posix() for x in tutorials}
    assert {"README.md", *names} == set(PAGES)
