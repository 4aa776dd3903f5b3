"""Tables that programs of others store across functions, in templates, in registers, or as steps
between which other functions are called; and what is told where none is read.
"""

from __future__ import annotations

import pytest

from garkcli.bridges.audit import audit
from garkcli.sources.finder import UNRECOGNISED
from garkcli.sources.found import Find
from garkcli.sources.languages import c, fortran, java, julia, matlab, python

CASES = """
module coefficients
  real(8) :: gam
contains
subroutine choose(name)
  select case (name)
  case ('TWO')
     gam = (2d0 - sqrt(2d0))/2d0
  case ('THREE')
     gam = (3d0 + sqrt(3d0))/6d0
  end select
end subroutine
subroutine tableau(name)
  select case (name)
  case ('TWO')
     aI = reshape([gam,0d0, 1d0-gam,gam],[2,2],order=[2,1])
     bI = [1d0-gam, gam]
  case ('THREE')
     aI = reshape([gam,0d0, 1d0-2d0*gam,gam],[2,2],order=[2,1])
     bI = [0.5d0, 0.5d0]
  end select
end subroutine
end module
"""


def test_the_numbers_of_a_case_are_those_of_the_same_case_elsewhere() -> None:
    """Each function chooses by the same names; a number that a case has twice is not known."""
    found = [x for x in map(audit, fortran.find(CASES, "a.f90")) if x and x.order]
    assert [(x.table.name, x.order.order) for x in found if x.order] == [("TWO", 2), ("THREE", 3)]
    again = CASES.replace("end subroutine\nsubroutine tableau", "if (k > 1) then\nend if\nselect case"
        " (name)\ncase ('TWO')\ngam = 0.25d0\nend select\nend subroutine\nsubroutine tableau")  # fmt: skip
    assert [x.name for x in fortran.find(again, "a.f90") if x.is_read] == ["THREE"]


ALLOCATED = """
subroutine coefficients_of_rk(a, b, c, s)
  real(8) :: a(s,s), b(s), c(s)
  a = 0.d0
  b = 0.d0
  c = 0.d0
  if (s == 3) then
    a(2,1) = 0.5d0
    a(3,1) = -1.d0
    a(3,2) = 2.d0
    c(2) = 0.5d0
    c(3) = 1.d0
    b(1) = 1.d0/6.d0
    b(2) = 2.d0/3.d0
    b(3) = 1.d0/6.d0
  end if
  if (s == 4) then
    a(2,1) = 0.5d0
    a(3,2) = 0.5d0
    a(4,3) = 1.d0
    c(2) = 0.5d0
    c(3) = 0.5d0
    c(4) = 1.d0
    b(1) = 1.d0/6.d0
    b(2) = 1.d0/3.d0
    b(3) = 1.d0/3.d0
    b(4) = 1.d0/6.d0
  end if
end subroutine
"""
ALIAS = """
template <typename T = double>
using heun_three = tableau_of<
  list<T, 1.0 / 3.0,
          0.0, 2.0 / 3.0>,
  list<T, 1.0 / 4.0, 0.0, 3.0 / 4.0>,
  list<T, 0.0, 1.0 / 3.0, 2.0 / 3.0>>;
"""
VARIABLE = """
template <typename type> struct heun {};
template <typename type>
constexpr auto runge_a<heun<type>> = std::array { type(1.0 / 3.0), type(0.0), type(2.0 / 3.0) };
template <typename type>
constexpr auto runge_b<heun<type>> = std::array { type(0.25), type(0.0), type(0.75) };
template <typename type>
constexpr auto runge_c<heun<type>> = std::array { type(0.0), type(1.0 / 3.0), type(2.0 / 3.0) };
"""
PAIRS = (
    """
c = 2.0**(1.0/3.0)
ruth_four = np.array([[0.5, 0.5*(1.0 - c), 0.5*(1.0 - c), 0.5], [0.0, 1.0, -c, 1.0]]) / (2.0 - c)
yoshida = np.array([(w/2, w), ((1 - w)/2, 1 - 2*w), ((1 - w)/2, w), (w/2, 0)])
""".replace("ruth_four", "first")
    .replace("yoshida", "second")
    .replace("second =", "w = 1/(2 - c)\nsecond =")
)
WRAY = """
static const double a0 = 32. / 60., b0 =   0. / 60.;
static const double a1 = 25. / 60., b1 = -17. / 60.;
static const double a2 = 45. / 60., b2 = -25. / 60.;
const coefficients_t rk[3] = { {a0, b0, a0 + b0}, {a1, b1, a1 + b1}, {a2, b2, a2 + b2} };
"""
REGISTERS = """
Integrator::Integrator(const std::string &name) {
  if (name == "rk3") {
    delta.resize(3); beta.resize(3); gam0.resize(3); gam1.resize(3);
    delta[0] = 1.0; beta[0] = 1.0; gam0[0] = 0.0; gam1[0] = 1.0;
    delta[1] = 0.0; beta[1] = 0.25; gam0[1] = 0.25; gam1[1] = 0.75;
    delta[2] = 0.0; beta[2] = 2.0 / 3.0; gam0[2] = 2.0 / 3.0; gam1[2] = 1.0 / 3.0;
  }
}
"""
ROOM = "a = [{}]\nb = [1/6, 1/3, 1/3, 1/6]\nc = [0, 1/2, 1/2, 1]\n"
DIAGONAL = """
d = (3 + sqrt(3))/6;
Ai = zeros(2,2); Ai(2,1) = 1 - 2*d;
rk = struct('Ai', Ai, 'w', [1/2, 1/2], 'gam', d);
"""
BESIDE = """
void Solver::rk_step(double h) {
    double w[3][n]; double k[4][n];
    (*f)(t0, y0, k[0], data);
    for (int i = 0; i < n; i++) { w[0][i] = y0[i] + 0.5 * k[0][i] * h; }
    limit(w[0]);
    (*f)(t0 + 0.5 * h, w[0], k[1], data);
    for (int i = 0; i < n; i++) { w[1][i] = y0[i] + 0.5 * k[1][i] * h; }
    (*f)(t0 + 0.5 * h, w[1], k[2], data);
    for (int i = 0; i < n; i++) { w[2][i] = y0[i] + k[2][i] * h; }
    (*f)(t0 + h, w[2], k[3], data);
    for (int i = 0; i < n; i++) { y1[i] = y0[i] + (k[0][i] + 2*k[1][i] + 2*k[2][i] + k[3][i]) * h/6; }
    history.keep(t0 + h, y1);
}
"""  # fmt: skip
FIRST = """
subroutine rk(y, ynew, h, nd)
  call acceleration(y, acc, nd, soft)
  k1 = h*acc
  call acceleration(y + 0.5d0*k1, acc, nd, soft)
  k2 = h*acc
  ynew = y + k2
end subroutine
"""
ENTRIES = """
void Solver::run(const Array& y0) {
  for (int step = 0; step < steps; ++step) {
    double dt = times(step + 1) - times(step);
    ode.rhs(y, step, time, k1);
    for (int i = 0; i < n; ++i) { z(i) = y(i) + 0.5*dt*k1(i); }
    ode.rhs(z, step, time + 0.5*dt, k2);
    for (int i = 0; i < n; ++i) { y(i) += dt*k2(i); }
    time += dt;
  }
}
"""
CALLED = """
def weights():
    return [1/6, 2/3, 1/6]

class Kutta:
    A = [[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]]
    b = weights()
"""


@pytest.mark.parametrize(
    ("find", "text", "orders"),
    [
        (fortran.find, ALLOCATED, [3, 4]),
        (c.find, ALIAS, [3]),
        (c.find, VARIABLE, [3]),
        (python.find, PAIRS, [4, 4]),
        (c.find, WRAY, [3]),
        (c.find, REGISTERS, [3]),
        (python.find, ROOM.format("1/2, 0, 1/2, 0, 0, 1"), [4]),
        (matlab.find, DIAGONAL, [3]),
        (c.find, BESIDE, [4]),
        (fortran.find, FIRST, [2]),
        (c.find, ENTRIES, [2]),
        (python.find, CALLED, [3]),
    ],
)
def test_programs_of_others(find: Find, text: str, orders: list[int]) -> None:
    """Zeros that branches fill, lists of templates, rows and columns of one array, the registers of
    Wray and of Ketcheson, a diagonal of its own, functions beside f, and functions without
    arguments.
    """
    suffix = {c: "cpp", fortran: "f90", python: "py", matlab: "m"}
    name = next(f"a.{x}" for module, x in suffix.items() if module.find is find)
    found = [x for x in map(audit, find(text, name)) if x is not None and x.order]
    assert [x.order.order for x in found if x.order] == orders
    assert not any(x.has_errors for x in found)


def test_what_changes_a_slope_is_no_function_beside_f() -> None:
    """A slope that is given to another function may have changed; one that nothing uses is lost."""
    for change in ("scale(k[0]);", "k[0].negate();"):
        text = BESIDE.replace("limit(w[0]);", change)
        assert not any(x.is_read for x in c.find(text, "a.cpp"))
    lost = BESIDE.replace("2*k[2][i] + k[3][i]", "3*k[2][i]")
    assert not any(x.is_read for x in c.find(lost, "a.cpp"))


WRONG = """
butcher.a = zeros(2, 2);
s = sqrt(3)/6;
butcher.a(1,1) = 1/4; butcher.a(1,2) = 1/2 - s;
butcher.a(2,1) = 1/2 + s; butcher.a(2,2) = 1/4;
butcher.b = [1/2 1/2];
butcher.c = [1/2 - s, 1/2 + s];
"""
PLAIN = """
sel = struct();
sel.{} = [0 0 0; 1/2 0 0; 1/3 1/7 0];
sel.{} = [0.3 0.4 0.1];
"""


def test_a_wrong_matrix_beside_a_quadrature_is_an_error() -> None:
    """All rows are wrong, but nodes and weights are those of Gauss."""
    (found,) = filter(None, map(audit, matlab.find(WRONG, "a.m")))
    assert [x.code for x in found.findings if x.level == "error"] == ["nodes"]


def test_two_explicit_matrices_are_no_implicit_part() -> None:
    """The diagonal of the implicit part is elsewhere."""
    text = "Ae = [0 0 0; 1/2 0 0; 0 1 0];\nAi = [0 0 0; 1/4 0 0; 0 3/4 0];\n"
    text = f"{text}t = struct('Ae', Ae, 'Ai', Ai, 'b', [1/4 1/4 1/2], 'c', [0 1/2 1]);\n"
    assert not any(x.has_errors for x in map(audit, matlab.find(text, "a.m")) if x is not None)


def test_arrays_of_a_scope_that_speaks_of_methods_are_told_once() -> None:
    """By the name of the file, of a scope or of arrays; other arrays are not told."""
    text = PLAIN.format("weights", "nodes")
    for name in ("butcher", "rk"):
        told = matlab.find(f"function t = {name}_three()\n{text}t = sel;\nend\n", "a.m")
        assert [x.trouble for x in told] == [UNRECOGNISED]
    for name in ("fit", "plot_rk_of", "rk_interpolant"):
        told = matlab.find(f"function t = {name}()\n{text}t = sel;\nend\n", "a.m")
        assert told == []


MEMBERS = """
const double Sdirk::gam = 1.0 - 1.0 / std::sqrt(2.0);
const double Sdirk::coefficients[3][3] = {
  {gam, 0.0, 0.0}, {1.0 - 2.0 * gam, gam, 0.0}, {0.5, 0.5, 0.0} };
"""


def test_members_of_a_class_are_known_in_others() -> None:
    """Their initialisers name them without the class."""
    (found,) = filter(None, map(audit, c.find(MEMBERS, "a.cpp")))
    assert found.order is not None
    assert found.order.order == 2


STATE = """
public class Heun extends Solver {
  public double step() {
    double state[] = ode.getState();
    if (state.length != n) { initialize(h); }
    ode.getRate(state, k1);
    for (int i = 0; i < n; i++) { z[i] = state[i] + h * k1[i] / 3; }
    ode.getRate(z, k2);
    for (int i = 0; i < n; i++) { z[i] = state[i] + 2 * h * k2[i] / 3; }
    ode.getRate(z, k3);
    for (int i = 0; i < n; i++) { state[i] = state[i] + h * (k1[i] + 3.0 * k3[i]) / 4.0; }
    return h;
  }
}
"""
NUMBER = """
Schemes::Ascher::Ascher() : RungeKutta() {
  const scalar g(1.0 - sqrt(2.0) / 2.0);
  const scalar d(1.0 - 0.5 / g);
  a_.setSize(3, list(3, 0.0));
  a_[1][0] = g;
  a_[2][0] = d;
  a_[2][1] = 1.0 - d;
  b_[1][1] = g;
  b_[2][1] = 1.0 - g;
  b_[2][2] = g;
}
"""
ROWS = """
const order = {}
const a2 = Float64[1/2]
const a3 = Float64[0, 3/4]
const a4 = Float64[2/9, 1/3, 4/9]
const a = Vector{{Float64}}[Float64[], a2, a3, a4]
const bs = Float64[7/24, 1/4, 1/3, 1/8]
const c = Float64[0, 1/2, 3/4, 1]
"""


def test_more_steps_and_numbers() -> None:
    """The value of a call that knows nothing of the step; a number by its constructor."""
    (found,) = filter(None, map(audit, java.find(STATE, "Heun.java")))
    assert found.order is not None
    assert found.order.order == 3
    pair = [x for x in map(audit, c.find(NUMBER, "a.C")) if x is not None and x.order]
    assert [x.order.order for x in pair if x.order] == [2, 2]


@pytest.mark.parametrize("order", [2, 3])
def test_the_declared_order_says_which_weights_are_meant(order: int) -> None:
    """Bogacki and Shampine's pair, of which names tell the embedded weights alone."""
    found = [x for x in map(audit, julia.find(ROWS.format(order), "a.jl")) if x and x.order]
    assert found
    for each in found:
        assert each.order is not None
        assert each.order.order >= order
        assert not [x for x in each.findings if x.code == "order"]


def test_weights_are_no_difference_of_others() -> None:
    """The last row would be the weights, and b their error: b is told by its name."""
    text = "class Rule(Method):\n    order = 2\n    A = [[0, 0], [1/2, 1/2]]\n"
    (found,) = filter(
        None, map(audit, python.find(f"{text}    b = [-1/2, 1/2]\n    c = [0, 1]\n", "a.py"))
    )
    assert found.has_errors


@pytest.mark.parametrize(
    ("pairs", "is_read"),
    [
        ("(0.31234, 0.5), (0.37532, 0.5), (0.31234, 0)", False),
        ("(2/3, 7/24), (-2/3, 3/4), (1, -1/24)", True),
    ],
)
def test_two_columns_are_a_splitting_of_order_three(pairs: str, is_read: bool) -> None:
    """Sums of 1 and the one condition of order 2 may hold by chance."""
    found = python.find(f"def rk():\n    x = [{pairs}]\n    return go(x)\n", "a.py")
    assert any(x.is_read for x in found) == is_read
