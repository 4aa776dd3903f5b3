"""Plugin of pytest that runs the tests that a file names, in its order, within its limits."""

from __future__ import annotations

import json
import os
import resource
from pathlib import Path

import pytest
from hypothesis import Phase, settings

CHOICE = json.loads(Path(os.environ["GARK_CHOICE"]).read_text(encoding="utf-8"))
MOST_MEMORY = 8 << 30
"""What a mutant may allocate, in bytes."""

resource.setrlimit(resource.RLIMIT_CPU, (CHOICE["seconds"], CHOICE["seconds"] + 5))
resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))


@pytest.hookimpl(tryfirst=True)
def pytest_collection() -> None:
    """Take the first example that fails as it is: a smaller one takes long, and nobody reads it."""
    phases = (Phase.explicit, Phase.reuse, Phase.generate)
    settings.register_profile("mutants", settings.default, phases=phases)
    settings.load_profile("mutants")


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Keep the tests that are chosen by name or with their whole file."""
    rank = {test: number for number, test in enumerate(CHOICE["tests"])}
    files = CHOICE["files"]
    kept = [x for x in items if x.nodeid in rank or x.nodeid.partition("::")[0] in files]
    items[:] = sorted(kept, key=lambda x: rank.get(x.nodeid, len(rank)))
