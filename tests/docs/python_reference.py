"""docs/python-reference.md: every public name of the package, from its signature and docstring."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from importlib import import_module
from itertools import pairwise
from typing import Any

import garkcli
from garkcli.cli.command import declaration_of
from garkcli.cli.table import COMMANDS
from garkcli.frozen import Frozen, fields
from tests.docs.tables import cell, table

TYPES = {
    "AnyMethod": "api.anymethod",
    "Number": "exact.given:AnyNumber",
    "Whole": "api.numbers",
    "Settings": "api.numbers",
    "AnyTree": "api.trees",
    "AnyProblem": "api.problems",
    "AnyFamily": "api.design",
    "Blocks": "api.construction",
    "AnyPath": "bridges.calls",
}
"""Types of arguments: where each is defined, and as what where that differs."""
OWN = {"AnyMethod", "AnyTree", "AnyProblem", "AnyFamily", "AnyPath", "Settings"}
"""Those that say all of an argument: it stands in the signature alone."""
SAID = {"the rounding of the coefficients", "what errors call it.", "of the file."}
OF_COMMANDS = {x.of for name in COMMANDS for x in declaration_of(name).all_options}
"""Arguments that are options, by their functions: the reference of commands tells these."""
USUAL_ERRORS = {"MethodError", "MethodFileError", "UsageProblem"}
"""Errors of most functions, which the head of the page tells."""
"""What the head of the page says of ``tolerance``, ``source`` and ``text``."""
COMMON = {
    "limit": "the order at which a search stops",
    "h": "the step size",
    "step": "the step size",
    "steps": "step sizes that divide `t_end`, the largest first",
    "count": "how many steps",
    "t_end": "the final time, a whole number of steps",
    "initial": "the start, shape (2d,) for (q, p) or (d,) for y",
    "integrator": "`bind(method, problem)`, or that `.at(digits)`",
    "stiffness": "the parameter `stiffness` of a stiff problem",
    "terms": "one for each colour of a method",
    "seconds": "when to give up",
    "deadline": "the reading of `time.monotonic` at which to give up",
    "max_order": "the order of the largest trees",
    "seed": "of what is random",
    "whose": '`"method"`, `"conjugate"` or `"pair"`',
    "fast": "the colour of the fast spring, from 1",
    "slow": "(hω_s)² of the slow spring, or an interval of it",
    "up_to": "a bound on (hω_f)²",
    "keys": "claims, or one of them",
}
"""Arguments of several functions, which the page tells once."""
PLAIN = {"h", "step", "count", "seconds", "stiffness", "keys"}
"""Those whose names say all."""
VALUES = (
    "order.certificate:Order",
    "order.certificate:Witness",
    "order.rounded:RoundedOrder",
    "check.analysis:Analysis",
    "order.simplifying:Simplifying",
    "order.conditions:Condition",
    "check.outcome:Outcome",
    "check.outcome:Claim",
    "errors:Remark",
    "properties.property:Verdict",
    "stability.summary:Stability",
    "stability.summary:LinearStability",
    "stability.linear:StabilityFunction",
    "stability.two_frequencies:TwoFrequencies",
    "stability.two_frequencies:SlowInterval",
    "exact.cells:Interval",
    "exact.roots:RealRoot",
    "check.analysis:MethodProof",
    "order.certificate:Proof",
    "comparison.comparison:Comparison",
    "conversion.convert:Converted",
    "tableau.garkmethod:ByColour",
    "tableau.embedded:DenseOutput",
    "problems.hamiltonian:Hamiltonian",
    "problems.righthandside:RightHandSide",
    "convergence.result:Convergence",
    "convergence.result:StepSizeRow",
    "longtime.history:LongRun",
    "longtime.history:InvariantHistory",
    "longtime.symplecticity:Defect",
    "stepping.integrator:Binding",
    "stepping.integrator:Integrator",
    "backward.summary:BackwardAnalysis",
    "backward.summary:Reached",
    "backward.formulas:ModifiedFormula",
    "backward.formulas:PowerTerm",
    "backward.energy:ModifiedRun",
    "backward.energy:ModifiedEnergy",
    "methodfile.family:FamilyFile",
    "design.design:Design",
    "design.steps:Undecided",
    "design.steps:NoValue",
    "design.steps:Solutions",
    "design.steps:Many",
    "design.steps:Knowledge",
    "design.steps:Found",
    "design.within:DesignWithin",
    "design.within:StepWithin",
    "design.within:ValuesWithin",
    "design.minimise.result:Minimum",
    "design.stable_values:StableValues",
    "design.search.run:SearchResult",
    "bridges.audit:Audited",
    "sources.found:FoundTable",
    "sweep.report:SweepReport",
    "check.meanings:Meaning",
)
"""What calls return, in the order of the page."""
SECTION = re.compile(r"^(Args|Attributes|Returns|Raises|Errors|Source): ?", re.MULTILINE)


@dataclass
class Docstring:
    """A docstring taken apart.

    Attributes:
        prose: what stands before the sections, in Markdown.
        sections: by their labels, in order.
        examples: the lines with prompts and what they print.
    """

    prose: str
    sections: dict[str, str] = field(default_factory=dict)
    examples: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, thing: Any) -> Docstring:
        """That of a function, a class, or a property."""
        text = inspect.getdoc(thing) or ""
        plain, examples = [], []
        for paragraph in text.split("\n\n"):
            of_example = paragraph.lstrip().startswith(">>> ")
            (examples if of_example else plain).append(paragraph)
        prose, *rest = SECTION.split("\n\n".join(plain))
        sections = dict(zip(rest[::2], rest[1::2], strict=True))
        return cls(prose.strip(), sections, examples)


def items(section: str) -> Iterator[tuple[str, str]]:
    """The entries of a section of arguments, attributes or errors: name and text."""
    for entry in re.split(r"^ {4}(?! )", section, flags=re.MULTILINE)[1:]:
        name, colon, text = entry.partition(":")
        if colon:
            yield name.strip(), " ".join(text.split())
        else:
            yield "", " ".join(entry.split())


def linked(text: str, own: str = "") -> str:
    """Markdown of a docstring: code in single quotes, public names as links."""

    def code(match: re.Match[str]) -> str:
        word = match[1]
        if word in garkcli.__all__ and word not in {own, "catalogue"}:
            return f"[`{word}`](#{word.lower()})"
        return f"`{word}`"

    return re.sub(r"``([^`]+)``", code, text)


def brief(text: str) -> str:
    """The first sentence of a text.

    >>> brief("The order, eq. (bA). It is exact.")
    'The order, eq. (bA).'
    """
    return re.split(r"(?<=\.)\s+(?=[A-Z`])", " ".join(text.split()))[0]


class _Plain(str):
    """A text that is shown without quotes."""

    __slots__ = ()
    __repr__ = str.__str__


def signature(name: str, thing: Any) -> str:
    """How a function is called, or a value made; most types of arguments stand with these."""
    shape = inspect.signature(thing)
    empty = inspect.Signature.empty
    shown = [
        parameter.replace(annotation=_Plain(kind) if (kind := type_of(x, thing)) in OWN else empty)
        for x, parameter in shape.parameters.items()
    ]
    answer: Any = empty if isinstance(thing, type) else _Plain(shape.return_annotation)
    return f"{name}{shape.replace(parameters=shown, return_annotation=answer)}"


def type_of(name: str, thing: Any) -> str:
    """The type of an argument."""
    return str(inspect.signature(thing).parameters[name].annotation).replace('"', "")


def members(kind: type) -> Iterator[tuple[str, Any]]:
    """The public properties and methods of a class, and of its bases that have no section."""
    seen = {*fields(kind)} if issubclass(kind, Frozen) else set()
    for base in of_page(kind):
        for name, value in vars(base).items():
            if name in seen:
                continue
            is_told = isinstance(value, (property, cached_property))
            if inspect.isfunction(value) or isinstance(value, classmethod):
                is_told = True
            if is_told and not name.startswith("_") and inspect.getdoc(value):
                seen.add(name)
                yield name, value


def member(name: str, value: Any) -> tuple[str, str]:
    """A property or a method: how it is written, and what it is."""
    if isinstance(value, classmethod):
        value = value.__func__
    shape = ""
    if inspect.isfunction(value):
        names = [x for x in inspect.signature(value).parameters if x not in ("self", "cls")]
        shape = f"({', '.join(names)})"
    return f"{name}{shape}", Docstring.of(value).prose


def of_page(kind: type) -> list[type]:
    """The class and those of its bases whose members are told with it, as they have no section."""
    sections = {*garkcli.__all__, *(x.partition(":")[2] for x in VALUES)}
    bases = []
    for base in kind.__mro__[1:]:
        if base.__name__ in sections:
            break
        if base.__module__.startswith("garkcli"):
            bases.append(base)
    return [kind, *bases]


def more_general(kind: type) -> str:
    """What leads to the section of a base; empty where none has one."""
    own = of_page(kind)
    for base in kind.__mro__:
        if base not in own and base.__name__ in garkcli.__all__:
            return f" A [`{base.__name__}`](#{base.__name__.lower()})."
    return ""


def told(name: str, thing: Any) -> list[tuple[str, str]]:
    """The arguments of a function whose types do not tell all, or what a value has."""
    doc = of_class(thing)
    if isinstance(thing, type):
        entries = list(items(doc.sections.get("Attributes", "")))
        entries += [member(x, value) for x, value in members(thing)]
        return [(x, linked(brief(text).partition("; ")[0], name)) for x, text in entries]
    entries = [
        (
            f"{x}: {type_of(x, thing).removesuffix(' | None')}",
            _DEFAULT.sub("", brief(text)).partition("; ")[0],
        )
        for x, text in items(doc.sections.get("Args", ""))
        if type_of(x, thing) not in OWN and x not in COMMON and f"{name}.{x}" not in OF_COMMANDS
    ]
    return [
        (x, linked(text, name))
        for x, text in entries
        if text not in SAID and not text.startswith("as in ")
    ]


_DEFAULT = re.compile(r"[;,] (by default|None for|that of the method where) .*")
"""What is said of defaults, which the signature shows."""


def described(name: str, thing: Any) -> str:
    """The section of one name."""
    doc = of_class(thing)
    is_value = isinstance(thing, type)
    parts = [f"### {name}"]
    if not is_value or is_made(thing):
        parts.append(f"`{signature(name, thing)}`")
    general = more_general(thing) if is_value else ""
    parts.append(linked(brief(doc.prose) + answer(thing, doc), name) + general)
    own = told(name, thing)
    if own and is_value:
        parts.append(f"Has {', '.join(f'`{x}`' for x, _ in own)}.")
    elif own:
        parts.append("\n".join(f"* `{x}`: {text.rstrip('.')}" for x, text in own))
    if "Raises" in doc.sections:
        errors = [x for x, _ in items(doc.sections["Raises"]) if x not in USUAL_ERRORS]
        if errors:
            parts.append(f"Raises {', '.join(linked(f'``{x}``', name) for x in errors)}.")
    return "\n\n".join(parts)


def answer(thing: Any, doc: Docstring) -> str:
    """What a call returns; empty where its type has a place on the page, which says it."""
    sections = {*garkcli.__all__, *(x.partition(":")[2] for x in VALUES)}
    if (
        "Returns" not in doc.sections
        or {*re.findall(r"\w+", str(inspect.signature(thing).return_annotation))} & sections
    ):
        return ""
    return f" Returns: {brief(doc.sections['Returns']).partition('; ')[0].rstrip('.')}."


def value_row(name: str, kind: type) -> tuple[str, str, str]:
    """The row of what calls return: what it is, and the names that it has."""
    names = ", ".join(f"`{x}`" for x, _ in told(name, kind))
    return f"`{name}`", cell(linked(brief(of_class(kind).prose))), names.replace("|", "\\|")


def of_class(thing: Any) -> Docstring:
    """The docstring of a name, with the attributes of its bases that have no section."""
    doc = Docstring.of(thing)
    if isinstance(thing, type):
        for base in of_page(thing)[1:]:
            further = Docstring.of(base).sections.get("Attributes", "")
            own = doc.sections.get("Attributes", "")
            doc.sections["Attributes"] = f"{further.rstrip()}\n{own.strip(chr(10))}"
    return doc


def is_made(kind: type) -> bool:
    """Whether people make values of a class by calling it."""
    return kind.__name__ in {"Tree", "Oscillator"}


def home(place: str) -> tuple[str, Any]:
    """A value that is named by its room: its name and itself."""
    module, _, name = place.partition(":")
    return name, getattr(import_module(f"garkcli.{module}"), name)


def groups() -> Iterator[tuple[str, list[str]]]:
    """The parts of the package's docstring: what they are for, and their names."""
    text = inspect.getdoc(garkcli) or ""
    part = text.split("\n\n")[1]
    for entry in re.split(r"\n(?! )", part):
        head, _, rest = entry.partition(":")
        words = re.findall(r"\w+", rest)
        names = [x for x in words if x in garkcli.__all__]
        yield head, list(dict.fromkeys(names))


def type_text(name: str, place: str) -> str:
    """What a type of arguments is: the text below its definition."""
    module, _, other = place.partition(":")
    source = import_module(f"garkcli.{module}").__file__
    assert source is not None
    with open(source, encoding="utf-8") as file:
        nodes = ast.parse(file.read()).body
    for node, after in pairwise(nodes):
        is_named = isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)
        if is_named and node.target.id == (other or name):
            assert isinstance(after, ast.Expr)
            told = ast.literal_eval(after.value)
            return linked(" ".join(told.split()))
    raise LookupError(name)


def page() -> str:
    """All of it, below the head that a person wrote."""
    parts = ["## Types of arguments\n"]
    parts += [f"* `{name}`: {type_text(name, place)}" for name, place in TYPES.items()]
    parts.append("\n## Arguments of several functions\n")
    parts += [f"* `{name}`: {text}" for name, text in COMMON.items() if name not in PLAIN]
    shown: set[str] = set()
    for head, names in groups():
        things = {name: getattr(garkcli, name) for name in names if name not in shown}
        things |= {x: type(thing) for x, thing in things.items() if x == "catalogue"}
        shown |= {*things}
        sections = [described(name, thing) for name, thing in things.items()]
        parts.append(f"\n## {head}\n\n" + "\n\n".join(sections))
    parts.append("\n## Values\n")
    rows = (value_row(*home(place)) for place in VALUES)
    parts.append(table(("value", "what it is", "what it has"), rows).rstrip())
    return "\n".join(parts) + "\n"


def returned() -> set[str]:
    """The classes of the package that public functions say they return."""
    found: set[str] = set()
    for name in garkcli.__all__:
        thing: Callable[..., Any] = getattr(garkcli, name)
        if inspect.isfunction(thing):
            shape = inspect.signature(thing).return_annotation
            words = re.findall(r"[A-Z]\w+", str(shape))
            module = import_module(thing.__module__)
            for word in words:
                value = getattr(module, word, None)
                if inspect.isclass(value):
                    found.add(value.__name__)
    return found
