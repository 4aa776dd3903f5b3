"""``gark show --reference``: publications of methods as BibTeX, and as rows."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from string import ascii_lowercase

from garkcli.errors import counted, printable
from garkcli.frozen import Frozen, fields
from garkcli.page.latex import ascii_letters, letters
from garkcli.reference import ARXIV, Reference
from garkcli.tell.facts import Level, Row, Section, itself, maybe, optional
from garkcli.tell.kinds import TEXT, TEXTS
from garkcli.tell.parts import BESIDE, part, parts, shown
from garkcli.tell.report import FORMATS as TOLD
from garkcli.tell.report import Report

_ENTRY_TYPES = {
    "article": "article",
    "book": "book",
    "chapter": "incollection",
    "report": "techreport",
    "software": "misc",
    "thesis": "phdthesis",
    "web": "misc",
}
_BETWEEN_WORDS = re.compile(r"([\s–—-]+)")
_DASHES = re.compile(r"\s*[-–—]+\s*")


class Cited(Frozen):
    """``text`` is empty without a reference, ``reference`` None if it is plain text."""

    methods: tuple[str, ...]
    text: str
    reference: Reference | None


def together(cited: Sequence[Cited]) -> list[Cited]:
    """The place in the work and the origin of digits make no other publication."""
    found: dict[object, Cited] = {}
    for one in cited:
        key = _work(one) if one.text else one.methods
        before = found.get(key)
        methods = (*before.methods, *one.methods) if before else one.methods
        each = tuple(dict.fromkeys(methods))  # one may be named twice
        found[key] = Cited(each, one.text, one.reference)
    return list(found.values())


def _work(cited: Cited) -> object:
    reference = cited.reference
    if reference is None:
        return cited.text
    own = {"where", "coefficients", "note"}
    return tuple(getattr(reference, name) for name in fields(reference) if name not in own)


def keys(cited: Sequence[Cited]) -> list[str]:
    """Distinct keys, ``Dormand1980``, with a letter if need be, independent of the order."""
    plain = [_key(one) for one in cited]
    found = []
    for one, key in zip(cited, plain, strict=True):
        same = sorted(other.text for other, its in zip(cited, plain, strict=True) if its == key)
        letter = _numbered(same.index(one.text)) if len(same) > 1 else ""
        found.append(key + letter)
    return found


def _numbered(number: int) -> str:
    """a, b, …, z, za, zb, …"""
    rounds, rest = divmod(number, len(ascii_lowercase))
    return "z" * rounds + ascii_lowercase[rest]


def _key(cited: Cited) -> str:
    reference = cited.reference
    people: Sequence[str] = () if reference is None else reference.authors or reference.editors
    if reference is None or not people:
        return _key_of_method(cited.methods[0])
    return ascii_letters(short_name(people[0])) + reference.year


def _key_of_method(name: str) -> str:
    return ascii_letters(re.split(r"[\\/]", name)[-1].partition(".")[0]) or "method"


def last_name(name: str) -> str:
    """The last word of a name, or the words before its comma.

    >>> last_name("J. C. Butcher"), last_name("Butcher, John C."), last_name("G. Vanden Berghe")
    ('Butcher', 'Butcher', 'Berghe')
    """
    before, comma, _ = name.partition(",")
    return before if comma else name.split()[-1]


def short_name(name: str) -> str:
    """The last name of a person, or the topic of a group.

    >>> short_name("J. C. Butcher"), short_name("The NodePy developers")
    ('Butcher', 'NodePy')
    """
    last = last_name(name)
    return last if last[:1].isupper() else name.removeprefix("The ").split()[0]


def bibliography(cited: Sequence[Cited], is_brief: bool = True) -> str:
    """BibTeX, with the origin of digits in comments."""
    texts = []
    for one, key in zip(cited, keys(cited), strict=True):
        source = "" if is_brief or one.reference is None else one.reference.coefficients
        texts.append(f"% coefficients: {printable(source)}\n" * bool(source) + _bibtex(one, key))
    return "\n".join(texts)


def _bibtex(cited: Cited, key: str) -> str:
    names = ", ".join(map(printable, cited.methods))
    if not cited.text:
        return f"% {names}: no reference in its file\n"
    if cited.reference is None:
        lines = [f"  note = {{{letters(printable(cited.text))}}},"]
        return _entry(names, "misc", key, lines)
    reference = cited.reference
    kind = _entry_type(reference)
    lines = [f"  {name} = {{{value}}}," for name, value in _fields(reference)]
    return _entry(names, kind, key, lines)


def _entry(names: str, kind: str, key: str, lines: Sequence[str]) -> str:
    body = "\n".join(lines)
    return f"% {names}\n@{kind}{{{key},\n{body}\n}}\n"


def _entry_type(reference: Reference) -> str:
    """Returns the type that the file says, or that suits its fields."""
    if reference.type == "thesis":
        is_master = "master" in reference.note.lower()
        return "mastersthesis" if is_master else "phdthesis"
    if reference.type:
        return _ENTRY_TYPES[reference.type]
    if reference.journal:
        return "article"
    if reference.book:
        return "incollection"
    if reference.institution:
        return "techreport"
    return "book" if reference.publisher else "misc"


def _fields(reference: Reference) -> Iterator[tuple[str, str]]:
    home = "school" if _entry_type(reference).endswith("thesis") else "institution"
    note = "; ".join(letters(x) for x in [reference.where, reference.note] if x)
    found = {
        "author": _people(reference.authors),
        "title": title(reference.title),
        "journal": letters(reference.journal),
        "booktitle": title(reference.book),
        "editor": _people(reference.editors),
        "edition": letters(reference.edition),
        "publisher": letters(reference.publisher),
        home: letters(reference.institution),
        "volume": letters(reference.volume),
        "number": letters(reference.number),
        "pages": letters(_DASHES.sub("–", reference.pages)),
        "year": reference.year,
        "note": note,
        "doi": reference.doi,
    }
    if reference.url.startswith(ARXIV):
        found |= {"eprint": reference.url.removeprefix(ARXIV), "archiveprefix": "arXiv"}
    else:
        found["url"] = reference.url
    for name, value in found.items():
        if value:
            yield name, value


def _people(names: Sequence[str]) -> str:
    """A name whose last word is small is a group, and stays whole."""
    written = []
    for name in names:
        is_whole = not last_name(name)[:1].isupper()
        written.append(f"{{{letters(name)}}}" if is_whole else letters(name))
    return " and ".join(written)


def title(text: str) -> str:
    """Braces keep capitals: styles turn others into small letters.

    >>> print(title("Embedded Runge–Kutta formulae of order 5"))
    Embedded {Runge}--{Kutta} formulae of order 5
    """
    pieces = _BETWEEN_WORDS.split(text)
    written = list(map(_kept, pieces))
    first = pieces[0]
    if first[:1].isupper() and not _has_capital(first[1:]):
        written[0] = letters(first)  # it is the first of a sentence in every style
    return "".join(written)


def _kept(piece: str) -> str:
    spelt = letters(piece)
    return f"{{{spelt}}}" if _has_capital(piece) else spelt


def _has_capital(word: str) -> bool:
    return any(sign.isupper() for sign in word)


def _of(field: str) -> Row[Reference]:
    if field in {"authors", "editors"}:
        return optional(field, TEXTS, lambda x: getattr(x, field) or None)
    return optional(field, TEXT, lambda x: getattr(x, field) or None)


REFERENCE: Section[Reference] = Section(_of(name) for name in fields(Reference))
CITED: Section[tuple[Cited, str]] = Section(
    Row("methods", TEXTS, lambda x: x[0].methods),
    Row("key", TEXT, lambda x: x[1]),
    maybe("text", TEXT, lambda x: x[0].text or None),
    maybe("reference", part(REFERENCE), lambda x: x[0].reference),
    maybe("bibtex", TEXT, lambda x: _bibtex(*x) if x[0].text else None),
)
LINE: Section[Cited] = Section(
    Row("methods", TEXTS, lambda x: x.methods, label=""),
    Row("reference", TEXT, lambda x: x.text or "no reference in its file"),
    Row("doi", BESIDE, lambda x: None if x.reference is None else x.reference.doi, Level.DETAIL),
    Row(
        "coefficients",
        BESIDE,
        lambda x: None if x.reference is None else x.reference.coefficients,
        Level.DETAIL,
    ),
)
REPORT: Report[Sequence[Cited]] = Report.only(
    "gark/cite/1",
    "what to cite, of gark show --reference",
    Section(
        Row("references", parts(CITED), lambda x: [*zip(x, keys(x), strict=True)], Level.DATA),
        itself("methods", shown(LINE, 0)),
        title=lambda x, _: counted(sum(bool(one.text) for one in x), "publication"),
    ),
)
FORMATS = ("bibtex", *TOLD)


def render(cited: Sequence[Cited], format: str) -> str:
    return bibliography(cited) if format == "bibtex" else REPORT.render([cited], format)
