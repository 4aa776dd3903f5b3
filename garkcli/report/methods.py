"""``gark list methods`` and ``gark show``: the methods of the catalogue and of files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Never, TypeAlias, TypeVar

from flint import fmpq

from garkcli.constructions.infinitesimal import Coupling
from garkcli.errors import counted, printable
from garkcli.exact.display import shortest
from garkcli.exact.expression import read_decimal
from garkcli.frozen import Frozen
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.lines import folded
from garkcli.properties.subject import every_property
from garkcli.reference import Reference
from garkcli.report.citation import REFERENCE, short_name
from garkcli.report.tableau import DOCUMENT, ShownTableau, drawn
from garkcli.tableau.pointwise import Entries
from garkcli.tableau.tableau import Tableau
from garkcli.tell import facts
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.kinds import COUNT, POSITION, TEXT, TEXTS, TRUTH, choice
from garkcli.tell.parts import SAID, drawing, part, parts, shown, told
from garkcli.tell.report import ListReport, Report

HEADLINE, USUAL, DETAIL, DATA = facts.Level
V = TypeVar("V")
Entry: TypeAlias = dict[str, Any]
ORDER = "order"


def _field(
    key: str, kind: facts.Kind[V], level: facts.Level = DATA, has_null: bool = True, line: str = ""
) -> facts.Row[Entry]:
    row = facts.maybe if has_null else facts.Row
    return row(key, kind, lambda entry: entry[key], level, line=line)


def rounding(entry: Entry) -> fmpq | None:
    return None if entry["tolerance"] is None else read_decimal(entry["tolerance"])


def order(key: str) -> Callable[[Entry], facts.Answer[int]]:
    return lambda entry: facts.Answer(entry[key], Status(rounding(entry)))


def _order(key: str, level: facts.Level = USUAL, label: str | None = None) -> facts.Row[Entry]:
    return facts.maybe(key, COUNT, order(key), level, line=ORDER, label=label)


def _size_words(text: str, d: Plain) -> str:
    over, _, under = text.partition("/")
    is_fraction = over.lstrip("-").isdecimal() and under.isdecimal()
    return d.prose(shortest(fmpq(int(over), int(under))) if is_fraction else text)


SIZE: facts.Kind[str] = facts.Kind(TEXT.what, facts.Words(_size_words))
KINDS: dict[str, facts.Kind[Never]] = {"truth": TRUTH, "count": COUNT, "number": SIZE}
PROPERTIES: facts.Rows[Entry] = [
    _field(
        x.field,
        KINDS[x.kind],
        USUAL if x.kind == "number" or x.field == "stage_order" else DETAIL,
        line=ORDER if x.field == "stage_order" else "",
    )
    for x in every_property()
]
TRUTHS = ["symplectic", *(x.field for x in every_property() if x.kind == "truth")]
STAGES: facts.Kind[list[int]] = facts.Kind(
    facts.Json(S.array(S.POSITION), csv=lambda xs: "; ".join(map(str, xs)))
)
BY_KIND = {
    "rk": "Runge-Kutta",
    "ark": "additive",
    "prk": "partitioned",
    "gark": "general",
    "row": "Rosenbrock",
    "rkn": "Nyström",
    "nprk": "nonlinearly partitioned",
    "mdrk": "multiderivative",
    "mri": "multirate",
    "family": "with free parameters",
}
KEYS_OF_KINDS = {"rosenbrock": "row", "nystrom": "rkn", "derivatives": "mdrk", "multirate": "mri"}
"""Keys that differ from the kind."""
_KIND = choice(*BY_KIND, None)
METHOD: facts.Rows[Entry] = [
    _field("name", TEXT, USUAL, has_null=False),
    _field("aliases", TEXTS, USUAL, has_null=False),
    _field("file", TEXT, DETAIL, has_null=False),
    _field("folder", TEXT, DETAIL, has_null=False),
    _field("catalogue", TEXT, DETAIL, has_null=False),
    _field("facts", choice("found", "claimed", "unread"), DETAIL, has_null=False),
    _field("title", TEXT, has_null=False),
    _field("reference", TEXT, USUAL, has_null=False),
    _field("authors", TEXTS, has_null=False),
    _field("year", TEXT, has_null=False),
    _order("order", HEADLINE),
    _order("embedded_order"),
    _order("conjugate_order"),
    _order("pair_order"),
    _order("nonautonomous_order"),
    _order("w_order", label="order with any matrix"),
    _order("index_1_order", label="order on index-1 DAEs"),
    _field("stages", POSITION),
    _field("stages_by_colour", STAGES, has_null=False),
    _field("colours", POSITION),
    _field("kind", _KIND, has_null=False),
    _field("structure", TEXT),
    _field("exact", TRUTH),
    _field("tolerance", TEXT, USUAL),
    _field("embedded", TRUTH),
    _field("dense", TRUTH),
    _field("error_constant", TEXT, USUAL, line=ORDER),
    _field("symplectic", TRUTH, DETAIL),
    *PROPERTIES,
    _field("undecided", TEXTS, has_null=False),
]
MARKS = {
    "A": ("a_stable", "A-stable"),
    "L": ("l_stable", "L-stable"),
    "B": ("algebraically_stable", "algebraically stable"),
    "F": ("fsal", "first same as last"),
    "S": ("symplectic", "symplectic"),
    "R": ("symmetric", "symmetric (reversible)"),
    "t": ("", "another order for y' = f(t, y)"),
    "~": ("", "rounded"),
}
TYPES = {
    "explicit": "explicit",
    "sdirk": "SDIRK",
    "esdirk": "ESDIRK",
    "diagonally_implicit": "DIRK",
    "fully_implicit": "implicit",
}
"""Dependences of stages, the narrower before the wider."""


def marks(entry: Entry) -> list[str]:
    found = [mark for mark, (key, _) in MARKS.items() if key and entry[key]]
    if entry["nonautonomous_order"] not in {None, entry["order"]}:
        found.append("t")
    return [*found, "~"] if entry["exact"] is False else found


def _order_words(entry: Entry, _: Plain) -> str:
    """``5(4)``, with a star if it is a claim."""
    if entry["order"] is None:
        return ""
    inner = "" if entry["embedded_order"] is None else f"({entry['embedded_order']})"
    return f"{entry['order']}{inner}{'*' if entry['facts'] == 'claimed' else ''}"


def _stages_words(entry: Entry, _: Plain) -> str:
    """``3+2`` if colours have stages of their own."""
    own = [entry["stages"]] if entry["kind"] == "ark" else entry["stages_by_colour"]
    return "+".join(map(str, own))


def _marks_words(entry: Entry, d: Plain) -> str:
    if d.is_brief:
        return d.prose("".join(marks(entry)))
    return d.prose(", ".join(MARKS[x][1] for x in marks(entry)))


def short_reference(entry: Entry) -> str:
    """Last names and year, or the beginning of a reference that is plain text."""
    names = list(map(short_name, entry["authors"]))
    if not names:
        return str(entry["reference"])
    text = f"{names[0]} et al." if len(names) > 3 else ", ".join(names)
    return f"{text} {entry['year']}".rstrip()


def _reference_words(entry: Entry, d: Plain) -> str:
    is_short = d.is_brief or d.breadth == "page"
    return d.prose(short_reference(entry) if is_short else entry["reference"])


def _type(entry: Entry) -> str:
    return next((word for key, word in TYPES.items() if entry[key]), "")


LINE: facts.Section[Entry] = facts.Section(
    facts.Row("name", TEXT, lambda x: x["name"], label=""),
    facts.itself("order", told(_order_words)),
    facts.itself("stages", told(_stages_words)),
    facts.Row("kind", TEXT, lambda x: x["kind"] or "unread"),
    facts.Row("explicit", TEXT, _type, label="type"),
    facts.itself("properties", told(_marks_words), label="is"),
    facts.itself("reference", told(_reference_words)),
    is_cut=True,
)


def _title(entries: Sequence[Entry], d: Plain) -> str:
    if not entries:
        return "no method of the catalogue matches"
    present = {mark for entry in entries for mark in marks(entry)} if d.is_brief else set()
    legend = [f"{mark}: {MARKS[mark][1]}" for mark in MARKS if mark in present]
    if any(x["facts"] == "claimed" and x["order"] is not None for x in entries):
        legend.append("*: as its file claims (--judge finds it)")
    return d.prose(". ".join(filter(None, [counted(len(entries), "method"), ", ".join(legend)])))


_MORE = "gark list methods --kind rk lists one kind, --sort order all; gark list --help"


def by_kind(entries: Sequence[Entry], width: int) -> list[str]:
    """The numbers of methods by kind and type, and how to list them."""
    groups: dict[tuple[str, str], list[Entry]] = {}
    for entry in entries:
        groups.setdefault((entry["kind"] or "", _type(entry)), []).append(entry)
    places = [*BY_KIND, ""]
    rows = [("kind", "", "type", "methods", "orders")]
    for kind, form in sorted(groups, key=lambda x: (places.index(x[0]), -len(groups[x]))):
        found = groups[kind, form]
        orders = sorted({x["order"] for x in found if x["order"] is not None})
        ends = dict.fromkeys(map(str, orders[:1] + orders[-1:]))
        named = kind or "unread", BY_KIND.get(kind, ""), form
        rows.append((*named, str(len(found)), " to ".join(ends)))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(
            x.rjust(n) if k == 3 else x.ljust(n)
            for k, (x, n) in enumerate(zip(row, widths, strict=True))
        )
        for row in rows
    ]
    return [
        counted(len(entries), "method"),
        *(f"  {line}".rstrip() for line in lines),
        *folded(f"{_MORE} has the other filters", width, ""),
    ]


REPORT: Report[Sequence[Entry]] = ListReport.only(
    "",
    "list of gark list methods",
    facts.Section(
        facts.itself("methods", parts(facts.Section(METHOD)), DATA),
        facts.itself("name", shown(LINE, 0)),
        title=_title,
    ),
    lines=lambda entries: (facts.Section(METHOD), entries),
)


DETAIL, DATA = facts.Level.DETAIL, facts.Level.DATA


class ShownMethod(Frozen):
    entry: Entry
    tableau: Tableau
    entries: Entries
    description: str
    reference: Reference | None
    coupling: Coupling | None = None

    @property
    def whole(self) -> ShownTableau:
        return ShownTableau(
            self.tableau,
            self.entries,
            self.title,
            is_rounded=self.entry["exact"] is False,
            coupling=self.coupling,
        )

    @property
    def title(self) -> str:
        return printable(self.entry["title"] or self.entry["name"])


def kind(x: ShownMethod) -> str:
    """``rk, 1 colour, stages 4``."""
    entry = x.entry
    about = [
        entry["kind"],
        counted(entry["colours"], "colour"),
        f"stages {', '.join(map(str, entry['stages_by_colour']))}",
    ]
    if entry["structure"] != "general":
        about.append(f"for {entry['structure']} problems")
    if entry["dense"]:
        about.append("with dense output")
    return ", ".join(about)


def such(x: ShownMethod, value: bool) -> str:
    """The properties that a method has; or those it lacks, except kinds of stages."""
    told = [key for key in TRUTHS if value or key not in TYPES]
    return ", ".join(key.replace("_", "-") for key in told if x.entry[key] is value)


def undecided(x: ShownMethod) -> str:
    return ", ".join(key.replace("_", "-") for key in x.entry["undecided"])


SHOWN: Report[ShownMethod] = Report.only(
    "gark/show/1",
    "report of gark show",
    facts.Section(
        facts.Row("kind", SAID, kind),
        facts.Row("description", SAID, lambda x: " ".join(x.description.split())),
        facts.via(lambda x: x.entry, METHOD),
        facts.Row("description", TEXT, lambda x: x.description, DATA),
        facts.Row("it_is", SAID, lambda x: such(x, value=True), is_short=True),
        facts.Row("it_is_not", SAID, lambda x: such(x, value=False), is_short=True),
        facts.Row("undecided", SAID, undecided, label="not decided"),
        facts.Row("doi", SAID, lambda x: None if x.reference is None else x.reference.doi),
        facts.Row(
            "coefficients",
            SAID,
            lambda x: None if x.reference is None else x.reference.coefficients,
        ),
        facts.maybe("publication", part(REFERENCE), lambda x: x.reference, DATA),
        facts.Row("tableau", part(DOCUMENT), lambda x: x.whole, DATA),
        facts.Row("tableau", drawing(drawn), lambda x: x.whole),
        title=lambda x, d: d.prose(x.title),
    ),
    letters=lambda x: x.tableau,
)
