"""MFEM: a header with a function that makes an ``ExplicitRKSolver``.

The solver keeps pointers to the numbers, which are static.
"""

from __future__ import annotations

from garkcli.bridges.registry import DENSE, EMBEDDED, HEADER, Bridge
from garkcli.bridges.trials import CPP_WORDS

BRIDGES = (
    Bridge(
        name="mfem",
        summary="MFEM: a header of C++, explicit methods",
        suffix=".hpp",
        stages="explicit",
        starts=True,
        lacks=(EMBEDDED, DENSE),
        words=CPP_WORDS,
        file=HEADER,
    ),
)
