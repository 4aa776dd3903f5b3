"""The tables of C and Fortran, read back bit by bit in several precisions."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import prod
from pathlib import Path

from flint import arb, fmpq

from garkcli.bridges.payload import Payload
from garkcli.bridges.rounding import ends
from garkcli.exact.display import to_ball
from garkcli.tableau.pointwise import Cell

_ARRAY_OF_C = re.compile(r"static const gark_real (\w+)((?:\[\d+\])+) = ")
_ARRAY_OF_FORTRAN = re.compile(r"real\(wp\), parameter :: (\w+)\(([\d, ]+)\)")
_DIGITS = 80


@dataclass(frozen=True)
class Precision:
    """A type of floating-point numbers.

    Attributes:
        name: in the table.
        bits: of its significand.
        width: of its bit pattern, where numbers are printed as such.
        exponent: bits of its exponent.
    """

    name: str
    bits: int
    width: int
    exponent: int


DOUBLE = Precision("binary64", 53, 64, 11)
QUAD = Precision("binary128", 113, 128, 15)
EXTENDED = Precision("long double", 64, 80, 15)


def rounded(x: Cell, bits: int) -> Fraction:
    """The nearest number with so many bits, ties to even.

    >>> rounded(fmpq(1, 3), 3)
    Fraction(5, 16)
    """
    if isinstance(x, fmpq):
        return _nearest(Fraction(int(x.p), int(x.q)), bits)
    ball = x if isinstance(x, arb) else to_ball(x, _DIGITS)
    low, high = (Fraction(int(e.p), int(e.q)) for e in ends(ball))
    found = _nearest(low, bits)
    assert found == _nearest(high, bits), "an enclosure that does not tell"
    return found


def _nearest(x: Fraction, bits: int) -> Fraction:
    if not x:
        return x
    size = abs(x)
    power = size.numerator.bit_length() - size.denominator.bit_length() - bits
    unit = Fraction(2) ** power
    if size / unit >= 2**bits:
        unit *= 2
    return round(x / unit) * unit


def cells_of(payload: Payload) -> dict[str, list[Cell]]:
    """The entries by the letter and the numbers of their array: ``A12`` is A of colours 1, 2."""
    found: dict[str, list[Cell]] = {}
    is_single = payload.kind == "rk"
    for l in range(payload.size):
        number = "" if is_single else str(l + 1)
        found[f"b{number}"] = list(payload.b[l])
        found[f"c{number}"] = list(payload.c[l])
        if payload.embedded is not None:
            found[f"embedded{number}"] = list(payload.embedded[l])
        if payload.dense is not None:
            found[f"dense{number}"] = [x for row in payload.dense[l] for x in row]
        for m, block in enumerate(payload.A[l]):
            other = "" if is_single else str(m + 1)
            if block is not None:
                entries = [x for row in block for x in row]
                found[f"A{number}{other}"] = entries
    return found


def program_of_c(header: str, file: str) -> tuple[str, list[tuple[str, int]]]:
    """A program that prints all entries in hexadecimal, and its arrays with their sizes."""
    arrays = [
        (name, prod(map(int, re.findall(r"\d+", sizes))))
        for name, sizes in _ARRAY_OF_C.findall(header)
    ]
    lines = [
        "#include <stdio.h>",
        "#ifdef GARK_FLOAT128",
        "#include <quadmath.h>",
        "#endif",
        f'#include "{file}"',
        "static void show(gark_real x) {",
        "#if defined(GARK_FLOAT128)",
        "  char text[80];",
        '  quadmath_snprintf(text, sizeof text, "%Qa", x);',
        "  puts(text);",
        "#elif defined(GARK_LONG_DOUBLE)",
        '  printf("%La\\n", x);',
        "#else",
        '  printf("%a\\n", x);',
        "#endif",
        "}",
        "int main(void) {",
    ]
    for name, size in arrays:
        lines.append(f"  for (int k = 0; k < {size}; k++) show(((const gark_real *){name})[k]);")
    return "\n".join([*lines, "  return 0;", "}"]) + "\n", arrays


def hexadecimal(text: str) -> Fraction:
    """A number as %a prints it.

    >>> hexadecimal("-0x1.8p-2")
    Fraction(-3, 8)
    """
    sign = -1 if text.startswith("-") else 1
    digits, _, power = text.lstrip("-").removeprefix("0x").partition("p")
    whole, _, rest = digits.partition(".")
    mantissa = Fraction(int(whole + rest, 16), 16 ** len(rest))
    return sign * mantissa * Fraction(2) ** int(power)


def program_of_fortran(module: str) -> tuple[str, list[tuple[str, int]]]:
    """A program that prints the bit patterns of all entries, row by row; its arrays."""
    arrays = [
        (name, prod(map(int, sizes.split(","))))
        for name, sizes in _ARRAY_OF_FORTRAN.findall(module)
    ]
    (name,) = re.findall(r"^module (\w+)", module, re.MULTILINE)
    lines = ["program read_back", f"  use {name}", "  implicit none"]
    lines.append("  integer :: i, j")
    for array, sizes in _ARRAY_OF_FORTRAN.findall(module):
        rows = sizes.split(",")
        if len(rows) == 1:
            lines.append(f"  print '(z32.32)', {array}")
            continue
        lines.append(f"  print '(z32.32)', (({array}(i, j), j = 1, {rows[1]}), i = 1, {rows[0]})")
    return "\n".join([*lines, "end program"]) + "\n", arrays


def pattern(text: str, precision: Precision) -> Fraction:
    """A number by its bits, in hexadecimal.

    >>> pattern("3FF8000000000000", DOUBLE)
    Fraction(3, 2)
    """
    bits = int(text, 16)
    stored = precision.bits - 1
    sign = -1 if bits >> (precision.width - 1) else 1
    exponent = (bits >> stored) & ((1 << precision.exponent) - 1)
    mantissa = bits & ((1 << stored) - 1)
    if not exponent:
        assert not mantissa, "a number too small"
        return Fraction(0)
    bias = (1 << (precision.exponent - 1)) - 1
    power = Fraction(2) ** (exponent - bias - stored)
    return sign * (mantissa + (1 << stored)) * power


def differing(
    payload: Payload, arrays: Sequence[tuple[str, int]], values: Sequence[Fraction], bits: int
) -> list[str]:
    """The entries whose bits are not those of the nearest number.

    Args:
        payload: the method.
        arrays: names, without underscores, and sizes.
        values: of all entries, one array after the other.
        bits: of a significand.
    """
    wanted = cells_of(payload)
    rest = iter(values)
    found = []
    for name, size in arrays:
        cells = wanted.pop(name)
        assert len(cells) == size, name
        for k, x in enumerate(cells):
            if next(rest) != rounded(x, bits):
                found.append(f"{name}[{k}]")
    assert not wanted, "an array that was not written"
    return found


def read_back_c(payload: Payload, header: str, folder: Path, precision: Precision) -> list[str]:
    """The entries of a header that are not the nearest numbers, by a program of C."""
    stem = payload.stem
    (folder / f"{stem}.h").write_text(header, encoding="utf-8")
    text, arrays = program_of_c(header, f"{stem}.h")
    (folder / "read_back.c").write_text(text, encoding="utf-8")
    said = _printed(["cc", *_OPTIONS[precision.name], "read_back.c"], folder)
    values = [hexadecimal(line) for line in said]
    prefix = f"gark_{stem}_"
    named = [(x.removeprefix(prefix), size) for x, size in arrays]
    return differing(payload, _plain(named), values, precision.bits)


_OPTIONS = {DOUBLE.name: [], EXTENDED.name: ["-DGARK_LONG_DOUBLE"], QUAD.name: ["-DGARK_FLOAT128"]}


def read_back_fortran(
    payload: Payload, module: str, folder: Path, precision: Precision
) -> list[str]:
    """The same of a module of Fortran."""
    if precision is QUAD:
        module = module.replace("wp => real64", "wp => real128")
    (folder / "table.f90").write_text(module, encoding="utf-8")
    text, arrays = program_of_fortran(module)
    (folder / "read_back.f90").write_text(text, encoding="utf-8")
    command = ["gfortran", "table.f90", "read_back.f90"]
    values = [pattern(line, precision) for line in _printed(command, folder)]
    return differing(payload, _plain(arrays), values, precision.bits)


def _plain(arrays: Sequence[tuple[str, int]]) -> list[tuple[str, int]]:
    return [(name.replace("_", ""), size) for name, size in arrays]


def _printed(build: Sequence[str], folder: Path) -> list[str]:
    """The lines that a program prints."""
    libraries = ["-lquadmath"] if "-DGARK_FLOAT128" in build else []
    for command in ([*build, "-o", "read_back", *libraries], ["./read_back"]):
        ended = subprocess.run(
            command,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=300,
            check=True,
        )
    return ended.stdout.split()
