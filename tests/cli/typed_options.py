"""Options that are wrong: mypy refuses each of them, or this file for an ignore that nothing needs."""

from __future__ import annotations

from flint import fmpq

from garkcli.cli import options as opt
from garkcli.cli.arguments import positive
from garkcli.cli.command import declared
from garkcli.cli.output import Output


class Right(opt.Derivable):
    """Options whose kinds are those of their types."""

    file: str = opt.argument("FILE", opt.METHOD)
    files: tuple[str, ...] = opt.arguments_of("FILE...", opt.METHOD)
    order: int | None = opt.option("--order -n", opt.number("n", 1))
    digits: int = opt.preset("--digits", opt.DECIMALS, 12)
    step: fmpq | None = opt.option("--step", opt.read("H", positive))
    work: bool = opt.flag("--work")
    rules = (opt.needs(order, work, "--order goes with --work", "add --work"),)


class Wrong(opt.Options):
    """Options of other kinds."""

    order: str | None = opt.option("--order", opt.number("n", 1))  # type: ignore[assignment]
    maybe: int = opt.option("--maybe", opt.number("n", 1))  # type: ignore[assignment]
    several: str = opt.repeated("--several", opt.text("X"))  # type: ignore[assignment]
    work: int | None = opt.option("--work", opt.text("X"))  # type: ignore[assignment]
    rules = (opt.needs(ordr, work, "message", "cure"),)  # type: ignore[name-defined]  # noqa: F821


@declared("right", Right)
def right(given: Right, output: Output) -> int | None:
    """What mypy knows of the options."""
    output.note(given.file.upper())
    given.work = True  # type: ignore[misc]
    output.note(given.fil)  # type: ignore[attr-defined]
    output.write(given.order + 1)  # type: ignore[operator, arg-type]
    given.method(given.step)  # type: ignore[arg-type]
    return given.digits


@declared("wrong", Right)  # type: ignore[arg-type]
def wrong(given: Wrong, output: Output) -> None:
    """A command of other options than it says."""
