"""Names and references that try to leave their comments, and names that are words of a language:
every target writes files that are what they were meant to be.
"""

from __future__ import annotations

import ast
import json
import re
import shutil
import subprocess
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from itertools import product
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.comments import XML, C, Comment, harmless
from garkcli.bridges.names import LONGEST, RESERVED, class_name, identifier
from garkcli.bridges.payload import Payload
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import Bridge, bridges
from garkcli.frozen import replace
from garkcli.methodfile.load import loads
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole, sample

HOSTILE = [
    "a */ int x; /*",
    "(* a *) b",
    "-- --> <!--",
    "coding: latin-1 -*- vim: fileencoding=utf-16",
    "ends with \\",
    "??/",
    "%{ #= =# %}",
    "Größe: ∞ 中 \u202e \n new line",
    "'''\"\"\"",
]
MARK = "~broken~out~"
"""What tries to leave a comment; no name that is made of it has its signs."""
ENDS = (
    *("*/", "-->", "--->", "- -->", "\u2010->", "\u2014>", "]]>", "*)", "=#", "%}", "#}", "-*-"),
    *("\n", "\r", "\r\n", "\x0b", "\x0c", "\x1c", "\x85", "\u2028", "\u2029", "\\\n", "\0"),
    *('"""', "'''", '"', "'", "`", "\\", "??/\n", "^^M", "\\end{document}", "</script>", "?>"),
    *("*\u200b/", "*\\\n/", "*??/\n/", "\u2217/", "*\u2215", "\uff0a\uff0f", "\u202e", "\u2066"),
    *("${", "$(", "#{", "{{", "%s", ",=", "=", "+", "@", "-", "::error::", "##[error]", "..."),
)
BEGINS = ("/*", "<!--", "(*", "#=", "%{", "<![CDATA[", "{", "(", "[", "|", "")
METHODS = {
    "rk": "A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\n",
    "pair": "A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\nembedded: [1, 0]\n"
    "dense: {degree: 2, weights: [[1, -1/2], [0, 1/2]]}\n",
    "implicit": "A: [['sqrt(2)/2']]\nb: [1]\n",
    "cubic": "A: [['cbrt(2)/2']]\nb: [1]\n",
    "quintic": "A: [['root_of(x^5 - x - 1, 1.167)']]\nb: [1]\n",
    "ark": "ark:\n  A: [[[0, 0], [1, 0]], [[0, 0], [1/2, 1/2]]]\n  b: [[1/2, 1/2], [1/2, 1/2]]\n",
    "prk": "prk: {q: {A: [[0, 0], [1, 0]], b: [1/2, 1/2]}, p: {A: [[1/2, 0], [1/2, 0]], "
    "b: [1/2, 1/2]}}\n",
    "kicks": "prk: {q: {A: [[0], [1]], b: [1]}, p: {A: [[1/2, 0]], b: [1/2, 1/2]}}\n"
    "structure: separable\n",
    "rosenbrock": "rosenbrock: {alpha: [[0, 0], [1, 0]], gamma: [[1/2, 0], [-1, 1/2]], "
    "b: [1/2, 1/2], embedded: [1, 0]}\n",
    "multirate": (ROOT / "garkcli/catalogue/data/multirate/mri-gark-erk22a.gark.yaml").read_text(
        encoding="utf-8"
    ),
}
"""A method of each form; between them every target holds one."""


def named(name: str, method: str) -> str:
    """A method file with a name and a reference."""
    text = re.sub(r"^(?:name|reference|aliases):.*\n(?:  .*\n)*", "", method, flags=re.MULTILINE)
    return f"name: {json.dumps(name)}\nreference: {json.dumps(name)}\n{text}"


@cache
def _payload(method: str) -> Payload:
    """What writers get of a method file."""
    return prepared(loads(method))


@cache
def _said(name: str) -> dict[str, str]:
    """The name and the reference that a file says, as writers get them."""
    payload = prepared(loads(named(name, METHODS["rk"])))
    return {"name": payload.name, "reference": payload.reference}


def payload_of(name: str, method: str) -> Payload:
    """What writers get of a method with a name and a reference; its numbers are those of before."""
    return replace(_payload(method), **_said(name))


def exported(
    name: str, methods: Sequence[str] = tuple(METHODS), suffix: str = "", once: bool = False
) -> Iterator[tuple[Bridge, str]]:
    """What targets write of methods with a name, and their programs of Python, C, C++, R, …

    Args:
        name: and reference, of the methods.
        methods: which of them, in this order.
        suffix: of the files of the targets, where not all are meant.
        once: each target writes the first of the methods that it holds.
    """
    for bridge in bridges().values():
        if not bridge.suffix.endswith(suffix):
            continue
        for method in methods:
            try:
                texts = _texts(bridge, payload_of(name, METHODS[method]))
            except CannotExport:
                continue
            yield from ((bridge, text) for text in texts)
            if once:
                break


def _texts(bridge: Bridge, payload: Payload) -> list[str]:
    """The file of a method, and the program that runs it."""
    program = [*bridge.tested(payload, f"neutral{bridge.suffix}").values()][:1]
    return [bridge.written(payload), *program]


def turned(place: int) -> list[str]:
    """The methods in turn, so that each target writes all of them under one name or another."""
    methods = list(METHODS)
    place %= len(methods)
    return methods[place:] + methods[:place]


def _without(pattern: str) -> Callable[[str], str]:
    return lambda text: re.sub(pattern, " ", text)


WITHOUT_COMMENTS: dict[str, Callable[[str], str]] = {
    **dict.fromkeys((".c", ".h", ".hpp"), _without(r"/\*[\s\S]*?\*/|//.*")),
    **dict.fromkeys((".py", ".jl", ".R", ".csv", ".inputs"), _without("#.*")),
    **dict.fromkeys((".m", ".tex"), _without("%.*")),
    ".tsv": lambda text: text,
    ".json": lambda text: json.dumps(sorted(json.loads(text))),
    ".f90": _without("!.*"),
    ".wl": _without(r"\(\*[\s\S]*?\*\)"),
    ".xml": lambda text: ET.tostring(ET.fromstring(text), encoding="unicode"),
}
"""What is left of a file of some kind without its comments."""


@pytest.mark.parametrize("end", sample(ENDS, 2), ids=ascii)
def test_nothing_leaves_its_comment(end: str) -> None:
    """No target, no name and no reference: without comments nothing is left of them."""
    place = ENDS.index(end)
    begin = BEGINS[place % len(BEGINS)]
    name = f"{end}{MARK}(){end} {MARK}() {begin}"
    seen = set()
    for bridge, text in exported(name, turned(place), once=True):
        seen.add(bridge.name)
        lines = re.split(r"\r\n|[\n\r\v\f\x1c\x1d\x1e\x85\u2028\u2029]", text)
        assert lines == text.split("\n")
        assert all(x.isprintable() or bridge.suffix == ".tsv" for x in lines)
        assert MARK not in WITHOUT_COMMENTS[bridge.suffix](text), bridge.name
    assert seen == set(bridges())


def test_comments_are_in_one_place() -> None:
    """No target has comments of its own, which would need care of their own."""
    places = [path for path in (ROOT / "garkcli").rglob("*.py") if " Comment(" in path.read_text()]
    assert [path.name for path in places] == ["comments.py"]


@pytest.mark.parametrize("name", HOSTILE)
def test_what_ends_a_comment_is_written_apart(name: str) -> None:
    """In every language, and what a language alone has in that language."""
    for pair in ("*/", "/*", "(*", "*)", "??", "\n"):
        assert pair not in harmless(name)
    for line in XML.lines([name])[1:-1]:
        assert "--" not in line
    assert "*/" not in "\n".join(C.lines([name])[:-1])
    odd = Comment("", begin="{:", end=":}")
    assert ":}" not in odd.lines([f"{name} :}} {{:"])[1]


# -- names
# ---------------------------------------------------------------------------------------------

WORDS = (
    *("import", "end", "class", "int", "function", "None", "none", "double", "True", "lambda"),
    *("3/8 rule", "42", "ß", "中文", "", " ", "---", "_", "__init__", "Ångström", "a b", "x" * 200),
    *("for", "if", "in", "next", "begin", "module", "program", "main", "state", "std", "boost"),
    *("f", "t", "y", "n", "m", "i", "e", "np", "RungeKutta", "runge kutta", "Butcher Tableau"),
    *("errno", "stdin", "NULL", "sqrt", "pi", "T", "N", "struct", "template", "quote", "using"),
    *("Class Var", "Explicit Runge Kutta", "switch", "while", "end if", "None method", "order"),
)


@pytest.mark.parametrize("name", [*WORDS, *HOSTILE])
def test_names_are_names(name: str) -> None:
    """A letter first, then letters, digits and underscores, not too long, and no word."""
    for language, words in RESERVED.items():
        for found in (identifier(name, language), class_name(name, language)):
            assert re.fullmatch("[A-Za-z][A-Za-z0-9_]*", found)
            assert len(found) <= LONGEST
            assert found not in words


def _bare(bridge: Bridge) -> str:
    """The language of a target that writes a name with nothing before it; empty for others."""
    languages = {".hpp": "cpp", ".jl": "julia", ".m": "matlab", ".R": "r", ".py": "python"}
    languages[".wl"] = "mathematica"
    return languages.get(bridge.suffix, "")


def test_no_name_is_a_word_of_the_files_themselves() -> None:
    """Whatever a target writes besides is reserved in its language: names of arrays, of variables
    of its programs, of what it imports.
    """
    for bridge, text in exported("neutral"):
        language = _bare(bridge)
        if not language:
            continue
        code = WITHOUT_COMMENTS[bridge.suffix](text)
        code = re.sub(r'"""[\s\S]*?"""|"[^"\n]*"|\'[^\'\n]*\'', " ", code)
        # the arrays a2, a3, … of boost are inside the function, which does not call itself
        found = set(re.findall(r"\b[A-Za-z]\w*", code))
        own = [x for x in found if not re.match(r"a\d|neutral", x, re.IGNORECASE)]
        for word in own:
            if bridge.name in {"irksome", "nodepy"} or language not in {"python", "mathematica"}:
                made = identifier(word, language)
            else:
                made = class_name(_parted(word), language)
            if language == "mathematica":
                made = made[0].lower() + made[1:]
            assert made != word or word == "method", (bridge.name, word)


def _parted(word: str) -> str:
    """The name of a method whose class would be called so."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", word)


@pytest.mark.parametrize("name", sample(WORDS, 3))
def test_modules_of_python_compile(name: str) -> None:
    """Every module and every program; what runs with NumPy alone has its arrays."""
    for _, text in exported(name, turned(WORDS.index(name)), ".py", once=True):
        tree = ast.parse(text)
        imported = {
            alias.asname or alias.name
            for node in ast.walk(tree)
            if isinstance(node, (ast.Import, ast.ImportFrom))
            for alias in node.names
        }
        classes = {node.name for node in ast.walk(tree) if isinstance(node, ast.ClassDef)}
        assert not classes & imported


def test_a_module_with_any_name_runs() -> None:
    """It has the arrays, and nothing else."""
    for name in (*WORDS, *HOSTILE):
        payload = payload_of(name, METHODS["rk"])
        written = bridges()["numpy"].written(payload)
        names: dict[str, object] = {}
        exec(compile(written, "exported", "exec"), names)
        assert set(names) - {"__builtins__"} == {"np", "order", "A", "b", "c"}


CC = shutil.which("cc") or shutil.which("gcc")
CXX = shutil.which("c++") or shutil.which("g++")
STUBS = {
    "mfem.hpp": """
#pragma once
namespace mfem {
struct Vector { Vector(int) {} double *GetData() const { return 0; }
  double &operator[](int) { static double x; return x; } };
struct TimeDependentOperator { TimeDependentOperator(int, double) {} double GetTime() const
  { return 0; } virtual void Mult(const Vector &, Vector &) const = 0; };
struct ODESolver { void Init(TimeDependentOperator &) {} void Step(Vector &, double &, double &) {}
  virtual ~ODESolver() {} };
struct ExplicitRKSolver : ODESolver { ExplicitRKSolver(int, const double *, const double *,
  const double *) {} };
}
""",
    "boost/array.hpp": """
#pragma once
#include <array>
namespace boost { using std::array; }
""",
    "boost/fusion/include/make_vector.hpp": """
#pragma once
namespace boost { namespace fusion { template <class... T> int make_vector(T...) { return 0; } } }
""",
    "boost/numeric/odeint.hpp": """
#pragma once
namespace boost { namespace numeric { namespace odeint {
template <int S, int O, class State> struct explicit_generic_rk {
  template <class... T> explicit_generic_rk(T...) {}
  template <class F> void do_step(F, State &, double, double) {} };
template <int S, int O, int P, int Q, class State> struct explicit_error_generic_rk {
  template <class... T> explicit_error_generic_rk(T...) {}
  template <class F> void do_step(F, State &, double, double) {} };
} } }
""",
}
"""As much of Boost.Odeint and MFEM as the compiler needs to see what is written for them."""


def built(command: list[str], folder: Path) -> None:
    """A compiler has nothing to say."""
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[:2000]


@pytest.mark.skipif(CC is None, reason="no C compiler here")
def test_headers_of_c_compile(tmp_path: Path) -> None:
    """With any name, all of them in one program."""
    options = ["-std=c11", "-Wall", "-Werror", "-Wno-unused-variable", "-Wno-unused-const-variable"]
    for method in ("rk", "ark"):
        texts = [text for x in WORDS for _, text in exported(x, [method], ".h")]
        for k, text in enumerate(texts):
            (tmp_path / f"header{k}.h").write_text(text)
        (tmp_path / "program.c").write_text(
            "".join(f'#include "header{k}.h"\n' for k in range(len(texts)))
        )
        built([str(CC), *options, "-fsyntax-only", "program.c"], tmp_path)


@in_whole
@pytest.mark.skipif(CXX is None, reason="no C++ compiler here")
def test_headers_of_cpp_compile(tmp_path: Path) -> None:
    """With any name, and with the program that runs them. What stands behind ``method_`` is a name:
    a word of the language and a word of these files are enough.
    """
    for name, text in STUBS.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    sources = []
    bare = [x for x in WORDS if not identifier(x, "cpp").startswith("method_")]
    for target, (k, name) in product(
        ["boost", "mfem"], enumerate([*sample(bare, 4), "int", "errno"])
    ):
        payload = payload_of(name, METHODS["pair"])
        bridge = bridges()[target]
        stem = f"{target}{k}"
        (tmp_path / f"{stem}.hpp").write_text(bridge.written(payload))
        for ending, content in bridge.tested(payload, f"{stem}.hpp").items():
            (tmp_path / f"{stem}{ending}").write_text(content)
        sources.append(f"{stem}_test.cpp")
    # what all programs include is parsed once
    text = "\n".join((tmp_path / x).read_text() for x in sources)
    shared = sorted(set(re.findall(r"#include <.*>", text)))
    (tmp_path / "shared.hpp").write_text("\n".join(shared))
    options = [str(CXX), "-std=c++17", "-I."]
    built([*options, "-x", "c++-header", "shared.hpp"], tmp_path)
    built([*options, "-fsyntax-only", "-include", "shared.hpp", *sources], tmp_path)


@pytest.mark.skipif(shutil.which("gfortran") is None, reason="no Fortran compiler here")
def test_modules_of_fortran_compile(tmp_path: Path) -> None:
    """With any name."""
    sources = []
    for k, name in enumerate(WORDS):
        payload = payload_of(name, METHODS["ark"])
        (tmp_path / f"x{k}.f90").write_text(bridges()["fortran"].written(payload))
        sources.append(f"x{k}.f90")
    built(["gfortran", "-fsyntax-only", *sources], tmp_path)


@pytest.mark.skipif(shutil.which("Rscript") is None, reason="no R here")
def test_lists_of_r_are_made(tmp_path: Path) -> None:
    """With any name, and the program has its syntax."""
    lines = ["options(warn = 2)"]
    for k, name in enumerate([*WORDS, *sorted(RESERVED["r"])]):
        payload = payload_of(name, METHODS["pair"])
        bridge = bridges()["desolve"]
        (tmp_path / f"x{k}.R").write_text(bridge.written(payload))
        program, _ = bridge.tested(payload, f"x{k}.R").values()
        (tmp_path / f"x{k}_test.R").write_text(program)
        lines += [f'local(source("x{k}.R", local = TRUE))', f'invisible(parse("x{k}_test.R"))']
    (tmp_path / "all.R").write_text("\n".join(lines) + "\n")
    built(["Rscript", "all.R"], tmp_path)


@pytest.mark.skipif(shutil.which("octave-cli") is None, reason="no Octave here")
def test_functions_of_octave_are_called(tmp_path: Path) -> None:
    """With any name: the function returns its struct."""
    lines = []
    for name in [*WORDS, *sorted(RESERVED["matlab"])]:
        payload = payload_of(name, METHODS["pair"])
        function = identifier(name, "matlab")
        (tmp_path / f"{function}.m").write_text(bridges()["matlab"].written(payload))
        lines.append(f"assert(numel({function}().b), 2);")
    (tmp_path / "all_of_them.m").write_text("\n".join(dict.fromkeys(lines)) + "\n")
    built(["octave-cli", "-q", "all_of_them.m"], tmp_path)


@pytest.mark.parametrize(
    ("target", "name"),
    [("diffrax", 'a "b" \\.py'), ("scipy", "a'b\\.py"), ("torchdiffeq", 'a"; import os #.py')],
)
def test_programs_find_files_of_any_name(target: str, name: str, tmp_path: Path) -> None:
    """A quote or a backslash in the name of the file is one in the program."""
    (tmp_path / "m.yaml").write_text(METHODS["rk"])
    run = gark("export", "m.yaml", "--to", target, "--test", "-o", name, cwd=tmp_path)
    assert run.code == 0, run.err
    program = (tmp_path / name.replace(".py", "_test.py")).read_text(encoding="utf-8")
    texts = [x.value for x in ast.walk(ast.parse(program)) if isinstance(x, ast.Constant)]
    assert name in texts


def test_a_header_with_a_quote_in_its_name_is_refused(tmp_path: Path) -> None:
    """C++ cannot include it."""
    (tmp_path / "m.yaml").write_text(METHODS["rk"])
    run = gark("export", "m.yaml", "--to", "boost", "--test", "-o", 'a"b.hpp', cwd=tmp_path)
    assert run.code == 2
    assert "C++ includes a header by the name of its file" in run.err
    assert not (tmp_path / 'a"b.hpp').exists()
