"""The standard streams with any encoding, closed ones, readers that stop, and signals."""

from __future__ import annotations

import codecs
import io
import os
import signal
import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING

from garkcli.doing import hush
from garkcli.errors import GarkError, MethodFileError, printable
from garkcli.page.progress import aside
from garkcli.terminal import TERMINAL, is_drawn_on, is_terminal, width_of_terminal

if TYPE_CHECKING:
    from garkcli.check.outcome import Outcome
    from garkcli.page.look import Look


HANDLER = "garkcli.plaintext"
READER_GONE = 128 + 13
"""The exit code if the reader of the report is gone, as after SIGPIPE."""
INTERRUPTED = 128 + signal.SIGINT


class NoStandardOutput(Exception):
    """Standard output is closed."""


class ReaderGone(Exception):
    """The reader of the report has stopped."""


def prepare() -> None:
    """No encoding fails then, and no file is opened in place of a closed stream."""
    _fill_places()
    codecs.register_error(HANDLER, _handled)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=HANDLER)
    if sys.platform == "win32":  # consoles show colours on request
        from colorama import just_fix_windows_console

        just_fix_windows_console()
    if sys.stderr is None:  # nobody listens
        sys.stderr = open(os.devnull, "w", encoding="utf-8")  # noqa: SIM115


def _handled(error: UnicodeError) -> tuple[str, int]:
    from garkcli.page.plaintext import handled  # few streams lack a sign

    return handled(error)


def _fill_places() -> None:
    """Opens the null device for closed streams, so that no file takes the numbers 0, 1 and 2."""
    if sys.stdin is not None and sys.stdout is not None and sys.stderr is not None:
        return
    while True:
        place = os.open(os.devnull, os.O_RDWR)
        if place > 2:
            os.close(place)
            return


def put(text: str, format: str = "text", coloured: bool = False) -> None:
    """Writes to standard output; raises NoStandardOutput or ReaderGone."""
    if not text:
        return
    if sys.stdout is None:
        raise NoStandardOutput
    text = safe(text, format, coloured)
    if is_terminal(sys.stdout):
        hush()
    try:
        width = TERMINAL if format == "text" else None
        sys.stdout.write(_for(sys.stdout.encoding, text, format, width))
    except BrokenPipeError:
        raise ReaderGone from None


def put_help(text: str) -> None:
    """Writes help to standard output, in colours on a terminal that has them."""
    is_coloured = is_drawn_on(sys.stdout) and wants_colour(sys.stdout)
    if is_coloured:
        from garkcli.tell.terminal import coloured_help

        text = coloured_help(text)
    put(text, coloured=is_coloured)


def put_exactly(text: str) -> None:
    """Writes UTF-8 with the line ends of the text; raises NoStandardOutput or ReaderGone."""
    if sys.stdout is None:
        raise NoStandardOutput
    buffer = getattr(sys.stdout, "buffer", None)
    try:
        if buffer is None:
            sys.stdout.write(text)
        else:
            sys.stdout.flush()
            buffer.write(text.encode())
    except BrokenPipeError:
        raise ReaderGone from None


def flush() -> None:
    if sys.stdout is None:
        return
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        raise ReaderGone from None


def say(text: str, coloured: bool = False, is_folded: bool = True) -> None:
    """Writes to standard error, ignoring failures; on a terminal lines are folded."""
    text = safe(text, "text", coloured)
    with aside():
        try:
            text = _for(sys.stderr.encoding, text, "text")
            sys.stderr.write((_fitting(text) if is_folded else text) + "\n")
            sys.stderr.flush()
        except OSError:
            drop(sys.stderr)


def _fitting(text: str) -> str:
    if not is_terminal(sys.stderr):
        return text
    from garkcli.page.lines import folded

    width = width_of_terminal()
    return "\n".join(x for line in text.split("\n") for x in folded(line, width, "  "))


def say_problem(error: GarkError) -> None:
    """The problem and its cure, one line each for any content."""
    say(f"gark: {printable(error.message)}")
    if error.help:
        say(f"help: {printable(error.help)}")


def complain(error: GarkError) -> None:
    if isinstance(error, MethodFileError):
        from garkcli.check.outcome import Outcome

        say_faults(Outcome(error.source, error.source, faults=error.faults, text=error.text))
        return
    say_problem(error)


def say_faults(outcome: Outcome) -> None:
    from garkcli.report import remarks
    from garkcli.tell.report import dialect_of

    look = look_of(sys.stderr, wants_colour(sys.stderr))
    d = dialect_of(look=look)(look=look, width=width_of_terminal())
    lines = remarks.lines(outcome.faults, outcome.file, outcome.text, d)
    say("\n".join(lines), look.has_colour, is_folded=False)


def drop(stream: io.TextIOBase | object) -> None:
    """Prevents the interpreter from flushing a broken stream at its end."""
    fileno = getattr(stream, "fileno", None)
    if fileno is None:
        return
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), fileno())
    except (OSError, io.UnsupportedOperation):
        return


def safe(text: str, format: str = "text", coloured: bool = False) -> str:
    """Returns the text without commands to a terminal or to the runner of a job."""
    from garkcli.page.safety import without_commands, written_out

    text = written_out(text, format, coloured)
    is_job = os.environ.get("GITHUB_ACTIONS") == "true"
    return without_commands(text, format) if is_job and format != "github" else text


def safe_pieces(pieces: Iterable[str], format: str, coloured: bool) -> Iterable[str]:
    return (safe(piece, format, coloured) for piece in pieces)


def _for(encoding: str | None, text: str, format: str, width: int | None = None) -> str:
    """Returns the text for the encoding of a stream; formats with escapes lose nothing."""
    encoding = encoding or "utf-8"
    if text.isascii() or encoding.lower().replace("_", "-").startswith("utf"):
        return text
    from garkcli.page.plaintext import plain_text
    from garkcli.page.safety import JSON, XML, YAML, escaped

    if format in YAML:
        from garkcli.grammar.editing import in_ascii

        return in_ascii(text)
    if format in JSON | XML:
        return "".join(x if x.isascii() else escaped(x, format) for x in text)
    return plain_text(text, encoding, width)


def look_of(stream: object, has_colour: bool) -> Look:
    from garkcli.page.look import Look

    encoding = getattr(stream, "encoding", None) or "utf-8"
    return Look(has_colour, encoding, is_drawn_on(stream))


def wants_colour(stream: object) -> bool:
    """A nonempty ``NO_COLOR`` turns colours off, ``FORCE_COLOR`` on; terminals have them."""
    if os.environ.get("NO_COLOR"):
        return False
    forced = os.environ.get("FORCE_COLOR", "")
    return forced != "0" if forced else is_drawn_on(stream)
