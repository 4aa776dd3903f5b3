"""Roles that names of arrays suggest: they rank readings, and decide none."""

from __future__ import annotations

import re

_HEAD = r"(?:^|[_.#\W]|get|set|rk|bt|\d)_?"
WEIGHTS = re.compile(
    rf"{_HEAD}(?:b|w|beta|weights?|bs|.*b_?(?:sol|high|coeffs?|array|values)|c_sol|gamma)\d*$", re.I
)
NODES = re.compile(
    rf"{_HEAD}(?:c|c_?(?:hat|values|array|coeffs?)|nodes?|rkc|gamma?m?|cs|eval_stages|alpha)\d*$",
    re.I,
)
MATRIX = re.compile(
    rf"{_HEAD}(?:a|a_?(?:hat|lower|values|matrix|coeffs?|array|explicit|implicit|ij)|rka|alpha?|bt"
    r"|butcher\w*|tableau\w*|.*coeff\w*|as)\d*$",
    re.I,
)
EMBEDDED = re.compile(r"hat|emb|err|low|tilde|star|2|bh|(?:^|_)er?$|b_?e|cmp|E$", re.I)
ALPHA, BETA = re.compile("alpha|α", re.I), re.compile("beta|β", re.I)
