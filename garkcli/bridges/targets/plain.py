"""Targets that consist of a template: the methods that each takes, and its style of numbers."""

from __future__ import annotations

from garkcli.bridges.numbers import PYTHON, Style, c_style
from garkcli.bridges.registry import DENSE, EMBEDDED, EVERYTHING, STEPPED, Bridge, FileName
from garkcli.bridges.trials import CPP_WORDS, WORDS

_HEADER = FileName(
    r'[^"\\]*', "C++ includes a header", "-o NAME.hpp, without quotes and backslashes"
)
_FUNCTION = FileName(
    r"[A-Za-z][A-Za-z0-9_]*(\.m)?",
    "MATLAB calls a function",
    "-o NAME.m, with letters, digits and _",
)

BRIDGES = (
    # it reads no fractions
    Bridge(
        name="amrex",
        summary="AMReX: lines of an inputs file, explicit methods",
        suffix=".inputs",
        stages="explicit",
    ),
    # a function that makes the stepper, for any type of state
    Bridge(
        name="boost",
        summary="Boost.Odeint: a header of C++, explicit methods",
        suffix=".hpp",
        stages="explicit",
        words=CPP_WORDS,
        file=_HEADER,
    ),
    # for any real type; for several vector fields arrays have names such as A1_2, b2
    Bridge(
        name="c",
        summary="a C header with constant arrays",
        kinds=STEPPED,
        suffix=".h",
        style=c_style("GARK_REAL_C"),
        lacks=(),
        has_predictor=True,
        reads_back=True,
    ),
    # With varstep = FALSE deSolve reads only the entries right below the diagonal of A. R reads
    # decimals through long double, which rounds some twice; those of floats survive it.
    Bridge(
        name="desolve",
        summary="deSolve of R: a method for rk, explicit methods",
        suffix=".R",
        style=Style(fraction="{p}/{q}", point=False),
        stages="explicit",
        words={**WORDS, "y1": "y[1]", "y2": "y[2]"},
    ),
    # 39 digits are enough for real128; a longer number would not fit a line of 100 columns
    Bridge(
        name="fortran",
        summary="a Fortran module with constant arrays",
        kinds=EVERYTHING,
        suffix=".f90",
        style=Style(digits=39, longest=80, fraction="{p}.0_wp/{q}.0_wp", decimal="{x}_wp"),
        lacks=(),
        reads_back=True,
    ),
    Bridge(
        name="irksome",
        summary="Irksome: a module with a ButcherTableau",
        suffix=".py",
        style=PYTHON,
    ),
    # its program solves all stages together, by Newton's method with exact derivatives
    Bridge(
        name="matlab",
        summary="MATLAB and Octave: a function that returns a struct",
        kinds=EVERYTHING,
        suffix=".m",
        style=PYTHON,
        lacks=(),
        words={**WORDS, "y1": "y(1)", "y2": "y(2)", "zero": "0"},
        file=_FUNCTION,
        reads_back=True,
    ),
    # the numbers are static, since the solver keeps pointers to them
    Bridge(
        name="mfem",
        summary="MFEM: a header of C++, explicit methods",
        suffix=".hpp",
        stages="explicit",
        starts=True,
        lacks=(EMBEDDED, DENSE),
        words=CPP_WORDS,
        file=_HEADER,
    ),
    Bridge(
        name="numpy",
        summary="a Python module with NumPy arrays",
        kinds=STEPPED,
        suffix=".py",
        style=PYTHON,
        lacks=(),
        has_predictor=True,
        reads_back=True,
    ),
    Bridge(
        name="rklab",
        summary="MATLAB: the block matrix of RKLab",
        suffix=".m",
        style=PYTHON,
        reads_back=True,
    ),
    # Tempus reads numbers by the stream operator of C++, for which 1/3 is 1, so all are decimals
    Bridge(
        name="tempus",
        summary="Tempus of Trilinos: XML, explicit, DIRK and IMEX methods",
        kinds=("rk", "ark"),
        suffix=".xml",
        stages="lower",
        several="pair",
    ),
    # Its cubic between steps uses the slopes of the first and the last stage: a method without a
    # stage at the end of the step gets one of weight 0, the first one of the next step.
    Bridge(
        name="torchode",
        summary="torchode: a module with a class, explicit methods",
        suffix=".py",
        style=PYTHON,
        stages="explicit",
        starts=True,
        ends=True,
    ),
)
