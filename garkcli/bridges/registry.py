"""The declarations of the targets of ``gark export``, and the list of them."""

from __future__ import annotations

import pkgutil
import re
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from importlib import import_module
from typing import Literal, TypeAlias

from garkcli.bridges import structure, targets
from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.comments import problem_class
from garkcli.bridges.linear_stages import printed_stages
from garkcli.bridges.numbers import DECIMALS, Style
from garkcli.bridges.own_arrays import KINDS, stepped_values
from garkcli.bridges.payload import Kind, Payload
from garkcli.bridges.texts import Values, program_values, text_of
from garkcli.bridges.trials import sides, trial_of
from garkcli.errors import UsageProblem, did_you_mean
from garkcli.frozen import Frozen

EMBEDDED, DENSE, PREDICTOR = "embedded weights", "dense output", "predictor"
Stages: TypeAlias = Literal["any", "lower", "explicit"]


class FileName(Frozen):
    """The name that a program needs for its file: ``pattern`` matches it whole."""

    pattern: str
    why: str
    cure: str


class Bridge(Frozen):
    """A target of ``gark export``.

    Its template is ``templates/NAME.SUFFIX.jinja``, that of its program ``NAME_test.ENDING.jinja``,
    that for Rosenbrock methods ``NAME-row.SUFFIX.jinja``. Makers of values raise ``CannotExport``.

    Attributes:
        kinds: the forms of methods that it can hold, some under conditions.
        stages: the stages that it computes.
        several: its input for several vector fields: ``as they are`` for the blocks of the method,
            ``shared`` for a table each on the same stages, ``pair`` for the explicit table and
            another one.
        is_split: whether it takes a method for (q, p) as kicks and drifts.
        starts: whether an explicit first stage must be at the beginning of a step.
        ends: whether to append to explicit methods a last stage that is the first of the next step.
        lacks: the further weights without a place in its files.
        values: further values for its template, from the method and its tables.
        words: for right-hand sides in its programs; None if there are no programs.
        reads_back: whether ``gark import`` reads its files.
        write: makes the file of a method, if no template does.
        linear: further values for the template for Rosenbrock methods.
    """

    name: str
    summary: str
    suffix: str
    kinds: tuple[Kind, ...] = ("rk",)
    style: Style = DECIMALS
    stages: Stages = "any"
    several: Literal["as they are", "shared", "pair"] = "as they are"
    is_split: bool = False
    starts: bool = False
    ends: bool = False
    lacks: tuple[str, ...] = (DENSE,)
    has_predictor: bool = False
    values: Callable[[Payload, Sequence[structure.Table]], Values] = lambda _, __: {}
    words: Mapping[str, str] | None = None
    file: FileName | None = None
    reads_back: bool = False
    write: Callable[[Payload], str] | None = None
    linear: Callable[[Payload], Values] = lambda payload: {"linear": printed_stages(payload)}

    def tested(self, payload: Payload, file: str) -> Mapping[str, str]:
        """Returns the test files by endings such as ``_test.c``; CannotExport, also if ``file``
        needs another name.
        """
        if self.words is None:
            return {}
        if payload.kind == "row":
            message = "there is no program that tries Rosenbrock methods"
            raise CannotExport(message, "leave out --test; --to numpy and c have a step")
        if self.file and not (re.fullmatch(self.file.pattern, file) and file.isprintable()):
            message = f"{self.file.why} by the name of its file, and {file} is none"
            raise CannotExport(message, self.file.cure)
        ending = _ENDINGS.get(self.suffix, self.suffix)
        values = self._values_for(payload)
        of_program = program_values(payload, file, ending)
        of_sides = {"sides": sides(payload, values["fields"], self.words)}
        name = f"{self.name}_test{ending}"
        text = text_of(name, payload, self.style, {**values, **of_program, **of_sides})
        return {f"_test{ending}": text, "_problem.yaml": trial_of(payload).file}

    def written(self, payload: Payload) -> str:
        """CannotExport if the target cannot hold the method."""
        values = self._values_for(payload)
        if self.write is not None:
            return self.write(payload)
        form = "-own" if payload.own else "-row" if payload.kind == "row" else ""
        return text_of(f"{self.name}{form}{self.suffix}", payload, self.style, values)

    def _values_for(self, payload: Payload) -> Values:
        if payload.kind == "row" and payload.size > 1 and self.name != "json":
            message = f"{self.name} has no Rosenbrock methods of several colours"
            raise CannotExport(message, "--to json has all of its blocks", code="unknown-word")
        if payload.kind not in self.kinds:
            message = f"{self.name} has no {_KINDS[payload.kind]}"
            raise CannotExport(message, _others(payload), code="unknown-word")
        if payload.kind == "row":
            left_out = self._left_out(payload)
            return {"left_out": left_out, **({} if self.write else self.linear(payload))}
        if payload.own is not None:
            return {} if self.write else stepped_values(payload)
        fields: Sequence[int] = range(payload.size)
        if payload.kind == "prk" and self.is_split:
            of_steps = {"steps": self._steps(payload), "tables": [], "fields": fields}
            return {**of_steps, "left_out": _left_out(payload, (EMBEDDED, DENSE, PREDICTOR))}
        tables = [structure.table(payload)] if payload.kind == "rk" else []
        if payload.kind != "rk" and self.several != "as they are":
            tables = structure.shared(payload)
            fields = self._pair(payload, tables) if self.several == "pair" else fields
        tables = [self._fitting(payload, tables[m]) for m in fields if tables]
        late_nodes = [x.c[0] for x in tables if not structure.vanishes(x.c[0])]
        if self.starts and late_nodes and all(structure.vanishes(x.A[0][0]) for x in tables):
            node = payload.number(late_nodes[0])
            cure = "where f does not depend on t, set the first node to 0"
            message = f"the first node is {node}; {self.name} has an explicit first stage at t"
            raise CannotExport(message, cure)
        of_tables = {"tables": tables, **self.values(payload, tables)}
        first = of_tables["tables"][0] if tables else None
        left_out = self._left_out(payload)
        return {**of_tables, "table": first, "fields": fields, "left_out": left_out}

    def _left_out(self, payload: Payload) -> list[str]:
        return _left_out(payload, self.lacks if self.has_predictor else (*self.lacks, PREDICTOR))

    def _steps(self, payload: Payload) -> structure.Composition:
        sequence = structure.composition(payload)
        if sequence is not None:
            return sequence
        cure = _others(payload, "any")
        if payload.structure == "general":
            cure = f"for q' = f(p), p' = g(q) say so: structure: separable; {cure}"
        raise CannotExport(
            f"{self.name} takes kicks and drifts by turns, each explicit, and {payload.name} is no"
            " such composition",
            cure,
        )

    def _pair(self, payload: Payload, tables: Sequence[structure.Table]) -> Sequence[int]:
        """The vector field with an explicit table, and the other one."""
        is_other = payload.tableau.is_partitioned and payload.kind != "prk"
        explicit = [m for m, x in enumerate(tables) if x.is_explicit]
        message = (
            f"{self.name} pairs an explicit with an implicit method, and both of {payload.name} are"
            " implicit"
        )
        if len(tables) != 2 or is_other:
            message = (
                f"{self.name} adds two vector fields, an explicit and an implicit one;"
                f" {payload.name} is for {problem_class(payload)}"
            )
        elif explicit:
            return explicit[0], 1 - explicit[0]
        raise CannotExport(message, _others(payload, "any"))

    def _fitting(self, payload: Payload, found: structure.Table) -> structure.Table:
        """The table with stages that the target computes, and with the last one that it needs."""
        holds = {"lower": found.is_diagonally_implicit, "explicit": found.is_explicit, "any": True}
        computed = [x for x in holds if holds[x]]
        if self.stages not in computed:
            message = (
                f"{self.name} has explicit methods only; a stage of {payload.name} sees itself or a"
                " later one"
            )
            if self.stages == "lower":
                message = (
                    f"{self.name} solves one stage after the other; a stage of {payload.name} sees"
                    " a later one"
                )
            raise CannotExport(message, _others(payload, *computed))
        wants_end = self.ends and payload.kind == "rk" and found.is_explicit
        return (
            structure.with_last_stage(found)
            if wants_end and not found.is_first_same_as_last
            else found
        )


EVERYTHING: tuple[Kind, ...] = ("rk", "ark", "prk", "gark")
STEPPED: tuple[Kind, ...] = (*EVERYTHING, "row", *KINDS)
_ENDINGS = {".hpp": ".cpp"}
_KINDS: Mapping[Kind, str] = {
    "rk": "methods for one vector field",
    "ark": "methods for several vector fields that share their stages",
    "prk": "methods for a pair (q, p)",
    "gark": "methods whose vector fields have stages of their own",
    "row": "Rosenbrock methods",
    "mri": "multirate infinitesimal methods",
    **KINDS,
}


def _left_out(payload: Payload, lacks: Sequence[str]) -> list[str]:
    has = {
        EMBEDDED: payload.embedded is not None,
        DENSE: payload.dense is not None,
        PREDICTOR: payload.predictor is not None,
    }
    return [x for x in lacks if has[x]]


def _others(payload: Payload, *stages: str) -> str:
    known = [x for x in bridges().values() if payload.kind in x.kinds]
    names = [x.name for x in known if x.stages in stages or not stages]
    return f"these have: {', '.join(names)}"


@lru_cache(maxsize=1)
def bridges() -> Mapping[str, Bridge]:
    by_name: dict[str, Bridge] = {}
    for module in pkgutil.iter_modules(targets.__path__):
        for bridge in import_module(f"{targets.__name__}.{module.name}").BRIDGES:
            by_name[bridge.name] = bridge
    return dict(sorted(by_name.items()))


def bridge_named(name: str, *others: str) -> Bridge:
    known = bridges()
    if name not in known:
        message = f"no target {name!r}"
        words = sorted([*known, *others])
        raise UsageProblem(message, did_you_mean(name, words), code="unknown-word")
    return known[name]
