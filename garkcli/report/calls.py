"""What commands print, as calls: references, certificates, sweeps, names."""

from __future__ import annotations

from typing import Protocol

from garkcli.bridges.registry import bridges
from garkcli.check.meanings import known_words
from garkcli.check.proof import prove_method
from garkcli.constructions.schemes.flows import SPLITTINGS
from garkcli.constructions.schemes.registry import SCHEMES
from garkcli.families.registry import FAMILIES
from garkcli.problems.builtin import PROBLEMS
from garkcli.reference import Reference
from garkcli.report import citation, proof_json
from garkcli.report.sweep import SweepReport
from garkcli.sweep.load import load_plan
from garkcli.sweep.run import sweep
from garkcli.sweep.store import RowStore
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.transfer import RULES


class Published(Protocol):
    """What a reference is known of: a method file."""

    @property
    def source(self) -> str:
        """Its path or its name in the catalogue."""

    @property
    def reference(self) -> str:
        """In one line; empty where there is none."""

    @property
    def bibliography(self) -> Reference | None:
        """Its fields; None where it is plain text."""


def cite(*methods: Published, format: str = "bibtex") -> str:
    """Where methods were published, each publication once: ``gark cite``.

    Args:
        methods: from files, texts or the catalogue.
        format: bibtex, text or json.
    """
    cited = [
        citation.Cited((one.source,), one.reference, one.bibliography)
        for one in methods
    ]
    return citation.render(citation.together(cited), format)


def certificate(method: GarkMethod) -> str:
    """What proves the orders of a method, as JSON text: ``gark certificate``.

    Raises:
        MethodError: the coefficients are rounded.
    """
    return proof_json.render(prove_method(method))


def run_sweep(
    spec: str, rows: str, is_resumed: bool = False, jobs: int = 1
) -> SweepReport:
    """Run a sweep, or what is left of it: ``gark sweep``.

    Args:
        spec: its file.
        rows: the file that the rows are written to, one by one.
        is_resumed: whether that file may have rows, which are kept.
        jobs: processes to work in.

    Raises:
        MethodFileError: every fault of the spec.
        UsageProblem: there are rows and nobody said that there may be.
    """
    plan = load_plan(spec)
    with RowStore(rows, is_resumed) as store:
        for _ in sweep(plan, store, jobs):
            pass
        return SweepReport(spec, plan, store.rows, top=10)


def names() -> dict[str, list[str]]:
    """The names that can be used, by kind: ``gark list``, ``gark list exports`` and the words of
    ``gark explain``. Those of the catalogue are in ``garkcli.catalogue``.

    >>> "gauss" in names()["families"], "collocation" in names()["transfer"]
    (True, True)
    """
    return {
        "families": list(FAMILIES),
        "transfer": list(RULES),
        "compositions": list(SCHEMES),
        "splittings": list(SPLITTINGS),
        "problems": list(PROBLEMS),
        "exports": list(bridges()),
        "words": known_words(),
    }
