"""Tables of several vector fields: ``A[l][m]`` as nested lists, whatever wrote them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from garkcli.frozen import replace
from garkcli.sources.found import FoundTable, Grid, Row, Rows, Unreadable
from garkcli.sources.scalars import Value, is_matrix, is_row, rows_of, whole
from garkcli.sources.shaping import weights

MAX_COLOURS = 60
"""Most vector fields of a table."""


def table_of_blocks(
    values: Mapping[str, Value], source: str, format: str, name: str, line: int = 1
) -> FoundTable | None:
    """The method whose blocks are ``A[l][m]``, weights ``b[l]`` and nodes ``c[l]``.

    Args:
        values: by name; a block may be None.
        source: the file.
        format: the reader.
        name: of the method.
        line: where it begins.

    Returns:
        None where the values have other shapes.
    """
    blocks = _with_rows(values.get("A"), values.get("b"))
    if not _has_blocks(blocks):
        return None
    try:
        grid = grid_of(blocks)
        b = rows_or_row(values.get("b"))
        c = None if "c" not in values else rows_or_row(values["c"])
        dense = dense_of(values.get("dense"), len(b))
        embedded = None
        if isinstance(values.get("embedded"), list):
            embedded = rows_or_row(values["embedded"])
    except Unreadable:
        return None
    return assembled(
        FoundTable(
            source,
            line,
            format,
            name,
            grid,
            b,
            (None,) * len(grid) if c is None else c,
            embedded=embedded,
            dense=dense,
            order=whole(values.get("order")),
            embedded_order=whole(values.get("embedded_order")),
        )
    )


def _with_rows(value: Value, weights_of: Value) -> Value:
    """Blocks of one row, which some languages write like a row, as matrices.

    A row is one where other blocks are matrices or missing and there are several rows of weights.
    """
    are_several = is_matrix(weights_of)
    if not are_several or not isinstance(value, list):
        return value
    rows = [row for row in value if isinstance(row, list)]
    items = [x for row in rows for x in row]
    if not any(x is None or is_matrix(x) for x in items):
        return value
    return [[[x] if is_row(x) else x for x in row] for row in rows]


def _has_blocks(value: Value) -> bool:
    """Whether it is a list of lists of matrices."""
    if not isinstance(value, list) or not value:
        return False
    for row in value:
        if not isinstance(row, list) or not row:
            return False
        for block in row:
            is_block = isinstance(block, list) and all(isinstance(x, list) for x in block)
            if block is not None and not is_block:
                return False
    return True


def grid_of(value: Value) -> Grid:
    """Blocks row by row; None where a vector field does not see another.

    Raises:
        Unreadable: they are none.
    """
    if not isinstance(value, list) or len(value) > MAX_COLOURS:
        raise Unreadable("a list of rows of blocks is expected")
    grid = []
    for row in value:
        if not isinstance(row, list) or len(row) > MAX_COLOURS:
            raise Unreadable("a list of blocks is expected")
        blocks = [None if x is None else rows_of(x) for x in row]
        grid.append(tuple(blocks))
    return tuple(grid)


def rows_or_row(value: Value) -> Rows:
    """A row for each vector field, or the one that all share.

    Raises:
        Unreadable: it is neither.
    """
    if isinstance(value, list) and value:
        if all(isinstance(x, list) for x in value):
            return tuple(weights(x) for x in value)
        return (weights(value),)
    raise Unreadable("weights are expected")


def dense_of(value: Value, colours: int) -> tuple[Rows, ...] | None:
    """Dense output, a matrix for each vector field; None where there is none.

    Raises:
        Unreadable: it is something else.
    """
    if not isinstance(value, list) or not value:
        return None
    if colours == 1 and not _has_blocks([value]):
        return (rows_of(value),)
    if len(value) != colours:
        raise Unreadable("dense output has a matrix for each vector field")
    return tuple(rows_of(x) for x in value)


def assembled(table: FoundTable) -> FoundTable:
    """The same with shared stages as one row of blocks, and one row of weights for each colour."""
    grid = table.A
    b = table.b
    colours = len(grid[0])
    if len(b) == 1 < colours:
        b = b * colours
    c: tuple[Row | None, ...] = table.c
    nodes: Sequence[Row | None] = c
    are_alike = all(row == grid[0] for row in grid)
    if are_alike and len(set(nodes)) == 1:
        grid = grid[:1]
        c = c[:1]
    embedded = table.embedded
    if embedded is not None and len(embedded) == 1 < colours:
        embedded = embedded * colours
    return replace(table, A=grid, b=b, c=c, embedded=embedded)
