"""The tree table against the fastest Python peer, and against its own float weights."""

from __future__ import annotations

import numpy as np

from garkcli import load, pair
from garkcli.ntrees.stage_vectors import elementary_weights
from garkcli.ntrees.table import TreeTable
from garkcli.order.admissible import coupling_graph
from garkcli.tableau.pointwise import numeric_entries
from tests.benchmarks.measuring import ROOT, assert_ratio, peak_megabytes, seconds


def test_against_kauri() -> None:
    """501 640 trees of four colours to order 7, with σ and γ: at least 300 times faster than kauri
    lists them.
    """
    import kauri

    def listed() -> int:
        trees = 0
        for order in range(1, 8):
            for _ in kauri.colored_trees_of_order(order, 4):
                trees += 1
        return trees

    counted: list[int] = []
    peer = seconds(lambda: counted.append(listed()), 1)
    assert counted == [501640]
    ours = seconds(lambda: TreeTable.upto(4, 7), 5)
    assert len(TreeTable.upto(4, 7)) == 501640
    assert_ratio(
        "tree table / kauri, 4 colours to order 7",
        ours / peer,
        1 / 300,
        f"{ours:.4f} s, {peer:.1f} s",
    )


def test_memory() -> None:
    """4 027 360 trees of four colours at order 8, with all below, in less than 2 GB."""
    code = "from garkcli.ntrees.table import TreeTable\nt = TreeTable.upto(4, 8)\nassert len(t) == 4529000"
    megabytes = peak_megabytes(code)
    assert_ratio(
        "memory of 4 colours to order 8 / 2000 MB", megabytes / 2000, 1.0, f"{megabytes:.0f} MB"
    )


def test_weights() -> None:
    """All elementary weights of the pair of the collocation example to order 7: within 5 times the
    table's time.
    """
    tableau = pair(load(str(ROOT / "methods/collocation.gark.yaml")).tableau)
    graph = coupling_graph(tableau)
    entries = numeric_entries(tableau)
    rows = [colour.space for colour in tableau.colours]
    blocks = {(rows[l], m): np.array(entries.A[l][m], dtype=float) for l, m in tableau.edges()}
    weights = [np.array(row, dtype=float) for row in entries.b]
    table = TreeTable.of(graph, 7)
    making = seconds(lambda: TreeTable.of(graph, 7), 7)
    weighing = seconds(lambda: elementary_weights(table, rows, blocks, weights), 7)
    assert_ratio(
        "weights / table, 4 colours to order 7",
        weighing / making,
        5.0,
        f"{weighing:.4f} s, {making:.4f} s",
    )
