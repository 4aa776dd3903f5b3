"""``gark certificate``."""

from __future__ import annotations

from garkcli.cli.options import Output, declared
from garkcli.tell.report import FORMATS as TOLD

FORMATS = ("json", *(x for x in TOLD if x != "json"))
"""JSON is what others check."""


@declared("certificate", FORMATS)
def command(file: str, settings: dict[str, str], output: Output) -> int:
    """What proves the orders of a method, to be checked without gark.

    The exact tableau, its conjugate and pair, the trees that span all trees of each order, and a
    tree that fails. tools/referee.py of the source distribution, one short file of plain Python,
    decides the orders again from it.
    """
    from garkcli.check.proof import prove_method
    from garkcli.methodfile.load import load
    from garkcli.report.certificate import REPORT

    output.tell(REPORT, [prove_method(load(file, settings))])
    return 0
