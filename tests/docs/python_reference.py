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
VALUES = (
    "order.certificate:Order",
    "order.certificate:Witness",
    "order.rounded:RoundedOrder",
    "check.analysis:Analysis",
    "order.simplifying:Simplifying",
    "order.conditions:Condition",
    "check.outcome:Outcome",
    "check.outcome:Claim",
    "errors:Fault",
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
    "convergence.result:Row",
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
    "design.design:Step",
    "design.design:Found",
    "design.minimise.result:Minimum",
    "design.stable_values:StableValues",
    "design.search.run:Result",
    "bridges.audit:Audited",
    "sources.found:FoundTable",
    "report.sweep:SweepReport",
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


def listed(section: str, own: str) -> Iterator[str]:
    """A section as a list."""
    for name, text in items(section):
        # errors have sections of their own, arguments only names like others
        is_error = isinstance(getattr(garkcli, name, None), type)
        shown = linked(f"``{name}``", own) if is_error else f"`{name}`"
        head = f"{shown}: " if name else ""
        yield f"* {head}{linked(text, own)}"


class _Plain(str):
    """A text that is shown without quotes."""

    __slots__ = ()
    __repr__ = str.__str__


def signature(name: str, thing: Any) -> str:
    """How a function is called, or a value made, with the types of its arguments."""
    shape = inspect.signature(thing)
    shown = []
    for parameter in shape.parameters.values():
        written = thing.__annotations__ if inspect.isclass(thing) else {}
        kind = str(written.get(parameter.name, parameter.annotation)).replace('"', "")
        shown.append(parameter.replace(annotation=_Plain(kind)))
    answer: Any = _Plain(shape.return_annotation)
    if isinstance(thing, type):
        answer = inspect.Signature.empty
    return f"{name}{shape.replace(parameters=shown, return_annotation=answer)}"


def body(doc: Docstring, own: str) -> Iterator[str]:
    """Prose, arguments, what is returned, errors and examples."""
    yield linked(prose(doc.prose), own)
    for label, section in doc.sections.items():
        entries = list(listed(section, own))
        if label in {"Args", "Attributes"}:
            yield "\n".join(entries)
        elif label in {"Raises", "Errors"}:
            yield "Raises:\n\n" + "\n".join(entries)
        else:
            yield f"{label}: {linked(' '.join(section.split()), own)}"
    if doc.examples:
        yield "```python\n" + "\n\n".join(doc.examples) + "\n```"


def prose(text: str) -> str:
    """Paragraphs in a line each; what stands on indented lines or in tables stays as it is."""
    parts = []
    for paragraph in text.split("\n\n"):
        if paragraph.startswith(" ") or "===" in paragraph:
            parts.append(paragraph)
        else:
            parts.append(" ".join(paragraph.split()))
    return "\n\n".join(parts)


def members(kind: type) -> Iterator[tuple[str, Any]]:
    """The public properties and methods of a class, and of its bases that have no section."""
    for base in of_page(kind):
        for name, value in vars(base).items():
            is_told = isinstance(value, (property, cached_property))
            if inspect.isfunction(value) or isinstance(value, classmethod):
                is_told = True
            if is_told and not name.startswith("_") and inspect.getdoc(value):
                yield name, value


def member(name: str, value: Any, own: str) -> str:
    """A property or a method in an entry of a list."""
    doc = Docstring.of(value)
    head = f"`.{name}`"
    if isinstance(value, classmethod):
        value = value.__func__
    if inspect.isfunction(value):
        shape = str(inspect.signature(value)).partition(" ->")[0]
        shape = re.sub(r"^\((self|cls)(, )?", "(", shape).replace("'", "")
        head = f"`.{name}{shape}`"
    text = linked(" ".join(doc.prose.split()), own)
    for label in ("Returns", "Raises"):
        if label in doc.sections:
            more = "; ".join(
                f"`{error}`: {why}" if error else why for error, why in items(doc.sections[label])
            )
            text += f" {label} {linked(more, own)}"
    return f"* {head}: {text}"


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
    """The sentence that leads to the section of a base; empty where none has one."""
    own = of_page(kind)
    others = [base for base in kind.__mro__ if base not in own]
    for base in others:
        if base.__name__ in {*garkcli.__all__}:
            return f"It is a [`{base.__name__}`](#{base.__name__.lower()})."
    return ""


def described(name: str, thing: Any) -> str:
    """The section of one name."""
    parts = [f"### {name}"]
    if not isinstance(thing, type) or is_made(thing):
        parts.append(f"`{signature(name, thing)}`")
    parts += [part for part in body(of_class(thing), name) if part]
    if isinstance(thing, type):
        if more_general(thing):
            parts.insert(2, more_general(thing))
        entries = [member(x, value, name) for x, value in members(thing)]
        if entries:
            parts.append("\n".join(entries))
    return "\n\n".join(parts)


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
    for name, place in TYPES.items():
        parts.append(f"* `{name}`: {type_text(name, place)}")
    told: set[str] = set()
    for head, names in groups():
        parts.append(f"\n## {head}\n")
        fresh = [name for name in names if name not in told]
        told |= {*fresh}
        parts.append("\n\n".join(_section(name) for name in fresh))
    parts.append("\n## Values\n")
    found = [home(place) for place in VALUES]
    parts.append("\n\n".join(described(*value) for value in found))
    return "\n".join(parts) + "\n"


def _section(name: str) -> str:
    thing = getattr(garkcli, name)
    if name == "catalogue":
        return described(name, type(thing))
    return described(name, thing)


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
