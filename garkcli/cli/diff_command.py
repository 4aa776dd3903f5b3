"""``gark diff``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.options import Output, declared
from garkcli.errors import UsageProblem, did_you_mean
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile

EXIT_CODES = {"identical": 0, "same": 0, "within-rounding": 0, "different": 1, "undecided": 3}
"""By what the methods are to each other."""


@declared("diff", FORMATS)
def command(first: str, second: str, strict: bool, settings: dict[str, str], output: Output) -> int:
    """How two methods differ: in entries, orders, conditions and properties; and whether they are
    the same method with its stages numbered otherwise, or in another form.

    Exit code 0 where the steps and the further weights are the same: with stages or colours
    renumbered, stages without influence left out, or within the rounding that both files admit; 1
    where they are not; 3 where that is not decided.
    """
    from garkcli.comparison.comparison import compare
    from garkcli.methodfile.naming import called
    from garkcli.report.diff import REPORT, Compared

    found = compare(*_loaded(first, second, settings))
    output.tell(REPORT, [Compared(found, (called(first), called(second)))])
    if strict and found.relation in {"same", "within-rounding"}:
        return 1
    return EXIT_CODES[found.relation]


def _loaded(first: str, second: str, settings: dict[str, str]) -> tuple[MethodFile, MethodFile]:
    """Both methods, each with the values of its own parameters.

    Raises:
        UsageProblem: a value is for a parameter of none of them.
    """
    from garkcli.methodfile.carried import parameter_names
    from garkcli.methodfile.load import loads, read_method_text

    methods = []
    known: set[str] = set()
    for path in (first, second):
        text, source = read_method_text(path)
        names = parameter_names(text, source)
        known.update(names)
        own = {name: x for name, x in settings.items() if name in names}
        methods.append(loads(text, source, own))
    for name in settings:
        if name not in known:
            message = f"--set {name}: neither file has such a parameter"
            raise UsageProblem(message, did_you_mean(name, sorted(known)), code="option-value")
    one, other = methods
    return one, other
