"""No input, however made, is met with anything but a verdict or the errors of ``garkcli.errors``."""

from __future__ import annotations

from random import Random
from time import perf_counter

import pytest

from garkcli.errors import ExpressionError, Fault, MethodFileError
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.rewriting import substitute
from garkcli.methodfile.load import loads
from tests.fuzz.inputs import SIGNS, method_file, seeds, soup

SLOWEST = 5.0
"""Seconds that no file may take before its verdict."""


def faults_of(text: str) -> tuple[Fault, ...]:
    """The faults of a file; none where it is a method. Any other exception is what fuzzing looks for."""
    try:
        loads(text)
    except MethodFileError as error:
        return error.faults or (Fault("an error without faults"),)
    return ()


def offset_of_fault(text: str) -> int:
    """Where a number is wrong; 0 where it is right."""
    try:
        expression = substitute(parse(text), {"tau": parse("1/2")})
        Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        return error.start
    return 0


@pytest.mark.parametrize("seed", range(10))
def test_method_files(seed: int) -> None:
    """Three hundred damaged files a seed: a method or its faults, each with a place in the file, and soon."""
    random, files = Random(seed), seeds()
    refused = 0
    for _ in range(300):
        text = method_file(random, files)
        start = perf_counter()
        faults = faults_of(text)
        refused += bool(faults)
        assert all(fault.line >= 1 and fault.column >= 1 and fault.message for fault in faults), text
        assert perf_counter() - start < SLOWEST, text
    assert 0 < refused < 300


@pytest.mark.parametrize("seed", range(4))
def test_numbers(seed: int) -> None:
    """Five hundred texts of number signs a seed: a value, or an error with offsets inside the text."""
    random = Random(seed)
    for _ in range(500):
        text = soup(random, SIGNS, 30)
        assert 0 <= offset_of_fault(text) <= len(text), text
