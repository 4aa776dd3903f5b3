"""Every form of a file gives the tableau that the direct construction gives."""

from pathlib import Path

import pytest
from flint import fmpq

from garkcli.exact.field import Number
from garkcli.families.registry import BY_STAGES, diagonal_method
from garkcli.methodfile.load import loads
from garkcli.methodfile.naming import find_files
from garkcli.order.admissible import coupling_graph
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import (
    additive,
    gark,
    pair,
    partitioned,
    separable_prk,
    spelled_out,
    symplectic_pair,
    with_linear,
)
from garkcli.tableau.tableau import Tableau, butcher
from garkcli.transfer import PAIR_RULES, RULES, combination, symplectic_blocks

GAUSS, LOBATTO = (diagonal_method("gauss", 2), diagonal_method("lobatto-iiia", 3))
TWO = "methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]\n"


def rows(*lines: str) -> tuple[tuple[Number, ...], ...]:
    """A matrix from lines of fractions."""
    return tuple(tuple(fmpq(*map(int, word.split("/"))) for word in line.split()) for line in lines)


def tableau(text: str) -> Tableau:
    """The tableau of a file."""
    return loads(text).tableau


def graph_of(found: Tableau) -> tuple[set[tuple[int, int]], set[int]]:
    """Which colours see which, and which are linear, both counted from 0."""
    graph = coupling_graph(found)
    colours = range(found.size)
    edges = {(l, m) for l in colours for m in graph.branches[l]}
    return edges, {l for l in colours if graph.is_linear(l)}


def coupled(rule: str) -> Tableau:
    """Gauss 2 and Lobatto IIIA 3 with both blocks made by a rule."""
    make = RULES[rule]
    return gark([GAUSS, LOBATTO], {(0, 1): make(GAUSS, LOBATTO), (1, 0): make(LOBATTO, GAUSS)})


@pytest.mark.parametrize("family", BY_STAGES)
def test_a_family_is_the_method_of_the_registry(family: str) -> None:
    """A one-colour file of any family is that diagonal method."""
    s = (
        max(BY_STAGES[family].smallest, 2)
        if not BY_STAGES[family].is_single
        else BY_STAGES[family].smallest
    )
    assert tableau(f"methods: [{{family: {family}, stages: {s}}}]") == gark(
        [diagonal_method(family, s)], {}
    )


@pytest.mark.parametrize("rule", RULES)
def test_a_rule_makes_every_block(rule: str) -> None:
    """``transfer: rule`` is that rule on every ordered pair of colours."""
    assert tableau(f"{TWO}transfer: {rule}") == coupled(rule)


@pytest.mark.parametrize("rule", PAIR_RULES)
def test_a_rule_for_pairs_builds_on_the_smaller_order(rule: str) -> None:
    """Of two methods of order 4 the one with fewer stages is built on, whichever colour it has."""
    blocks = symplectic_blocks(PAIR_RULES[rule], [GAUSS, LOBATTO], 0, 1)
    assert tableau(f"{TWO}transfer: {rule}") == gark([GAUSS, LOBATTO], blocks)
    swapped = "methods: [{family: lobatto-iiia, stages: 3}, {family: gauss, stages: 2}]\n"
    other = {(1 - l, 1 - m): block for (l, m), block in blocks.items()}
    assert tableau(f"{swapped}transfer: {rule}") == gark([LOBATTO, GAUSS], other)
    assert tableau(f'{TWO}transfer: {{blocks: {{"2,1": {rule}}}}}') == gark(
        [GAUSS, LOBATTO], blocks
    )


def test_a_combination_is_linear_in_its_weights() -> None:
    """The weights of eq. (lincomb) may be parameters, and the block is Σ τ A."""
    text = f"{TWO}parameters: {{tau: 1/3}}\ntransfer: {{interpolation: tau, collocation: 1 - tau}}"
    terms = [(fmpq(1, 3), RULES["interpolation"]), (fmpq(2, 3), RULES["collocation"])]
    blocks = {
        (0, 1): combination(terms, GAUSS, LOBATTO),
        (1, 0): combination(terms, LOBATTO, GAUSS),
    }
    assert tableau(text) == gark([GAUSS, LOBATTO], blocks)


def test_an_exception_replaces_the_default_of_its_block_alone() -> None:
    """The key "2,1" is A^{2,1}: in the rows of colour 2 and the columns of colour 1."""
    text = f'{TWO}transfer: {{default: collocation, blocks: {{"2,1": interpolation}}}}'
    blocks = {
        (0, 1): RULES["collocation"](GAUSS, LOBATTO),
        (1, 0): RULES["interpolation"](LOBATTO, GAUSS),
    }
    assert tableau(text) == gark([GAUSS, LOBATTO], blocks)


def test_a_spelled_out_block_stands_as_it_is_written() -> None:
    """A matrix under ``blocks`` is the block, s_l rows by s_m columns."""
    text = """
    methods: [{A: [[1/2]], b: [1]}, {A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}]
    transfer: {default: collocation, blocks: {"1,2": [[1/3, 1/6]]}}
    """
    methods = [
        butcher(rows("1/2"), rows("1")[0]),
        butcher(rows("0 0", "1/2 1/2"), rows("1/2 1/2")[0]),
    ]
    blocks = {(0, 1): rows("1/3 1/6"), (1, 0): RULES["collocation"](methods[1], methods[0])}
    assert tableau(text) == gark(methods, blocks)


def test_a_block_beside_a_family_is_exact_in_its_nodes() -> None:
    """The paper's A^{2,1}, in radicals beside two families, gives what collocation gives: order and
    bound.
    """
    text = f"""{TWO}transfer:
  default: collocation
  blocks: {{"2,1": [[0, 0], [1/4 + sqrt(3)/8, 1/4 - sqrt(3)/8], [1/2, 1/2]]}}
"""
    from garkcli.tableau.pointwise import entries

    assert str(entries(tableau(text)).A) == str(entries(coupled("collocation")).A)


def test_a_spelled_out_tableau_is_its_blocks() -> None:
    """Every block, absent block, node and weight of ``tableau`` is taken over, and ``linear`` marks
    colours.
    """
    text = """
    tableau: {c: [[1/2], [0, 1]], A: [[null, [[1/2, 0]]], [[[0], [1]], ~]], b: [[1], [1/2, 1/2]]}
    linear: [1]
    """
    A = [[None, rows("1/2 0")], [rows("0", "1"), None]]
    b = [rows("1")[0], rows("1/2 1/2")[0]]
    assert tableau(text) == spelled_out(A, b, [rows("1/2")[0], rows("0 1")[0]], [0])
    assert graph_of(tableau(text)) == ({(0, 1), (1, 0)}, {0})


def test_nodes_default_to_row_sums() -> None:
    """Without ``c`` the nodes are the row sums of A^{l,l}, with ``c`` they are what the file
    says.
    """
    blocks = "A: [[[[1/4, 1/4], [1/3, 1/3]]]], b: [[1/2, 1/2]]"
    assert tableau(f"tableau: {{{blocks}}}").colours[0].c == (fmpq(1, 2), fmpq(2, 3))
    assert tableau(f"tableau: {{{blocks}, c: [[0, 1]]}}").colours[0].c == (0, 1)


def test_an_additive_method_shares_its_stages() -> None:
    """``ark`` is one space for all colours, with a shared row of weights or a row each."""
    A = [rows("0 0", "1 0"), rows("0 0", "1/2 1/2")]
    b = rows("1/2 1/2")[0]
    text = "ark: {A: [[[0, 0], [1, 0]], [[0, 0], [1/2, 1/2]]], b: "
    assert tableau(f"{text}[1/2, 1/2]}}") == additive(A, [b, b], None)
    assert tableau(f"{text}[[1/2, 1/2], [0, 1]], c: [0, 1/3]}}") == additive(
        A, [b, rows("0 1")[0]], rows("0 1/3")[0]
    )


PRK = "prk: {q: {A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}, p: {A: [[1/2, 0], [1/2, 0]], b: [1/2, 1/2], c: [0, 1]}}\n"


def test_a_partitioned_method_takes_its_parts() -> None:
    """``prk`` is ``partitioned`` for a general problem; separable, and with linear velocities for
    nystrom.
    """
    b = rows("1/2 1/2")[0]
    Q, P = rows("0 0", "1/2 1/2"), rows("1/2 0", "1/2 0")
    assert tableau(PRK) == partitioned(butcher(Q, b), butcher(P, b, rows("0 1")[0]))
    separable = separable_prk((Q, b, None), (P, b, rows("0 1")[0]))
    assert tableau(f"{PRK}structure: separable") == separable
    assert tableau(f"{PRK}structure: nystrom") == with_linear(separable, ["q"])
    assert tableau(f"{PRK}conjugate: true") == conjugate(tableau(PRK))


@pytest.mark.parametrize(
    ("structure", "velocities", "forces", "linear", "graph"),
    [
        (
            "semi-separable",
            [0],
            [0, 1],
            [],
            {(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2), (2, 0)},
        ),
        ("separable", [0], [1], [], {(0, 1), (1, 0)}),
        ("nystrom", [0], [1], ["V1"], {(0, 1), (1, 0)}),
    ],
)
def test_a_structure_keeps_the_vector_fields_of_its_problem(
    structure: str,
    velocities: list[int],
    forces: list[int],
    linear: list[str],
    graph: set[tuple[int, int]],
) -> None:
    """With ``methods``, a structure is the symplectic pair with the colours the problem has, and no
    others.
    """
    found = tableau(f"{TWO}transfer: collocation\nstructure: {structure}")
    assert found == with_linear(symplectic_pair(coupled("collocation"), velocities, forces), linear)
    assert graph_of(found) == (graph, {0} if linear else set())


def test_conjugate_true_is_the_conjugate() -> None:
    """``conjugate: true`` is the symplectic conjugate of what the file says, ``false`` is the
    file.
    """
    assert tableau(f"{TWO}transfer: collocation\nconjugate: true") == conjugate(
        coupled("collocation")
    )
    assert tableau(f"{TWO}transfer: collocation\nconjugate: false") == coupled("collocation")
    assert loads(f"{TWO}transfer: collocation\nconjugate: true").is_conjugate


def test_a_general_file_is_not_paired() -> None:
    """Without a structure the tableau is Q alone: N colours, not 2N."""
    found = tableau(f"{TWO}transfer: collocation")
    assert (found.size, pair(found).size) == (2, 4)


def test_the_parts_of_a_file_are_kept() -> None:
    """Name, description, reference, tolerance, form and structure arrive as written."""
    method = loads(
        f"{TWO}transfer: collocation\nname: N\ndescription: D\nreference: R\ntolerance: 1e-3", "s"
    )
    assert (method.name, method.description, method.reference) == ("N", "D", "R")
    assert (method.source, method.form, method.structure) == ("s", "methods", "general")
    assert loads("tolerance: 1e-3\nA: [[0.25]]\nb: [1]").tolerance == fmpq(1, 1000)
    assert method.tolerance is None  # nothing in it is rounded
    assert loads(TWO + "transfer: collocation", "s").name == "s"


def test_patterns_and_directories_stand_for_their_files(tmp_path: Path) -> None:
    """A pattern means what it matches, a directory its method files, and what means nothing is
    kept.
    """
    (tmp_path / "deep").mkdir()
    for name in ("b.gark.yaml", "a.gark.yaml", "deep/c.gark.yaml", "other.yaml"):
        (tmp_path / name).write_text("methods: [{family: rk4}]\n")

    def found(*paths: str) -> list[str]:
        return [
            Path(x).relative_to(tmp_path).as_posix()
            for x in find_files(str(tmp_path / p) for p in paths)
        ]

    assert found("") == ["a.gark.yaml", "b.gark.yaml", "deep/c.gark.yaml"]
    assert found("*.yaml") == ["a.gark.yaml", "b.gark.yaml", "other.yaml"]
    assert found("**/c*", "b.gark.yaml") == ["deep/c.gark.yaml", "b.gark.yaml"]
    assert found("none*") == ["none*"]
    assert list(find_files(["-"])) == ["-"]
