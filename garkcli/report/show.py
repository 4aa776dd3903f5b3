"""``gark show``: all about one method, declared once."""

from __future__ import annotations

from garkcli.errors import counted, printable
from garkcli.frozen import Frozen
from garkcli.reference import Reference
from garkcli.report.citation import REFERENCE
from garkcli.report.list_methods import METHOD, TRUTHS, TYPES, Entry
from garkcli.report.tableau import DOCUMENT, ShownTableau, drawn
from garkcli.tableau.pointwise import Entries
from garkcli.tableau.tableau import Tableau
from garkcli.tell.facts import Level, Row, Section, maybe, via
from garkcli.tell.kinds import TEXT
from garkcli.tell.parts import SAID, drawing, part
from garkcli.tell.report import Report

DETAIL, DATA = Level.DETAIL, Level.DATA


class ShownMethod(Frozen):
    """A method of the catalogue or of a file, with its entry in the list of methods."""

    entry: Entry
    tableau: Tableau
    entries: Entries
    description: str
    reference: Reference | None

    @property
    def whole(self) -> ShownTableau:
        rounded = self.entry["exact"] is False
        return ShownTableau(self.tableau, self.entries, self.title, is_rounded=rounded)

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
    """The properties that the method has, or lacks, without the kinds of stages that it lacks."""
    told = [key for key in TRUTHS if value or key not in TYPES]
    return ", ".join(key.replace("_", "-") for key in told if x.entry[key] is value)


def undecided(x: ShownMethod) -> str:
    return ", ".join(key.replace("_", "-") for key in x.entry["undecided"])


REPORT: Report[ShownMethod] = Report.only(
    "gark/show/1",
    "report of gark show",
    Section(
        Row("kind", SAID, kind),
        Row("description", SAID, lambda x: " ".join(x.description.split())),
        via(lambda x: x.entry, METHOD),
        Row("description", TEXT, lambda x: x.description, DATA),
        Row("it_is", SAID, lambda x: such(x, value=True), is_short=True),
        Row("it_is_not", SAID, lambda x: such(x, value=False), is_short=True),
        Row("undecided", SAID, undecided, label="not decided"),
        Row("doi", SAID, lambda x: None if x.reference is None else x.reference.doi),
        Row(
            "coefficients",
            SAID,
            lambda x: None if x.reference is None else x.reference.coefficients,
        ),
        maybe("publication", part(REFERENCE), lambda x: x.reference, DATA),
        Row("tableau", part(DOCUMENT), lambda x: x.whole, DATA),
        Row("tableau", drawing(drawn), lambda x: x.whole),
        title=lambda x, d: d.prose(x.title),
    ),
)
