"""The meaning of the fields of JSON reports, from data/fields.toml."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache

from garkcli.glossary import read

ORDERS = (
    *("order", "conjugate_order", "pair_order", "nonautonomous_order"),
    *("embedded_order", "embedded_nonautonomous_order", "dense_order"),
    *("slow_order", "position_order", "velocity_order"),
    *("embedded_position_order", "embedded_velocity_order"),
    *("dense_position_order", "dense_velocity_order"),
    *("w_order", "old_jacobian_order", "embedded_w_order", "embedded_old_jacobian_order"),
    *("index_1_order", "index_1_y_order", "index_1_z_order", "embedded_index_1_order"),
    *("stage_order", "weak_stage_order", "symplectic_order", "energy_order"),
    *("effective_order", "exact_order"),
)
"""The fields with an order; further fields say how certain it is."""


@lru_cache(maxsize=1)
def field_entries() -> Mapping[str, str]:
    entries: dict[str, str] = read("fields")
    endings = {x: text for x, text in entries.items() if x.startswith("_")}
    texts = {x: text for x, text in entries.items() if x not in endings}
    for order in ORDERS:
        texts |= {order + ending: text for ending, text in endings.items()}
    return texts


def field_text(path: Sequence[str]) -> str:
    """Returns the meaning of a field by its path from the report on; empty if there is no entry.

    >>> field_text(("diff", "orders", "first"))
    'The result for the first method.'
    """
    entries = field_entries()
    return entries.get(".".join(path[-2:])) or entries.get(path[-1], "")
