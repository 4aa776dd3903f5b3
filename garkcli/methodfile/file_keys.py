"""The keys of method files, and the JSON Schema (draft-07) of single values, for editors."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache

from garkcli.glossary.key import FileKind, KeyMeaning
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import SequenceNode
from garkcli.grammar.source import Home
from garkcli.methodfile import spelled_out
from garkcli.methodfile.bibliography import ALIASES, REFERENCE
from garkcli.methodfile.description import BESIDE, CONSTRUCTIONS, FORMS, PLAIN, STRUCTURES
from garkcli.methodfile.expectations import EXPECT
from garkcli.methodfile.parameters import DEFINITIONS, PARAMETERS

_PAGE = "docs/method-file.md#"
_MADE = f"{_PAGE}compose-adjoint-extrapolate-splitting-methods-made-from-methods"
_PAPER = f"{_PAGE}methods-and-transfer-the-papers-construction"


def _methods() -> g.Schema:
    member = {"type": "string", "pattern": "^[a-zA-Z]"}
    method = {"anyOf": [g.defined("method").schema(), member]}
    return {"anyOf": [spelled_out.rows_of(method), method]}


def _inside_methods() -> Iterable[g.Key]:
    from garkcli.methodfile.diagonal import FAMILY

    return {key.name: key for key in (*spelled_out.BUTCHER.inside(), *FAMILY.inside())}.values()


KEYS = {
    key.name: key
    for key in (
        g.Key(
            "gark: 1", g.VERSION, "The version of the format that a method file is written in.", 1
        ),
        g.Key(
            "name: Heun's method",
            g.TEXT,
            "The name of the method; by default that of its file.",
            also=("title",),
        ),
        g.Key(
            "aliases: [DOPRI5, RK45]",
            ALIASES,
            "Other names of the method: a list of texts, or one text, without a /.",
        ),
        g.Key(
            "description: for separable Hamiltonians",
            g.TEXT,
            "The purpose or the origin of the method, in words.",
        ),
        g.Key(
            "reference: {authors: M. Kutta, title: Beitrag zur Integration, year: 1901}",
            REFERENCE,
            "The publication of the method: a text, or the fields of a publication.",
            page=f"{_PAGE}reference-where-it-was-published",
        ),
        g.Key(
            "methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]",
            g.ValueKind(_methods, inside=_inside_methods),
            "The diagonal methods of the paper's construction, one per colour: families with their "
            "stages, or Butcher tableaus. One method on its own needs no list.",
            page=_PAPER,
            also=("method",),
        ),
        *spelled_out.TABLEAU_KEYS,
        spelled_out.PREDICTOR_KEY,
        g.Key(
            "transfer: collocation",
            g.later("garkcli.methodfile.transfers", "TRANSFER"),
            "The rules for the off-diagonal blocks between the methods: one rule for all of them, "
            "weights of several rules with the sum 1, or a default with exceptions.",
            page=_PAPER,
        ),
        g.Key(
            "tableau: {A: [[0, 0], [1/2, 0]], b: [0, 1]}",
            spelled_out.TABLEAU,
            "One Butcher tableau, or every block A^{l,m} of several colours spelled out.",
            page=f"{_PAGE}tableau-every-block-spelled-out",
            also=("butcher",),
        ),
        g.Key(
            "ark: {A: [[[0, 0], [1, 0]], [[0, 0], [0, 1]]], b: [[0, 1], [0, 1]]}",
            g.later("garkcli.methodfile.ark_prk", "ARK"),
            "An additive method: colours that share their stage values, such as an IMEX pair.",
            page=f"{_PAGE}ark-additive-rungekutta-shared-stages",
        ),
        g.Key(
            "prk: {q: {A: [[0], [1]], b: [1]}, p: {A: [[1/2, 0]], b: [1/2, 1/2]}}",
            g.later("garkcli.methodfile.ark_prk", "PRK"),
            "A partitioned method: one tableau for the positions q, one for the momenta p.",
            page=f"{_PAGE}prk-partitioned-rungekutta-written-as-the-paper-prints-the-rectangular-"
            "method",
        ),
        g.Key(
            "shu-osher: {alpha: [[1], [1/2, 1/2]], beta: [[1], [0, 1/2]]}",
            g.later("garkcli.methodfile.registers", "SHU_OSHER"),
            "An explicit method in the form of Shu and Osher.",
            page=f"{_PAGE}shu-osher-and-low-storage-as-programs-print-them",
            also=("shu_osher", "shuosher"),
        ),
        g.Key(
            "low-storage: {form: 2N, A: [0, -1], B: [1, 1/2]}",
            g.later("garkcli.methodfile.registers", "LOW_STORAGE"),
            "An explicit method as codes with few registers print it: 2N, 2R, 3R, 2C, 2S, 3S*.",
            page=f"{_PAGE}shu-osher-and-low-storage-as-programs-print-them",
            also=("low_storage", "lowstorage"),
        ),
        g.Key(
            "rosenbrock: {alpha: [[0, 0], [1, 0]], gamma: [[1/2, 0], [-1, 1/2]], b: [1/2, 1/2]}",
            g.later("garkcli.methodfile.rosenbrock", "ROSENBROCK"),
            "A Rosenbrock or W-method: linear systems with the Jacobian, or another matrix, in "
            "place of nonlinear ones.",
            page=f"{_PAGE}rosenbrock-rosenbrock-and-w-methods",
            also=("ros", "row", "rosw"),
        ),
        g.Key(
            "nystrom: {Abar: [[], [1/2]], c: [0, 1], bbar: [1/2, 0], b: [1/2, 1/2]}",
            g.later("garkcli.methodfile.nystrom", "NYSTROM"),
            "A Nyström method for q″ = g(q, q′), or g(q) without A.",
            page=f"{_PAGE}nystrom-nyström-methods",
            also=("rkn", "rkng"),
        ),
        g.Key(
            "nprk: {a: [[], [[], [1]]], b: [[], [1]]}",
            g.later("garkcli.methodfile.nprk", "NPRK"),
            "A nonlinearly partitioned method for F(y, y).",
            page=f"{_PAGE}nprk-nonlinearly-partitioned-methods",
        ),
        g.Key(
            "derivatives: {A: [[[], [1/2]], [[], [1/8]]], b: [[1, 0], [1/6, 1/3]]}",
            g.later("garkcli.methodfile.derivatives", "DERIVATIVES"),
            "A multiderivative method: it uses f, f′f, …, the derivatives along the solution.",
            page=f"{_PAGE}derivatives-multiderivative-methods",
            also=("multiderivative", "tdrk"),
        ),
        g.Key(
            "compose: {of: rk4, steps: [1/2, 1/2]}",
            g.later("garkcli.methodfile.constructed.compose", "KIND"),
            "Substeps of methods, one after the other, the first one first.",
            page=_MADE,
        ),
        g.Key(
            "adjoint: explicit-euler",
            g.later("garkcli.methodfile.constructed.compose", "ADJOINT"),
            "The adjoint of a method: the inverse of its step with −h.",
            page=_MADE,
        ),
        g.Key(
            "extrapolate: {of: {family: gauss, stages: 1}, order: 6}",
            g.later("garkcli.methodfile.constructed.extrapolate", "KIND"),
            "Several numbers of equal substeps of a method, combined so that powers of h cancel.",
            page=_MADE,
        ),
        g.Key(
            "splitting: {a: [1/2, 1/2], b: [1]}",
            g.later("garkcli.methodfile.constructed.splitting", "KIND"),
            "The parts of a problem flow in turn, each by its exact flow or by a method.",
            page=_MADE,
        ),
        g.Key(
            "multirate: {slow: kutta, fast: kutta, steps: 4}",
            g.later("garkcli.methodfile.constructed.multirate", "KIND"),
            "Small steps of a fast method within one step of a slow one; colour 1 is the fast "
            "part.",
            page=f"{_PAGE}multirate-small-steps-of-one-method-within-one-of-another",
        ),
        g.Key(
            "structure: separable",
            g.word(lambda: STRUCTURES),
            "The vector fields of the problem: general ones, or Hamiltonians whose terms have "
            "velocities or forces alone, so that fewer trees have conditions. Write it beside "
            "methods, prk or splitting.",
            "general",
            page=f"{_PAGE}structure",
        ),
        g.Key(
            "conjugate: true",
            g.FLAG,
            "Whether the method is the symplectic conjugate of what the rest of the file says.",
            False,
            page=f"{_PAGE}conjugate",
        ),
        g.Key(
            "linear: [1]",
            g.ValueKind(lambda: {"type": "array", "items": g.count(1).schema()}),
            "Colours whose vector field is linear: their vertices have one branch at most.",
        ),
        g.Key(
            "unknown: {stages: 3, shape: sdirk}",
            g.later("garkcli.methodfile.shapes", "UNKNOWN"),
            "A tableau of unknowns, by its stages and its shape, for gark design.",
            page="docs/design.md",
        ),
        g.Key(
            "design: {order: 3, l-stable: true}",
            g.later("garkcli.methodfile.wishes", "DESIGN"),
            "The demands on methods that gark design seeks, for all colours or for some of them.",
            page="docs/design.md",
        ),
        g.Key(
            "parameters: {tau: 1/2, gamma: free}",
            PARAMETERS,
            "Names that coefficients are written with, each with a value, which may use the names "
            "before it; or free, for gark design, gark sweep and --set.",
            also=("params",),
        ),
        g.Key(
            "tolerance: 1e-13",
            g.later("garkcli.methodfile.tolerance", "KIND"),
            "The largest error of each rounded coefficient; zeros, short fractions and roots are "
            "exact. Write one number for all, a number for each place, or digits: then every "
            "decimal is off by one unit of its last digit at most.",
            page=f"{_PAGE}rounded-coefficients",
        ),
        g.Key(
            'expect: {order: 4, pair-order: ">= 2"}',
            EXPECT,
            "Claims that gark check confirms; gark claims FILE --write puts the true ones there.",
            page=f"{_PAGE}expect",
            also=("claims",),
        ),
    )
}
KEYS_OF_METHOD = ("name", *FORMS, *PLAIN, *BESIDE, "transfer", "structure", "conjugate", "linear")
_TWO_COLOURS = g.KeyValues(
    {"type": "array", "minItems": 2},
    lambda node: isinstance(node, SequenceNode) and len(node.value) > 1,
)
_NOT_GENERAL = g.KeyValues(
    {"not": {"const": "general"}}, lambda node: bool(node.value != "general")
)
_SEMI_SEPARABLE = g.KeyValues(
    {"const": "semi-separable"}, lambda node: bool(node.value == "semi-separable")
)
FORM = g.Ways(
    "the coefficients are",
    (*FORMS, "unknown", g.Together(("A", "b"), ("c",))),
    "no coefficients",
    "give A and b, or one of the keys methods, tableau, ark, prk, shu-osher, "
    "low-storage, rosenbrock, nystrom, nprk, derivatives",
)
"""A, b and c at the top are those of a tableau."""
_INSIDE: dict[str, str] = dict.fromkeys(
    CONSTRUCTIONS, "give it beside the coefficients of the methods inside"
)
_SPELL_OUT: dict[str, str] = dict.fromkeys(
    CONSTRUCTIONS, "gark tableau --format yaml spells the method out, for them"
)
BESIDE_FORM: tuple[g.KeyRelation, ...] = (
    g.KeyRelation(
        "methods",
        "two or more methods need a transfer rule",
        "write transfer: collocation (or interpolation)",
        needs=("transfer",),
        code="missing-key",
        values=_TWO_COLOURS,
    ),
    g.KeyRelation("transfer", "transfer goes with methods, not with {way}", needs=("methods",)),
    g.KeyRelation("linear", "linear goes with tableau, not with {way}", needs=("tableau", "A")),
    *(
        g.KeyRelation(
            key,
            f"{key} belongs beside b, which is missing",
            {
                "methods": "write it in each of the methods",
                **_SPELL_OUT,
                "unknown": "write embedded: true under unknown"
                if key == "embedded"
                else "spell A and b out",
                "": "write it inside of {way}, beside b",
            },
            needs=("A",),
            code="missing-key",
        )
        for key in BESIDE
    ),
    g.KeyRelation(
        "predictor",
        "predictor belongs beside b of a Butcher tableau, which is missing",
        "gark tableau --format yaml spells the method out, for it",
        needs=("A", "tableau"),
        code="missing-key",
    ),
    g.KeyRelation(
        "structure",
        "structure does not go with {way}",
        {**_INSIDE, "ark": "use methods, tableau or prk", "": "write absent blocks as null"},
        needs=("methods", "prk", "unknown", "splitting"),
        values=_NOT_GENERAL,
    ),
    g.KeyRelation(
        "structure",
        "a prk cannot be semi-separable: that takes two Hamiltonians",
        "use methods",
        bars=("prk",),
        values=_SEMI_SEPARABLE,
    ),
)


@cache
def elsewhere() -> Mapping[str, Home]:
    every = (x for x in KEYS.values() if x.name != "parameters")  # has keys below other names
    return g.homes([KEYS["expect"], *every])


def method_file_schema() -> g.Schema:
    """The JSON Schema of method files, as plain data, with the meaning of each key.

    >>> method_file_schema()["title"]
    'gark method file'
    """
    from garkcli.methodfile.diagonal import FAMILY

    name: g.Schema = {
        "type": "string",
        "description": "A single method of a family, or a name of the catalogue.",
    }
    rules: tuple[g.Rule, ...] = (FORM, *BESIDE_FORM)
    return g.file_schema(
        "gark method file",
        "One Runge-Kutta method: GARK, ARK, PRK, or built from diagonal methods.",
        g.mapping(*KEYS.values(), rules=rules),
        definitions={
            **DEFINITIONS,
            "dense": spelled_out.DENSE.schema(),
            "predictor": spelled_out.PREDICTOR.schema(),
            "butcher": spelled_out.BUTCHER.schema(),
            "method": {"oneOf": [FAMILY.schema(), g.defined("butcher").schema()]},
            "part": {
                "anyOf": [
                    name,
                    FAMILY.schema(),
                    g.mapping(*(KEYS[key] for key in KEYS_OF_METHOD), rules=rules).schema(),
                ]
            },
            "rule": g.later("garkcli.methodfile.transfers", "RULE").schema(),
        },
    )


def told(kind: FileKind) -> Iterable[KeyMeaning]:
    return g.told(KEYS.values(), kind.page)
