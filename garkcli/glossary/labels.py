"""Labels of the keys of results that are not simply the key with spaces."""

from __future__ import annotations

LABELS = {
    "A_alpha": "A(α)-stable",
    "B": "B(r)",
    "C": "C(η)",
    "D": "D(ζ)",
    "R": "R(z)",
    "R_alike": "R(z), all colours alike",
    "R_infinity": "R(∞)",
    "a_stable": "A-stable",
    "l_stable": "L-stable",
    "p_stable": "P-stable",
    "i_stable": "I-stable",
    "conserved": "conserved form",
    "degenerate": "not refined to a method",
    "unstable": "not shown to be stable",
    "discriminant": "4D² − N²",
    "e_polynomial": "E(x), x = y²",
    "esdirk": "ESDIRK",
    "factors": "factors of 4D² − N²",
    "fsal": "first same as last",
    "gamma": "γ",
    "imaginary_interval": "imaginary axis",
    "inconsistent_blocks": "row sums that differ",
    "nodes_in_unit_interval": "nodes in [0, 1]",
    "nonautonomous_order": "non-autonomous order",
    "embedded_nonautonomous_order": "embedded non-autonomous order",
    "open_points": "not decided",
    "pair_criterion": "why this pair order",
    "pair_order": "symplectic pair",
    "phase_order": "phase lag",
    "real_interval": "real axis",
    "same_as": "the same as",
    "differs_from": "differs from",
    "sdirk": "SDIRK",
    "sigma": "σ",
    "springs": "two springs",
    "ssp": "SSP coefficient",
    "ssp_radii": "additive SSP radii",
    "stable_for_every_fast": "stable for all x > 0",
}


def key_of(label: str) -> str:
    """Returns the key for a label.

    >>> key_of("A-stable"), key_of("symplectic pair")
    ('a_stable', 'pair_order')
    """
    keys = {label: key for key, label in LABELS.items()}
    return keys.get(label) or label.replace(" ", "_")


def label_of(key: str) -> str:
    return LABELS.get(key) or key.replace("_", " ")
