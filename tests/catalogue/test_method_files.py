"""The catalogue as method files: the whole way from YAML to verdict."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest

from garkcli.methodfile.load import loads
from garkcli.ntrees.stage_vectors import elementary_weights
from garkcli.ntrees.table import TreeTable
from garkcli.order.admissible import coupling_graph
from garkcli.tableau.pointwise import numeric_entries
from tests.catalogue.catalogue import entries
from tests.catalogue.method_files import method_file
from tests.whole import sample

ENTRIES = entries()


def _floats(rows: Iterable[Iterable[Any]]) -> Any:
    """Double precision: ``long double`` has as many bits as the machine likes."""
    return np.array([[float(x.str(25, radius=False)) for x in row] for row in rows])


@pytest.mark.parametrize("name", sample([*ENTRIES], 4))
def test_brute_force_over_the_table_in_floats(name: str) -> None:
    """Every tree of the table, in floats: residuals vanish up to the verified order, and not one
    above.

    Zero is what is within the rounding of the entry, or within 1e-11 where that is smaller, and
    what round-off can make: coefficients reach 458, and seven of them are multiplied. The weights
    of |A| and |b| bound it (Higham, *Accuracy and Stability of Numerical Algorithms*, 3.1).
    """
    entry = ENTRIES[name]
    tableau, order = loads(method_file(entry)).tableau, entry["verified_order"]
    table = TreeTable.of(coupling_graph(tableau), order + 1)
    printed = numeric_entries(tableau, 25)
    rows = [colour.space for colour in tableau.colours]
    blocks = {(rows[l], m): _floats(printed.A[l][m] or ()) for l, m in tableau.edges()}
    weights = [_floats([row])[0] for row in printed.b]
    found = elementary_weights(table, rows, blocks, weights)
    sizes = elementary_weights(
        table, rows, {key: np.abs(A) for key, A in blocks.items()}, [np.abs(b) for b in weights]
    )
    # a vertex adds up at most as many products as there are stages, and is multiplied once
    operations = (order + 1) * (max(entry["stages"]) + 2)
    round_off = operations * np.finfo(float).eps * sizes
    residuals = np.abs(found - 1 / table.gamma)
    near = max(entry["rounding"], 1e-11)
    assert np.all(residuals <= near + round_off, where=table.order <= order)
    assert np.any(residuals > near + round_off, where=table.order == order + 1)
