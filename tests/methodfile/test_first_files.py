"""First files: what people write before they have read a page is a method, or has one fault a cause,
with the cure and the caret at the word.
"""

from __future__ import annotations

from time import process_time

import pytest
from flint import fmpq

from garkcli.errors import MethodFileError, Remark
from garkcli.methodfile.file_keys import KEYS, elsewhere
from garkcli.methodfile.load import loads
from garkcli.order.certificate import find_order
from garkcli.tableau.tableau import Tableau
from tests.fuzz.hostile import hostile_files
from tests.whole import in_whole

RK4 = "[[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]]"
SECONDS = 15.0
"""Of the processor; five where nothing else runs."""
TWO = "A: [[0, 0], [1/2, 0]]\n"


def tableau(text: str) -> Tableau:
    """The method of a file."""
    return loads(text).tableau


def faults(text: str) -> tuple[Remark, ...]:
    """What is wrong with a file."""
    with pytest.raises(MethodFileError) as caught:
        loads(text)
    return caught.value.faults


WAYS = {
    "a list of one": f"methods: [{{A: {RK4}, b: [1/6, 1/3, 1/3, 1/6]}}]",
    "methods without a list": f"methods: {{A: {RK4}, b: [1/6, 1/3, 1/3, 1/6]}}",
    "tableau": f"tableau: {{A: {RK4}, b: [1/6, 1/3, 1/3, 1/6]}}",
    "nothing around it": f"A: {RK4}\nb: [1/6, 1/3, 1/3, 1/6]",
    "with nodes": f"A: {RK4}\nb: [1/6, 1/3, 1/3, 1/6]\nc: [0, 1/2, 1/2, 1]",
    "blocks of one colour": f"tableau: {{A: [[{RK4}]], b: [[1/6, 1/3, 1/3, 1/6]]}}",
    "blocks at the top": f"A: [[{RK4}]]\nb: [[1/6, 1/3, 1/3, 1/6]]",
    "rows before the diagonal": "A: [[], [1/2], [0, 1/2], [0, 0, 1]]\nb: [1/6, 1/3, 1/3, 1/6]",
    "rows to the diagonal": "A: [[0], [1/2, 0], [0, 1/2, 0], [0, 0, 1, 0]]\nb: [1/6, 1/3, 1/3, 1/6]",
    "texts": f'{{"A": {RK4.replace("1/2", chr(34) + "1/2" + chr(34))}, "b": ["1/6", "1/3", "1/3", "1/6"]}}',
}


@pytest.mark.parametrize("way", WAYS)
def test_a_plain_butcher_tableau_is_one_method(way: str) -> None:
    """However it is typed in, RK4 is one method of one colour, the one of the registry."""
    assert tableau(WAYS[way]) == tableau("methods: [{family: rk4}]")


def test_one_family_needs_no_list() -> None:
    """A single mapping under methods is the list of one."""
    assert tableau("methods: {family: gauss, stages: 3}") == tableau(
        "methods: [{family: gauss, stages: 3}]"
    )


def test_triangles_are_completed_wherever_matrices_are_square() -> None:
    """A block on the diagonal and the matrices of an ark may end at the diagonal too."""
    short = "ark: {A: [[[], [1]], [[0], [0, 1]]], b: [1/2, 1/2]}"
    whole = "ark: {A: [[[0, 0], [1, 0]], [[0, 0], [0, 1]]], b: [1/2, 1/2]}"
    assert tableau(short) == tableau(whole)
    short = "tableau: {A: [[[[], [1]], null], [null, [[1]]]], b: [[1/2, 1/2], [1]]}"
    whole = "tableau: {A: [[[[0, 0], [1, 0]], null], [null, [[1]]]], b: [[1/2, 1/2], [1]]}"
    assert tableau(short) == tableau(whole)


@pytest.mark.parametrize(
    "text",
    [
        "A: [[]]\nb: [1]",
        "tableau: {A: [[]], b: [1]}",
        "methods: [{A: [[]], b: [1]}]",
        "tableau: {A: [[[[]]]], b: [[1]]}",
        "tableau: {A: [[[[]], [[1]]], [[[1/2]], [[]]]], b: [[1], [1]]}",
        "ark: {A: [[[]], [[1]]], b: [1]}",
        "prk: {q: {A: [[]], b: [1]}, p: {A: [[1]], b: [1]}}",
        "prk: {q: {A: [[]], b: [1]}, p: {A: [[1]], b: [1]}}\nstructure: separable",
        "compose: {of: {A: [[]], b: [1]}, steps: [1/2, 1/2]}",
        "methods: [rk4, rk4]\ntransfer: {blocks: {'1,2': [[]], '2,1': [[]]}}".replace(
            "rk4", "{A: [[1/2]], b: [1]}"
        ),
        "methods: [{A: [[1]], b: [1]}, {A: [[]], b: [1]}]\ntransfer: collocation",
    ],
)
def test_a_single_stage_has_the_short_form_too(text: str) -> None:
    """``[[]]`` is the strictly lower triangle of one stage, ``[[0]]``, wherever a matrix may be."""
    assert tableau(text) == tableau(text.replace("[[]]", "[[0]]").replace("[[[]]", "[[[0]]"))


def test_forward_euler_in_short() -> None:
    """Order 1, and 2 fails at [[]]: b·c = 0."""
    found = find_order(tableau("A: [[]]\nb: [1]"))
    assert (found.order, found.is_lower_bound) == (1, False)
    assert found.witness is not None
    assert found.witness.residual == fmpq(-1, 2)


def test_a_linear_colour_goes_with_a_plain_tableau() -> None:
    """``linear: [1]`` says of a plain tableau that its vector field is linear."""
    assert tableau(f"{TWO}b: [0, 1]\nlinear: [1]").colours[0].is_linear


ONE_FAULT = {
    # name: text, the words under the caret, a part of the message, a part of the help
    "Matlab's matrix": (
        "A: [0 0; 1/2 0]\nb: [0, 1]",
        "0 0; 1/2 0",
        "is a list",
        "[[0, 0], [1/2, 0]]",
    ),
    "no commas in a row": (f"{TWO}b: [0 1]", "[0 1]", "is a list", "[0, 1]"),
    "no commas in rows": (
        "A: [[0 0], [1/2 0]]\nb: [0, 1]",
        "[0 0]",
        "is a list",
        "[[0, 0], [1/2, 0]]",
    ),
    "no brackets": (f"{TWO}b: 0, 1", "0, 1", "is a list", "[0, 1]"),
    "a matrix as text": (
        "A: |\n  0 0\n  1/2 0\nb: [0, 1]",
        "0 0",
        "is a list",
        "[[0, 0], [1/2, 0]]",
    ),
    "another long b": (f"{TWO}b: [0, 1, 0]", "[0, 1, 0]", "b has 3 entries, A is 2 by 2", "stage"),
    "another long c": (f"{TWO}b: [0, 1]\nc: [0, 1/2, 1]", "[0, 1/2, 1]", "c has 3", "leave c out"),
    "A is one row": ("A: [[1/2, 1/2]]\nb: [1/2, 1/2]", "[[1/2, 1/2]]", "1 by 2", "b has 2 entries"),
    "uneven rows": ("A: [[0, 0], [1/2, 0, 0]]\nb: [0, 1]", "[1/2, 0, 0]", "row 2 has 3", "same"),
    "no empty first row": (
        "A: [[1/2], [0, 1]]\nb: [1/6, 2/3, 1/6]",
        "[[1/2], [0, 1]]",
        "2 rows for 3 stages",
        "begin with the empty row",
    ),
    "embedded weights": (
        f"{TWO}b: [[0, 1], [1, 0]]",
        "[[0, 1], [1, 0]]",
        "one matrix",
        "embedded: […]",
    ),
    "b is a row of a matrix": (f"{TWO}b: [[0, 1]]", "[[0, 1]]", "one matrix", "b: [0, 1]"),
    "embedded weights by name": (
        f"{TWO}b: [0, 1]\nbhat: [1, 0]",
        "bhat",
        "unknown key",
        "did you mean 'embedded'?",
    ),
    "one bracket more": ("A: [[[0, 0], [1/2, 0]]]\nb: [[0, 1]]", "[[[0", "list of matrices", "ark"),
    "blocks and a row": ("A: [[[[0, 0], [1/2, 0]]]]\nb: [0, 1]", "[0, 1]", "one row", "one colour"),
    "one matrix in an ark": (
        "ark: {A: [[0, 0], [1, 0]], b: [0, 1]}",
        "[[0",
        "one per colour",
        "tableau:",
    ),
    "no b": (TWO, "[[0", "b missing", "write A and b"),
    "no b in a tableau": ("tableau: {A: [[0]]}", "{A", "b missing", "write A and b"),
    "a bordered array": ("tableau: [[0, 0], [1, 1]]", "[[0", "a mapping", "{A: [[0, 0]"),
    "capitals": ("a: [[0]]\nb: [1]", "a", "unknown key 'a'", "'A'"),
    "a slip": ("methds: [{family: gauss, stages: 2}]", "methds", "unknown key", "'methods'"),
    "weights": ("A: [[0]]\nweights: [1]", "weights", "unknown key", "'b'"),
    "the claim at the top": (
        "A: [[0]]\nb: [1]\norder: 1",
        "order",
        "unknown key",
        "expect: {order",
    ),
    "a family at the top": (
        "family: gauss\nstages: 2",
        "family",
        "unknown keys",
        "methods: {family",
    ),
    "a word for a method": ("methods: [gauss]", "gauss", "a mapping", "{family: gauss, stages: 2}"),
    "a word for methods": ("methods: gauss", "gauss", "a list", "[{family: gauss"),
    "numbered methods": (
        "methods: {1: {family: gauss, stages: 2}}",
        "{1",
        "a list",
        "[{family: gauss",
    ),
    "Lobatto in capitals": (
        "methods: [{family: LobattoIIIA, stages: 3}]",
        "Lob",
        "no fam",
        "'lobatto-iiia'",
    ),
    "radau": (
        "methods: [{family: radau, stages: 2}]",
        "radau",
        "no family",
        "'radau-ia' or 'radau-iia'",
    ),
    "another name": (
        "methods: [{family: implicit-midpoint}]",
        "implicit-",
        "no family",
        "gauss with 1",
    ),
    "no such stages": (
        "methods: [{family: lobatto-iiia, stages: 1}]",
        "1",
        "does not exist",
        "2 or more",
    ),
    "a block under transfer": (
        "methods: [{family: gauss, stages: 2}, {family: gauss, stages: 1}]\n"
        'transfer: {"1,2": collocation}',
        '1,2"',
        "under blocks",
        'blocks: {"1,2"',
    ),
    "an unquoted block": (
        "methods: [{family: gauss, stages: 2}, {family: gauss, stages: 1}]\n"
        "transfer: {1,2: collocation}",
        "1,2",
        "under blocks",
        'blocks: {"1,2"',
    ),
    "a list of rules": (
        "methods: [{family: gauss, stages: 2}, {family: gauss, stages: 1}]\ntransfer: [collocation]",
        "[coll",
        "a mapping",
        "transfer: collocation",
    ),
    "sqrt without parentheses": (
        "A: [[1/4, 1/4 - sqrt3/6], [1/4 + sqrt3/6, 1/4]]\nb: [1/2, 1/2]",
        "sqrt3/6]",
        "'sqrt3' is not a parameter (also at 1:34)",
        "write sqrt(3)",
    ),
    "symbols without values": (
        "A: [[a11, a_12], [a21, a22]]\nb: [b1, b2]",
        "a11",
        "'a11' is not a parameter (also at 1:11, 1:19, 1:24 and in 2 more places)",
        "define it",
    ),
    "Fortran's exponents": (f"{TWO}b: [0.0d0, 1.0d0]", "0.0d0", "'0.0d0'", "with e: 0.0e0"),
    "Fortran's kinds": (
        f"{TWO}b: [0.5_dp, 0.25_dp]",
        "0.5_dp",
        "also at 2:13",
        "leave the kind out",
    ),
    "C's suffixes": (f"{TWO}b: [0.0f, 1.0f]", "0.0f", "also at 2:11", "leave the suffix out: 0.0"),
    "Python's math": (f"{TWO}b: [0, math.sqrt(2)]", "math.sqrt", "math.sqrt", "write sqrt(x)"),
    "Python's Fraction": (
        f"{TWO}b: [0, 'Fraction(1, 2)']",
        "Fraction",
        "Fraction",
        "write fractions as",
    ),
    "Julia's fractions": (f"{TWO}b: [1//2, 1//2]", "1//2", "also at 2:11", "write 1/2"),
    "LaTeX": (f"{TWO}b: [0, '\\frac{{1}}{{2}}']", "\\frac", "frac", "write fractions as 1/2"),
    "a root cut by YAML": (
        "A: [[1, root(3, 2)], [1, 1]]\nb: [0, 1]",
        "root(3",
        "a comma ends the value",
        '"root(x, n)"',
    ),
    "an undefined name": (
        "A: [[g, 0], [1 - g, g]]\nb: [g, 1 - g]",
        "g, 0",
        "'g' is not",
        "parameters: {g",
    ),
    "Infinity": (
        '{"A": [[0, 0], [Infinity, 0]], "b": [0, 1]}',
        "Infinity",
        "not a number",
        "finite",
    ),
    "an order for expect": ("A: [[0]]\nb: [1]\nexpect: 1", "1", "a mapping", "expect: {order: 4}"),
    "an equation": ("A = [[0]]\nb = [1]", "A =", "a mapping of keys", "A: in place of A ="),
    "a matrix of LaTeX": (
        "\\begin{array}{c|c}\n0 & 0 \\\\\n & 1\n\\end{array}",
        "\\begin",
        "a mapping of keys",
        "gark import FILE reads it",
    ),
    "a fraction of LaTeX": (
        "A: [[0, 0], [\\frac{1}{2}, 0]]\nb: [0, 1]",
        "{1}",
        "not YAML",
        "this looks like LaTeX",
    ),
    "a tableau with bars": (
        " 0  |\n1/2 | 1/2\n----+----\n    | 0  1",
        "0  |",
        "a mapping of keys",
        "gark new FILE --tableau -",
    ),
    "a table of a spreadsheet": (
        "0,,\n1/2,1/2,\n,0,1",
        "0,,",
        "a mapping of keys",
        "this looks like CSV",
    ),
    "no blank behind a colon": (
        "A:[[0, 0], [1/2, 0]]\nb:[0, 1]",
        "A:[",
        "a mapping of keys",
        "put a blank behind the colon",
    ),
    "a comment of another language": (
        "// midpoint\nA: [[0, 0], [1/2, 0]]\nb: [0, 1]",
        ": [[0",
        "not YAML",
        "comments begin with #",
    ),
    "a comment of MATLAB": (
        "% midpoint\nA: [[0, 0], [1/2, 0]]\nb: [0, 1]",
        " midpoint",
        "not YAML",
        "comments begin with #",
    ),
    "a decimal comma": (
        "A: [[0, 0], [0,5, 0]]\nb: [0, 1]",
        "[0,5",
        "has 3 entries",
        "decimals have a point",
    ),
    "a decimal comma in quotes": (
        'A: [[0, 0], ["0,5", 0]]\nb: [0, 1]',
        ",5",
        "unexpected ','",
        "with a point: 0.5",
    ),
    "a column of weights": (
        "A: [[0, 0], [1/2, 0]]\nb: [[0], [1]]",
        "[[0], [1]]",
        "a list of rows",
        "write it as one row, [0, 1]",
    ),
    "a minus sign of a page": (
        "A: [[0, 0], [−1/2, 0]]\nb: [0, 1]",
        "−1/2",
        "the sign '−' (U+2212, minus sign) is not allowed in a number",
        "use the sign - (hyphen)",
    ),
    "a slash of fractions": (
        "A: [[0, 0], [1⁄2, 0]]\nb: [0, 1]",
        "⁄2",
        "is not allowed in a number",
        "use the sign /",
    ),
    "rows parted by semicolons": (
        "A: [0, 0; 1/2, 0]\nb: [0, 1]",
        "0; 1/2",
        "a matrix is a list",
        "with commas: [[0, 0], [1/2, 0]]",
    ),
    "an open bracket": ("A: [[0]\nb: [1]", "b: [1]", "not YAML", "the bracket at 1:4 is open"),
    "a tab": ("tableau:\n\tA: [[0]]", "\tA", "not YAML", "indent with spaces"),
}


@pytest.mark.parametrize("kind", ONE_FAULT)
def test_one_cause_is_one_fault(kind: str) -> None:
    """One mistake gets one fault, at the word, that says what it is and what to write."""
    text, word, message, cure = ONE_FAULT[kind]
    found = faults(text)
    assert len(found) == 1, [fault.message for fault in found]
    (fault,) = found
    assert message in fault.message
    assert cure in fault.help
    line = text.splitlines()[fault.line - 1]
    assert line[fault.column - 1 :].startswith(word)


def test_a_misspelt_key_hides_no_other_fault() -> None:
    """The value of a misspelt key is read as that of the key it was meant to be."""
    found = faults("tableu: {A: [[0, oops], [1/2, 0]], weights: [0, 1]}")
    assert [fault.column for fault in found] == [1, 18, 36]


def test_many_faults_end_the_reading() -> None:
    """A thousand faults are enough: the file is read no further, and two hundred are told."""
    entries = ", ".join(f"x{i}y" for i in range(5000))
    found = faults(f"A: [[{entries}]]\nb: [1]")
    assert len(found) == 201
    assert found[-1].message == "and 800 more faults"


def test_signs_from_a_file_are_written_out() -> None:
    """What a terminal would act on stands in no message, help or excerpt of an error."""
    text = (
        'parameters: {"a\\u202Eb": 1, "c\\e[31m": 2}\n'
        'A: [["\\e[2J", "ok\\u202E"]]\nb: ["\\x9b", 1]\n"x\\u202E": 1'
    )
    with pytest.raises(MethodFileError) as caught:
        loads(text, "na\x1bme")
    shown = str(caught.value)
    assert len(caught.value.faults) > 4
    assert all(sign.isprintable() or sign == "\n" for sign in shown)
    assert all(
        fault.message.isprintable() and fault.help.isprintable() for fault in caught.value.faults
    )


def test_an_error_is_its_own_report() -> None:
    """``str`` of the error has the place, the line, a caret and the help."""
    with pytest.raises(MethodFileError) as caught:
        loads("A: [[0, 0], [O.5, 0]]\nb: [0, 1]\n", "first.gark.yaml")
    lines = str(caught.value).splitlines()
    assert lines[0].startswith("first.gark.yaml:1:15: A, row 2, entry 1: ")
    assert lines[1:3] == ["    1 | A: [[0, 0], [O.5, 0]]", "      |               ^"]
    assert lines[3].startswith("      help: ")


@pytest.mark.parametrize(
    "name",
    [
        "roots of a hidden zero",
        pytest.param("unknown parameters", marks=in_whole),
        pytest.param("many colours", marks=in_whole),
        "aliases of a colour",
        "blocks of many entries",
        pytest.param("interpolation at many nodes", marks=in_whole),
    ],
)
def test_hostile_files_are_refused_soon(name: str) -> None:
    """Files that took more than five seconds, or more memory than there is, are refused with the
    reason in seconds of the processor.

    Those of many keys, colours of an ark or values are in test_hostile.py in other sizes; make fuzz
    tries all.
    """
    start = process_time()
    found = faults(hostile_files()[name])
    assert process_time() - start < SECONDS
    assert all(fault.message for fault in found)


def test_a_key_that_belongs_elsewhere_is_shown_there() -> None:
    """Every key that has its place below another one, and is none of the top, is written where it
    belongs, by an example that is declared with it.
    """
    found = elsewhere()
    assert {"order", "symplectic"} <= {key for key, home in found.items() if home.key == "expect"}
    assert found["stages"].key == "methods"
    for key, home in found.items():
        (fault,) = faults(f'A: [[0]]\nb: [1]\n"{key}": 1')
        assert fault.code == "unknown-key"
        lines = home.line, f"{key}: 1"  # with the value of the file where it is not a list
        assert fault.help in {f"write {home.key}: {{{line}}}" for line in lines}


def test_other_words_for_keys_are_understood() -> None:
    """What people call a key besides its name is read as this key, with one fault."""
    words = [(word, key) for key in KEYS.values() for word in key.also]
    assert ("weights", KEYS["b"]) in words
    for word, key in words:
        said = [x for x in faults(f'"{word}": 1') if x.code == "unknown-key"]
        assert [x.help for x in said] == [f"did you mean {key.name!r}?"]
