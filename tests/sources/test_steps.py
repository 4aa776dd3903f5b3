"""Steps that programs write out: the methods that they are."""

from __future__ import annotations

import re

import pytest

from garkcli.bridges.audit import audit
from garkcli.frozen import replace
from garkcli.sources.found import Find
from garkcli.sources.languages import c, fortran, java, julia, matlab, python, rust

KUTTA = """
subroutine rk4(me, t, x, h, xf)
    associate (f1 => me%funcs(:,1), f2 => me%funcs(:,2), f3 => me%funcs(:,3), &
               f4 => me%funcs(:,4), h2 => 0.5_wp*h)
        call me%f(t,x,f1)
        call me%f(t+h2,x+h2*f1,f2)
        call me%f(t+h2,x+h2*f2,f3)
        call me%f(t+h,x+h*f3,f4)
        xf = x + h*(f1+f2+f2+f3+f3+f4)/6.0_wp
    end associate
end subroutine
"""
SHU_OSHER = """
subroutine ssp33(t, x, h, xf)
    call f(t, x, fs)
    xf = x + h*fs
    call f(t + h, xf, fs)
    xf = (3.0_wp*x + xf + h*fs)/4.0_wp
    call f(t + h/2.0_wp, xf, fs)
    xf = (x + 2.0_wp*xf + 2.0_wp*h*fs)/3.0_wp
end subroutine
"""
PAIR = """
subroutine bs32(t, x, h, xf, xerr)
    real(wp), parameter :: a2 = 1.0_wp/2.0_wp, a3 = 3.0_wp/4.0_wp
    real(wp), parameter :: c1 = 2.0_wp/9.0_wp, c2 = 1.0_wp/3.0_wp, c3 = 4.0_wp/9.0_wp
    real(wp), parameter :: e1 = c1 - 7.0_wp/24.0_wp, e2 = c2 - 0.25_wp, e3 = c3 - 1.0_wp/3.0_wp
    call f(t, x, f1)
    call f(t+a2*h, x+h*a2*f1, f2)
    call f(t+a3*h, x+h*a3*f2, f3)
    xf = x + h*(c1*f1 + c2*f2 + c3*f3)
    call f(t+h, xf, f4)
    xerr = h*(e1*f1 + e2*f2 + e3*f3 - 0.125_wp*f4)
end subroutine
"""
PYTHON = """
def heun(f, y, t, dt):
    k1 = dt * f(y, t)
    k2 = dt * f(y + k1, t + dt)
    return y + 0.5 * (k1 + k2)
"""
JULIA = """
function midpoint(f, u, p, t, dt)
    k1 = f(u, p, t)
    k2 = f(t + dt / 2, u + dt * k1 / 2)
    u + dt * k2
end
"""
MATLAB = """
function y = heun3(f, t, y0, h)
k1 = f(t, y0);
k2 = f(t + h/3, y0 + h/3*k1);
k3 = f(t + 2*h/3, y0 + 2*h/3*k2);
y = y0 + h*(k1 + 3*k3)/4;
end
"""
ADAMS = """
def step(f, t, y, h, old):
    new = f(t, y)
    return y + h*(3/2*new - 1/2*old)
"""
CORRECTED = """
def step(f, t, y, h, old):
    new = f(t, y)
    end = f(t + h, y + h*(3/2*new - 1/2*old))
    return y + h*(5/12*end + 8/12*new - 1/12*old)
"""
LOOPS = """
void rk4(float y[], float dydx[], int n, float x, float h, float yout[], Slopes derivs)
{
  float xh, hh, h6, dym[9], dyt[9], yt[9];
  hh = h*0.5;
  h6 = h/6.0;
  xh = x+hh;
  for (i = 1; i <= n; i++) yt[i] = y[i]+hh*dydx[i];
  (*derivs)(xh, yt, dyt);
  for (i = 1; i <= n; i++) yt[i] = y[i]+hh*dyt[i];
  (*derivs)(xh, yt, dym);
  for (i = 1; i <= n; i++) { yt[i] = y[i]+h*dym[i]; dym[i] += dyt[i]; }
  (*derivs)(x+h, yt, dyt);
  for (i = 1; i <= n; i++) yout[i] = y[i]+h6*(dydx[i]+dyt[i]+2.0*dym[i]);
}
"""
STATUS = """
static const double ah[] = { 1.0/2.0, 1.0 };
static const double b3[] = { -1.0, 2.0 };
int apply(void *s, size_t dim, double t, double h, double y[], double yerr[],
          const double dydt_in[], double dydt_out[], const system *sys)
{
  double *const k1 = s->k1;
  double *const k2 = s->k2;
  if (dydt_in != NULL) {
    memcpy(k1, dydt_in, dim);
  } else {
    int s = EVAL(sys, t, y, k1);
    if (s != SUCCESS) { return s; }
  }
  for (i = 0; i < dim; i++)
    ytmp[i] = y[i] + ah[0] * h * k1[i];
  int s = EVAL(sys, t + ah[0] * h, ytmp, k2);
  for (i = 0; i < dim; i++)
    ytmp[i] = y[i] + h * (b3[0] * k1[i] + b3[1] * k2[i]);
  s = EVAL(sys, t + ah[1] * h, ytmp, k3);
  for (i = 0; i < dim; i++) {
    const double d_i = (k1[i] + 4.0 * k2[i] + k3[i]) / 6.0;
    y[i] += h * d_i;
    yerr[i] = h * (d_i - k2[i]);
  }
  if (dydt_out != NULL) {
    s = EVAL(sys, t + h, y, dydt_out);
    if (s != SUCCESS) { memcpy(y, y0, dim); return s; }
  }
  return SUCCESS;
}
"""
AUTONOMOUS = """
def step(system, state, dt):
    k1 = system.slope(state)
    k2 = system.slope(state + dt / 2 * k1)
    k3 = system.slope(state + dt * (2 * k2 - k1))
    return state + dt / 6 * (k1 + 4 * k2 + k3)
"""
FIELDS = """
function perform_step!(integrator, cache::SSPRK22ConstantCache)
    (; t, dt, uprev, u, f, p) = integrator
    integrator.fsalfirst = f(uprev, p, t)
    u = uprev + dt * integrator.fsalfirst
    k = f(u, p, t + dt)
    u = (uprev + u + dt * k) / 2
    integrator.u = u
end
"""
VECTORS = """
void Step(Vector &x, double &t, double &dt)
{
   f->SetTime(t);
   f->Mult(x, k);
   add(x, dt/2, k, y);
   add(x, dt/6, k, z);
   f->SetTime(t + dt/2);
   f->Mult(y, k);
   add(x, dt/2, k, y);
   z.Add(dt/3, k);
   f->Mult(y, k);
   add(x, dt, k, y);
   z.Add(dt/3, k);
   f->SetTime(t + dt);
   f->Mult(y, k);
   add(z, dt/6, k, x);
   t += dt;
}
"""
FUNCTION = """
subroutine rk2(t, y, h, yn)
    real :: t, y(3), h, yn(3), k1(3), k2(3)
    k1 = f(t, y)
    k2 = f(t + h/2, y + h/2*k1)
    yn = y + h*k2
end subroutine
"""
IN_PLACE = """
function step!(f!, u, k1, k2, tmp, p, t, dt)
    f!(k1, u, p, t)
    @. tmp = u + dt/2*k1
    f!(k2, tmp, p, t + dt/2)
    @. u = u + dt*k2
end
"""
INCREMENT = """
def rk4_step_of_func(func, time, step, value, perturbation=None, has_to_perturb=False):
    half_step = step*0.5
    k1 = func(time, value, perturb=Perturb.NEXT if has_to_perturb else Perturb.NONE)
    k2 = func(time + half_step, value + half_step*k1)
    k3 = func(time + half_step, value + half_step*k2)
    k4 = func(time + step, value + step*k3, perturb=Perturb.LAST if has_to_perturb else None)
    return (k1 + 2*(k2 + k3) + k4)*step*one_sixth
"""
HELPERS = """
class Solver {
double[] slopes(double h, double t, double[] x, Function f) {
    double[] k = new double[4];
    k[0] = f.apply(t, x);
    k[1] = f.apply(t + h/2, shifted(x, h/2, k[0]));
    k[2] = f.apply(t + h/2, shifted(x, h/2, k[1]));
    k[3] = f.apply(t + h, shifted(x, h, k[2]));
    return k;
}
double[] shifted(double[] x, double h, double[] k) {
    double[] y = new double[x.length];
    for (int i = 0; i < x.length; i++) { y[i] = x[i] + h*k[i]; }
    return y;
}
double[] step(double h, double t, double[] x, Function f) {
    double[] k = slopes(h, t, x, f);
    double[] y = new double[x.length];
    for (int i = 0; i < x.length; i++) {
        y[i] = x[i] + h*(k[0][i] + 2*k[1][i] + 2*k[2][i] + k[3][i])/6;
    }
    return y;
}
}
"""
END = """
double step(double t) {
    try {
        double k1 = rhs(y(0), t - dt, x);
        double k2 = rhs(y(0) + dt*k1/2, t - dt/2, x);
        return y(0) + dt*k2;
    } catch (Error e) { throw e; }
}
"""
SIR = """
def step(s, i, r, dt):
    s1, i1, r1 = dt*fs(s, i), dt*fi(s, i), dt*fr(i)
    s2 = dt*fs(s + s1/2, i + i1/2)
    i2 = dt*fi(s + s1/2, i + i1/2)
    r2 = dt*fr(i + i1/2)
    return s + s2, i + i2, r + r2
"""
NUMBER = """
h = 0.1
def run(f, t, y):
    while t < 1:
        k1 = h*f(t, y)
        k2 = h*f(t + h/2, y + k1/2)
        y += k2
        t += h
"""
POINTS = """
void solve(double h, int n) {
    for (int i = 0; i < n; ++i) {
        k[0] = f(p[i].x, p[i].y);
        k[1] = f(p[i].x + h/2, p[i].y + h*k[0]/2);
        p[i + 1].y = p[i].y + h*k[1];
    }
}
"""
TIMES = """
def advance(self):
    u, f, n, t = self.u, self.f, self.n, self.t
    dt = t[n+1] - t[n]
    star = u[n] + dt*f(u[n], t[n])
    return u[n] + 0.5*dt*(f(u[n], t[n]) + f(star, t[n+1]))
"""
FIRST = """
void advance(Vector &v, double t, double dt) {
    eq->equation(k1, v, t);
    for (int i = 0; i < n; i++) tmp[i] = v[i] + dt/2*k1[i];
    eq->equation(k2, tmp, t + dt/2);
    for (int i = 0; i < n; i++) v[i] += dt*k2[i];
}
"""
STEPS = {
    "increments": (python.find, INCREMENT, 4, None),
    "functions that evaluate f and add slopes": (java.find, HELPERS, 4, None),
    "times before the end of the step": (c.find, END, 2, None),
    "functions of some of the values": (python.find, SIR, 2, None),
    "a number for the step": (python.find, NUMBER, 2, None),
    "fields of entries": (c.find, POINTS, 2, None),
    "entries at unknown indices": (python.find, TIMES, 2, None),
    "slopes in the first argument": (c.find, FIRST, 2, None),
    "sums of vectors": (c.find, VECTORS, 4, None),
    "a function of Fortran": (fortran.find, FUNCTION, 2, None),
    "slopes in place": (julia.find, IN_PLACE, 2, None),
    "slopes in fields": (julia.find, FIELDS, 2, None),
    "loops over components, the first slope is given": (c.find, LOOPS, 4, None),
    "what is evaluated before and after, errors": (c.find, STATUS, 3, 2),
    "no time": (python.find, AUTONOMOUS, 3, None),
    "Kutta": (fortran.find, KUTTA, 4, None),
    "Shu and Osher": (fortran.find, SHU_OSHER, 3, None),
    "Bogacki and Shampine": (fortran.find, PAIR, 3, 2),
    "Heun": (python.find, PYTHON, 2, None),
    "Heun, three stages": (matlab.find, MATLAB, 3, None),
}


@pytest.mark.parametrize("name", STEPS)
def test_the_order_of_a_step(name: str) -> None:
    """The order that the paper has, and no higher; nothing is wrong."""
    find, text, order, low = STEPS[name]
    (table,) = find(text, "x")
    assert table.notes == ("the coefficients are those of a step that is written out",)
    found = audit(table)
    assert found is not None
    assert found.order is not None
    # the sign of an estimate may be open
    wrong = [x for x in found.findings if x.code != "sign"]
    assert (found.order.order, wrong) == (order, [])
    assert (found.embedded_order and found.embedded_order.order) == low


@pytest.mark.parametrize(
    ("text", "old", "new"),
    [
        (LOOPS, "yt[i] = y[i]+hh*dyt[i]", "yt[i] = y[i]+hh*dyt[i-1]"),
        (LOOPS, "(*derivs)(x+h, yt, dyt)", "if (x > 0) (*derivs)(x+h, yt, dyt)"),
        (LOOPS, "{ yt[i] = ", "{ s += y[i]; yt[i] = "),
        (LOOPS, "<= n; i++) yt[i] = y[i]+hh*dyt", "<= n/2; i++) yt[i] = y[i]+hh*dyt"),
        (STATUS, "memcpy(k1, dydt_in", "memcpy(k1, y"),
        (STATUS, "k1[i] + 4.0", "g(k1[i]) + 4.0"),
    ],
)
def test_a_step_that_is_not_followed_is_told(text: str, old: str, new: str) -> None:
    """Other entries, half of the entries, another way that is another step, sums, calls in loops."""
    assert old in text
    (found,) = c.find(text.replace(old, new), "x")
    assert (found.name, found.trouble) == (found.name, "a step that is not followed")


def test_vectors_that_change_in_place_in_julia() -> None:
    """Sums in place, at the end too, are followed; other changes of slopes and of the value are not."""
    assert [x.b for x in julia.find(IN_PLACE, "x")] == [(("0", "1"),)]
    last = "@. u = u + dt*k2"
    for sum_ in ("@. u += dt*k2", "axpy!(dt, k2, u)"):
        (table,) = julia.find(IN_PLACE.replace(last, sum_), "x")
        assert table.b == (("0", "1"),)
    for other in ("lmul!(s, k2)", "rmul!(k2, 0.5)", "mul!(u, M, k2)"):
        for text in (f"{other}\n    {last}", f"{last}\n    {other.replace('k2', 'u')}"):
            (table,) = julia.find(IN_PLACE.replace(last, text), "x")
            assert table.trouble == "a step that is not followed"


def test_multistep_methods_are_no_steps() -> None:
    """A slope that is given beside the first one is that of an earlier step; where a stage has
    another slope in it, it is not passed over.
    """
    assert python.find(ADAMS, "x") == []
    (found,) = python.find(CORRECTED, "x")
    assert found.trouble == "a step that is not followed"


def test_vectors_with_indices_from_0_in_fortran() -> None:
    """Loops over components of vectors of unknown length."""
    text = "subroutine s(n, t, y, h)\nreal :: y(0:n), k(0:n), w(0:n)\ncall f(t, y, k)\nname = me%name()\n{}\n"
    text += "call f(t + h/2, w, k)\n{}\nend subroutine\n"
    loop = "do i = 0, n\n{0}(i) = y(i) + {1}*k(i)\nend do"
    (table,) = fortran.find(text.format(loop.format("w", "h/2"), loop.format("y", "h")), "x")
    assert (table.b, table.c) == ((("0", "1"),), (("0", "1/2"),))


@pytest.mark.parametrize(
    "index", [("", ""), ("[n]", "[n+1]"), ("[n-1]", "[n]"), ("[:, n]", "[:, n+1]")]
)
@pytest.mark.parametrize("loop", ["for n in range(N)", "while go()"])
def test_steps_in_loops_over_time(index: tuple[str, str], loop: str) -> None:
    """A loop that takes steps, with a value or with an array of them; not that of Euler."""
    here, after = index if loop.startswith("for") else ("", "")
    text = f"def run(f, t, y, h, N):\n    {loop}:\n        k = f(t{here}, y{here})\n"
    end = f"        y{after} = y{here} + h*k\n        print(y)\n    return y\n"
    second = f"        k = f(t{here} + h/2, y{here} + h/2*k)\n"
    (found,) = python.find(text + second + end, "x")
    assert (found.name, found.b, found.c) == ("run", (("0", "1"),), (("0", "1/2"),))
    assert python.find(text + end, "x") == []
    third = "        k = g(k)\n"
    (other,) = python.find(text + second + third + second + end, "x")
    assert other.trouble == "a step that is not followed"


def test_steps_between_times_of_an_array() -> None:
    """``h = t[n + 1] - t[n]``, counted by hand, outside of functions; another index is no step."""
    text = """
n = 0
while n < N:
    h = t[n + {}] - t[n]
    k = f(t[n], y[n])
    y[n + 1] = y[n] + h*f(t[n] + h/2, y[n] + h/2*k)
    n += 1
"""
    (found,) = python.find(text.format(1), "x")
    assert (found.b, found.c) == ((("0", "1"),), (("0", "1/2"),))
    assert not any(x.b for x in python.find(text.format("m"), "x"))


@pytest.mark.parametrize("last", ["l", "m"])
def test_steps_of_systems(last: str) -> None:
    """Several functions with the slopes of several values; the coefficients are those of all."""
    text = f"""
def step(f, g, t, x, v, h):
    k = f(t, x, v)
    l = g(t, x, v)
    m = f(t + h, x + h*k, v + h*l)
    n = g(t + h, x + h*k, v + h*{last})
    return x + h/2*(k + m), v + h/2*(l + n)
"""
    found = [(x.b, x.c) for x in python.find(text, "x") if x.b]
    assert found == ([((("1/2", "1/2"),), (("0", "1"),))] if last == "l" else [])


@pytest.mark.parametrize("both", ["add(k, l, y)", "add(1.0, k, 1.0, l, y)"])
def test_sums_of_vectors_by_their_arguments(both: str) -> None:
    """Heun with the sum of its slopes, as MFEM has it; before, y is another vector."""
    text = f"""
    void Step(Vector &x, double &t, double &dt)
    {{ f->Mult(x, k); add(x, dt, k, y); f->Mult(y, l); {both}; x.Add(dt/2, y); }}"""
    (table,) = c.find(text, "x")
    assert (table.b, table.A) == ((("1/2", "1/2"),), (((("0", "0"), ("1", "0")),),))


def test_which_value_of_a_pair_is_the_step() -> None:
    """The one that is returned, whichever is computed last; of two it is the first one, unless the
    declared order is that of the other.
    """
    text = "def step(f, t, y, h):\n    k1 = f(t, y)\n    k2 = f(t + h, y + h*k1)\n"
    text += "    high = y + h/2*(k1 + k2)\n    low = y + h*(k1/4 + 3*k2/4)\n"
    text += "    error = abs(high - low)\n"
    for result, order in [("high", 2), ("high, error", 2), ("low, error", 1), ("t + h, high", 2)]:
        (table,) = python.find(f"{text}    return {result}\n", "x")
        found = audit(table)
        assert found is not None
        assert found.order is not None
        assert found.order.order == order
    for result, low in [("high, low", "1/4"), ("low, high", "1/2"), ("error", "1/4")]:
        (table,) = python.find(f"{text}    return {result}\n", "x")
        assert table.embedded is not None
        assert table.embedded[0][0] == low
        for declared in (None, 2):
            found = audit(replace(table, order=declared))
            assert found is not None
            assert found.order is not None
            assert (found.order.order, found.has_errors) == (2, False)


def test_a_value_that_is_a_stage_may_be_the_step() -> None:
    """Bogacki and Shampine's pair, the embedded value computed last: nothing is returned."""
    text = PAIR.replace("xerr = h*(", "low = x + h*(7.0_wp/24.0_wp*f1 + f2/4.0_wp + f3/3.0_wp")
    text = re.sub(r"(f3/3.0_wp).*", r"\1 + 0.125_wp*f4)\n    xerr = xf - low", text)
    (found,) = fortran.find(text, "x")
    assert (found.trouble != "", found.b) == (True, ())


def test_a_wrong_number_is_found() -> None:
    """A stage at another time than its value has; weights whose sum is not 1."""
    (table,) = fortran.find(KUTTA.replace("call me%f(t+h,x", "call me%f(t+h2,x"), "x")
    found = audit(table)
    assert found is not None
    assert [(x.code, x.level) for x in found.findings] == [("nodes", "error")]
    (table,) = python.find(PYTHON.replace("0.5 * (k1", "0.4999 * (k1"), "x")
    found = audit(table)
    assert found is not None
    assert [(x.code, x.level) for x in found.findings] == [("weights", "error")]


@pytest.mark.parametrize(
    "text",
    [
        JULIA,
        PYTHON.replace("y + k1", "y + k1**2"),
        PYTHON.replace("k1 = dt", "for i in range(n):\n        k1 = dt"),
        PYTHON.replace("0.5 * (k1", "0.4 * (k1"),
        PYTHON.replace("t + dt", "t + 1"),
        "def g(a, b):\n    c = max(a, b)\n    d = max(a + c, b)\n    return c + d\n",
        "def step(sim, rhs, h):\n    k1 = rhs(sim.u)\n    sim.predict(h/2)\n    k2 = rhs(sim.u)\n"
        "    k3 = rhs(sim.u + h/4*k2)\n    sim.u = sim.u + h*(k1 + k3)/2\n",
    ],
)
def test_what_is_no_step(text: str) -> None:
    """Slopes squared, in a loop, weights whose sum is not 1, times without the step; arguments in
    another order; a call that is given the step and may go on with the state.
    """
    find = julia.find if text is JULIA else python.find
    assert not any(x.b for x in find(text, "x"))


@pytest.mark.parametrize(
    "between", ["    project(k1)", "    match m:\n        case 1:\n            k1 = 3*k1"]
)
def test_a_slope_that_may_have_changed_makes_no_step(between: str) -> None:
    """What is done to it in place, or where it is not followed."""
    text = "def step(f, t, x, h, m):\n    k1 = f(t, x)\n{}\n    k2 = f(t + h/2, x + h/2*k1)\n"
    text += "    return x + h*k2\n"
    assert [x.trouble for x in python.find(text.format("    print(m)"), "x")] == [""]
    assert not any(x.b for x in python.find(text.format(between), "x"))


def test_a_stage_value_is_not_taken_for_a_lost_result() -> None:
    """The step goes into a setter or a limiter."""
    text = "def step(s, t, y, h):\n    k = h*s.f(t, y)\n    z = y + k\n    l = h*s.f(t + h, z)\n"
    text += "    w = y + (k + l)/2\n    {}(w)\n"
    for name in ("s.set_state", "s.limit"):
        assert [x.b for x in python.find(text.format(name), "x")] == [(("1/2", "1/2"),)]


@pytest.mark.parametrize(
    ("between", "entry"),
    [
        ("    if m:\n        project(k1)", "1/2"),
        ("    try:\n        k1 = 3*k1\n    except ValueError:\n        pass", "3/2"),
    ],
)
def test_the_way_that_is_followed(between: str, entry: str) -> None:
    """Without what a branch does to a slope; with what is tried."""
    text = "def step(f, t, x, h, m):\n    k1 = f(t, x)\n{}\n    k2 = f(t + h/2, x + h/2*k1)\n"
    (table,) = python.find(text.format(between) + "    return x + h*k2\n", "x")
    assert (((("0", "0"), (entry, "0")),),) == table.A


@pytest.mark.parametrize(
    ("first", "second"), [("f", "g"), ("max", "max"), ("np.hypot", "np.hypot")]
)
def test_slopes_are_of_one_function(first: str, second: str) -> None:
    """A split step, and what only looks like one."""
    text = f"def step(t, x, h):\n    k1 = {first}(t, x)\n    k2 = {second}(t + h/2, x + h/2*k1)\n"
    assert python.find(text + "    return x + h*k2\n", "x") == []


@pytest.mark.parametrize(
    "between",
    [
        "call dscal(f1, 2.0_wp)",
        "call dscal(f1, two)",
        "call f1%scale()",
        "where (f1 > 0) f1 = 3.0_wp*f1",
        "select case (m)\ncase (1)\nf1 = 3.0_wp*f1\nend select",
    ],
)
def test_a_slope_of_fortran_that_may_have_changed(between: str) -> None:
    """The same in Fortran."""
    text = "subroutine step(t,x,h,xf)\ncall f(t,x,f1)\n{}\n"
    text += "call f(t+h/2.0_wp,x+h/2.0_wp*f1,f2)\nxf = x + h*f2\nend subroutine\n"
    assert [x.trouble for x in fortran.find(text.format(""), "x")] == [""]
    assert not any(x.b for x in fortran.find(text.format(between), "x"))


KERNEL = """
__global__ void advance(double *y, double t, double h, int n)
{
  int i = blockIdx.x*blockDim.x + threadIdx.x;
  if (i >= n) return;
  double k1 = f(t, y[i]);
  double k2 = f(t + h/2, y[i] + h/2*k1);
  y[i] += h*k2;
}
"""


def test_a_thread_takes_its_own_entry() -> None:
    """The entry of a kernel is one place; that of another thread is another."""
    (table,) = c.find(KERNEL, "x.cu")
    assert (table.b, table.c, table.trouble) == ((("0", "1"),), (("0", "1/2"),), "")
    other = KERNEL.replace("if (", "int j = threadIdx.y;\n  if (").replace("t, y[i]", "t, y[j]")
    assert not any(x.b for x in c.find(other, "x.cu"))


@pytest.mark.parametrize(("last", "order"), [("0.67560359597983", 4), ("0.5", None)])
def test_drifts_and_kicks_in_turns(last: str, order: int | None) -> None:
    """Calls with parts of a step; their sums are 1."""
    text = f"""
    void Symplectic::integrate(System &system, double h) {{
      system.drift(6.7560359597983E-1 * h);
      system.kick(1.35120719195966 * h);
      system.drift(-1.7560359597983E-1 * h);
      system.kick(-1.70241438391932 * h);
      system.drift(-1.7560359597983E-1 * h);
      system.kick(1.35120719195966 * h);
      system.drift({last} * h);
    }}"""
    found = [x for x in map(audit, c.find(text, "x")) if x is not None and x.is_read]
    assert [x.order and x.order.order for x in found] == ([order] if order else [])


CHOSEN = {
    "python": (python.find, "    k = f(t, y) if k0 is None else k0\n"),
    "nothing": (python.find, "    k = f(t, y)\n"),
    "a branch": (
        python.find,
        "    if k0 is None:\n        k = f(t, y)\n    else:\n        k = k0\n",
    ),
}


@pytest.mark.parametrize("name", CHOSEN)
def test_increments_of_accepted_steps(name: str) -> None:
    """The first slope may be given; what is returned is an increment, if the error is small."""
    find, first = CHOSEN[name]
    text = f"""
def step(f, t, y, h, k0=None):
{first}    l = f(t + h, y + h*k)
    error = norm(h/2*(l - k))
    if error < 1:
        return h/2*(k + l)
    else:
        return False
"""
    (table,) = find(text, "x")
    assert (table.b, table.c) == ((("1/2", "1/2"),), (("0", "1"),))
    (again,) = find(text.replace("return False", "return None, h/2"), "x")
    assert again.b == table.b
    assert not any(x.b for x in find(text.replace("h/2*(k + l)", "h/2*(k + 2*l)"), "x"))
    (either,) = find(text.replace("return False", "return h*l"), "x")
    assert (either.b, either.trouble) == ((), "a step that is not followed")


def test_values_that_depend_on_a_condition() -> None:
    """Either value of a conditional expression gives the same step, in each language."""
    sources = {
        c: "void step(double t, double *y, double h) { double k = d ? d : f(t, y); BODY }",
        java: "class A { void step(double t, double y, double h) "
        "{ double k = d > 0 ? d : f(t, y); BODY } }",
        julia: "function step(f, t, y, h)\n k = d > 0 ? d : f(t, y)\n BODY\nend",
        rust: "fn step(t: f64, h: f64) { let k = if d > 0.0 { d } else { f(t, y) }; BODY }",
    }
    for module, text in sources.items():
        for second, count in (("f(t + 1.0*h, y + h*k)", 1), ("f(t + 1.0*h, y + h*k*k)", 0)):
            body = f"l = {second}; y = y + 0.5*h*(k + l);"
            tables = module.find(text.replace("BODY", body), "x")
            assert sum(x.b == (("1/2", "1/2"),) for x in tables) == count, module


PROGRAM = """
program main
  h = 0.1d0
  y = 1d0
  do i = 1, 10
    k1 = h*f(x, y)
    k2 = h*f(x + h, y + k1)
    y = y + 0.5d0*(k1 + k2)
    x = x + h
  end do
  do i = 1, 10
    k1 = h*f(x, z)
    k2 = h*f(x + h/2, z + k1/2)
    z = z + k2
    x = x + h
  end do
end program
"""
LISTS = """
def moved(u, v, s):
    return [a + s*b for a, b in zip(u, v)]

def step(f, t, y, h):
    k = f(t, y)
    l = f(t + h/2, [y[i] + h/2*k[i] for i in range(len(y))])
    return moved(y, l, h)
"""
COMPUTED = """
def step(f, t, y):
    h = courant(y, t)
    k = f(t, y)
    l = f(t + h/2, y + h/2*k)
    return y + h*l
"""


def test_steps_of_a_program() -> None:
    """Each loop of a program is a step, with functions that look like entries."""
    found = [x.b for x in fortran.find(PROGRAM, "x")]
    assert found == [(("1/2", "1/2"),), (("0", "1"),)]


@pytest.mark.parametrize(
    ("text", "old", "new"),
    [
        (LISTS, "a + s*b", "a + b"),
        (LISTS, "h/2*k[i]", "h/2*k[0]"),
        (COMPUTED, "y + h/2*k", "y + courant(k, t)/2*k"),
    ],
)
def test_steps_with_lists_and_computed_steps(text: str, old: str, new: str) -> None:
    """Comprehensions over components, a helper without numbers, a step that a function gives."""
    (table,) = python.find(text, "x")
    assert (table.b, table.c) == ((("0", "1"),), (("0", "1/2"),))
    assert not any(x.b for x in python.find(text.replace(old, new), "x"))


PENDULUM = """
def step(x, v, h):
    k1x = v
    k1v = -g*sin(x)
    k2x = v + 0.5*h*k1v
    k2v = -g*sin(x + 0.5*h*k1x)
    return x + h*k2x, v + h*k2v
"""
GROWTH = """
def step(x, t, h):
    k1 = r*(x + t)
    k2 = r*((x + h/2*k1) + (t + h/2))
    return x + h*k2
"""
DECAY = """
void step(double &x, double t, double h) {
  double k1 = h * (-2.0*x + t);
  double k2 = h * (-2.0*(x + 0.5*k1) + (t + 0.5*h));
  x += k2;
}
"""


@pytest.mark.parametrize(
    ("find", "text", "nodes", "old", "new"),
    [
        (python.find, PENDULUM, (), "sin(x + 0.5*h*k1x)", "cos(x + 0.5*h*k1x)"),
        (python.find, PENDULUM, (), "v + 0.5*h*k1v", "v + 0.5*h*k1x"),
        (python.find, GROWTH, ("0", "1/2"), "k2 = r*", "k2 = r/"),
        (c.find, DECAY, ("0", "1/2"), "0.5*k1) +", "0.5*k1) -"),
        (c.find, DECAY, ("0", "1/2"), "-2.0*", "sizeof(x)*"),
    ],
)
def test_vector_fields_that_are_written_out(
    find: Find, text: str, nodes: tuple[str, ...], old: str, new: str
) -> None:
    """The expressions of a family are values of one function, if only its arguments differ."""
    (table,) = find(text, "x")
    assert table.b == (("0", "1"),)
    assert table.A == (((("0", "0"), ("1/2", "0")),),)
    assert (table.c[0] if nodes else ()) == nodes
    assert not any(x.b for x in find(text.replace(old, new), "x"))


LAMBDA = """
void rk2_step(State& y, double t, double dt) {
  auto moved = [](const State& a, double s, const State& b) {
    State r(a.size());
    for (size_t i = 0; i < a.size(); i++) r[i] = a[i] + s*b[i];
    return r;
  };
  State k1 = rhs(t, y);
  State k2 = rhs(t + dt/2, moved(y, dt/2, k1));
  for (size_t i = 0; i < y.size(); i++) y[i] += dt*k2[i];
}
"""


def test_local_functions_of_cpp() -> None:
    """A lambda of several statements, with a loop of its own."""
    (table,) = c.find(LAMBDA, "x.cpp")
    assert (table.b, table.c) == ((("0", "1"),), (("0", "1/2"),))
    wrong = LAMBDA.replace("a[i] + s*b[i]", "a[i] + b[i]")
    assert not any(x.b for x in c.find(wrong, "x.cpp"))


INDEXED = """
def rk2(f, t, y, h):
    for n in range(steps):
        d = z[t[n - 1]] - z[t[n + 1]]
        k = f(t[n], y[n])
        l = f(t[n] + h/2, y[n] + h/2*k)
        y[n + 1] = y[n] + h*l
"""


def test_entries_at_entries_are_no_steps() -> None:
    """A difference of entries whose indices are entries, too, is not the step."""
    (table,) = python.find(INDEXED, "x")
    assert (table.b, table.c) == ((("0", "1"),), (("0", "1/2"),))
