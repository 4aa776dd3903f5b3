"""The English of everything a user reads: the list of patterns in docs/contributing/style.md."""

from __future__ import annotations

import ast
import itertools
import re
import tomllib
from collections.abc import Iterator
from typing import Any

from click.testing import CliRunner

from garkcli.cli.main import gark
from garkcli.cli.table import COMMANDS
from tests.cli.harness import ROOT
from tests.docs.blocks import pages
from tests.docs.test_links import prose
from tests.whole import sample_of_files

STYLE = ROOT / "docs" / "contributing" / "style.md"
PACKAGE = ROOT / "garkcli"
DATA = PACKAGE / "glossary" / "data"
TEMPLATES = PACKAGE / "webpage" / "templates"
EXPORTS = PACKAGE / "bridges" / "templates"
_BE = r"(?:is|are|was|were|be|been)"
REFUSED = {
    "is told": rf"\b{_BE} told\b",
    "is asked for": rf"\b{_BE} asked for\b",
    "is said of": rf"\b{_BE} said (?:of|so|to be)\b",
    "hangs on": r"\bhangs? on\b",
    "stands": r"\bstands?\b(?! for\b)",
    "what is …ed is": rf"\bwhat (?:\w+ ){{0,3}}{_BE} (?:\w+ ){{1,2}}{_BE}\b",
    "what is not": r"\bwhat (?:is|are) not\b",
    "which nothing": r", which (?:nothing|nobody)\b",
    "of … that … that": r"\bof (?:\w+ ){1,3}that (?:\w+ ){1,5}that\b",
    "one's own": r"\bone's own\b",
    "whatever": r"\bwhatever (?:becomes|stands|is)\b",
    "is left open": rf"\b{_BE} left open\b",
    "goes for": r"\bgoes for\b",
    "there is none": r"\band here is (?:none|no)\b",
    "of those that": r"\bof those that\b",
    "as many as there are": r"\bas many as there are\b",
    "is looked for": rf"\b{_BE} (?:looked (?:at|for|into)|thought of|taken for)\b",
    "a row a colour": (
        r"\b(?:an?|one) (?:row|entry|number|matrix|block|weight|line|object|condition)"
        r" an? (?:colour|stage|power|block|tree|method|row)\b"
    ),
}
"""Patterns that no text has, by their names in the tables of the style page."""
OPENINGS = re.compile(
    r"(?:what|that|the same|those|of|which|how|who|whose|by (?:how much|what|which)|so many|where"
    r"|its|their|items|iterates"
    r"|(?:returns|yields) the same (?:as|for|if|in|with))\b",
    re.IGNORECASE,
)
"""First words of a docstring or comment that leave its subject to be guessed."""
INSIDE = re.compile(
    r"\b(?:none (?:too |also )?where|where there (?:is|are) none|that is none|that are none"
    r"|one coordinate a stage|but for\b)",
    re.IGNORECASE,
)
"""Phrases that docstrings and comments do without."""
DOCSTRING = re.compile(r'^ *r?"""(.*?)"""', re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r"^(?:.*?  | *)# (?!noqa|type:)(.+)$", re.MULTILINE)


def texts() -> Iterator[tuple[str, str]]:
    """Every text, with where it is: pages, help, the data of faults, fields and keys, strings and
    comments of the source, all of it in ``make whole``, and the page of gark report.
    """
    for page in pages():
        if page != STYLE:
            yield page.relative_to(ROOT).as_posix(), plain(prose(page))
    runner = CliRunner()
    for name in ("", *COMMANDS):
        words = [name, "--help"] if name else ["--help"]
        yield f"gark {' '.join(words)}", plain(runner.invoke(gark, words).output)
    for path in sorted(DATA.glob("*.toml")):
        for number, text in enumerate(strings(tomllib.loads(path.read_text(encoding="utf-8")))):
            yield f"{path.name}, text {number}", plain(text)
    for path in sample_of_files(sorted(PACKAGE.rglob("*.py")), 4):
        for line, text in sentences(path.read_text(encoding="utf-8")):
            yield f"{path.relative_to(ROOT)}:{line}", plain(text)
    for path in sorted(TEMPLATES.iterdir()):
        yield path.name, plain(path.read_text(encoding="utf-8"))


def sentences(source: str) -> Iterator[tuple[int, str]]:
    """Every text of a source with its line: strings, docstrings, comments that go on for lines."""
    for node in _nodes(ast.parse(source)):
        if isinstance(node, ast.JoinedStr):
            parts = [x.value if isinstance(x, ast.Constant) else "x" for x in node.values]
            yield node.lineno, "".join(map(str, parts))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value:
            yield node.lineno, node.value
    # the sign in a string makes no harm, and to tell it from a comment takes longer than all else
    lines = enumerate(source.splitlines(), start=1)
    comments = {k: x.partition("#")[2].strip("# ") for k, x in lines if "#" in x}
    for line in comments:
        if line - 1 not in comments:
            block = itertools.takewhile(comments.get, itertools.count(line))
            yield line, " ".join(comments[x] for x in block)


def _nodes(root: ast.AST) -> Iterator[ast.AST]:
    """Those of ``ast.walk`` in another order, in half of its time."""
    pending = [root]
    while pending:
        node = pending.pop()
        yield node
        for value in vars(node).values():
            if isinstance(value, list):
                pending += [x for x in value if isinstance(x, ast.AST)]
            elif isinstance(value, ast.AST):
                pending.append(value)


def strings(value: Any) -> Iterator[str]:
    """Every text in a value of TOML."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for inner in value.values():
            yield from strings(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from strings(inner)


def plain(text: str) -> str:
    """A text in one line, without code."""
    return " ".join(re.sub(r"`[^`\n]*`", "`x`", text).split())


def refused(text: str) -> list[str]:
    """The patterns in a text, each with what is around it."""
    return [
        f"{name}: …{text[max(0, found.start() - 40) : found.end() + 30]}…"
        for name, pattern in REFUSED.items()
        for found in re.finditer(pattern, text, re.IGNORECASE)
    ]


def puzzles(source: str) -> Iterator[str]:
    """Docstrings and comments whose subject has to be guessed, or with a refused phrase."""
    for pattern in (DOCSTRING, COMMENT):
        for match in pattern.finditer(source):
            text = plain(match[1])
            phrase = OPENINGS.match(text) if pattern is DOCSTRING else None
            phrase = phrase or INSIDE.search(text)
            if phrase:
                yield f"…{text[max(0, phrase.start() - 20) : phrase.end() + 40]}…"


def test_docstrings_say_what_they_are_about() -> None:
    """In every file of the package; see the second table of the style page."""
    sources = [(path, path.read_text(encoding="utf-8")) for path in sorted(PACKAGE.rglob("*.py"))]
    assert [f"{path}: {x}" for path, source in sources for x in puzzles(source)] == []


def test_data_and_templates_have_a_subject() -> None:
    """Sentences of the glossary, and comments of templates, begin with one."""
    data = (x for p in DATA.glob("*.toml") for x in strings(tomllib.loads(p.read_text("utf-8"))))
    assert [x[:60] for x in data if INSIDE.search(plain(x))] == []
    notes = (
        (path.name, note)
        for path in (*TEMPLATES.iterdir(), *EXPORTS.iterdir())
        for note in re.findall(r"\{#-?(.*?)-?#\}", path.read_text("utf-8"), re.DOTALL)
    )
    assert [x for x in notes if OPENINGS.match(plain(x[1])) or INSIDE.search(plain(x[1]))] == []


def test_puzzles_are_found() -> None:
    """In docstrings of every kind and in comments; a question in code is none of them."""
    source = '''"""What it is."""\nx = 1  # a root that is none\n"""The factor."""\n'''
    assert list(puzzles(source)) == ["…What it is.…", "…a root that is none…"]
    assert [x for before, _ in second_table() for x in puzzles(f'"""{before}"""')] != []


def test_no_text_has_a_pattern_that_is_refused() -> None:
    """Say it in the active voice, with a concrete subject: the style page has pairs."""
    assert [f"{where}: {x}" for where, text in texts() for x in refused(text)] == []


PAIRS = re.compile(r"^\|(?!not\||---)(.+?)\|(.+?)\|$", re.MULTILINE)


def pairs() -> list[tuple[str, str]]:
    """The sentences of the style page: before, after."""
    text = STYLE.read_text(encoding="utf-8").partition("## English")[2]
    return PAIRS.findall(text.partition("## Docstrings")[0])


def second_table() -> list[tuple[str, str]]:
    """The docstrings, comments and names of the style page: before, after."""
    return PAIRS.findall(STYLE.read_text(encoding="utf-8").partition("## Docstrings")[2])


def test_the_second_table_teaches_its_patterns() -> None:
    """Fifteen pairs; no recommendation is refused, and most of what it discourages is."""
    table = second_table()
    assert len(table) >= 15
    assert [after for _, after in table if OPENINGS.match(after) or INSIDE.search(after)] == []
    discouraged = [x for x, _ in table if OPENINGS.match(x) or INSIDE.search(x)]
    assert len(discouraged) >= 2 * len(table) // 3


def test_the_page_has_pairs_and_they_teach_the_patterns() -> None:
    """Fifteen at least; what it recommends is not refused, and of what it discourages much is."""
    found = pairs()
    assert len(found) >= 15
    assert [after for _, after in found if refused(plain(after))] == []
    assert sum(bool(refused(plain(before))) for before, _ in found) >= len(found) // 2


def test_every_pattern_finds_something() -> None:
    """Each refuses a sentence that the project once had."""
    once = [
        *(before for before, _ in pairs()),
        "the family has what is said of each, whatever is asked for",
        "no file, which nobody reads, goes for one",
        "one of those that are looked for",
        "of a file that is named that is told",
        "what is found is no method, and here is none",
        "a row a colour, as many as there are",
    ]
    text = " ".join(map(plain, once))
    assert [name for name, pattern in REFUSED.items() if not re.search(pattern, text)] == []


def test_texts_of_a_source() -> None:
    """An f-string is one text, with x for its values; so are comments in lines that follow."""
    source = (
        '''"""A file."""\nfail("no number", f"it has {n} stages")  # it\n# is told\nf()\n# x\n'''
    )
    found = [text for _, text in sentences(source)]
    assert {"A file.", "no number", "it has x stages", "it is told", "x"} <= set(found)
    assert [bool(refused(text)) for text in found].count(True) == 1


def test_what_is_refused_and_what_is_not() -> None:
    """``stands for`` and questions are English."""
    assert refused("the key stands here") == ["stands: …the key stands here…"]
    assert refused("x stands for y; what is the order?") == []
