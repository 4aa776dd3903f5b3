"""Coefficients of methods that no reader understands are told, once for each scope."""

from __future__ import annotations

import pytest

from garkcli.sources.found import Find
from garkcli.sources.languages import c, fortran, julia, python, typescript

STEP = """
/* Runge-Kutta: y holds the start, and is added to */
static int rk4_step(double *y, const state_t *state, double h, double t, int dim)
{
  double *y0 = state->y0, *w = state->w, *k = state->k;
  for (i = 0; i < dim; i++) { y[i] += h / 6.0 * k[i]; w[i] = y0[i] + 0.5 * h * k[i]; }
  EVAL(t + 0.5 * h, w, k);
  for (i = 0; i < dim; i++) { y[i] += h / 3.0 * k[i]; w[i] = y0[i] + 0.5 * h * k[i]; }
  EVAL(t + 0.5 * h, w, k);
  for (i = 0; i < dim; i++) { y[i] += h / 3.0 * k[i]; w[i] = y0[i] + h * k[i]; }
  EVAL(t + h, w, k);
  for (i = 0; i < dim; i++) { y[i] += h / 6.0 * k[i]; }
  return 0;
}
"""
STRONG = """
class Solver:
    def ssp43(self, state):
        self.work = state.q + self.dt/2*self.dq(state)
        self.work += self.dt/2*self.dq(self.work)
        self.work = 2/3*state.q + 1/3*(self.work + self.dt/2*self.dq(self.work))
        state.q = self.work + self.dt/2*self.dq(self.work) + 0.75*self.rest
"""
LOW_STORAGE = """
// low storage, three stages
static const double alpha[3] = {0, -5.0/7, -153.0/128};
static const double beta[3] = {1.0/3, 15.0/16, 8.0/11};
static const double gam[3] = {0, 1.0/5, 3.0/4};
"""
ROSENBROCK = """
struct default_rosenbrock_coefficients {
  default_rosenbrock_coefficients() : gamma(0.25), d1(0.25), d2(-0.1043), c2(0.386), c3(0.21) {}
};
"""
ARGUMENTS = """
function ImKG(T)
    return kinnmark(T, (1 // 4, 1 // 6, 3 // 8), (0, -1 // 6, 2 // 3))
end
"""
PACKED = """
/* a triangle of Runge-Kutta in one row */
static const double a_packed[6] = {1.0/2, 0, 3.0/4, 2.0/9, 1.0/3, 5.0/7};
"""
ENTRIES = """
subroutine dirk(i, a)
  integer :: i
  real(8) :: a(3,3)
  a(i,1) = 0.2928932188134524d0
  a(i,2) = 0.7071067811865476d0
  a(i,3) = 1d0/3 + 2d0/7
end subroutine
"""
STAGES_INSIDE = """
void rungeKuttaBody(struct Body *body, double h) {
  slopes(body, x, x, h, 0.0, dx1);
  slopes(body, x, dx1, h, 0.5, dx2);
  slopes(body, x, dx2, h, 0.5, dx3);
  slopes(body, x, dx3, h, 1.0, dx4);
  for (j = 0; j < n; j++) { x[j] = x[j] + (dx1[j] + 2.0*dx2[j] + 2.0*dx3[j] + dx4[j])/6.0; }
}
"""


@pytest.mark.parametrize(
    ("find", "text", "name"),
    [
        (c.find, STAGES_INSIDE, "rungeKuttaBody"),
        (c.find, STEP, "rk4_step"),
        (python.find, STRONG, "ssp43"),
        (c.find, LOW_STORAGE, "x"),
        (c.find, PACKED, "x"),
        (c.find, ROSENBROCK, "default_rosenbrock_coefficients"),
        (julia.find, ARGUMENTS, "ImKG"),
        (fortran.find, ENTRIES, "dirk"),
    ],
)
def test_a_scope_that_nothing_else_is_said_of_is_told(find: Find, text: str, name: str) -> None:
    """Steps with several registers, arrays, constructors, arguments, entries at unknown places."""
    (table,) = find(text, "x")
    assert (table.name, bool(table.trouble), table.b) == (name, True, ())


READ = """
/* Runge-Kutta */
static const double b21 = 1.0/5, b31 = 3.0/40, b32 = 9.0/40, w1 = 1.0/6, w2 = 5.0/24, w3 = 5.0/8;
void step(double t, double h, double *y, double *k1, double *k2, double *k3, double *w)
{
  f(t, y, k1);
  for (int i = 0; i < n; i++) w[i] = y[i] + h * b21 * k1[i];
  f(t + h / 5, w, k2);
  for (int i = 0; i < n; i++) w[i] = y[i] + h * (b31 * k1[i] + b32 * k2[i]);
  f(t + 3 * h / 10, w, k3);
  for (int i = 0; i < n; i++) y[i] += h * (w1 * k1[i] + w2 * k2[i] + w3 * k3[i]);
}
"""


def test_what_a_table_uses_or_is_none_is_not_told() -> None:
    """Constants of a step that is read; numbers without any word for a method; interpolants."""
    assert [(x.name, x.trouble) for x in c.find(READ, "x")] == [("step", "")]
    numbers = "    a = [0.25, 1/3, 2/7]\n    c = [3/8, 5/8]\n    return a\n"
    assert python.find(f"def fit(x):\n{numbers}", "x") == []
    assert python.find(f"def runge(x):\n{numbers}", "x") != []
    assert python.find(f"def runge_interpolant(x):\n{numbers}", "x") == []


ANEW = """
t = {}
t["A"] = [[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]]
t["b"] = [1/6, 2/3, 1/6]
use(t)
t["A"] = [[0, 0, 0], [1/3, 0, 0], [0, 2/3, 0]]
use(t)
t["A"] = [[0, 0, 0], [1/2, 0, 0], [0, 3/4, 0]]
use(t)
"""


def test_a_structure_whose_matrix_alone_is_new_is_told_each_time() -> None:
    """The first matrix has the weights; those after it have not."""
    tables = python.find(ANEW, "x")
    assert [bool(x.trouble) for x in tables] == [False, True, True]
    assert "anew" in tables[1].trouble


def test_words_count_in_the_beginning_of_a_line() -> None:
    """All of a source in one line takes no longer than elsewhere: a scope is beside few words."""
    scope = "void g(void) { double a[] = {0.25, 0.3, 2.0/7}, c[] = {0.6, 0.8, 0.1}; }"
    assert c.find(f"/* Runge-Kutta */ {scope}", "x") != []
    assert c.find(f"/* Runge-Kutta */ {scope}".rjust(600), "x") == []


NODES_FIRST = """
function rk32(f, y, h) {
  let a = [0, 1/2, 3/4, 1];
  let b = [[], [1/2], [1/7, 3/4], [2/5, 1/3, 4/7]];
  let c = [7/24, 1/4, 1/3, 1/8];
}
"""


def test_arrays_with_other_roles_than_their_names_are_told() -> None:
    """A matrix called b beside nodes called a is a table; wrong entries hide the roles."""
    right = NODES_FIRST.replace("1/7", "0").replace("2/5", "2/9").replace("4/7", "4/9")
    assert [x.trouble for x in typescript.find(right, "x")] == [""]
    told = [x for x in typescript.find(NODES_FIRST, "x") if not x.is_unlike]
    assert ["do not fit" in x.trouble for x in told] == [True]


BRANCHES = """
module runge_kutta
#if SCHEME == 1 || defined(KUTTA)
  real, parameter :: a(3, 3) = reshape((/0., .5, -1., 0., 0., 2., 0., 0., 0./), (/3, 3/))
  real, parameter :: b(3) = (/1./6, 2./3, 1./6/), c(3) = (/0., .5, 1./)
#elif SCHEME == 2
  real, parameter :: a(2, 2) = reshape((/0., 1., 0., 0./), (/2, 2/))
  real, parameter :: b(2) = (/.5, .5/), c(2) = (/0., 1./)
#endif
end module
"""


def test_branches_of_the_preprocessor_are_tables_of_their_own() -> None:
    """Fortran has them as C does."""
    tables = fortran.find(BRANCHES, "x")
    assert [(x.stages, x.trouble) for x in tables] == [(3, ""), (2, "")]
