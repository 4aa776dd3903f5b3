"""Unknown entries and shapes of tableaus: classical methods from nothing but their stages."""

from __future__ import annotations

import re
from itertools import chain
from pathlib import Path

import pytest
from flint import fmpq

from garkcli import find_order, find_property, load, loads
from garkcli.check.analysis import inconsistent_blocks
from garkcli.design.choices import accepted_methods
from garkcli.design.design import Design, find_parameters
from garkcli.design.solutions import value_at
from garkcli.errors import MethodError, MethodFileError
from garkcli.methodfile.family import loads_family, with_values
from garkcli.methodfile.shapes import SHAPES, layout_of
from garkcli.order.constants import error_constants
from garkcli.tableau.embedded import with_weights
from tests.cli.harness import gark
from tests.whole import in_whole


def shaped(stages: int, shape: str) -> str:
    """A file of some stages and a shape."""
    return f"unknown: {{stages: {stages}, shape: {shape}}}\n"


def dimensions(found: Design) -> list[int]:
    """Of the methods of each order."""
    return [step.ideal.dimension for step in found.steps if step.ideal is not None]


def decimals(found: Design, name: str) -> list[float]:
    """The real values of one unknown at the last order, ascending."""
    values = []
    for one in found.last.found:
        for root in one.solution.real:
            value = value_at(one.solution.values[name], root)
            values.append(float(value.ball(80)))
    return sorted(values)


def test_entries_are_named_by_their_place() -> None:
    """One colour, several, shared stages and two parts: names do not collide."""
    one = loads_family('A: [["?", "?"], [0, 0]]\nb: ["?", 1]\n')
    assert one.parameters == ("a11", "a12", "b1")
    blocks = 'A: [[[["?"]], [["?"]]], [[["?"]], [["?"]]]]\nb: [["?"], ["?"]]\n'
    several = ("a11_11", "a12_11", "a21_11", "a22_11", "b1_1", "b2_1")
    assert sorted(loads_family(blocks).parameters) == sorted(several)
    ark = 'ark:\n  A: [[["?"]], [["?"]]]\n  b: ["?"]\n'
    assert sorted(loads_family(ark).parameters) == ["a1_11", "a2_11", "b1"]
    prk = 'prk:\n  q: {A: [["?"]], b: ["?"]}\n  p: {A: [["?"]], b: ["?"]}\n'
    names = ["p_a11", "p_b1", "q_a11", "q_b1"]
    assert sorted(loads_family(prk).parameters) == names


NODES = 'A: [[0, 0], ["?", 0]]\nb: ["?", "?"]\nc: [0, {}]\n'


def test_given_nodes_are_data() -> None:
    """As in ``gark check``, order conditions do not depend on nodes: the methods of order 2 are
    those without them, one with other row sums among them, and ``gark check`` says order 2 of it.
    """
    found = find_parameters(loads_family(NODES.format("1/3")), 2)
    without = find_parameters(loads_family(NODES.replace("c: [0, {}]\n", "")), 2)
    assert dimensions(found) == dimensions(without) == [2, 1]
    values = {"a21": "1", "b1": "1/2", "b2": "1/2"}
    taken = find_parameters(loads_family(NODES.format("1/3"), settings={"a21": "1"}), 2)
    (one,) = taken.last.found
    assert {x: str(one.solution.values[x]) for x in ("b1", "b2")} == {"b1": "1/2", "b2": "1/2"}
    method = loads(NODES.format("1/3"), settings=values)
    assert find_order(method).order == 2
    assert inconsistent_blocks(method.tableau) == ((0, 0),)


def test_nodes_that_are_wanted_as_row_sums() -> None:
    """``consistent``: with c₂ given the one method of order 2 is found; a node of its own is no
    freedom more. Of two colours each block is meant, or those of the rows that are named.
    """
    text = NODES + "design: {{consistent: true}}\n"
    found = find_parameters(loads_family(text.format("1/3")), 2)
    (one,) = found.last.found
    assert list(map(str, one.solution.values.values())) == ["1/3", "-1/2", "3/2"]
    free = find_parameters(loads_family(text.format('"?"')), 2)
    assert dimensions(free) == [2, 1]
    blocks = 'A: [[[["?"]], [["?"]]], [[["?"]], [["?"]]]]\nb: [[1], [1]]\nc: [[1/2], [1/3]]\n'
    for wish, expected in (("true", ["1/2", "1/2", "1/3", "1/3"]), ("{2: true}", ["1/3", "1/3"])):
        family = loads_family(f"{blocks}design: {{consistent: {wish}}}\n")
        fixed = find_parameters(family, 1).last
        assert fixed.ideal is not None
        assert fixed.ideal.dimension == 4 - len(expected)
        for name, value in zip(sorted(family.parameters)[-len(expected) :], expected, strict=True):
            p, q = map(int, value.split("/"))
            assert fixed.ideal.contains(family.ring.parameter(name).numerator - fmpq(p, q))


@pytest.mark.parametrize("form", ["entries", "shape"])
def test_explicit_methods_of_two_stages(form: str) -> None:
    """Order 2 is the family b₂ = 1/(2 c₂), order 3 none; entries and shape say the same."""
    text = 'A: [[0, 0], ["?", 0]]\nb: ["?", "?"]\n'
    if form == "shape":
        text = shaped(2, "explicit")
    found = find_parameters(loads_family(text))
    assert [step.kind for step in found.steps] == ["family", "family", "none"]
    assert dimensions(found) == [2, 1, -1]
    node = "a21" if form == "entries" else "c2"
    chosen = find_parameters(loads_family(text, settings={node: "2/3"}), 2)
    (one,) = chosen.last.found
    assert list(map(str, one.solution.values.values())) == ["1/4", "3/4"]


def test_explicit_methods_of_three_stages() -> None:
    """Order 3 is a family of dimension 2 (Kutta), order 4 none."""
    found = find_parameters(loads_family(shaped(3, "explicit")))
    assert dimensions(found) == [5, 4, 2, -1]


def test_singly_diagonally_implicit_methods() -> None:
    """Two stages: order 3 for both γ of Nørsett; three: order 4 for three γ, one of them Crouzeix's
    (1 + 2 cos(π/18)/√3)/2.
    """
    two = find_parameters(loads_family(shaped(2, "sdirk")), 3)
    assert decimals(two, "gamma") == pytest.approx([0.2113248654, 0.7886751346])
    three = find_parameters(loads_family(shaped(3, "sdirk")), 4)
    gammas = [0.1288864005, 0.3025345782, 1.0685790213]
    assert decimals(three, "gamma") == pytest.approx(gammas)


def test_gauss_from_two_stages() -> None:
    """Two stages, order 4: Gauss's nodes, in both orders, and order 5 for none."""
    found = find_parameters(loads_family(shaped(2, "full")), 4)
    nodes = pytest.approx([0.2113248654, 0.7886751346])
    assert decimals(found, "c1") == nodes
    assert decimals(found, "c2") == nodes


@pytest.mark.parametrize(("stages", "order", "real"), [(3, 4, 1), (5, 4, 0)])
def test_symmetric_compositions(stages: int, order: int, real: int) -> None:
    """Three midpoint rules, the same backwards: order 4 for one real solution, with
    b₁ = 1/(2 − ∛2); five leave a family.
    """
    text = shaped(stages, "[symplectic-dirk, palindromic]")
    found = find_parameters(loads_family(text), order)
    if not real:
        assert (found.last.kind, dimensions(found)[-1]) == ("family", 1)
        return
    assert decimals(found, "b1") == pytest.approx([1 / (2 - 2 ** (1 / 3))])
    assert sum(x.solution.degree for x in found.last.found) == 3


def test_shapes_do_what_they_say() -> None:
    """Each shape on three stages, entry by entry."""
    (rows,) = layout_of(3, ["esdirk", "stiffly-accurate"]).A
    assert rows == (("0", "0", "0"), ("c2 - gamma", "gamma", "0"), ("b1", "b2", "gamma"))
    assert layout_of(2, ["splitting"]).A == ((("a1", "0"), ("a1", "a2")), (("0", "0"), ("b1", "0")))
    explicit, implicit = layout_of(2, ["imex"]).A
    assert explicit == (("0", "0"), ("c2", "0"))
    assert implicit == (("0", "0"), ("c2 - gamma", "gamma"))
    for name in SHAPES:
        shape = SHAPES[name]
        assert (shape.name, bool(shape.summary)) == (name, True)


def test_first_same_as_last() -> None:
    """Explicit and stiffly accurate: the last weight is 0. Four stages of order 3 with the nodes 1/2
    and 3/4 are the method of Bogacki and Shampine (Appl. Math. Lett. 2, 1989).
    """
    text = "unknown: {stages: 4, shape: [explicit, stiffly-accurate]}\n"
    family = loads_family(f"{text}design: {{order: 3, fix: {{c2: 1/2, c3: 3/4}}}}\n")
    chosen = next(accepted_methods(find_parameters(family, 3)))
    method = loads(with_values(family, chosen.values, "any", "order: 3"))
    A, b = method.tableau.block(0, 0), method.tableau.colours[0].b
    assert A is not None
    assert list(map(str, b)) == ["2/9", "1/3", "4/9", "0"]
    assert A[-1] == b
    assert find_property(method, "fsal").value is True


@pytest.mark.parametrize("shape", ["[full, palindromic]", "[dirk, palindromic]"])
def test_palindromes_are_symmetric(shape: str) -> None:
    """Whatever the unknowns are, the method is its own adjoint: odd orders come for nothing."""
    family = loads_family(shaped(3, shape))
    values = {}
    for k, name in enumerate(family.parameters):
        values[name] = f"{k + 1}/{2 * k + 3}"
    method = loads(with_values(family, values, "any", "order: 0"))
    A, b = method.tableau.block(0, 0), method.tableau.colours[0].b
    for i in range(3):
        for j in range(3):
            assert A[2 - i][2 - j] == b[2 - j] - A[i][j]


def test_colours_share_unknown_embedded_weights() -> None:
    """A row of unknowns for both colours has one name an entry, also where one gets its value; a row
    a colour has others.
    """
    text = "ark:\n  A: [[[0, 0], [1, 0]], [[0, 0], [0, 1]]]\n  b: [1/2, 1/2]\n"
    wanted = "design: {embedded-order: 1}\n"
    shared = loads_family(f"{text}  embedded: ['?', '?']\n{wanted}")
    assert shared.parameters == ("bh1", "bh2")
    given = loads_family(f"{text}  embedded: ['?', '?']\n{wanted}", settings={"bh1": "1/3"})
    (method,) = accepted_methods(find_parameters(given, 2))
    assert method.values == {"bh2": "2/3"}
    apart = loads_family(f"{text}  embedded: [['?', '?'], ['?', '?']]\n{wanted}")
    assert len(apart.parameters) == 4


def test_two_registers() -> None:
    """The tableau of register steps is that of a method file in the form 2N with these numbers."""
    family = loads_family("unknown: {stages: 4, shape: low-storage}\n")
    assert set(family.parameters) == {"B1", "B2", "B3", "B4", "A2", "A3", "A4"}
    values = {name: f"{k + 1}/{k + 3}" for k, name in enumerate(sorted(family.parameters))}
    A = [values[f"A{i}"] for i in (2, 3, 4)]
    B = [values[f"B{i}"] for i in (1, 2, 3, 4)]
    method = loads(with_values(family, values, "any", "order: 0"))
    registers = loads(f"low-storage: {{form: 2N, A: [0, {', '.join(A)}], B: [{', '.join(B)}]}}\n")
    assert method.tableau.block(0, 0) == registers.tableau.block(0, 0)
    assert method.tableau.colours[0].b == registers.tableau.colours[0].b


def test_palindromic_splittings_are_symmetric() -> None:
    """The last map is the first one again: four stages of order 4 are the method of E. Forest and
    R. Ruth (1990) with a₁ = 1/(2(2 − ∛2)); every member is symmetric.
    """
    text = "unknown: {stages: 4, shape: [splitting, palindromic]}\n"
    found = find_parameters(loads_family(text), 4)
    assert decimals(found, "a1") == pytest.approx([1 / (2 * (2 - 2 ** (1 / 3)))])
    family = loads_family("unknown: {stages: 5, shape: [splitting, palindromic]}\n")
    assert family.parameters == ("a1", "a2", "a3", "b1", "b2")
    values = {name: f"{k + 1}/{2 * k + 3}" for k, name in enumerate(family.parameters)}
    method = loads(with_values(family, values, "any", "order: 0"))
    assert find_property(method, "symmetric").value is True


@pytest.mark.parametrize(
    "shapes", [["explicit", "palindromic"],
               ["sdirk", "palindromic"], ["splitting", "stiffly-accurate"],
               ["sdirk", "imex"]],
)  # fmt: skip
def test_shapes_that_do_not_go_together(shapes: list[str]) -> None:
    """They are refused, with a cure."""
    with pytest.raises(MethodError) as caught:
        layout_of(3, shapes)
    assert caught.value.help


@pytest.mark.parametrize(
    ("text", "order"),
    [
        (shaped(2, "sdirk"), 3),
        (shaped(3, "[symplectic-dirk, palindromic]"), 4),
        ('A: [["?"]]\nb: ["?"]\n', 2),
    ],
)
def test_what_is_found_is_a_method_file(text: str, order: int) -> None:
    """The file that is written spells the tableau out and has the order."""
    family = loads_family(text)
    chosen = next(accepted_methods(find_parameters(family, order)))
    written = with_values(family, chosen.values, "head", f"order: {chosen.order}")
    method = loads(written)
    assert not re.search(r"unknown:|\?", written)
    assert [x.value for x in method.claims] == [order]
    assert find_order(method).order == order


@pytest.mark.parametrize("shape", ["imex", "splitting", "[esdirk, stiffly-accurate]"])
def test_a_shape_with_values_is_a_method_file(shape: str) -> None:
    """Parts on shared stages and parts of their own are spelled out too."""
    family = loads_family(shaped(2, shape))
    values = dict.fromkeys(family.parameters, "1/2")
    method = loads(with_values(family, values, "head", "order: 0"))
    tableau = loads(shaped(2, shape), settings=values).tableau
    assert method.tableau.blocks == tableau.blocks


PAIR = """unknown: {stages: 4, shape: [explicit, stiffly-accurate], embedded: true}
design: {order: 3, embedded-order: 2, fix: {c2: 1/2, c3: 3/4, bh1: 7/24, bh4: 1/8}}
"""


def test_an_embedded_pair() -> None:
    """P. Bogacki, L. F. Shampine (1989): the file that is written is the method of the catalogue,
    its embedded weights included; their error is that of the list of all trees.
    """
    family = loads_family(PAIR)
    found = find_parameters(family)
    [one] = found.last.found
    assert one.embedded is not None
    order, error = one.embedded
    method = next(accepted_methods(found))
    written = loads(with_values(family, method.values, "head", "embedded-order: 2"))
    known = load("bogacki-shampine-3")
    assert written.tableau.blocks == known.tableau.blocks
    assert written.embedded is not None
    assert written.embedded == known.embedded
    listed = error_constants(with_weights(written.tableau, written.embedded), 3)
    assert listed is not None
    assert (order.order, method.embedded, error) == (2, 2, listed.all.two_squared)
    assert find_order(with_weights(written.tableau, written.embedded)).order == 2


def test_embedded_entries() -> None:
    """b̂ of order 1 beside explicit methods of order 2 with two stages: b̂₁ + b̂₂ = 1 alone; of
    order 2 they are the weights b, as both have as many conditions as entries.
    """
    text = 'A: [[0, 0], ["?", 0]]\nb: ["?", "?"]\nembedded: ["?", "?"]\n'
    assert loads_family(text).parameters == ("a21", "b1", "b2", "bh1", "bh2")
    first, second = (
        find_parameters(loads_family(f"{text}design: {{order: 2, embedded-order: {k}}}"))
        for k in (1, 2)
    )
    assert dimensions(first)[-1] == 2
    ring = first.family.ring
    ideal = second.last.ideal
    assert ideal is not None
    assert ideal.dimension == 1
    b, bh = (ring.context.gen(ring.names.index(x)) for x in ("b2", "bh2"))
    assert ideal.contains(b - bh)


def test_embedded_weights_are_those_of_the_method() -> None:
    """One stage of order 2 is the midpoint rule, and so is its conjugate: b̂ = 1 has order 2 with the
    method, and is no part of the conjugate.
    """
    family = loads_family('A: [["?"]]\nb: ["?"]\nembedded: [1]\n')
    [method] = find_parameters(family, 2).last.found
    [conjugate] = find_parameters(family, 2, "conjugate").last.found
    assert method.solution.values == conjugate.solution.values
    assert method.solution.values == {"a11": fmpq(1, 2), "b1": 1}
    assert method.embedded is not None
    assert method.embedded[0].order == 2
    assert conjugate.embedded is None


def test_embedded_weights_that_are_not_there(tmp_path: Path) -> None:
    """Their order is not wanted of methods without them, nor of a single colour."""
    path = tmp_path / "family.yaml"
    path.write_text('A: [["?"]]\nb: ["?"]\ndesign: {embedded-order: 1}\n')
    run = gark("design", str(path))
    assert (run.code, "embedded: true under unknown" in run.err) == (2, True)


@pytest.mark.parametrize(
    ("shape", "parts"), [("imex", 1), ("splitting", 2), ("[explicit, stiffly-accurate]", 1)]
)
def test_embedded_shapes_are_spelled_out(shape: str, parts: int) -> None:
    """The file that is written has the embedded weights of each form."""
    family = loads_family(f"unknown: {{stages: 2, shape: {shape}, embedded: true}}")
    values = {name: f"{k}/7" for k, name in enumerate(family.parameters, 1)}
    method = loads(with_values(family, values, "head", "order: 0"))
    hats = [f"{x}h{i}" for x in "ab"[:parts] for i in (1, 2)] if parts > 1 else ["bh1", "bh2"]
    expected = [fmpq(family.parameters.index(x) + 1, 7) for x in hats]
    assert method.embedded is not None
    assert list(dict.fromkeys(chain(*method.embedded))) == expected


def test_parameters_beside_a_shape() -> None:
    """A parameter of the name of an unknown is that unknown, here gamma, with its value and its
    range; another one is used in what is fixed. All of them are in the file that is written.
    """
    head = "parameters: {t: 1/4, gamma: {free: true, range: [1/2, 1]}}  # the diagonal\n"
    text = f"{head}{shaped(2, 'sdirk')}design: {{order: 2, fix: {{c2: 4*t*gamma, b2: 1/2}}}}\n"
    family = loads_family(text)
    assert family.parameters == ("gamma", "c2", "b1", "b2")
    found = find_parameters(family)
    [one] = found.last.found
    assert (decimals(found, "gamma"), one.accepted) == ([0.5], (0,))
    method = next(accepted_methods(found))
    written = with_values(family, method.values, "head", "order: 2")
    assert written.count("parameters:") == 1
    assert "t: 1/4" in written
    assert find_order(loads(written)).order == 2
    assert loads(written).tableau.block(0, 0) == ((fmpq(1, 2), 0), (0, fmpq(1, 2)))


def test_as_a_command(tmp_path: object) -> None:
    """Choosing every unknown of a shape leaves a method that commands take; too few are named."""
    path = f"{tmp_path}/shape.yaml"
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(shaped(2, "explicit"))
    run = gark("design", path, "--order", "2")
    assert (run.code, "2*c2*b2 - 1" in run.out) == (0, True)
    left = gark("design", path, "--set", "d2=1")
    assert (left.code, "one of: c2, b1, b2" in left.err) == (2, True)


def test_the_misspelt_key_is_read_on() -> None:
    """``unknown`` misspelt is one fault that says so, and what it says is read as meant."""
    with pytest.raises(MethodFileError) as told:
        loads_family("unknwon: {stages: 2, shape: sdirk}\n")
    assert [(fault.line, fault.column, fault.help) for fault in told.value.faults] == [
        (1, 1, "did you mean 'unknown'?")
    ]


@pytest.mark.parametrize(
    "text",
    [
        "parameters: {t: free}\nmethods: [{A: [[t]], b: [1]}, {A: [[1/2]], b: [1]}]\n"
        "transfer: symplectic-collocation",
        "methods: [gauss-2, lobatto-iiia-4]\n"
        'transfer: {default: symplectic-collocation, blocks: {"1,2": "?"}}',
    ],
)
def test_symplectic_rules_compare_orders_of_numbers(text: str) -> None:
    """Which block they start from depends on the orders: one fault, not one a block."""
    with pytest.raises(MethodFileError) as found:
        loads_family(text)
    assert str(found.value).count("a symplectic- rule compares orders of numbers") == 1


@pytest.mark.parametrize(
    ("text", "cure"),
    [
        ("unknown: {stages: 2, shape: sdirk}\nparameters: {gama: free}\n", "did you mean 'gamma'?"),
        ("unknown: {stages: 2, shape: sdirk}\nparameters: {gama: 1/4}\n", "did you mean 'gamma'?"),
        (
            'methods: [gauss-1, gauss-2]\ntransfer: {default: "?"}\n',
            'write transfer: "?", or blocks: {"1,2": "?"}',
        ),
        (
            'A: [[0, 0], ["?", 0]]\nb: ["?", "?"]\nembedded: "?"\n',
            "write ['?', '?'], one per stage",
        ),
        (
            "parameters: {g: free}\nA: [[g]]\nb: [1]\ndesign: {range: {g: [sqrt(2), sqrt(2)]}}\n",
            "write fix: {g: sqrt(2)}",
        ),
        ('A: [[0, 0], [1, 0]]\nb: "?"\n', "write ['?', '?'], one per stage"),
        ("A: ?\nb: [1]\n", "quote a text that begins with this sign"),
    ],
)
def test_cures_name_what_works(text: str, cure: str) -> None:
    """A parameter that nothing uses, ? where it has no place or no quotes, a range of one number."""
    with pytest.raises(MethodFileError) as told:
        loads_family(text)
    assert [fault.help for fault in told.value.faults] == [cure]


@pytest.mark.parametrize(
    ("parameters", "design"),
    [
        ("{t: free}", "fix: {c2: t, c3: 2*t}"),
        ("{t: 1/3}", "fix: {c2: t, c3: 2*t}"),
        ("{t: 1/3, c3: 2*t}", "fix: {c2: 1/3}"),
        ("{t: 1/3, c3: {free: true, range: [t, 1]}}", "fix: {c2: 1/3}"),
        ("{t: 1/3}", "range: {c2: [t, 1]}"),
    ],
)
def test_a_parameter_that_only_values_use(parameters: str, design: str) -> None:
    """Beside a shape it is no fault, as unknowns, their ranges and wishes may depend on it."""
    text = f"unknown: {{stages: 3, shape: explicit}}\nparameters: {parameters}\n"
    assert "c2" in loads_family(f"{text}design: {{{design}}}\n").parameters


RK3 = 'A: [[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]]\nb: [1/6, 2/3, 1/6]\nembedded: ["?", "?", "?"]\n'


@pytest.mark.parametrize(
    ("text", "order", "embedded", "is_b"),
    [
        ("unknown: {stages: 2, shape: explicit, embedded: true}\n", 2, 2, True),
        ("unknown: {stages: 2, shape: explicit, embedded: true}\n", 2, 1, False),
        pytest.param(
            "unknown: {stages: 4, shape: explicit, embedded: true}\n", 4, 4, True, marks=in_whole
        ),
        ("unknown: {stages: 4, shape: explicit, embedded: true}\n", 2, 2, False),
        (RK3, 3, 3, True),
        (RK3, 3, 2, False),
    ],
)
def test_embedded_weights_that_are_b(text: str, order: int, embedded: int, is_b: bool) -> None:
    """The report says where b alone has the embedded order: known by an ideal, in parts, or as a
    solution, whose values are compared too.
    """
    text += f"design: {{order: {order}, embedded-order: {embedded}}}\n"
    run = gark("design", "-", stdin=text)
    assert ("the embedded weights are b at every value" in " ".join(run.out.split())) is is_b
    found = find_parameters(loads_family(text))
    for one in found.last.found:
        values = [one.solution.values[f"bh{k}"] for k in (1, 2, 3)]
        assert (values == [fmpq(1, 6), fmpq(2, 3), fmpq(1, 6)]) is is_b
