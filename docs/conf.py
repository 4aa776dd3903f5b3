"""The documentation as a site, which `make docs` builds with Sphinx.

The pages are plain Markdown that reads well where the code is hosted, so
they have no directives, but for the cells of the notebook. What the site has
besides is made here: the contents in the margin, from the headings and lists
of `all-pages.md`; `CONTRIBUTING.md`, which stands outside of this folder, as the
first page for contributors; at the ends of some pages what ``gark schema``,
``gark explain``, ``gark COMMAND --help`` and Python's ``help`` print; titles in place of the names
of files, in links that show these; and formulas, drawn as MathML.
"""

from __future__ import annotations

import re
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from garkcli.version import __version__

if TYPE_CHECKING:
    from sphinx.application import Sphinx

project = "gark"
author = "The gark authors"
release = version = __version__
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath"]  # formulas as code hosts read them too
html_math_renderer = "mathml"
exclude_patterns = ["package-page.md"]  # the page of the package index
html_theme = "furo"
html_title = f"gark {__version__}"
html_show_copyright = False
html_copy_source = False
html_static_path = ["static"]
html_css_files = ["site.css"]
linkcheck_ignore = [r".*/OWNER/"]  # where the reader hosts it
myst_heading_anchors = 4  # links to headings, as code hosts have them
smartquotes = False  # transcripts are quoted as they are printed
highlight_language = "text"
# What a command prints may be what no lexer knows: it is then shown plain.
suppress_warnings = ["misc.highlighting_failure"]


def contents(index: str) -> str:
    """Hidden tables of contents, one for each part of the list of pages, which is the last entry.

    Args:
        index: the text of all-pages.md.
    """
    parts = re.split(r"^## ", index, flags=re.MULTILINE)[1:]
    parts[-1] += "\n* [All pages](all-pages.md)\n"
    return "\n".join(_contents_of_part(part) for part in parts)


def _contents_of_part(part: str) -> str:
    caption = part.partition("\n")[0]
    pages = re.findall(r"\]\(([\w/-]+)\.md\)", part)
    head = ["```{toctree}", ":hidden:", f":caption: {caption}", ""]
    return "\n".join([*head, *pages, "```", ""])


def contributing() -> str:
    """CONTRIBUTING.md with its links as seen from `contributing/`."""
    root = Path(__file__).resolve().parents[1]
    text = (root / "CONTRIBUTING.md").read_text(encoding="utf-8")
    from_here = text.replace("](docs/contributing/", "](")
    return from_here.replace("](docs/", "](../")


def titled(text: str, folder: Path) -> str:
    """Links that show the name of a page with its title.

    Args:
        text: a page.
        folder: where it is.
    """

    def with_title(link: re.Match[str]) -> str:
        page = folder / link["page"]
        first = page.read_text(encoding="utf-8").partition("\n")[0]
        return f"[{first.removeprefix('# ')}]({link['page']}"

    return re.sub(r"\[(?:docs/)?[\w-]+\.md\]\((?P<page>[\w./-]+\.md)", with_title, text)


_AS_IT_IS = re.compile(
    r"(^```.*?^```$|`[^`\n]*`|\$\$.*?\$\$|\$[^$\n]+\$|^ {4}.*?$|^#.*?$|\]\([^)]*\)|<!--.*?-->)",
    re.DOTALL | re.MULTILINE,
)
"""Code, formulas, headings, targets of links and comments."""
_INDEXED = re.compile(
    r"(?<![\w`$\\/.-])"
    r"[^\W\d_](?:\^\{[^}]*\}|\^\([^()]*\)|\^\[\w+\]|\^\w(?!\w)|_\{[^}]*\}|_[^\W_]{1,2}(?![^\W_²]))+²?"
    r"(?![\w{])"
)
"""A letter with indices or powers, such as A^{l,m}, b_i or h^(p+1)."""


def typeset(text: str) -> str:
    """Letters with indices, as pages have them in plain text, become formulas.

    Args:
        text: a page.
    """

    def formula(plain: re.Match[str]) -> str:
        latex = plain[0].replace("Â", r"\hat A").replace("𝒜", r"\mathcal{A}").replace("²", "^2")
        latex = re.sub(r"\^(?:\((.*?)\)|(\[\w+\]))", r"^{\1\2}", latex)
        latex = re.sub(r"\^\{(\w)\}", r"^{\\{\1\\}}", latex)  # colours have braces in the paper
        latex = re.sub(r"_(\w{2})", r"_{\1}", latex)
        return plain[0] if latex.count("^") > 1 else f"${latex}$"

    parts = _AS_IT_IS.split(text)
    parts[::2] = [_INDEXED.sub(formula, part) for part in parts[::2]]
    return "".join(parts)


MADE = {
    "json-fields": "tests.docs.tables:fields_page",
    "command-line": "tests.docs.command_reference:reference",
    "python-reference": "tests.docs.python_reference:page",
}
"""Functions that make the ends of pages of the site, which programs print as well."""


def made(page: str) -> str:
    """What the program says of itself at the end of a page; empty for most.

    Args:
        page: its name without ending.
    """
    if page not in MADE:
        return ""
    module, _, name = MADE[page].partition(":")
    text: str = getattr(import_module(module), name)()
    return text


def _complete(_: Sphinx, page: str, source: list[str]) -> None:
    if page == "index":
        pages = Path(__file__).with_name("all-pages.md").read_text(encoding="utf-8")
        source[0] += "\n" + contents(pages)
    elif page == "contributing/index":
        source[0] = contributing()
    if end := made(page):
        source[0] += "\n" + end
    folder = (Path(__file__).parent / page).parent
    source[0] = typeset(titled(source[0], folder))


def scrollable(html: str) -> str:
    """What scrolls sideways on a phone can have the focus, so that arrow keys move it.

    Args:
        html: the article of a page.
    """
    table = '<div class="table-wrapper'
    focused = table.replace("<div", '<div tabindex="0"')
    return html.replace("<pre>", '<pre tabindex="0">').replace(table, focused)


def breakable(html: str) -> str:
    """Paths and names of fields may go on in another line of a narrow column.

    Args:
        html: the article of a page.
    """

    def with_breaks(code: re.Match[str]) -> str:
        return re.sub(r"([/_])(?=\w)", r"\1<wbr>", code[0])

    return re.sub(r'(?<=<span class="pre">)[^<]+', with_breaks, html)


def _make_readable(*event: Any) -> None:
    *_, context, _ = event
    if "body" in context:
        context["body"] = scrollable(breakable(context["body"]))


def _write_formula(writer: Any, node: Any) -> None:
    """A formula as MathML, which a browser draws without a script or a font of ours."""
    from docutils.nodes import SkipNode
    from latex2mathml.converter import convert

    is_block = node.tagname == "math_block"
    formula = convert(node.astext(), display="block" if is_block else "inline")
    formula = re.sub(r"<mi>([≤≥≠±·∘⊙∈≈⇔∖◁])</mi>", r"<mo>\1</mo>", formula)  # with space around
    block = f'<div class="formula" tabindex="0">{formula}</div>'
    writer.body.append(block if is_block else formula)
    raise SkipNode


def setup(app: Sphinx) -> None:
    """Complete pages when they are read, draw formulas, and show cells of a notebook as code."""
    # imported here: who reads the contents alone has no Sphinx
    from sphinx.directives.code import CodeBlock

    formulas = (_write_formula, None)
    app.add_html_math_renderer("mathml", inline_renderers=formulas, block_renderers=formulas)
    app.add_directive("code-cell", CodeBlock)
    app.connect("source-read", _complete)
    app.connect("html-page-context", _make_readable)
