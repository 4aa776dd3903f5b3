"""Forms in which programs write steps out: each is read, and with a misprint it is judged or noted."""

from __future__ import annotations

import pytest

from garkcli.bridges.audit import audit
from garkcli.bridges.readers import mathematica
from garkcli.sources.found import Find
from garkcli.sources.languages import (
    c,
    csharp,
    fortran,
    java,
    julia,
    matlab,
    python,
    rust,
    typescript,
)

KEPT_IN_A_LOOP = """
def bs32(f, t0, x0, end, h):
    t = [t0]
    x = [x0]
    i = 0
    k1 = f(t0, x0)
    while t[i] < end:
        if t[i] + h > end:
            h = end - t[i]
        k2 = f(t[i] + 1/2*h, x[i] + 1/2*h*k1)
        k3 = f(t[i] + 3/4*h, x[i] + 3/4*h*k2)
        new = x[i] + h*(2*k1 + 3*k2 + 4*k3)/9
        k4 = f(t[i] + h, new)
        err = h*(-5/72*k1 + 1/12*k2 + 1/9*k3 - 1/8*k4)
        h, accepted = control.adapted(h, err, x[i], new)
        if accepted:
            t.append(t[i] + h)
            x.append(new)
            k1 = k4
            i += 1
    return t, x
"""
KEPT_IN_A_FIELD = """
def step(self, t, y, h):
    if self.is_first:
        self.k1 = self.f(t, y)
        self.is_first = False
    k2 = self.f(t + h/2, y + h/2*self.k1)
    k3 = self.f(t + 3*h/4, y + 3*h/4*k2)
    new = y + h*(2*self.k1 + 3*k2 + 4*k3)/9
    k4 = self.f(t + h, new)
    error = np.abs(h*(-5/72*self.k1 + k2/12 + k3/9 - k4/8))
    self.k1 = k4
    return new, error
"""
REJECTED = """
def rk23(f, t, y, h):
    k1 = h*f(t, y)
    k2 = h*f(t + h, y + k1)
    k3 = h*f(t + h/2, y + k1/4 + k2/4)
    R = abs((k1 + k2 - 2*k3)/3)/h
    if R <= tol:
        y = y + (k1 + k2 + 4*k3)/6
        t = t + h
    h = h*0.84*(tol/R)**0.25
    return t, y, h
"""
NUMBERED_FUNCTIONS = """
class RK4:
    def step(self, u0, tau):
        def f1(u):
            A1, b1 = self.rhs[0]
            return A1*u + b1
        def f2(u):
            A2, b2 = self.rhs[1]
            return A2*u + b2
        self.k[0] = f1(u0)
        self.k[1] = f2(u0 + 0.5*tau*self.k[0])
        return u0 + tau*self.k[1]
"""
COMPONENTS = """
def f1(x, y):
    return 2*x - y
def f2(x, y):
    return 3*x - y
def step(x, y, h):
    k1 = f1(x, y)
    l1 = f2(x, y)
    k2 = f1(x + h/2*k1, y + h/2*l1)
    l2 = f2(x + h/2*k1, y + h/2*l1)
    return x + h*k2, y + h*l2
"""
STAGES_IN_A_LIST = """
def step(f, t, y, h):
    k = [f(t, y)]
    for c, a in zip([1/2, 1/2, 1], [1/2, 1/2, 1]):
        k.append(f(t + c*h, y + h*a*k[-1]))
    return y + h*sum(b*s for b, s in zip([1/6, 1/3, 1/3, 1/6], k))
"""
STAGES_BY_NUMBER = """
A = [[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]]
def step(f, y, h):
    k = []
    for i in range(3):
        k.append(f(y + h*sum(A[i][j]*k[j] for j in range(i) if A[i][j] != 0)))
    for i, w in enumerate([1/6, 2/3, 1/6]):
        y = y + w*h*k[i]
    return y
"""
REVERSED = """
def step(f, t, y, h):
    z = y
    for a in reversed([1, 1/2, 1/3]):
        z = y + a*h*f(z)
    return z
"""
KEYS = """
def step(f, t, y, h, *args):
    k = {}
    k[1] = f(t, y, *args)
    k[2] = f(t + h/2, y + h/2*k[1], *args)
    k[3] = f(t + h, y - h*k[1] + 2*h*k[2], *args)
    return y + h*np.dot([1/6, 2/3, 1/6], [k[1], k[2], k[3]])
"""
PAIRED = """
def step(f, t, y, h):
    k = f(t, y)
    l = f(t + h/2, [a + h/2*b for a, b in zip(y, k)])
    return [a + h*b for a, b in zip(y, l)]
"""
COLUMNS = """
function y = step(f, t, y, h)
K(:,1) = f(t, y);
K(:,2) = f(t + h/2, y + h/2*K(:,1));
K(:,3) = f(t + h, y - h*K(:,1) + 2*h*K(:,2));
y = y + h*K*[1/6; 2/3; 1/6];
"""
GROWN = """
function [T, Y] = midpoint(f, t0, t1, y0, n)
h = (t1 - t0)/n; T = t0; Y = y0;
for i = 1:n
  t = T(end); y = Y(:,end);
  k = f(t, y);
  l = f(t + h/2, y + h/2*k);
  T(end+1) = t + h;
  Y(:,end+1) = y + h*l;
end
"""
REFERENCES = """
void step(double t, std::vector<double> &y, double h) {
  auto k1 = f(t, y);
  std::vector<double> z(y);
  auto it = k1.begin();
  for (auto &x : z) { x += h/2 * *it; ++it; }
  auto k2 = f(t + h/2, z);
  std::transform(y.begin(), y.end(), k2.begin(), y.begin(),
                 [h](double a, double b) { return a + h*b; });
}
"""
POINTERS = """
void step(double t, double *y, double h, int n) {
  f(t, y, k);
  for (int i = 0; i != n; i++) *(z + i) = *(y + i) + h/2 * *(k + i);
  f(t + h/2, z, l);
  for (int i = 0; i != n; i++) *(y + i) += h * *(l + i);
}
"""
VECTORS_OF_GSL = """
void step(double t, gsl_vector *y, double h, int n) {
  f(t, y, k);
  for (int i = 0; i < n; i++)
    gsl_vector_set(z, i, gsl_vector_get(y, i) + h/2*gsl_vector_get(k, i));
  f(t + h/2, z, l);
  for (int i = 0; i < n; i++)
    gsl_vector_set(y, i, gsl_vector_get(y, i) + h*gsl_vector_get(l, i));
}
"""
CHANGING_HELPER = """
void advanced(State &s, const Slope &k, const Slope &l) {
  s.x = s.x + H*(k.x + l.x)/2.0;
  s.v = s.v + H*(k.v + l.v)/2.0;
}
void step(State &s, double t) {
  Slope k = slope(s, t);
  State z;
  z.x = s.x + H*k.x;
  z.v = s.v + H*k.v;
  Slope l = slope(z, t + H);
  advanced(s, k, l);
}
"""
ITERATORS = """
fn step<F>(f: F, t: f64, y: &Vec<f64>, h: f64) -> Vec<f64> where F: Fn(f64, &Vec<f64>) -> Vec<f64> {
    let k = f(t, y);
    let z: Vec<f64> = y.iter().zip(k.iter()).map(|(a, b)| a + h*b/2.0).collect();
    let l = f(t + h/2.0, &z);
    y.iter().zip(l.iter()).map(|(a, b)| a + h*b).collect()
}
"""
ARRAYS = """
class S { double[] step(double t, double[] y, double h) {
  int n = y.length;
  double[] k = f(t, y);
  double[] z = new double[n];
  for (int i = 0; i < n; i++) { z[i] = y[i] + h/2*k[i]; }
  double[] l = f(t + h/2, z);
  double[] made = new double[n];
  for (int i = 0; i < n; i++) { made[i] = y[i] + h*l[i]; }
  return made;
} }
"""
FUNCTION_OF_ONE = """
program lorenz
  do i = 1, 1000
    k1 = f(u)
    k2 = f(u + 0.5d0*h*k1)
    u = u + h*k2
    write(10,*) u
  end do
end program
"""
EACH = """
function step(f, t, y, h)
    k = [f(i, t, y) for i in eachindex(y)]
    l = [f(i, t + h/2, y .+ h/2 .* k) for i in eachindex(y)]
    return y .+ h .* l
end
"""
TUPLES = """
def step(state, t, h):
    x, v = state
    dx1, dv1 = slopes(x, v, t)
    dx2, dv2 = slopes(x + h/2*dx1, v + h/2*dv1, t + h/2)
    return x + h*dx2, v + h*dv2
"""
ENTRIES = """
def step(x, v, t, h):
    k = [v, f(x, v, t)]
    l = [v + h*k[1]/2, f(x + h*k[0]/2, v + h*k[1]/2, t + h/2)]
    return x + h*l[0], v + h*l[1]
"""
STRUCTURES = """
Slope evaluated(const State &initial, double t, double h, const Slope &k) {
    State s;
    s.x = initial.x + k.dx*h;
    s.v = initial.v + k.dv*h;
    Slope made;
    made.dx = s.v;
    made.dv = acceleration(s, t + h);
    return made;
}
void step(State &s, double t, double h) {
    Slope k = evaluated(s, t, 0.0, Slope());
    Slope l = evaluated(s, t, h*0.5, k);
    s.x = s.x + l.dx*h;
    s.v = s.v + l.dv*h;
}
"""
WITHOUT_A_FUNCTION = """
void step(double *y, double t, double h) {
  double k1[2], k2[2], z[2];
  k1[0] = y[1];
  k1[1] = -sin(y[0]);
  z[0] = y[0] + h/2*k1[0]; z[1] = y[1] + h/2*k1[1];
  k2[0] = z[1];
  k2[1] = -sin(z[0]);
  y[0] += h*k2[0]; y[1] += h*k2[1];
}
"""
LISTS_OF_RESULTS = """
def heun(f, y0, t):
    y = [y0]
    for i in range(len(t) - 1):
        h = t[i+1] - t[i]
        guess = y[-1] + h*f(t[i], y[-1])
        y.append(y[-1] + h/2*(f(t[i], y[-1]) + f(t[i+1], guess)))
    return y
"""
BACKWARD = """
def solve(f, r, x, h):
    for n in range(N):
        k = -h*f(r, x)
        l = -h*f(r + 0.5*k, x - 0.5*h)
        r += l
        x -= h
    return r
"""
KEPT_ENTRIES = """
def run(f, g, x_0, v_0, t_0, h, end):
    t = [t_0]
    xs = [x_0]
    vs = [v_0]
    n = 0
    while t[n] < end:
        k = f(v_0)
        l = g(x_0, t[n])
        m = f(v_0 + h/2*l)
        o = g(x_0 + h/2*k, t[n] + h/2)
        xs.append(xs[n] + h*m)
        vs.append(vs[n] + h*o)
        n += 1
        t.append(t[n-1] + h)
        x_0 = xs[n]
        v_0 = vs[n]
    return xs, vs
"""
TYPE_BOUND = """
subroutine ralston(u, t, h, field)
    class(vector_field), intent(inout) :: field
    real(dp), dimension(size(u)) :: k1, k2
    k1 = field % slope(t, u)
    k2 = field % slope(t + 2*h/3, u + 2*h*k1/3)
    u = u + h*(k1 + 3*k2)/4
    t = t + h
end subroutine
"""
ACCEPTED = """
subroutine pair(u, t, h, f, g1, atol, is_good)
    real(dp), dimension(size(u)) :: g2, g3, low, high
    g2 = f(t + h/3, u + h*g1/3)
    g3 = f(t + 2*h/3, u + 2*h*g2/3)
    high = u + h*(g1 + 3*g3)/4
    low = u + h*(3*g2 - g1)/2
    call control(low, high, atol, h, h_new, is_good)
    if (is_good) then
        u = high
        t = t + h
    end if
    h = h_new
end subroutine
"""
KEPT_BY_ITS_END = """
subroutine fsal(u, t, h, f, g1, is_good)
    real(dp), dimension(size(u)) :: g2, g3, low, high
    g2 = f(t + 2*h/3, u + 2*h*g1/3)
    high = u + h*(g1 + 3*g2)/4
    g3 = f(t + h, high)
    low = u + h*(3*g1 + 3*g2 + 2*g3)/8
    call control(low, high, h, h_new, is_good)
    if (is_good) then
        u = high
        t = t + h
        g1 = g3
    end if
    h = h_new
end subroutine
"""
TRIED_AGAIN = """
function [U, T] = again(f, h, tol, u, t)
factor = 1;
is_bad = 1;
while is_bad
  h = h*factor;
  g1 = f(t, u);
  low = u + h*g1;
  g2 = f(t + 3*h/4, u + 3/4*h*g1);
  high = u + h*(g1 + 2*g2)/3;
  factor = sqrt(tol/norm(high - low));
  if factor > 1
    is_bad = 0;
  end
end
T = t + h;
U = high;
end
"""
MAPPED = """
export function ralston(rhs, state, dt) {
  const byStep = x => x * dt;
  const k1 = rhs(state).map(byStep);
  const k2 = rhs(state.map((s, i) => s + 2/3*k1[i])).map(byStep);
  return state.map(function (s, i) { return s + (k1[i] + 3*k2[i]) / 4; });
}
"""
ROOM = """
void Solver::heun(double t, double h) {
  double **g = new double *[2];
  for (int s = 0; s < 2; s++) { g[s] = new double[n]; }
  double *z = new double[n];
  rhs(t, y, g[0]);
  for (int i = 0; i < n; i++) { z[i] = y[i] + h*g[0][i]; }
  rhs(t + h, z, g[1]);
  for (int i = 0; i < n; i++) {
    y[i] += h*(g[0][i] + g[1][i])/2.;
    track[i].push_back(y[i]);
  }
}
"""
COUNTER_BEFORE = """
class Midpoint {
  double[] slope, k2, u, next;
  void Step(double t, double h, double[] x) {
    int i;
    for (i = 0; i < n; ++i) { u[i] = x[i] + h/2 * slope[i]; }
    rhs(t + h/2, u, k2);
    for (i = 0; i < n; ++i) { next[i] = x[i] + h*k2[i]; }
  }
}
"""
COUNTER_BEFORE_JS = """
function midpoint(f, t, y, h, n) {
  var i, u = [], k1 = f(t, y), k2;
  for (i = 0; i < n; i++) { u[i] = y[i] + h/2 * k1[i]; }
  k2 = f(t + h/2, u);
  for (i = 0; i < n; i++) { y[i] = y[i] + h * k2[i]; }
}
"""
RESHAPED = """
def ralston(field, t, h, u, *given):
    slope = field(t, u, *given).reshape(-1)
    other = field(t + 2*h/3, u + 2*h/3*slope, *given).ravel()
    return u + h*(slope + 3*other)/4
"""
ANONYMOUS = """
class Steps {
  static Stepper ralston(Field f, double h) {
    return new Stepper() {
      public double next(double t, double y) {
        double k = f.at(t, y);
        double l = f.at(t + 2*h/3, y + 2*h/3*k);
        return y + h*(k + 3*l)/4;
      }
    };
  }
}
"""
SELECTED = """
class Ralston {
  double[] Step(Field f, double t, double[] y, double h) {
    var k = f.At(t, y);
    var l = f.At(t + 2*h/3, y.Zip(k, (v, w) => v + 2*h/3*w).ToArray());
    return y.Select((v, i) => v + h*(k[i] + 3*l[i])/4).ToArray();
  }
}
"""
NODE, UNREAD = "nodes", ""
"""A misprint that is an error, and one that makes no step."""
FORMS = {
    "a slope kept in a loop": (python.find, KEPT_IN_A_LOOP, (3, 2), "3/4*h,", "3/5*h,", NODE),
    "a slope kept in a field": (python.find, KEPT_IN_A_FIELD, (3, 2), "3*h/4,", "3*h/5,", NODE),
    "a step that may be rejected": (python.find, REJECTED, (3, 2), "h/2,", "h/3,", NODE),
    "functions with numbers": (python.find, NUMBERED_FUNCTIONS, (2, None), "b2\n", "b2**3\n", ""),
    "stages in a list": (python.find, STAGES_IN_A_LIST, (4, None), "1], [", "1/2], [", NODE),
    "stages by number": (python.find, STAGES_BY_NUMBER, (3, None), "2/3, 1/6", "2/3, 1/7", UNREAD),
    "reversed": (python.find, REVERSED, (2, None), "[1,", "[1/2,", UNREAD),
    "keys and further arguments": (python.find, KEYS, (3, None), "h/2,", "h,", NODE),
    "pairs": (python.find, PAIRED, (2, None), "zip(y, l)", "zip(y, z)", UNREAD),
    "columns": (matlab.find, COLUMNS, (3, None), "t + h,", "t + h/3,", NODE),
    "growing columns": (matlab.find, GROWN, (2, None), "h/2,", "h/3,", NODE),
    "references and transform": (c.find, REFERENCES, (2, None), "t + h/2", "t + h", NODE),
    "pointers": (c.find, POINTERS, (2, None), "*(y + i) + h/2", "*(y + 1) + h/2", UNREAD),
    "vectors of GSL": (c.find, VECTORS_OF_GSL, (2, None), "t + h/2", "t + h", NODE),
    "a helper that changes": (c.find, CHANGING_HELPER, (2, None), "k.x + l.x", "k.x + k.x", UNREAD),
    "iterators": (rust.find, ITERATORS, (2, None), "t + h/2.0", "t + h", NODE),
    "arrays of Java": (java.find, ARRAYS, (2, None), "t + h/2", "t + h", NODE),
    "a function of one value": (fortran.find, FUNCTION_OF_ONE, (2, None), "h*k2", "k2", UNREAD),
    "comprehensions of Julia": (julia.find, EACH, (2, None), "t + h/2", "t + h", NODE),
    "several values": (python.find, TUPLES, (2, None), "t + h/2", "t + h", NODE),
    "lists of slopes": (python.find, ENTRIES, (2, None), "t + h/2", "t + h", NODE),
    "structures": (c.find, STRUCTURES, (2, None), "l.dx*h", "k.dx*h", UNREAD),
    "no function": (c.find, WITHOUT_A_FUNCTION, (2, None), "-sin(z[0])", "-sin(2*z[0])", UNREAD),
    "components": (python.find, COMPONENTS, (2, None), "y + h/2*l1)", "y + h*l1)", UNREAD),
    "backward": (python.find, BACKWARD, (2, None), "x - 0.5*h", "x + 0.5*h", NODE),
    "kept entries": (python.find, KEPT_ENTRIES, (2, None), "v_0 = vs[n]", "v_0 = xs[n]", UNREAD),
    "type-bound functions": (fortran.find, TYPE_BOUND, (2, None), "t + 2*h/3,", "t + h/3,", NODE),
    "an accepted result": (fortran.find, ACCEPTED, (3, 2), "t + h/3", "t + h/2", NODE),
    "a kept slope": (fortran.find, KEPT_BY_ITS_END, (2, 2), "t + 2*h/3", "t + h/3", NODE),
    "tried again": (matlab.find, TRIED_AGAIN, (2, 1), "t + 3*h/4", "t + h/4", NODE),
    "mapped entries": (typescript.find, MAPPED, (2, None), "s + 2/3*", "s*2/3*", UNREAD),
    "room for slopes": (c.find, ROOM, (2, None), "t + h,", "t + h/2,", NODE),
    "counters of C#": (csharp.find, COUNTER_BEFORE, (2, None), "t + h/2", "t + h", NODE),
    "counters of JavaScript": (
        *(typescript.find, COUNTER_BEFORE_JS, (2, None), "t + h/2", "t + h", NODE),
    ),
    "slopes in another shape": (python.find, RESHAPED, (2, None), "t + 2*h/3", "t + h", NODE),
    "a class without a name": (java.find, ANONYMOUS, (2, None), "t + 2*h/3", "t + h", NODE),
    "selected entries": (csharp.find, SELECTED, (2, None), "t + 2*h/3", "t + h", NODE),
    "a list of results": (python.find, LISTS_OF_RESULTS, (2, None), "h/2*(", "h/3*(", UNREAD),
}


@pytest.mark.parametrize("name", FORMS)
def test_a_form_of_a_step(name: str) -> None:
    """It has the order that the method has, and nothing is wrong; a misprint is an error, or makes
    no step.
    """
    find, text, orders, old, new, code = FORMS[name]
    assert _judged(find, text) == [(orders, [])]
    assert old in text
    wrong = _judged(find, text.replace(old, new))
    assert [codes for _, codes in wrong] == ([[code]] if code else [])


def _judged(find: Find, text: str) -> list[tuple[tuple[int | None, int | None], list[str]]]:
    """The orders of the tables that are read, with the codes of errors."""
    judged = []
    for table in find(text, "x"):
        found = audit(table) if table.b else None
        if found is not None and found.order is not None:
            low = found.embedded_order and found.embedded_order.order
            errors = [x.code for x in found.findings if x.level == "error"]
            judged.append(((found.order.order, low), errors))
    return judged


POSITIONS = """
def step(x, v, t, h):
    k1 = f(t, x)
    k2 = f(t + h/2, x + h/2*v + h**2/8*k1)
    k3 = f(t + h, x + h*v + h**2/2*k2)
    return x + h*v + h**2/6*(k1 + 2*k2), v + h/6*(k1 + 4*k2 + k3)
"""
CLASSICAL = """
def step(x, v, t, h):
    k1x = v
    k1v = f(x, t)
    k2x = v + h/2*k1v
    k2v = f(x + h/2*k1x, t + h/2)
    k3x = v + h/2*k2v
    k3v = f(x + h/2*k2x, t + h/2)
    k4x = v + h*k3v
    k4v = f(x + h*k3x, t + h)
    return x + h/6*(k1x + 2*k2x + 2*k3x + k4x), v + h/6*(k1v + 2*k2v + 2*k3v + k4v)
"""
VERLET = """
def step(x, v, h):
    a = f(x)
    x = x + h*v + h*h/2*a
    b = f(x)
    v = v + h/2*(a + b)
    return x, v
"""


@pytest.mark.parametrize(
    ("text", "structure", "order"),
    [(POSITIONS, "nystrom", 4), (CLASSICAL, None, 4), (VERLET, "nystrom", 2)],
)
def test_steps_in_positions_and_velocities(text: str, structure: str | None, order: int) -> None:
    """A Nyström method, unless the positions are those of the velocities of a Runge–Kutta method."""
    (table,) = python.find(text, "x")
    assert (table.structure or None) == structure
    assert _judged(python.find, text) == [((order, None), [])]


def test_a_time_that_is_not_that_of_its_position_makes_no_step() -> None:
    """A Nyström method has one node for both."""
    for old, new in (("t + h/2", "t + h/3"), ("f(t + h,", "f(t,")):
        assert old in POSITIONS
        assert _judged(python.find, POSITIONS.replace(old, new)) == []


def test_a_position_with_other_velocities_is_no_step() -> None:
    """F depends on the velocity, whose stages are not those of the position."""
    text = CLASSICAL.replace("f(x", "f(v, x").replace("f(v, x + h", "f(V, x + h")
    for old, new in (
        ("V, x + h/2*k1x", "k2x, x + h/2*k1x"),
        ("V, x + h/2*k2x", "k3x, x + h/2*k2x"),
    ):
        text = text.replace(old, new)
    text = text.replace("V, x + h*k3x", "k4x, x + h*k3x")
    assert _judged(python.find, text) == [((4, None), [])]
    assert _judged(python.find, text.replace("x + h*k3x", "x + h*k2x")) == []


EXTRAPOLATED = """
def run(f, t, x, h, n):
    k = f(t[i], x[i])
    coarse = x[i] + h*f(t[i] + h/2, x[i] + h/2*k)
    fine = refined(coarse, n)
    x.append(fine + (fine - coarse)/3)
"""
ITERATED = """
void step(double *X, F f, double t, double h, int i) {
  double x = X[i];
  double y = x + h * f(x, t);
  newton(x, y, residual, 1e-7);
  return y;
}
"""
TWO_STEPS = """
def step(f, t, y, h):
    k = f(t, y)
    z = y + h*k
    h, accepted = adapted(h)
    return z + h*f(t + h, z + h*k)
"""


@pytest.mark.parametrize(
    ("find", "text"), [(python.find, EXTRAPOLATED), (c.find, ITERATED), (python.find, TWO_STEPS)]
)
def test_what_goes_on_with_a_step_is_not_read(find: Find, text: str) -> None:
    """Another value is put into the list; a function may change the guess; the step changes."""
    assert _judged(find, text) == []


@pytest.mark.parametrize(("term", "is_read"), [("{}*k[j]", True), ("{}*k[j] + k[j]", False)])
def test_only_products_with_zero_are_left_out(term: str, is_read: bool) -> None:
    text = STAGES_BY_NUMBER.replace("A[i][j]*k[j]", term.format("A[i][j]"))
    assert bool(_judged(python.find, text)) is is_read


def test_long_loops_over_steps_are_read() -> None:
    """A program with a thousand steps is no table of a thousand entries."""
    text = "def f(y, t):\n    return -y\nh = 0.1\ny = np.zeros(1001)\nfor i in range(1000):\n"
    text += (
        "    k = h*f(y[i], t[i])\n    l = h*f(y[i] + 0.5*k, t[i] + 0.5*h)\n    y[i+1] = y[i] + l\n"
    )
    assert [x.b for x in python.find(text, "x")] == [(("0", "1"),)]


def test_a_file_of_matlab_is_none_of_mathematica() -> None:
    """Both have the ending ``.m``."""
    text = "function y = rk4(f, t, y, h)\n% Runge-Kutta\nk1 = h*f(t, y);\nk2 = h*f(t + h/2, y + k1/2);\n"
    text += "k3 = h*f(t + h/2, y + k2/2);\nk4 = h*f(t + h, y + k3);\ny = y + (k1 + 2*k2 + 2*k3 + k4)/6;\n"
    assert mathematica.find(text, "rk4.m") == []
    assert [x.b for x in matlab.find(text, "rk4.m")] == [(("1/6", "1/3", "1/3", "1/6"),)]


def test_a_long_number_has_a_length() -> None:
    """A power with more digits than Python prints."""
    assert not any(x.b for x in python.find("a = 1e-300\nb = [[a**30, a**40], [a, 1]]\n", "x"))
