"""Methods with unknowns, and what is found of them."""

from __future__ import annotations

from garkcli.glossary.term import Term

_DESIGN = "this project, docs/design.md"
_SEARCH = "this project, docs/searching.md"
TERMS = (
    Term(
        "free parameter",
        'A name in coefficients without a value: parameters: {tau: free}, or "?" for an entry. gark'
        " design says which values have an order, gark check what holds for every value.",
        "",
        _DESIGN,
        ("unknown", "unknowns", "parameter", "every value", "elsewhere"),
        ("family of dimension d", "shape"),
    ),
    Term(
        "family of dimension d",
        "The values that have an order, where there are infinitely many: d of them can be chosen,"
        " and the others follow. --choose goes down it value by value.",
        "",
        _DESIGN,
        ("family", "dimension"),
        ("free parameter",),
    ),
    Term(
        "shape",
        "Which entries of an unknown tableau are zero, equal or given: explicit, sdirk,"
        " stiffly-accurate and others.",
        "",
        _DESIGN,
        (),
        ("free parameter",),
    ),
    Term(
        "not decided",
        "There is an answer, and it was not found: in the time there was, or with the digits that"
        " were given. It is no verdict.",
        "",
        _DESIGN,
        ("undecided",),
        ("exact",),
    ),
    Term(
        "exact",
        "Found without rounding, and proved: the numbers are rational or algebraic, and the order"
        " is that of the certificate.",
        "",
        _SEARCH,
        (),
        ("proved to exist", "numerical"),
    ),
    Term(
        "proved to exist",
        "Near these decimals there is a method that has the order exactly, by Krawczyk's test; its"
        " numbers are not known in closed form.",
        "",
        _SEARCH,
        ("exists",),
        ("exact", "numerical"),
    ),
    Term(
        "numerical",
        "These decimals meet the conditions to many digits. Nothing is proved.",
        "",
        _SEARCH,
        (),
        ("exact", "proved to exist"),
    ),
)
