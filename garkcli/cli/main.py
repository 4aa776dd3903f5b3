"""The group of commands, each imported when it is used, and the handling of all errors."""

from __future__ import annotations

import atexit
import gc
import os
import sys
from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING, NoReturn

import click

from garkcli.cli import streams
from garkcli.cli.command import command_of, help_option
from garkcli.cli.table import COMMANDS, FORMER
from garkcli.ending import Ended, at_once
from garkcli.errors import GarkError, NotDecided, UsageProblem, counted
from garkcli.files import noting_inputs
from garkcli.page.progress import watching
from garkcli.version import __version__

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

REPORT_TO = "the issue tracker of the project"
HELP = "help"
COMPLETION = "_GARK_COMPLETE"


class _LazyGroup(click.Group):
    """Imports a command only to run it or to show its help."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        return command_of(cmd_name) if cmd_name in COMMANDS else None

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        words = FORMER.get(args[0], args[:1])
        if args[0] == "conjugate" and "--pair" in args:  # which took its place
            words = words[:1]
        args = [*words, *args[1:]]
        # a shell that asks what may follow hears of no mistakes
        is_run = not ctx.resilient_parsing
        is_word = args[0] == "-" or not args[0].startswith("-")
        if is_run and args[0] not in COMMANDS and is_word:
            from garkcli.cli.usage import no_such_command  # paid for by mistakes alone

            ctx.fail(no_such_command(args[0], COMMANDS))
        return super().resolve_command(ctx, args)

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        from click.shell_completion import CompletionItem

        found = super().shell_complete(ctx, incomplete)
        if HELP.startswith(incomplete):
            found.append(CompletionItem(HELP, help="more of one command"))
        return found

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        width = max(map(len, COMMANDS))
        for group, names in groupby(COMMANDS, key=lambda name: COMMANDS[name].group):
            with formatter.section(group):
                formatter.write_dl([(f"{x:{width}}", COMMANDS[x].summary) for x in names])


def _show_version(context: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted and not context.resilient_parsing:
        streams.put(f"gark {__version__}\n")
        context.exit()


@click.group(
    cls=_LazyGroup,
    context_settings={"help_option_names": [], "max_content_width": 100},
    # what a call without arguments does is said below: releases of click differ in it
    subcommand_metavar="COMMAND [ARGS]...",
    no_args_is_help=False,
    invoke_without_command=True,
    epilog=f'Shell completion: eval "$({COMPLETION}=bash_source gark)"; also zsh and fish.',
)
@click.option(
    "-V",
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_version,
    help="Show the version and exit.",
)
@click.option("--debug", is_flag=True, help="Show the traceback of a fault of the program.")
@click.pass_context
def gark(context: click.Context, debug: bool) -> int:  # noqa: ARG001 -- read where faults are shown
    """The order of a Runge-Kutta method, proved exactly, and which coefficient is wrong.

    METHOD is a name (gark list methods), a family such as gauss-2, or a file: a Butcher tableau, or
    several methods and the rule that couples them.

    \b
        A: [[0, 0], [1/2, 0]]
        b: [0, 1]

    \b
        methods:
          - {family: gauss, stages: 2}
          - {family: lobatto-iiia, stages: 3}
        transfer: collocation
    """  # noqa: D301 -- click's sign for lines that stay as they are
    if context.invoked_subcommand is None:
        streams.say(context.get_help(), is_folded=False)
        return 2
    context.with_resource(watching(f"gark {context.invoked_subcommand}"))
    return 0


gark.params.append(help_option())


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Exit codes: 0 success, 1 a claim fails, 2 wrong usage or input, 3 undecided, or an internal
    error, 128 + n ended by signal n, 141 if the reader of the report is gone.
    """
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    streams.prepare()
    # there is no use in looking for circles a last time, in all that was loaded
    atexit.register(gc.freeze)
    if COMPLETION in os.environ:
        gark.main(arguments, prog_name="gark", complete_var=COMPLETION)
    sys.exit(_exit_code(arguments))


def _exit_code(arguments: list[str]) -> int:
    try:
        with at_once(), noting_inputs():
            code = _run(arguments)
            streams.flush()
            return code
    except (KeyboardInterrupt, click.Abort):
        streams.drop(sys.stdout)
        return streams.INTERRUPTED
    except Ended as end:
        streams.drop(sys.stdout)
        return end.exit_code
    except streams.ReaderGone:
        streams.drop(sys.stdout)
        return streams.READER_GONE
    except streams.NoStandardOutput:
        streams.say("gark: standard output is closed\nhelp: -o FILE writes the report into a file")
        return 2
    except click.ClickException as error:
        from garkcli.cli.usage import usage_text

        streams.say(usage_text(error))
        return 2
    except GarkError as error:
        streams.complain(error)
        return 3 if isinstance(error, NotDecided) else 2
    except OSError as error:
        streams.say(f"gark: the report cannot be written: {error.strerror or error}")
        streams.drop(sys.stdout)
        return 2
    except Exception as error:
        _own_up(error, "--debug" in arguments)
        return 3


def _run(arguments: list[str]) -> int:
    """Runs without the exit of click, whose code 1 would be a failing claim."""
    if arguments[:1] == [HELP]:
        names = [x for x in arguments[1:] if not x.startswith("-")]
        if len(names) > 1:
            message = f"gark help is for one command, not for {counted(len(names), 'word')}"
            raise UsageProblem(message, f"gark help {names[0]}", code="wrong-value")
        arguments = [*arguments[1:], "--help"]
    if any("\0" in x for x in arguments):
        message = "an argument has the character NUL in it, which no name has"
        raise UsageProblem(message, "leave it out", code="option-value")
    try:
        with gark.make_context("gark", list(arguments)) as context:
            result = gark.invoke(context)
    except click.exceptions.Exit as end:
        return end.exit_code
    return result if isinstance(result, int) else 0


def _own_up(error: Exception, with_traceback: bool) -> None:
    if with_traceback:
        import traceback

        streams.say("".join(traceback.format_exception(error)).rstrip(), is_folded=False)
    what = f"{type(error).__name__}: {error}".splitlines()[0]
    streams.say(f"gark: internal fault: {what[:200]}")
    streams.say(f"please report it, with the command and the file, to {REPORT_TO}")
