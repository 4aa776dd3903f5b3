"""Settings that all tests share."""

import atexit
import gc
import os
import sys
from collections.abc import Generator
from functools import lru_cache
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.grammar import nodes
from tests.whole import IS_WHOLE, at_most, few_cases

# The suite starts gark some hundred times: byte code is kept, whatever the environment says.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False
# Workers have all cores: threads of OpenBLAS, which wait in loops, would take them from each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# the same examples every time: what passes here passes there; see docs/contributing/fuzzing.md
IS_RANDOM = os.environ.get("GARK_RANDOM_EXAMPLES") == "1"
settings.register_profile(
    "gark",
    deadline=None,
    max_examples=at_most(10, 200),
    derandomize=not IS_RANDOM,
    print_blob=IS_RANDOM,
)
settings.load_profile("gark")

# Thousands of runs read a few hundred files: the nodes of a text, which nothing changes, are kept.
nodes.compose = lru_cache(maxsize=600)(nodes.compose)


@given(st.none())
def draw_nothing(_: None) -> None:
    """What hypothesis does before a first test is done."""


@pytest.hookimpl(wrapper=True)
def pytest_collect_file(
    file_path: Path,
) -> Generator[None, list[pytest.Collector], list[pytest.Collector]]:
    """Look for examples in docstrings only where a file of the tests has any."""
    found = yield
    has_examples = b">>> " in file_path.read_bytes()
    return [x for x in found if has_examples or type(x).__name__ != "DoctestModule"]


@pytest.hookimpl(trylast=True)  # what -k and -m leave
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Of tests with many cases take a few, where nobody names files or folders."""
    if IS_WHOLE or config.args != config.getini("testpaths"):
        return
    chosen = few_cases(items)
    config.hook.pytest_deselected(items=[*set(items) - set(chosen)])
    items[:] = chosen


def pytest_collection_finish() -> None:
    """Keep the garbage collector from what stays until the end: modules and thousands of tests."""
    # older hypothesis asks the collector who holds its generator of random numbers, before a first
    # test, and does not see what is frozen
    draw_nothing()
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000)  # as gark has it
    atexit.register(gc.freeze)  # nor at the end
