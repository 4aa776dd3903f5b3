"""The templates of ``gark export``: whose they are, what they are given, and what they may print."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any
from unittest.mock import patch

import pytest
from flint import fmpq
from jinja2 import Environment, Template, UndefinedError
from jinja2.meta import find_referenced_templates

from garkcli.bridges import texts
from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.numbers import EXACT
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import bridges
from garkcli.bridges.structure import table
from garkcli.frozen import Frozen, fields
from garkcli.methodfile.load import loads
from tests.bridges.examples import RALSTON, payload_of
from tests.bridges.test_hostile_names import METHODS, named
from tests.cli.harness import ROOT
from tests.cli.test_process import run
from tests.whole import in_whole

PACKAGE = ROOT / "garkcli"
TEMPLATES = sorted((PACKAGE / "bridges" / "templates").iterdir())


def test_every_template_is_written_by_a_target() -> None:
    """As its file, as its program, or as a part of another template; and no target lacks its own."""
    written = [x for x in bridges().values() if x.write is None]
    own = {f"{x.name}{x.suffix}.jinja" for x in written if x.kinds != ("row",)}
    own |= {f"{x.name}-row{x.suffix}.jinja" for x in written if "row" in x.kinds}
    own |= {f"{x.name}-own{x.suffix}.jinja" for x in written if "nystrom" in x.kinds}
    for bridge in bridges().values():
        if bridge.words is not None:
            ending = {".hpp": ".cpp"}.get(bridge.suffix, bridge.suffix)
            own.add(f"{bridge.name}_test{ending}.jinja")
    parts: set[str] = set()
    for path in TEMPLATES:
        tree = Environment().parse(path.read_text(encoding="utf-8"))
        parts |= {x for x in find_referenced_templates(tree) if x is not None}
    assert {path.name for path in TEMPLATES} == own | parts
    assert not own & parts


def test_templates_are_part_of_the_package() -> None:
    """What pyproject.toml says goes into the wheel matches each of them."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    patterns = tomllib.loads(text)["tool"]["setuptools"]["package-data"]["garkcli"]
    packed = {path for pattern in patterns for path in PACKAGE.glob(pattern)}
    assert TEMPLATES
    assert set(TEMPLATES) <= packed


@pytest.mark.parametrize("value", [None, True, fmpq(1, 3), 0.1, ["x"], ("x",), {}, payload_of])
def test_what_is_no_text_is_not_printed(value: object) -> None:
    """Nothing is written as Python writes it: no None, no float, no list, no exact number."""
    with pytest.raises(TypeError, match="a template prints"):
        texts.printed(value)
    assert (texts.printed("x"), texts.printed(7)) == ("x", 7)


def test_a_template_that_prints_such_a_thing_fails() -> None:
    """The check is that of the templates; a name that is not given is refused too."""
    environment = texts._environment()
    with pytest.raises(TypeError, match="prints Payload"):
        environment.from_string("{{ payload }}").render(payload=payload_of(RALSTON))
    with pytest.raises(UndefinedError):
        environment.from_string("{{ payload.name }}").render()


SECRET = "zqx secret */ words"


def strings(value: object) -> Iterator[str]:
    """Every text in a value, however deep; what is called is not looked into."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        for pair in value.items():
            yield from strings(pair)
    elif isinstance(value, (list, tuple, set, frozenset)):
        for item in value:
            yield from strings(item)
    elif isinstance(value, Frozen):
        for name in fields(value):
            yield from strings(getattr(value, name))


def test_no_text_of_a_file_is_given_to_a_template() -> None:
    """Names come as identifiers; the name and the reference of a method are in comments alone."""
    given: list[dict[str, Any]] = []
    render = Template.render

    def spying(self: Template, *values: Any, **further: Any) -> str:
        given.append({**values[0], **further})
        return render(self, *values, **further)

    with patch.object(Template, "render", spying):
        for method in METHODS.values():
            payload = prepared(loads(named(SECRET, method)))
            assert SECRET in (payload.name, payload.reference)
            for bridge in bridges().values():
                try:
                    bridge.written(payload)
                    bridge.tested(payload, f"neutral{bridge.suffix}")
                except CannotExport:
                    continue
    written = [x for x in bridges().values() if x.write is None]
    assert len(given) > len(written)
    assert not [x for values in given for x in strings(values) if "secret */" in x]


def test_the_search_finds_texts() -> None:
    """In what templates could be given: a method itself, too."""
    payload = prepared(loads(named(SECRET, METHODS["rk"])))
    assert any(SECRET in x for x in strings({"deep": [(payload,)]}))


def test_every_ending_has_its_language() -> None:
    """The files and the programs of each template are in a language whose comments are known."""
    endings = {Path(path.stem).suffix for path in TEMPLATES}
    assert endings == set(texts.LANGUAGES)


def test_a_comment_of_a_template_is_none_where_the_method_ends_it() -> None:
    """The head is a comment whatever the template is: the secret's end of a comment is apart."""
    payload = prepared(loads(named(SECRET, METHODS["rk"])))
    values = {"table": table(payload)}
    text = texts.text_of("boost.hpp", payload, EXACT, values)
    assert "zqx secret * / words" in text
    assert text.count("*/") == 1


@in_whole
def test_templates_are_loaded_when_a_file_is_written() -> None:
    """The list of targets, and a target that has no template, need no Jinja."""
    script = (
        "import sys\n"
        "from garkcli.bridges.registry import bridges\n"
        "from garkcli.bridges.calls import export\n"
        "bridges()\n"
        "export('heun', 'csv')\n"
        "before = 'jinja2' in sys.modules\n"
        "export('heun', 'numpy')\n"
        "print(before, 'jinja2' in sys.modules)\n"
    )
    assert run(python=("-c", script)).stdout == "False True\n"
