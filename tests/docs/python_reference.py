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
from garkcli.errors import GarkError
from garkcli.frozen import Frozen, fields

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
COMMON = {
    "limit": "the order at which a search stops",
    "steps": "step sizes that divide `t_end`, the largest first",
    "t_end": "the final time, a whole number of steps",
    "initial": "the start, shape (2d,) for (q, p) or (d,) for y",
    "integrator": "`bind(method, problem)`, or that `.at(digits)`",
    "terms": "one for each colour of a method",
    "deadline": "the reading of `time.monotonic` at which to give up",
    "max_order": "the order of the largest trees",
    "seed": "of what is random",
    "whose": '`"method"`, `"conjugate"` or `"pair"`',
    "fast": "the colour of the fast spring, from 1",
    "slow": "(hω_s)² of the slow spring, or an interval of it",
    "up_to": "a bound on (hω_f)²",
}
"""Arguments of several functions, which the page tells once."""
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
    "properties.verdict:Verdict",
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


def plain(text: str) -> str:
    """Markdown of a docstring: code in single quotes."""
    return re.sub(r"``([^`]+)``", r"`\1`", text)


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
    """How a function is called, or a value made; what arguments are stands with their types."""
    shape = inspect.signature(thing)
    empty = inspect.Signature.empty
    shown = [x.replace(annotation=empty) for x in shape.parameters.values()]
    answer: Any = empty if isinstance(thing, type) else _Plain(shape.return_annotation)
    return f"{name}{shape.replace(parameters=shown, return_annotation=answer)}"


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


def member(name: str, value: Any) -> str:
    """How a property or a method is written."""
    if isinstance(value, classmethod):
        value = value.__func__
    if not inspect.isfunction(value):
        return name
    names = [x for x in inspect.signature(value).parameters if x not in ("self", "cls")]
    return f"{name}({', '.join(names)})"


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


def told(kind: type) -> list[str]:
    """What values of a class have: attributes, properties and methods."""
    names = [x for x, _ in items(of_class(kind).sections.get("Attributes", ""))]
    return [*names, *(member(x, value) for x, value in members(kind))]


def described(name: str, thing: Any) -> str:
    """The row of one name: how it is called, what it is, what it has, and from which error it is
    made.
    """
    doc = of_class(thing)
    shown = signature(name, thing) if not isinstance(thing, type) or is_made(thing) else name
    if isinstance(thing, type) and issubclass(thing, GarkError) and thing is not GarkError:
        shown += f"({thing.__bases__[0].__name__})"
    own = told(thing) if isinstance(thing, type) else []
    parts = [f"* `{shown}`: {plain(brief(doc.prose))}"]
    if own:
        parts.append(f"Has {', '.join(f'`{x}`' for x in own)}.")
    return " ".join(parts)


def value_row(name: str, kind: type) -> str:
    """The row of what calls return."""
    return f"* `{name}`: {plain(brief(of_class(kind).prose))}"


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
            return plain(" ".join(told.split()))
    raise LookupError(name)


def page() -> str:
    """All of it, below the head that a person wrote."""
    parts = ["## Types of arguments\n"]
    parts += [f"* `{name}`: {type_text(name, place)}" for name, place in TYPES.items()]
    parts.append("\n## Arguments of several functions\n")
    parts += [f"* `{name}`: {text}" for name, text in COMMON.items()]
    shown: set[str] = set()
    for head, names in groups():
        things = {name: getattr(garkcli, name) for name in names if name not in shown}
        things |= {x: type(thing) for x, thing in things.items() if x == "catalogue"}
        shown |= {*things}
        parts.append(f"\n## {head}\n")
        parts += [described(name, thing) for name, thing in things.items()]
    parts.append("\n## Values\n")
    parts += [value_row(*home(place)) for place in VALUES]
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
