"""The group of commands, each imported when it is used, and the last word on every error."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import NoReturn

import click

from garkcli import __version__
from garkcli.errors import GarkError, did_you_mean

REPORT_TO = "the issue tracker of the project"
COMMANDS = {
    "check": "orders, B/C/D, symplecticity and the claims of method files",
    "trees": "enumerate or count the N-trees of an order",
    "conditions": "the order-condition table, of any method or of a file",
    "tableau": "the assembled tableau, all blocks",
    "conjugate": "the symplectic conjugate tableau, or the pair",
    "stability": "A-, L-, P-stability, intervals, SSP coefficient, exactly",
    "converge": "the convergence test on a problem",
    "energy": "energy and other invariants over a long time: do they drift?",
    "list": "families, transfer rules, problems",
    "schema": "the JSON Schemas of method and problem files, for editors",
}
"""Every command with its line in the help; the module of the same name in this room has it."""


class _LazyGroup(click.Group):
    """A group that imports a command only to run it or to show its help."""

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002 -- click's signature
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        if cmd_name not in COMMANDS:
            return None
        command = import_module(f"garkcli.cli.{cmd_name}_command").command
        assert isinstance(command, click.Command)
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        if args and args[0] not in COMMANDS and not args[0].startswith("-"):
            ctx.fail(f"no such command {args[0]!r}; {did_you_mean(args[0], COMMANDS)}")
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.group(
    cls=_LazyGroup,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
    epilog='Shell completion: eval "$(_GARK_COMPLETE=bash_source gark)"; also zsh and fish.',
)
@click.version_option(__version__, "--version", prog_name="gark", message="%(prog)s %(version)s")
@click.option("--debug", is_flag=True, help="Show the traceback of a fault of the program.")
def gark(debug: bool) -> None:
    """Order conditions and design of generalized additive Runge-Kutta methods, decided exactly.

    A method file (YAML) describes the diagonal methods and how the blocks between them are made:

    \b
        methods:
          - {family: gauss, stages: 2}
          - {family: lobatto-iiia, stages: 3}
        transfer: collocation
    """  # noqa: D301 -- click's sign for lines that stay as they are


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run the command line and exit: 0, 1 a claim fails, 2 usage or input, 3 our fault, 130
    interrupted.
    """
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    code = 0
    try:
        result = gark.main(list(arguments), prog_name="gark", standalone_mode=False)
        code = result if isinstance(result, int) else 0
        sys.stdout.flush()
    except click.ClickException as error:
        error.show()
        code = 2
    except GarkError as error:
        _complain(error)
        code = 2
    except (KeyboardInterrupt, click.Abort):
        code = 130
    except BrokenPipeError:
        _drop_stdout()  # the reader has gone, which is its right
    except OSError as error:
        click.echo(f"gark: the report cannot be written: {error.strerror or error}", err=True)
        _drop_stdout()
        code = 2
    except Exception as error:
        if "--debug" in arguments:
            import traceback

            traceback.print_exc()
        what = f"{type(error).__name__}: {error}".splitlines()[0]
        click.echo(f"gark: internal fault: {what[:200]}", err=True)
        click.echo(f"please report it, with the command and the file, to {REPORT_TO}", err=True)
        code = 3
    sys.exit(code)


def _drop_stdout() -> None:
    """Keep the interpreter from flushing, at its end, what cannot be written."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _complain(error: GarkError) -> None:
    from garkcli.errors import MethodFileError

    if isinstance(error, MethodFileError):
        from garkcli.check.outcome import Outcome
        from garkcli.report.check_text import faults_text
        from garkcli.report.paint import Paint

        outcome = Outcome(error.source, error.source, faults=error.faults, text=error.text)
        click.echo(faults_text(outcome, Paint(sys.stderr.isatty())), err=True)
        return
    click.echo(f"gark: {error.message}", err=True)
    if error.help:
        click.echo(f"help: {error.help}", err=True)
