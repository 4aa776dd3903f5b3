"""The sections of the page, in their order."""

from __future__ import annotations

from garkcli.webpage.section import Section
from garkcli.webpage.sections import (
    claims,
    conditions,
    faults,
    orders,
    pictures,
    properties,
    reference,
    simplifying,
    stability,
    tableau,
)

SECTIONS: tuple[Section, ...] = (
    faults.SECTION,
    tableau.SECTION,
    orders.SECTION,
    claims.SECTION,
    simplifying.SECTION,
    properties.SECTION,
    stability.SECTION,
    reference.SECTION,
    pictures.SECTION,
    conditions.SECTION,  # the longest, and across on paper: pages of its own
)
