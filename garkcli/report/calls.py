"""Commands as calls: references, certificates, sweeps, names."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Literal

from garkcli.api.anymethod import AnyMethod, method_of
from garkcli.api.calls import prove_method, prove_method_exists
from garkcli.api.files import AnyPath, references_in
from garkcli.api.numbers import Whole, whole
from garkcli.bridges.registry import bridges
from garkcli.check.meanings import known_words
from garkcli.doing import doing
from garkcli.errors import UsageProblem, did_you_mean
from garkcli.reference import ZANNA, Reference
from garkcli.report import citation
from garkcli.report.certificate import REPORT, coq_proof
from garkcli.report.listing import all_lists
from garkcli.sweep.file import load_plan
from garkcli.sweep.plan import Plan
from garkcli.sweep.report import SweepReport
from garkcli.sweep.run import Progress, sweep
from garkcli.sweep.store import RowStore
from garkcli.version import __version__


def cite(*methods: AnyMethod, format: str = "bibtex") -> str:
    """The publications of methods, each once: ``gark show --reference``.

    Args:
        methods: from files, texts or the catalogue; or paths and names.
        format: bibtex, text, json, markdown or latex.

    Raises:
        UsageProblem: there is no such format.

    >>> print(cite("rk4").splitlines()[1])
    @article{Kutta1901,
    """
    if format not in citation.FORMATS:
        message = f"no format {format!r}"
        raise UsageProblem(message, did_you_mean(format, citation.FORMATS), code="unknown-word")
    return citation.render(references(methods), format)


def references(methods: Iterable[AnyMethod]) -> list[citation.Cited]:
    """Returns each publication once, or else those of the parts; ``gark`` is this program and its
    paper.
    """
    cited: list[citation.Cited] = []
    for method in methods:
        if method == GARK:
            cited += [citation.Cited((GARK,), str(work), work) for work in WORKS]
        else:
            source, works = references_in(method)
            cited += [citation.Cited((source,), *work) for work in works or [("", None)]]
    return citation.together(cited)


GARK = "gark"
WORKS = (
    Reference(
        authors=("The gark authors",),
        title="gark: order conditions and design of generalized additive Runge-Kutta methods",
        type="software",
        year="2026",
        note=f"version {__version__}",
    ),
    ZANNA,
)


def certificate(method: AnyMethod, format: Literal["json", "coq"] = "json") -> str:
    """A proof of the orders of a method, as JSON text or for Coq: ``gark export --to certificate``.

    Args:
        method: whatever ``method_of`` takes.
        format: ``"json"``, or ``"coq"`` for the theory in ``proofs/``.

    Raises:
        MethodError: the coefficients are rounded, and it is not proved that a method within the
            tolerance has the order; or, for Coq, they are rounded, or a colour is linear.

    >>> import json
    >>> json.loads(certificate("heun"))["schema"]
    'gark/certificate/1'
    """
    method = method_of(method)
    if format == "coq":
        return coq_proof(prove_method(method))
    is_exact = method.tolerance is None
    return REPORT.json([prove_method(method) if is_exact else prove_method_exists(method)])


def run_sweep(
    spec: AnyPath, rows: AnyPath, is_resumed: bool = False, jobs: Whole = 1, scheduler: str = ""
) -> SweepReport:
    r"""Run a sweep, or what is left of it: ``gark sweep``.

    Args:
        spec: its file.
        rows: the file that the rows are written to, one by one.
        is_resumed: whether that file may have rows, which are kept.
        jobs: processes to work in.
        scheduler: the address of a Dask scheduler, to work there instead.

    Raises:
        MethodFileError: every fault of the spec.
        UsageProblem: there are rows and nobody said that there may be.

    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> text = "methods:\n  - {family: gauss, stages: [1, 2]}\ncolumns: [order]\n"
    >>> with TemporaryDirectory() as folder:
    ...     spec, rows = Path(folder, "spec.yaml"), Path(folder, "rows.jsonl")
    ...     _ = spec.write_text(text)
    ...     [row["order"] for row in run_sweep(spec, rows).done]
    [2, 4]
    """
    source = os.fspath(spec)
    plan = load_plan(source)
    report, _ = swept(plan, source, os.fspath(rows), is_resumed, whole(jobs, "jobs", 1), scheduler)
    return report


def swept(
    plan: Plan, source: str, rows: str, is_resumed: bool = False, jobs: int = 1, scheduler: str = ""
) -> tuple[SweepReport, Progress]:
    with RowStore(rows, is_resumed) as store:
        with doing("methods") as work:
            for last in sweep(plan, store, jobs, scheduler):
                work.total = last.total
                work.reach(last.before + last.done)
        return SweepReport(source, plan, store.rows, top=10), last


def names() -> dict[str, list[str]]:
    """The names that can be used, by kind: ``gark list``, ``gark list exports`` and the words of
    ``gark explain``. Those of the catalogue are in ``garkcli.catalogue``.

    >>> "gauss" in names()["families"], "collocation" in names()["transfer"]
    (True, True)
    """
    lists = {kind: list(names) for kind, names in all_lists()._asdict().items()}
    return {
        "families": lists["families"],
        "transfer": lists["rules"],
        "compositions": lists["schemes"],
        "splittings": lists["splittings"],
        "problems": lists["problems"],
        "exports": list(bridges()),
        "words": known_words(),
    }
