"""Problem files: a Hamiltonian, a Lagrangian or right-hand sides with their initial values, every
fault of the text at once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.doing import doing
from garkcli.methodfile.file_kind import PROBLEM_FILE
from garkcli.methodfile.problem_reader import ProblemReader
from garkcli.methodfile.reading import read_text
from garkcli.methodfile.sides import SidesMaker
from garkcli.methodfile.source import Source
from garkcli.methodfile.terms import Maker

if TYPE_CHECKING:
    from garkcli.problems.problem import Problem


def load_problem(path: str, stiffness: fmpq | None = None) -> Problem:
    """Read one problem file, or standard input for ``-``.

    Args:
        path: of the file.
        stiffness: the value of its parameter of this name, in place of its own.

    Raises:
        MethodFileError: every fault of the file, with positions.
    """
    with doing(f"reading {path}"):
        return loads_problem(*read_text(path, PROBLEM_FILE), stiffness)


def loads_problem(text: str, source: str = "<text>", stiffness: fmpq | None = None) -> Problem:
    """Read a problem file from its text; see ``load_problem``.

    Raises:
        MethodFileError: every fault of the text, with positions.

    >>> text = "{variables: [x], hamiltonian: px**2/2 - cos(x), initial: {x: 1, px: 0}}"
    >>> loads_problem(text).energy
    px**2/2 - cos(x)
    """
    reading = Source(source, text, PROBLEM_FILE)
    reader = ProblemReader(reading, stiffness)
    read = reader.read()
    if read is None:
        raise reading.error()
    if read.form == "rhs":
        return SidesMaker(reading, reader.formulas, read).problem()
    return Maker(reading, reader.formulas, read).problem()
