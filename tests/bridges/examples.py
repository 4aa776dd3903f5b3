"""Methods that the tests of targets write."""

from __future__ import annotations

from garkcli.bridges.payload import Payload
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import bridges
from garkcli.frozen import replace
from garkcli.methodfile.load import loads

RALSTON = """\
name: Ralston-Euler
A: [[0, 0], [2/3, 0]]
b: [1/4, 3/4]
embedded: [1, 0]
reference: A. Ralston, Runge-Kutta methods with minimum error bounds, 1962
"""
MIDPOINTS = """\
name: midpoints
ark:
  A: [[[0, 0], [1/2, 0]], [[0, 0], [0, 1/2]]]
  b: [0, 1]
"""
SDIRK = "parameters: {g: 1 - sqrt(2)/2}\nA: [[g, 0], [1 - g, g]]\nb: [1 - g, g]\n"
VERLET = """\
name: Störmer-Verlet
prk:
  q: {A: [[0], [1]], b: [1], c: [0, 1]}
  p: {A: [[1/2, 0]], b: [1/2, 1/2], c: [1/2]}
structure: separable
"""
GAUSS = "methods: [{family: gauss, stages: 2}]\n"
BOGACKI = """\
name: BS
A:
  - [0, 0, 0, 0]
  - [1/2, 0, 0, 0]
  - [0, 3/4, 0, 0]
  - [2/9, 1/3, 4/9, 0]
b: [2/9, 1/3, 4/9, 0]
embedded: [7/24, 1/4, 1/3, 1/8]
"""


def payload_of(text: str) -> Payload:
    """A method as writers see it, of no version of ours."""
    return replace(prepared(loads(text)), version="0")


def written(target: str, text: str) -> str:
    """What a target is given of a method file."""
    return bridges()[target].written(payload_of(text))
