"""MATLAB and Octave: a function that returns a struct, and RKLab's block matrix."""

from __future__ import annotations

import re
from collections.abc import Sequence

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.comments import PERCENT, head
from garkcli.bridges.lines import filled
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge, Written
from garkcli.bridges.structure import table
from garkcli.bridges.trials import STEPS, command_of, trial_of
from garkcli.tableau.pointwise import Block

MATLAB = Style(longest=100, fraction="{p}/{q}", point=False)
"""The quotient of two whole numbers, and a decimal of any length, is rounded once."""
_GOES_ON = " ..."


def write(payload: Payload) -> str:
    """A function without arguments; one vector field has matrices, several have cells."""
    name = payload.identifier("matlab")
    lines = [f"function m = {name}()"]
    lines += PERCENT.lines(head(payload, *_notes(payload)))
    lines.append(f"m.order = {payload.orders.effective};")
    if payload.orders.embedded is not None:
        lines.append(f"m.embedded_order = {payload.orders.embedded};")
    lines += _coefficients(payload)
    lines.append("end")
    return "\n".join(lines) + "\n"


def _notes(payload: Payload) -> list[str]:
    notes = []
    if payload.kind != "rk":
        notes.append(
            "m.A{l,m}: how the stages of vector field l see vector field m; [] where they do not."
        )
    if payload.dense is not None:
        notes.append(
            "m.dense: the coefficients of theta, theta^2, ... of b_i(theta), a row a stage."
        )
    return notes


def _coefficients(payload: Payload) -> list[str]:
    lines = []
    is_single = payload.kind == "rk"
    for l, blocks in enumerate(payload.A, 1):
        for m, block in enumerate(blocks, 1):
            lines += _matrix(_at("A", is_single, l, m), block, payload)
    rows = {"b": payload.b, "c": payload.c, "bhat": payload.embedded or ()}
    for name, of_colours in rows.items():
        for l, row in enumerate(of_colours, 1):
            numbers = payload.numbers(row, MATLAB)
            lines += _row(_at(name, is_single, l), numbers)
    for l, of_colour in enumerate(payload.dense or (), 1):
        lines += _matrix(_at("dense", is_single, l), of_colour, payload)
    return lines


def _at(name: str, is_single: bool, *indices: int) -> str:
    """A field of the struct, or a cell of it."""
    place = ",".join(map(str, indices))
    return f"m.{name}" if is_single else f"m.{name}{{{place}}}"


def _row(name: str, numbers: Sequence[str]) -> list[str]:
    return filled(numbers, f"{name} = [", "];", " ", _GOES_ON)


def _matrix(name: str, block: Block, payload: Payload) -> list[str]:
    """An assignment, a row a line."""
    if not block:
        return [f"{name} = [];"]
    indent = " " * len(f"{name} = [")
    lines = []
    for i, row in enumerate(block):
        begin = indent if i else f"{name} = ["
        end = "];" if i == len(block) - 1 else ";" + _GOES_ON
        numbers = payload.numbers(row, MATLAB)
        lines += filled(numbers, begin, end, " ", _GOES_ON)
    return lines


def write_rklab(payload: Payload) -> str:
    """The block matrix [c A; q b; p b̂] of RKLab."""
    found = table(payload)
    orders = payload.orders
    numbers = []
    for c, row in zip(found.c, found.A, strict=True):
        numbers.append(payload.numbers((c, *row), MATLAB))
    numbers.append([str(orders.effective), *payload.numbers(found.b, MATLAB)])
    if found.embedded is not None:
        embedded = payload.numbers(found.embedded, MATLAB)
        numbers.append([str(orders.embedded), *embedded])
    lines = PERCENT.lines(head(payload, "Rows [c A], then [order b], then [embedded order bhat]."))
    indent = " " * len("B = [")
    for i, line in enumerate(numbers):
        begin = indent if i else "B = ["
        end = "];" if i == len(numbers) - 1 else ";" + _GOES_ON
        lines += filled(line, begin, end, " ", _GOES_ON)
    return "\n".join(lines) + "\n"


def test_driver(payload: Payload, file: str) -> list[Written]:
    """A function that solves all stages together, by Newton's method with exact derivatives.

    Raises:
        CannotExport: the name of the file is no name of a function.
    """
    stem = file.removesuffix(".m")
    if not re.fullmatch("[A-Za-z][A-Za-z0-9_]*", stem):
        raise CannotExport(
            f"MATLAB calls a function by the name of its file, and {file} is none",
            "-o NAME.m, with letters, digits and _",
        )
    trial = trial_of(payload)
    problem = f"{stem}_problem.yaml"
    notes = [
        f"Runs {file}: octave --no-gui -q --eval {stem}_test",
        f"The same errors: {command_of(payload, problem)}",
    ]
    lines = [f"function {stem}_test()", *PERCENT.lines(notes)]
    lines += [f"m = {stem}();", *_SINGLE]
    lines.append("f = {" + ", ".join(_fields(payload)) + "};")
    lines += [
        f"t_end = {trial.t_end};",
        f"final = [{'; '.join(trial.final)}];",
        "before = [];",
        "fprintf('steps      error  slope\\n');",
        f"for n = [{' '.join(map(str, STEPS))}]",
        f"  y = [{'; '.join(trial.initial)}];",
        *_LOOP,
    ]
    text = "\n".join([*lines, *_STEP]) + "\n"
    return [Written("_test.m", text), Written("_problem.yaml", trial.file)]


def _fields(payload: Payload) -> list[str]:
    """The vector field of each colour; those of q and p have one component each."""
    trial = trial_of(payload)
    if payload.kind != "prk":
        sides = [trial.formulas(l, _WORDS) for l in range(payload.size)]
    else:
        first, second = trial.formulas(0, _WORDS)
        sides = [(first, "0"), ("0", second)]
    return [f"@(t, y) [{first}; {second}]" for first, second in sides]


_WORDS = {"y1": "y(1)", "y2": "y(2)", "t": "t", "sin": "sin", "cos": "cos"}
_SINGLE = ("if ~iscell(m.A)", "  m.A = {m.A}; m.b = {m.b}; m.c = {m.c};", "end")
_LOOP = (
    "  h = t_end/n;",
    "  for k = 0:n-1",
    "    y = step(f, m, k*h, y, h);",
    "  end",
    "  err = norm(y - final);",
    "  fprintf('%5d  %.3e', n, err);",
    "  if ~isempty(before)",
    "    fprintf('  %5.2f', log2(before/err));",
    "  end",
    "  fprintf('\\n');",
    "  before = err;",
    "end",
    "end",
    "",
)
_STEP = (
    "function y = step(f, m, t, y, h)",
    "N = numel(f);",
    "s = cellfun(@numel, m.b);",
    "first = [0, cumsum(s)];",
    "S = first(end);",
    "A = zeros(S); b = zeros(1, S); c = zeros(1, S); colour = zeros(1, S);",
    "for l = 1:N",
    "  rows = first(l)+1:first(l+1);",
    "  b(rows) = m.b{l}; c(rows) = m.c{l}; colour(rows) = l;",
    "  for k = 1:N",
    "    if ~isempty(m.A{l,k})",
    "      A(rows, first(k)+1:first(k+1)) = m.A{l,k};",
    "    end",
    "  end",
    "end",
    "d = numel(y);",
    "Y = repmat(y, 1, S);",
    "for iteration = 1:50",
    "  F = zeros(d, S);",
    "  J = zeros(d*S);",
    "  for j = 1:S",
    "    g = @(x) f{colour(j)}(t + c(j)*h, x);",
    "    F(:, j) = g(Y(:, j));",
    "    D = zeros(d);",
    "    for i = 1:d",
    "      x = Y(:, j);",
    "      x(i) = x(i) + 1i*1e-30;",
    "      D(:, i) = imag(g(x))/1e-30;",
    "    end",
    "    columns = (j-1)*d+1:j*d;",
    "    J(:, columns) = h*kron(A(:, j), D);",
    "  end",
    "  R = Y - repmat(y, 1, S) - h*F*A.';",
    "  X = reshape((eye(d*S) - J) \\ R(:), d, S);",
    "  Y = Y - X;",
    "  if max(abs(X(:))) <= 4*eps*max(abs(Y(:)))",
    "    break",
    "  end",
    "end",
    "F = zeros(d, S);",
    "for j = 1:S",
    "  F(:, j) = f{colour(j)}(t + c(j)*h, Y(:, j));",
    "end",
    "y = y + h*F*b.';",
    "end",
)


BRIDGES = (
    Bridge(
        name="matlab",
        summary="MATLAB and Octave: a function that returns a struct",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".m",
        write=write,
        test_driver=test_driver,
        reads_back=True,
    ),
    Bridge(
        name="rklab",
        summary="MATLAB: the block matrix of RKLab",
        kinds=("rk",),
        suffix=".m",
        write=write_rklab,
        reads_back=True,
    ),
)
