"""The three standard streams: any encoding, closed ones, readers that go away; and the signals that
end the program.
"""

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

if TYPE_CHECKING:
    from garkcli.check.outcome import Outcome


HANDLER = "garkcli.plaintext"
"""The name of the error handler of streams."""
TERMINAL = 80
"""Columns that texts for people fit, in the longer forms of ASCII too."""
READER_GONE = 128 + 13
"""The exit code where nobody reads the report: that of a program that SIGPIPE ends."""
INTERRUPTED = 128 + signal.SIGINT


class NoStandardOutput(Exception):
    """The report has nowhere to go."""


class ReaderGone(Exception):
    """Whoever read the report has stopped, which is their right."""


def prepare() -> None:
    """Ready the streams: what their encoding lacks is written in ASCII, and a stream that is closed
    leaves no place for a file to be opened in.
    """
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
    """Open nothing as 0, 1 and 2 where these are closed: the next file would count as one of
    them.
    """
    if sys.stdin is not None and sys.stdout is not None and sys.stderr is not None:
        return
    while True:
        place = os.open(os.devnull, os.O_RDWR)
        if place > 2:
            os.close(place)
            return


def put(text: str, format: str = "text", coloured: bool = False) -> None:
    """Write a piece of a report to standard output.

    Raises:
        NoStandardOutput: it is closed.
        ReaderGone: nobody reads it any more.
    """
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


def put_exactly(text: str) -> None:
    """Write a text as UTF-8 with the line ends that it has, whatever standard output is like.

    Raises:
        NoStandardOutput: it is closed.
        ReaderGone: nobody reads it any more.
    """
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
    """Write what is held back.

    Raises:
        ReaderGone: nobody reads it any more.
    """
    if sys.stdout is None:
        return
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        raise ReaderGone from None


def say(text: str, coloured: bool = False) -> None:
    """Write a line to standard error, which is never a reason to stop."""
    text = safe(text, "text", coloured)
    with aside():
        try:
            sys.stderr.write(_for(sys.stderr.encoding, text, "text") + "\n")
            sys.stderr.flush()
        except OSError:
            drop(sys.stderr)


def say_problem(error: GarkError) -> None:
    """Say what is wrong and the cure, each in one line whatever a stranger has put into it."""
    say(f"gark: {printable(error.message)}")
    if error.help:
        say(f"help: {printable(error.help)}")


def complain(error: GarkError) -> None:
    """Say what is wrong with a file, an option or a run, and the cure."""
    if isinstance(error, MethodFileError):
        from garkcli.check.outcome import Outcome

        say_faults(Outcome(error.source, error.source, faults=error.faults, text=error.text))
        return
    say_problem(error)


def say_faults(outcome: Outcome) -> None:
    """Say every fault of a file that cannot be read."""
    from garkcli.page.paint import Paint
    from garkcli.report import remarks

    paint = Paint(wants_colour(sys.stderr))
    say("\n".join(remarks.lines(outcome.faults, outcome.file, outcome.text, paint)), paint.color)


def drop(stream: io.TextIOBase | object) -> None:
    """Keep the interpreter from flushing, at its end, what cannot be written."""
    fileno = getattr(stream, "fileno", None)
    if fileno is None:
        return
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), fileno())
    except (OSError, io.UnsupportedOperation):
        return


def safe(text: str, format: str = "text", coloured: bool = False) -> str:
    """A text that gives no orders to a terminal or to the runner of a job."""
    from garkcli.page.safety import without_commands, written_out

    text = written_out(text, format, coloured)
    is_job = os.environ.get("GITHUB_ACTIONS") == "true"
    return without_commands(text, format) if is_job and format != "github" else text


def safe_pieces(pieces: Iterable[str], format: str, coloured: bool) -> Iterable[str]:
    """The same for a report in pieces."""
    return (safe(piece, format, coloured) for piece in pieces)


def _for(encoding: str | None, text: str, format: str, width: int | None = None) -> str:
    """A text for a stream of this encoding: in formats that have escapes nothing is lost."""
    encoding = encoding or "utf-8"
    if text.isascii() or encoding.lower().replace("_", "-").startswith("utf"):
        return text
    from garkcli.page.plaintext import plain_text
    from garkcli.page.safety import JSON, XML, YAML, escaped

    if format in JSON | YAML | XML:
        return "".join(x if x.isascii() else escaped(x, format) for x in text)
    return plain_text(text, encoding, width)


def is_terminal(stream: object) -> bool:
    """Whether somebody sits at the other end; nobody does where it is closed."""
    isatty = getattr(stream, "isatty", None)
    return bool(isatty is not None and isatty())


def wants_colour(stream: object) -> bool:
    """Whether text on this stream has colour where no option says so.

    ``NO_COLOR`` says no and ``FORCE_COLOR`` yes, where they are not empty; without them a terminal
    has colour unless it says that it is a dumb one.
    """
    if os.environ.get("NO_COLOR"):
        return False
    forced = os.environ.get("FORCE_COLOR", "")
    return forced != "0" if forced else is_terminal(stream) and os.environ.get("TERM") != "dumb"
