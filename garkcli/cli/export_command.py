"""``gark export``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.companion import exact_companion
from garkcli.cli.options import Output, declared
from garkcli.errors import UsageProblem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from garkcli.bridges.registry import Bridge, Written


@declared("export")
def command(
    file: str,
    which: str | None,
    target: str,
    digits: int | None,
    has_test: bool,
    settings: dict[str, str],
    output: str | None,
) -> int:
    """A method as the codes that people run read it: SciPy, SUNDIALS, PETSc, C, JSON and others.

    The head of the file says which orders gark proved. Decimals are correctly rounded. What a
    target cannot hold is refused, with the reason.
    """
    from pathlib import Path

    from garkcli.bridges.preparing import prepared
    from garkcli.bridges.registry import bridge_named
    from garkcli.methodfile.load import load

    bridge = bridge_named(target)
    if has_test:
        _check_test(bridge, output)
    place = Output("text", output, 0, "never")
    payload = prepared(exact_companion(load(file, settings), which), digits)
    table = bridge.written(payload)
    beside: Sequence[Written] = ()
    if has_test and output is not None and bridge.test_driver is not None:
        beside = bridge.test_driver(payload, Path(output).name)
    place.write(table, format=bridge.name)
    for written in beside:
        path = Path(str(output))
        named = path.with_name(path.stem + written.ending)
        Output("text", str(named), 0, "never").write(written.text)
    return 0


def _check_test(bridge: Bridge, output: str | None) -> None:
    """Whether a test can be written, before any work is done.

    Raises:
        UsageProblem: the target runs nothing, or there is no place for it.
    """
    if bridge.test_driver is None:
        raise UsageProblem(
            f"{bridge.name} is data, which nothing runs", "leave out --test", code="cannot-export"
        )
    if output is None:
        raise UsageProblem(
            "--test writes further files beside the first", "name it: -o FILE", code="option-alone"
        )
