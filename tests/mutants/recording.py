"""Plugin of pytest that records which lines of the mathematical rooms each test runs, and how long
it takes; ``run.py`` starts it once, and chooses tests by it.
"""

from __future__ import annotations

import functools
import json
import os
import sys
import time
from collections.abc import Generator
from pathlib import Path

import coverage
import pytest

ROOT = Path.cwd()
RECORD = Path(os.environ["GARK_RECORD"])


class Recorder:
    """One process: the lines of each passed test, and its processor time in seconds."""

    def __init__(self) -> None:
        rooms = os.environ["GARK_ROOMS"].split(",")
        self.coverage = coverage.Coverage(
            data_file=None, include=[str(ROOT / "garkcli" / room / "*") for room in rooms]
        )
        self.seconds: dict[str, float] = {}
        self.coverage.start()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Generator[None, object, object]:
        """Lines belong to the test that runs them, and not to an earlier one with the same value."""
        forget()
        self.coverage.switch_context(item.nodeid)
        start = time.process_time()
        try:
            return (yield)
        finally:
            self.seconds[item.nodeid] = time.process_time() - start
            self.coverage.switch_context("")

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """A test that fails or is skipped says nothing on a mutant."""
        if report.outcome != "passed":
            self.seconds[report.nodeid] = float("nan")

    def pytest_sessionfinish(self) -> None:
        """Write what was seen."""
        self.coverage.stop()
        data = self.coverage.get_data()
        lines = {}
        for name in data.measured_files():
            found: dict[str, list[int]] = {}
            for line, tests in data.contexts_by_lineno(name).items():
                for test in tests:
                    found.setdefault(test, []).append(line)
            lines[Path(name).relative_to(ROOT).as_posix()] = found
        seconds = {test: x for test, x in self.seconds.items() if x == x}
        text = json.dumps({"seconds": seconds, "lines": lines})
        RECORD.write_text(text, encoding="utf-8")


def forget() -> None:
    """Empty the caches of all functions of gark."""
    for name, module in list(sys.modules.items()):
        if name.startswith("garkcli"):
            for value in list(vars(module).values()):
                if isinstance(value, functools._lru_cache_wrapper):
                    value.cache_clear()


def pytest_configure(config: pytest.Config) -> None:
    """Begin."""
    config.pluginmanager.register(Recorder())
