"""Constants of sources: exact values, and what is not known, never anything in between."""

from __future__ import annotations

import json

import pytest

from garkcli.bridges.audit import audit
from garkcli.bridges.claiming import imported
from garkcli.exact.display import to_text
from garkcli.sources.found import FoundTable
from garkcli.sources.languages import (
    c,
    csharp,
    fortran,
    go,
    java,
    julia,
    matlab,
    notebook,
    python,
    rust,
    typescript,
)

FIND = {
    **dict.fromkeys(("c", "cpp", "cuh"), c.find),
    "c.inc": c.find,
    "cs": csharp.find,
    "go": go.find,
    "ipynb": notebook.find,
    "java": java.find,
    "jl": julia.find,
    "m": matlab.find,
    "rs": rust.find,
    **dict.fromkeys(("js", "ts"), typescript.find),
    **dict.fromkeys(("py", "pyx"), python.find),
    **dict.fromkeys(("f90", "f", "for", "inc"), fortran.find),
}
RALSTON = ((("0", "0"), ("2/3", "0")),)
SAME = {
    "c, wrappers and macros": (
        "#define T (RCONST(2.0)/RCONST(3.0))\n#define R PetscRealConstant\n"
        "double A[2][2] = {{0}, {T}}, b[2] = {R(0.25), 1 - R(0.25)};"
    ),
    "c, macros as text": (
        "#define HALF 1.0-0.5 /* no brackets */\n#define MORE HALF+HALF\n#define T (1.0/3.0)\n"
        "double A[2][2] = {{0}, {2*T}}, b[2] = {HALF-0.25, 2*MORE-1.25};"
    ),
    "c, macros of floats and of doubles": (
        "#ifdef SINGLE\n#define HALF 1.0f-0.5f\n#else\n#define HALF 1.0 - 0.5\n#endif\n"
        "double A[2][2] = {{0}, {2.0/3}}, b[2] = {HALF-0.25, 0.75};"
    ),
    "c, loops": (
        "void f(void) { double A[2][2] = {{0}}, b[2]; A[1][0] = 2./3;\n"
        "  for (int i = 0; i < 2; i++) b[i] = (2*i + 1)/4.; }"
    ),
    "c, arrays of the caller": (
        "void f(int *s, double A[], double b[]) { *s = 2; A[0] = 0; A[1] = 0; A[2] = 2./3;\n"
        "  A[3] = 0; b[0] = 0.25; b[1] = 1 - b[0]; }"
    ),
    "c, the number of stages is that of the case": (
        "void f(double *A, double *b, int s) { switch (s) { case 2:\n"
        "  A[0*s + 0] = 0; A[0*s + 1] = 0; A[1*s + 0] = 2.0/3; A[1*s + 1] = 0;\n"
        "  b[0] = 0.25; b[s - 1] = 0.75; break; } }"
    ),
    "c, a macro for entries, after loops of unknown length": (
        "void f(int k, int *s, double *A, double *b) { for (i = 0; i < MAX; i++) { b[i] = ZERO;\n"
        "  for (j = 0; j < MAX; j++) ENTRY(A, i, j) = 0.0; }\n"
        "  switch (k) { case(1): *s = 2; ENTRY(A,1,0) = 2.0/3; b[0] = 0.25; b[1] = .75; break; } }"
    ),
    "cpp, lists of Boost": (
        "Ralston::Ralston() { a += 0., 0.,\n 2./3., 0.; b += 1./4., 3./4.; c += 0., 2./3.; }"
    ),
    "c, types that the grammar does not know": (
        "void f(void) { Scalar g = 3; Scalar A[2][2] = {{0}}, b[2]; A[1][0] = (Scalar)-2.0/(Scalar)(-g);\n"
        "  b[0] = (Scalar)(0.25); b[1] = (Scalar)0.75; }"
    ),
    "cpp, a matrix that is finished": (
        "struct R { const M A = (M() << 0, 0, 2.0/3, 0).finished(); const double b[2] = {.25, .75}; };"
    ),
    "cpp, initialisers of a constructor": "R::R() : A{{0, 0}, {2.0/3, 0}}, b{0.25, 0.75} {}",
    "cpp, literals and matrices of the program": (
        "void f() { Dense<real> A(2, 2), b(2); A(0,0) = A(0,1) = A(1,1) = 0; A(1,0) = 2_r/3_r;\n"
        "  b(0) = 1_r/4; b(1) = 3_r/4; }"
    ),
    "cpp, matrices that are made of lists": (
        "const Tab R = { .A = arma::mat({{0, 0}, {2.0/3, 0}}), .b = Vec({0.25, 0.75}) };"
    ),
    "c, signs before numbers": "double A[2][2] = {{0}, {+2.0/3}}, b[2] = {+0.25, +.75};",
    "cpp, entries by at": (
        "void f() { std::vector<std::vector<double>> A(2, std::vector<double>(2));\n"
        "  std::vector<double> b(2, 0.25); A.at(1).at(0) = 2.0/3; b.at(1) = 3*b.at(0); }"
    ),
    "cpp, braces within braces": (
        "struct R { Lower<double, 2> a{{{2.0 / 3}}}; Vector<double, 2> b{{{0.25, 0.75}}}; };"
    ),
    "cpp, a function without a name": (
        "void f() { const auto R = [](double x, int y) { return x / y; };\n"
        "  double A[2][2] = {{0}, {R(2, 3)}}, b[2] = {R(1, 4), R(3, 4)}; }"
    ),
    "cuh, constants of a device": (
        "__constant__ double A[2][2] = {{0}, {2.0/3}};\n__device__ const double b[2] = {.25, .75};"
    ),
    "c.inc, of C": "double A[2][2] = {{0}, {2.0/3}}, b[2] = {0.25, 0.75};",
    "inc, in fixed form": (
        "      real A(2,2), b(2)\nC     of Ralston\n      data A /0.0, 0.0, 0.0, 0.0/\n"
        "      A(2,1) = 2.0/\n     &  3.0\n      b(1) = 0.25\n      b(2) = 0.75\n"
    ),
    "inc, in free form": "real :: A(2,2), b(2)\nA = 0\nA(2,1) = 2.0/3.0\nb = [0.25, 0.75]\n",
    "f90, keywords of a structure": (
        "type(t), parameter :: r = t(A=reshape([0d0, 2/3d0, 0d0, 0d0], [2,2]), b=[0.25d0, 0.75d0])\n"
    ),
    "f90, a case": (
        "subroutine f(self, s)\nselect case(s)\ncase(2)\nself%A(2, 1) = 2d0/3d0\n"
        "self%b(1) = 0.25d0\nself%b(2) = 0.75d0\ncase(3)\nself%w = 1\nend select\nend subroutine\n"
    ),
    "f90, zeros of an array that is elsewhere": (
        "subroutine f(self)\nself%A = 0d0\nself%A(2, 1) = 2d0/3d0\nself%b(1) = 0.25d0\n"
        "self%b(2) = 0.75d0\nend subroutine\n"
    ),
    "f, fixed form": (
        "c     of Ralston\n      subroutine f(A, b)\n      double precision A(2,2), b(2), w\n"
        "      parameter (w=0.25d0)\n      A(1,1) = 0\n      A(1,2) = 0\n      A(2,1) = ! in two\n"
        "     &  2.0d0/\n     1  3.0d0\n      A(2,2) = 0\n      b(1) = w\n      b(2) = 3*w\n"
        "      end\n"
    ),
    "jl, comprehensions": (
        "r = [0 0 1; 0 2//3 1]\nA = [r[i, 3 - j] for i in 1:size(r, 1), j in 1:size(r, 2) - 1]\n"
        "b = Rational[w for w in [1//4]]\npush!(b, sum(x//4 for x in 1:2))\n"
    ),
    "jl, lists that grow": (
        "A = [0 0; 2//3 0]\nb = [1//4]\nappend!(b, [3//4])\nc = [2//3]\npushfirst!(c, 0)\n"
    ),
    "jl, entries of other arrays": (
        "c = [0, 2//3]\nA = zeros(2, 2)\nA[2, 1] = c[end]\nb = [1//4; 3//4]\n"
    ),
    "jl, rows and conversions": "A = T[0 0; big(2)//3 0]\nb = map(BigFloat, [1//4, 3//4])\n",
    "py, shapes by methods": (
        "A = np.array([0, 2/3, 0, 0]).reshape(2, -1).transpose()\nb = np.array([[1/4, 3/4]]).ravel()\n"
    ),
    "py, another array with an entry": (
        "A = jnp.zeros((2, 2)).at[1, 0].set(2/3)\nb = np.r_[1/4, 3/4]\n"
    ),
    "py, defaults of a dataclass": (
        "@dataclass\nclass R:\n    A: list = field(default_factory=lambda: [[], [2/3]])\n"
        "    b: list = field(default=(1/4, 3/4))\n"
    ),
    "py, methods": (
        "class R:\n    def A(self):\n        a = np.tril(np.ones((2, 2)), -1)\n"
        "        return 2*a/3\n    @staticmethod\n    def b():\n        return [1/4, 3/4]\n"
    ),
    "py, rows by their numbers": "A = {0: [0, 0], 1: [2/3]}\nb = [1/4, 3/4]\n",
    "py, keywords of a call that has none elsewhere": (
        "r = TableauRKExplicit(a=np.array([[0, 0], [2/3, 0]]), b=np.array([1/4, 3/4]))\n"
    ),
    "pyx, types": (
        "cdef double A[2][2]\nA[1][0] = 2/3\ncdef list b = [1/4, 3/4]\n"
        "cdef inline double f(double x) nogil:\n    cdef int n\n    return x\n"
    ),
    "ipynb, lines and texts": json.dumps(
        {
            "cells": [
                {"cell_type": "markdown", "source": ["A = [[0, 0], [1, 0]]"]},
                {"cell_type": "code", "source": ["%pip install x\n", "A = [[], [2/3]]"]},
                {"cell_type": "code", "source": "b = [1/4]\nb.append(3/4)"},
            ]
        },
        indent=1,
    ),
    "ipynb, of Julia": json.dumps(
        {
            "metadata": {"kernelspec": {"language": "julia"}},
            "cells": [{"cell_type": "code", "source": "A = [0 0; 2//3 0]\nb = [1//4, 3//4]"}],
        }
    ),
    "rs, constants of an implementation": (
        "impl Method for Ralston {\n    const A: &'static [&'static [f64]] = &[&[], &[2.0 / 3.0]];\n"
        "    const B: [f64; 2] = [0.25_f64, 1f64 - 0.2_5];\n}\n"
    ),
    "rs, entries and closures": (
        "pub fn ralston<T: Real>() -> Tableau<T> {\n    let mut a = [[0.0; 2]; 2];\n"
        "    a[1][0] = 2.0 / 3.0;\n    let w = 4.0_f64.sqrt() / 8.0;\n    let mut b = vec![w; 2];\n"
        "    b[1] += 0.5;\n    let a = a.map(|row| row.map(|x| T::from_f64(x).unwrap()));\n"
        "    let b = b.iter().map(|&x| T::from_f64(x).unwrap()).collect();\n    Tableau { a, b }\n}\n"
    ),
    "rs, lists in shapes, boxes and results": (
        "fn ralston(k: Kind) -> Rk {\n    let s = stages(k);\n"
        '    let a = Array2::from_shape_vec((s, s), vec![0., 0., 2. / 3., 0.]).expect("a square");\n'
        "    let b = Some(Arc::new(Array1::from_shape_vec(s, vec![0.25, 0.75]).unwrap()));\n"
        "    Rk { a: a.to_owned(), b }\n}\n"
    ),
    "cpp, values that are moved and shared": (
        "Rk ralston() {\n  std::vector<double> w{0.25, 0.75};\n  auto b = std::move(w);\n"
        "  auto A = std::make_shared<Rows>(Rows{{0, 0}, {2.0 / 3, 0}});\n  return Rk(A, b);\n}\n"
    ),
    "py, copies of arrays": (
        "A = np.ascontiguousarray(np.array([[0, 0], [2/3, 0]]))\nb = np.squeeze([1/4, 3/4]).copy()\n"
    ),
    "rs, a record by position": (
        "struct Rk { a: Vec<Vec<f64>>, b: Vec<f64> }\nimpl Rk {\n"
        "    fn new(a: Vec<Vec<f64>>, b: Vec<f64>) -> Self { Self { a, b } }\n"
        "    fn ralston() -> Self { Self::new(vec![vec![], vec![2. / 3.]], vec![0.25, 0.75]) }\n}\n"
    ),
    "rs, slices and static names": (
        "lazy_static! { static ref A: DMatrix<f64> =\n"
        "  DMatrix::from_column_slice(2, 2, &[0., 2. / 3., 0., 0.]);\n"
        "  static ref B: Vec<f64> = SVector::<f64, 2>::from_row_slice(&[0.25, 0.75]); }\n"
    ),
    "rs, methods": (
        "impl Table for Ralston {\n    fn a(&self) -> SMatrix<f64, 2, 2> { matrix![0., 0.; 2. / 3., 0.] }\n"
        "    fn b(&self) -> Vec<f64> { vec![0.25, 0.75] }\n}\n"
    ),
    "java, methods that give arrays": (
        "class Ralston extends Stepper {\n  public double[][] getA() {\n"
        "    return new double[][] { { 2.0 / 3.0 } };\n  }\n"
        "  public double[] getB() {\n    final double[] b = new double[2];\n"
        "    for (int i = 0; i < b.length; ++i) { b[i] = (2 * i + 1) / 4.0; }\n    return b;\n  }\n}\n"
    ),
    "java, numbers of a field": (
        "class Ralston<T> {\n  public T[][] getA() {\n    final T[][] a = build(getField(), 1, -1);\n"
        "    for (int i = 0; i < a.length; ++i) { a[i] = build(getField(), i + 1); }\n"
        "    a[0][0] = fraction(getField(), 2, 3);\n    return a;\n  }\n  public T[] getB() {\n"
        "    final T q = getField().getZero().add(4).sqrt();\n    T[] b = build(getField(), 2);\n"
        "    b[0] = q.divide(8);\n    b[1] = getField().getOne().subtract(b[0]);\n    return b;\n"
        "  }\n}\n"
    ).replace("build", "MathArrays.buildArray"),
    "java, a record that is declared behind": (
        "class X { static final Rk R = new Rk(2, List.of(List.of(), List.of(2.0 / 3)), List.of(.25, .75));\n"
        "  record Rk(int order, List a, List b) {} }\n"
    ),
    "java, one of several": (
        "enum Method {\n  RALSTON(new double[][] {{0, 0}, {2 / 3d, 0}}, new double[] {.25, .75});\n"
        "  Method(double[][] a, double[] b) { this.a = a; this.b = b; }\n}\n"
    ),
    "ts, an object with types": (
        "export const ralston = { A: [[0, 0], [2 / 3, 0]] as number[][], 'b': [0.25, 3 / 4]!,\n"
        "  step(h: number) { return h; } } satisfies Tableau;"
    ),
    "ts, entries of typed arrays": (
        "const t = new Tableau(2);\nt.A = [Float64Array.of(0, 0), new Float64Array(2)];\n"
        "t.A[1][0] = Math.sqrt(4) / 3;\nt.b = Float64Array.from([0.25, 0.75]);"
    ),
    "js, a function of a module": (
        "module.exports.ralston = function () {\n  const [x, y] = [1 / 4, 3 / 4];\n"
        "  for (let i = 0; i < 1; i++) { z = i; }\n"
        "  return { name: 'Ralston', A: Object.freeze([[0, 0], [2 / 3, 0]]), b: [x, y] };\n};"
    ),
    "js, a class with its fields": (
        "class Ralston extends Explicit {\n  static #k = 3;\n  static A = [[0, 0], [2 / 3, 0]];\n"
        "  get b() { return [1 / 4, 3 / 4]; }\n}"
    ),
    "go, entries of arrays": (
        "package p\nfunc f() {\n\tvar A [2][2]float64\n\tvar b [2]float64\n\tA[1][0] = 2.0 / 3\n"
        "\tfor i := range b {\n\t\tb[i] = (2*float64(i) + 1) / 4\n\t}\n}"
    ),
    "ts, behind else": (
        "function f(s) { let A, b; if (s) { A = 1; } else {\n"
        "  A = [[0, 0], [2 / 3, 0]]; b = [1 / 4, 3 / 4]; } }"
    ),
    "go, behind else": (
        "package p\nfunc f(s bool) {\n\tif s {\n\t\tprint(1)\n\t} else {\n"
        "\t\tA := [][]float64{{0, 0}, {2.0 / 3, 0}}\n\t\tb := []float64{0.25, 0.75}\n\t}\n}"
    ),
    "java, behind else": (
        "class X { void f(boolean s) { if (s) { f(false); } else {\n"
        "  double[][] A = {{0, 0}, {2.0 / 3, 0}}; double[] b = {0.25, 0.75}; } } }"
    ),
    "cs, behind else": (
        "class X { void F(bool s) { if (s) { F(false); } else {\n"
        "  double[,] A = { { 0, 0 }, { 2.0 / 3, 0 } }; double[] b = { 0.25, 0.75 }; } } }"
    ),
    "go, arrays of functions filled later": (
        "package p\nfunc f() *T {\n\tt := new(T)\n\tt.A = grid.AllocDense(2, 2)\n"
        "\tt.B = make([]float64, len(t.A))\n\tt.A[1][0] = 2.0 / 3\n\tt.B[0] = 0.25\n"
        "\tt.B[1] = 0.75\n\tt.k[n] = 1\n\treturn t\n}"
    ),
    "go, a matrix of gonum": (
        "package p\nvar A, b = mat.NewDense(2, 2, []float64{0, 0, 2.0 / 3, 0}),"
        " mat.NewVecDense(2, []float64{0.25, 0.75})"
    ),
    "go, a record in the order of its fields": (
        "package p\ntype rk struct {\n\ta [][]float64\n\tb []float64\n}\n"
        "func ralston() *rk { return &rk{[][]float64{{}, {2.0 / 3}}, []float64{.25, 0.75}} }"
    ),
    "go, one of several": (
        "package p\nvar methods = map[string]rk{\n"
        '\t"ralston": {A: [][]float64{{0, 0}, {2.0 / 3, 0}}, B: []float64{0.25, 0.75}},\n}'
    ),
    "cs, properties": (
        "class Ralston : Rk { double[,] A => new double[,] { { 0, 0 }, { 2.0 / 3, 0 } };\n"
        "  double[] b { get { return new[] { .25, 0.75 }; } } }"
    ),
    "cs, entries and rows": (
        "class X { void F() { var A = new double[2][]; A[0] = new double[2]; A[1] = [2d / 3, 0];\n"
        "  var b = new double[2]; for (int i = 0; i < 2; i++) { b[i] = (2 * i + 1) / 4.0; } } }"
    ),
    "cs, fields of an object": (
        "namespace N { static class T { public static readonly Tab R = new() { A = new double[,]\n"
        "  { { 0, 0 }, { 2 / 3.0, 0 } }, b = new List<double> { 0.25, 0.75 } }; } }"
    ),
    "cs, a record that is declared behind": (
        "class X { static Rk R = new Rk(A: new double[][] { new double[0], new[] { 2.0 / 3 } },\n"
        "  b: new[] { .25, .75 }); }\nrecord Rk(double[][] A, double[] b);"
    ),
    "py, triplets": (
        "A, b = zeros((2, 2)), zeros(2)\nfor i, j, x in [(1, 0, 2/3)]:\n    A[i, j] = x\n"
        "for i, x in ((0, 1/4), (1, 3/4)):\n    b[i] = x\n"
    ),
    "py, slices": (
        "import numpy as np\nc = np.array([0, 2/3])\nA = np.zeros((2, 2))\n"
        "A[1, :1] = c[1:]\nb = [1/4, 1 - 1/4]\n"
    ),
    "py, a transpose": "A = np.array([[0, 2/3], [0, 0]]).T\nb = (0.25, 0.75)\n",
    "py, newer than the Python that reads it": (
        "type X = int\nA = [[], [2/3]]\nb = [1/4, 3/4]\nmatch A:\n    case _:\n        pass\n"
    ),
    "f90, columns first": (
        "module m\nreal, parameter :: A(2,2) = reshape([0.0, 2.0/3.0, 0.0, 0.0], [2, 2])\n"
        "real, parameter :: b(2) = [0.25, 0.75]\nend module\n"
    ),
    "m, a column and a transpose": "A = [0 0; 2/3 0];\nb = [1/4; 3/4]';\n",
    "m, properties of a class": (
        "classdef Ralston < Scheme\n  properties (Constant)\n    A = [0 0; 2/3 0];\n"
        "    b = [1/4 3/4];\n  end\nend\n"
    ),
    "m, a class whose function makes its base": (
        "classdef Ralston < Schemes.Table\n  methods\n    function it = Ralston()\n"
        "      t.A = [0 0; 2/3 0];\n      t.b = [1/4 3/4];\n"
        "      it@Schemes.Table('Ralston', t);\n    end\n  end\nend\n"
    ),
    "m, products of matrices": "M = [0 0; 2 0];\nA = M*[1/3 0; 0 0];\nb = [1 1]*[1/4 0; 0 3/4];\n",
    "rs, entries by methods": (
        "fn ralston<M: Dense>(ctx: M::C) -> Tableau<M> {\n"
        "    let w = M::V::from_vec(vec![0.25, M::T::from_f64(0.75).unwrap()], ctx.clone());\n"
        "    let mut a = M::zeros(2, 2, ctx.clone());\n    a.set_index(1, 0, 2.0 / 3.0);\n"
        "    let a = M::from_vec(2, 2, vec![0., a.get_index(1, 0), 0., 0.], ctx.clone());\n"
        "    let mut b = M::V::zeros(2, ctx);\n"
        "    for i in 0..2 { b.set_index(i, w.get_index(i)); }\n    Tableau { a, b }\n}\n"
    ),
    "py, functions under other names": (
        "from numpy import (array as array_of, sqrt as root_of_two)\n"
        "A = array_of([[0, 0], [root_of_two(4)/3, 0]])\nb = [1/4, 3/4]\n"
    ),
    "py, pairs of lists": (
        "low = (1, 0)\nby = [3/4, -3/4]\nA = [[], [2/3]]\n"
        "b = tuple(x - y for x, y in zip(low, by))\n"
    ),
}


@pytest.mark.parametrize("name", SAME)
def test_the_same_table(name: str) -> None:
    """The method of Ralston in many ways."""
    table = one(name, SAME[name])
    assert table.trouble == ""
    assert table.A[0] == RALSTON
    assert table.b == (("1/4", "3/4"),)


BELOW = {
    "cs": "class Kutta : Rk { public Kutta() : base(ROWS) { } }",
    "java": "class Kutta extends Rk { Kutta() { super(ROWS); } }",
    "js": "class Kutta extends Rk { constructor() { super(ROWS); } }",
}
ROWS = {
    "cs": "new double[,] { MATRIX }, new[] { WEIGHTS }, new double[] { NODES }",
    "java": "new double[][] { MATRIX }, new double[] { WEIGHTS }, new double[] { NODES }",
    "js": "[MATRIX], [WEIGHTS], [NODES]",
}
MATRIX = "{0, 0, 0}, {0.5, 0, 0}, {-1, 2, 0}"


@pytest.mark.parametrize("language", BELOW)
def test_arguments_of_the_class_below(language: str) -> None:
    """A constructor passes arrays without names to the one of its base class."""
    matrix = MATRIX.replace("{", "[").replace("}", "]") if language == "js" else MATRIX
    rows = ROWS[language].replace("MATRIX", matrix).replace("WEIGHTS", "1 / 6.0, 2 / 3.0, 1 / 6.0")
    text = BELOW[language].replace("ROWS", rows.replace("NODES", "0, 0.5, 1"))
    assert one(language, text).b == (("1/6", "2/3", "1/6"),)


def one(name: str, text: str) -> FoundTable:
    """The only table of a source in the language that a name begins with."""
    suffix = name.partition(",")[0]
    (table,) = FIND[suffix](text, f"x.{suffix}")
    return table


UNKNOWN = {
    "c, a whole quotient": ("double A[2][2] = {{0}, {1/2}}, b[2] = {0, 1};", None),
    "java, a whole quotient": (
        "class X { double[][] A = {{0, 0}, {1 / 2, 0}}; double[] b = {0, 1}; }",
        None,
    ),
    "go, a whole quotient": (
        "package p\nvar A, b = [][]float64{{0, 0}, {1 / 2, 0}}, []float64{0, 1}",
        None,
    ),
    "cs, a whole quotient": (
        "class X { double[,] A = { { 0, 0 }, { 1 / 2, 0 } }; double[] b = { 0, 1 }; }",
        None,
    ),
    "ts, a function that is not known": (
        "const A = [[0, 0], [1 / 2, 0]];\nconst b = [g(), 1];",
        "the call g, line 2, is not known",
    ),
    "rs, a loop": (
        "fn f(k: i32) { let a = [[0.0, 0.0], [0.5, 0.0]]; let mut b = [0.25, 0.75];\n"
        "  while k > 0 { b[0] = 0.5; } }",
        "arrays called A and b do not fit together: assigned in a loop, line 2, is not known",
    ),
    "rs, a macro": (
        "fn f() { let a = [[0.0, 0.0], [0.5, 0.0]];\n  let b = [number!(1), 0.75]; }",
        "macro invocation, line 2, is not known",
    ),
    "c, a loop": (
        "void f(int n) { double A[2][2] = {{0}, {0.5}}, b[2] = {0, 1.0};\n"
        "  while (n) { A[1][0] = g(n); } }",
        "assigned in a loop, line 2, is not known",
    ),
    "jl, a function that changes an array": (
        "A = [0 0; 1//2 0]\nb = [0, 1]\nscale!(A)\n",
        "changed by scale!, line 3, is not known",
    ),
    "c, a loop that sets not only zeros": (
        "void f(int n) { double A[2][2] = {{0}, {0.5}}, b[2] = {0.25, 0.75};\n"
        "  for (int i = 0; i < n; i++) { b[i] = 1; } }",
        "arrays called A and b do not fit together: assigned in a loop, line 2, is not known",
    ),
    "c, a loop that sets some entries to zero": (
        "void f(int k, int n) { double A[2][2] = {{0}, {0.5}}, b[2] = {0.25, 0.75};\n"
        "  for (int i = k; i < n; i++) { b[i] = 0; } }",
        "arrays called A and b do not fit together: assigned in a loop, line 2, is not known",
    ),
    "c, a macro that has other numbers in a branch": (
        "#ifdef FAST\n#define HALF 1.0-0.25\n#else\n#define HALF 1.0-0.5\n#endif\n"
        "double A[2][2] = {{0}, {2.0/3}}, b[2] = {HALF-0.25, 0.75};",
        "a macro with several values, line 6, is not known",
    ),
    "ts, a loop in steps of ten": (
        "const A = [[0, 0], [1 / 2, 0]];\nconst b = [0.25, 0.75];\n"
        "for (let i = 0; i < 2; i += 10) { b[i] = 0.5; }",
        "arrays called A and b do not fit together: assigned in a loop, line 3, is not known",
    ),
    "c, a loop in steps of two beside another counter": (
        "void f(int j) { double A[2][2] = {{0}, {0.5}}, b[2] = {0.25, 0.75};\n"
        "  for (int i = 0; i < 2; i += 2, j++) b[i] = 0.5; }",
        "arrays called A and b do not fit together: assigned in a loop, line 2, is not known",
    ),
    "c, a loop that sets one entry to zero": (
        "void f(int n, int k) { double A[2][2] = {{0}, {0.5}}, b[2] = {0, 1.0};\n"
        "  for (int i = 0; i < n; i++) { A[k][i] = 0; } }",
        "assigned in a loop, line 2, is not known",
    ),
    "c, a number in brackets": (
        "void f(void) { /* h is, */ double A[2][2] = {{0}, {0.5}}, b[2] = {0.25, 0.75};\n"
        "  b[1] = (h)-0.25; }",
        "the name h, line 2, is not known",
    ),
    "jl, a list that grows in a loop": (
        "A = [0 0; 1//2 0]\nb, c = [1//4, 3//4], [0, 1//2]\nwhile x\n    push!(b, 1//2)\nend\n",
        "assigned in a loop, line 4, is not known",
    ),
    "jl, a list that grows by what is not known": (
        "A = [0 0; 1//2 0]\nb, c = [1//4], [0, 1//2]\nappend!(b, f(2))\n",
        "changed by append!, line 3, is not known",
    ),
    "c, an entry that the caller has": (
        "void f(double A[], double b[]) { A[0] = 0; A[1] = 0; A[3] = 0; b[0] = 0.25;\n"
        "  b[1] = 0.75; }",
        "the argument A, line 1, is not known",
    ),
    "py, a loop over pairs that are not known": (
        "A = [[0, 0], [0.5, 0]]\nb = [0, 1]\nfor i, x in pairs():\n    b[i] = x\n",
        "arrays called A and b do not fit together: assigned in a loop, line 4, is not known",
    ),
    "py, a call": (
        "A = [[0, 0], [alpha(1), 0.5]]\nb = [0, 1]\n",
        "the call alpha, line 1, is not known",
    ),
    "m, an unknown place": (
        "A = [0 0; 0.5 0];\nA(k, 1) = 2;\nb = [0 1];\n",
        "an entry at an unknown place, line 2, is not known",
    ),
}


@pytest.mark.parametrize("name", UNKNOWN)
def test_what_is_not_known_is_told(name: str) -> None:
    """The first place and the reason; no entry becomes zero. In C 1/2 is 0, and is read so."""
    text, trouble = UNKNOWN[name]
    table = one(name, text)
    if trouble is None:
        assert table.A[0][0] == (("0", "0"), ("0", "0"))
    else:
        assert (table.trouble, table.b) == (trouble, ())


def test_roots_by_their_names() -> None:
    """Constants that other files have."""
    text = "use lab::SQRT_6;\nconst A: [[f64; 2]; 2] = [[0.0, 0.0], [SQRT_6 / 4.0, 0.0]];\n"
    table = one("rs", f"{text}const B: [f64; 2] = [0.25, 0.75];\n")
    assert table.A[0][0][1] == ("sqrt(6)/4", "0")


CROUZEIX = {
    "py": "g = 2*cos(np.pi/18)/np.sqrt(3)",
    "jl": "g = 2/sqrt(3)*sin(4*pi/9)",
    "c": "double g = 2/sqrt(3)*cos(M_PI/18);",
    "m": "g = 2*cos(pi/18)/sqrt(3);",
    "f90": "real, parameter :: pi = 4*atan(1.0)\nreal, parameter :: g = 2*cos(pi/18)/sqrt(3.0)",
    "rs": "const G: f64 = (std::f64::consts::PI / 18.0).cos() * 2.0 / 3.0.sqrt();",
}
"""The parameter of his method of three stages and order 4 (1975)."""
ARRAYS = {
    "py": "A = [[(1+g)/2, 0, 0], [-g/2, (1+g)/2, 0], [1+g, -1-2*g, (1+g)/2]]\nb = [w, 1-2*w, w]",
    "jl": "A = [(1+g)/2 0 0; -g/2 (1+g)/2 0; 1+g -1-2*g (1+g)/2]\nb = [w, 1-2*w, w]",
    "c": "double A[3][3] = {{(1+g)/2}, {-g/2, (1+g)/2}, {1+g, -1-2*g, (1+g)/2}};\n"
    "double b[3] = {w, 1-2*w, w};",
    "f90": "real :: A(3,3) = reshape([(1+g)/2, -g/2, 1+g, 0., (1+g)/2, -1-2*g, 0., 0., (1+g)/2],"
    " [3,3])\nreal :: b(3) = [w, 1-2*w, w]",
    "rs": "const A: [[f64; 3]; 3] = [[(1.0+G)/2.0, 0.0, 0.0], [-G/2.0, (1.0+G)/2.0, 0.0],"
    " [1.0+G, -1.0-2.0*G, (1.0+G)/2.0]];\nconst B: [f64; 3] = [W, 1.0-2.0*W, W];",
}
WEIGHT = {
    "c": "double w = 1/(6*g*g);",
    "f90": "real, parameter :: w = 1/(6*g*g)",
    "rs": "const W: f64 = 1.0/(6.0*G*G);",
}


@pytest.mark.parametrize("name", CROUZEIX)
def test_cosines_of_parts_of_a_turn_are_exact(name: str) -> None:
    """They are roots of polynomials, so that the order is proved without any tolerance."""
    weight = WEIGHT.get(name, "w = 1/(6*g^2)" if name != "py" else "w = 1/(6*g**2)")
    text = f"{CROUZEIX[name]}\n{weight}\n{ARRAYS.get(name, ARRAYS['jl'])}\n"
    found = audit(one(name, f"module dirk\n{text}end module\n" if name == "f90" else text))
    assert found is not None
    assert found.order is not None
    assert (found.order.order, found.method and found.method.tolerance) == (4, None)


@pytest.mark.parametrize("angle", ["x", "1/3", "pi/1001", "pi*pi"])
def test_other_cosines_are_not_known(angle: str) -> None:
    table = one(
        "py", f"def f(x):\n    g = cos({angle})\n    A = [[0, 0], [g, 0]]\n    b = [1/2, 1/2]\n"
    )
    assert table.trouble


def test_printed_digits_are_kept() -> None:
    """A long decimal is what was printed, in sums too; short ones are exact."""
    text = "double g = 0.29289321881345254, A[2][2] = {{g}, {1 - g, 0.1 + 0.2}}, b[2] = {0.5, .5};"
    table = one("c", text)
    first, second = table.A[0][0] or ()
    assert first[0] == "0.29289321881345254"
    assert second == ("1 - 0.29289321881345254", "3/10")


FEHLBERG = """
A = [[0, 0, 0, 0, 0, 0], [1/4, 0, 0, 0, 0, 0], [3/32, 9/32, 0, 0, 0, 0],
     [1932/2197, -7200/2197, 7296/2197, 0, 0, 0], [439/216, -8, 3680/513, -845/4104, 0, 0],
     [-8/27, 2, -3544/2565, 1859/4104, -11/40, 0]]
b = [25/216, 0, 1408/2565, 2197/4104, -1/5, 0]
c = [0, 1/4, 3/8, 12/13, 1, 1/2]
"""
FIFTH = ("16/135", "0", "6656/12825", "28561/56430", "-9/50", "2/55")
DIFFERENCE = "1/360, 0, -128/4275, -2197/75240, 1/50, 2/55"
"""Of the weights of order 5 and those of order 4."""


@pytest.mark.parametrize("sign", ["-", "+"])
@pytest.mark.parametrize("declared", ["", "embedded_order = 5\n"])
def test_an_error_estimate_of_either_sign(sign: str, declared: str) -> None:
    """Fehlberg's estimate as b - b_hat and as b_hat - b: the weights of order 5, in an audit and in
    the file of an import.
    """
    numbers = ", ".join(f"{sign}({x})" for x in DIFFERENCE.split(", "))
    table = one("py", f"{FEHLBERG}E = [{numbers}]\n{declared}")
    found = audit(table)
    assert found is not None
    assert found.order is not None
    assert found.embedded_order is not None
    assert (found.order.order, found.embedded_order.order, found.findings) == (4, 5, ())
    (low,) = imported(table, "x").method.embedded or ()
    assert tuple(map(to_text, low)) == FIFTH


def test_nodes_of_zeros_are_told() -> None:
    """No reading without nodes explains them away."""
    head, _, _ = FEHLBERG.rpartition("c = ")
    found = audit(one("py", f"{head}c = [0, 0, 0, 0, 0, 0]\norder = 4\n"))
    assert found is not None
    assert [x.code for x in found.findings if x.level == "error"] == ["nodes"]


def test_two_stages_of_single_numbers() -> None:
    """One entry, two weights and the node are a table; without the node their numbers say so."""
    text = "function ralston(T)\n    a21 = T(2 // 3)\n    b1 = T(1 // 4)\n    b2 = T(3 // 4)\n"
    table = one("jl", f"{text}    c2 = T(2 // 3)\n    return Ralston(a21, b1, b2, c2)\nend\n")
    assert (table.A[0][0], table.b, table.is_assembled) == (RALSTON[0], (("1/4", "3/4"),), True)
    (table,) = julia.find(f"{text}    return Ralston(a21, b1, b2)\nend\n", "x")
    assert (table.A[0][0], table.b, table.c) == (RALSTON[0], (("1/4", "3/4"),), (None,))
    other = text.replace("1 // 4", "1 // 3")
    (table,) = julia.find(f"{other}    return Ralston(a21, b1, b2)\nend\n", "x")
    judged = audit(table)
    assert judged is not None
    assert not judged.is_read


def test_the_order_of_a_class_is_that_of_its_table() -> None:
    """A table above a class, which says of which order it is."""
    text = (
        "T = _ButcherTableau(alpha=[1.0], beta=[[1.0]], c_sol=[0.5, 0.5], c_error=[0.5, -0.5])\n"
        "class Heun(Solver):\n    order = 3\n    tableau = T\n"
    )
    assert one("py", text).order == 3


@pytest.mark.parametrize(
    ("call", "kind"),
    [
        ("TSRosWRegister(R, 2, 2, A, G, b, NULL, 0, NULL);", "Rosenbrock"),
        ("MRABCoupling(A, b, 2, 3, W);", "multirate"),
        ("TSGLEERegister(G, 2, 2, 2, 1.0, A, B, U, V, S, F, c);", "general linear"),
    ],
)
def test_other_methods_are_named(call: str, kind: str) -> None:
    """Their tables are no tables of Runge–Kutta methods."""
    table = one("c", f"void f(void) {{ double A[4] = {{0, 0, 1, 0}}, b[2] = {{0.5, .5}}; {call} }}")
    assert (table.kind, table.b) == (kind, ())


def test_a_call_that_takes_the_arrays_of_a_table_is_none() -> None:
    """The arrays are read by their names; what the call makes of them has no nodes in C."""
    text = (
        "struct T\n A\n C\n b\nend\nconst RK_A = [0 0; 2//3 0]\nconst RK_C = [1 0; 1 1]\n"
        "const RK_b = [1//4, 3//4]\nconst RK_c = [0, 2//3]\nf() = T(RK_A, RK_C, RK_b)\n"
    )
    table = one("jl", text)
    assert (table.A[0], table.trouble) == (RALSTON, "")
