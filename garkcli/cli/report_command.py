"""``gark report``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from garkcli.cli.companion import exact_companion
from garkcli.cli.options import Output, declared, files_meant, refuse_settings_of_several
from garkcli.doing import counting
from garkcli.errors import HasFreeParameters, MethodFileError

if TYPE_CHECKING:
    from garkcli.tableau.garkmethod import GarkMethod


@declared("report", ["html"])
def command(
    files: tuple[str, ...], settings: dict[str, str], output: Output, **options: Any
) -> int:
    """All about methods as one HTML page, to be looked at, printed and passed on.

    FILE is a method file, a directory, a pattern or a name of the catalogue, as for gark check.
    The page needs no network: tableau, conjugate and pair typeset, the orders with the tree at
    which each ends, B, C and D, the order conditions to be filtered, pictures, properties, claims,
    references. Of several methods it has a table that compares them, and a part each. The claims of
    a file are about its method: with --pair or --conjugate the page has none.

    Exit code: 0 every claim holds, 1 a claim fails, 2 a file cannot be read as a method; the page
    is written in each case, and says so.
    """
    from garkcli.cli.streams import say_faults
    from garkcli.webpage.page import render
    from garkcli.webpage.reported import reported

    paths = files_meant(files, output)
    refuse_settings_of_several(settings, paths)
    meant = (_meant(path, options["which"], settings) for path in paths)
    found = (reported(x, options["order"], options["pictures"], settings) for x in meant)
    methods = list(counting("methods", found, len(paths)))
    output.write(render(methods))
    for method in methods:
        if not method.outcome.is_read:
            say_faults(method.outcome)
    return max(method.outcome.exit_code for method in methods)


def _meant(path: str, which: str | None, settings: Mapping[str, str]) -> str | GarkMethod:
    """What the page is about: a file as it is, or the conjugate or the pair of its method.

    Raises:
        UsageProblem: the coefficients are rounded or have free parameters.
        ZeroWeight: a conjugate would divide by zero.
    """
    from garkcli.methodfile.load import load

    if which is None:
        return path
    try:
        method = load(path, settings)
    except HasFreeParameters as error:
        from garkcli.cli.every import read_family, refuse_numbers

        _, family = read_family(error, settings)
        refuse_numbers(family, {f"--{which}": which})
        raise
    except MethodFileError:
        return path  # the page says what is wrong with it
    return exact_companion(method, which)
