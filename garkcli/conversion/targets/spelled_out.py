"""The form that the method has, with every entry spelled out."""

from __future__ import annotations

from garkcli.conversion.sheet import sheet_of
from garkcli.conversion.target import Target

TARGET = Target("spelled-out", "the form that it has, every entry a number", sheet_of)
