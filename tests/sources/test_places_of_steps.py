"""Where programs keep functions with steps: in objects, in functions that run at once, in others."""

from __future__ import annotations

import pytest

from garkcli.exact.display import to_text
from garkcli.sources.found import Find
from garkcli.sources.languages import c, csharp, fortran, julia, python, rust, typescript

STEP = """(f, y, t, h) {
  var k1 = f(t, y);
  var k2 = f(t + 2*h/3, y + 2*h/3*k1);
  return y + h/4*(k1 + 3*k2);
}"""
PLACES: dict[str, tuple[Find, str]] = {
    "at once": (typescript.find, f"(function () {{ function ralston{STEP}\n}}());"),
    "at once, called behind": (
        typescript.find,
        f"!function (root) {{ root.ralston = function{STEP}; }}(this);",
    ),
    "given to a call": (
        typescript.find,
        f"define(['a'], function (a) {{ function ralston{STEP} return ralston; }});",
    ),
    "of an object": (typescript.find, f"const methods = {{ ralston: function{STEP} }};"),
    "exported": (typescript.find, f"module.exports = {{ ralston{STEP} }};"),
    "of a function": (
        typescript.find,
        "const ralston = (f, h) => (y, t) => {" + STEP.partition("{")[2],
    ),
    "beside this": (
        csharp.find,
        "class A { A Self => this; A B() => this; double ralston"
        "(Func<double, double, double> f, double y, double t, double h)"
        " {" + STEP.partition("{")[2] + " }",
    ),
}


@pytest.mark.parametrize("place", PLACES)
def test_a_step_is_found_in_its_place(place: str) -> None:
    find, text = PLACES[place]
    (table,) = find(text, "x")
    assert table.name.rpartition(".")[2] == "ralston"
    assert not table.trouble
    assert [tuple(map(to_text, x)) for x in table.b] == [("1/4", "3/4")]


LOCAL = """
def ssp(y, t, h, f):
    def half(s, x):
        return x + h/2*f(s, x)
    y1 = half(t, y)
    y2 = half(t + h/2, y1)
    return 1/3*y + 2/3*half(t + h, y2)
"""


def test_a_function_inside_a_step_is_a_part_of_it() -> None:
    """It is no step of its own."""
    (table,) = python.find(LOCAL, "x")
    assert table.name == "ssp"
    assert [tuple(map(to_text, x)) for x in table.b] == [("1/3",) * 3]


PAIRS = """
public static class S {
  public static (double a, double b) Ralston(
      Func<double, (double a, double b), (double a, double b)> f,
      double t, double h, (double a, double b) y) {
    var (a, b) = y;
    var (k1a, k1b) = f(t, y);
    (double k2a, double k2b) = f(t + 2*h/3, (a + 2*h/3 * k1a, b + 2*h/3 * k1b));
    return (a + h/4 * (k1a + 3*k2a), b + h/4 * (k1b + 3*k2b));
  }
}
"""


@pytest.mark.parametrize(
    ("old", "new", "weights"),
    [("", "", [("1/4", "3/4")]), ("3*k2b", "3*k2a", []), ("2*h/3 * k1b", "2*h/3 * k1a", [])],
)
def test_several_values_of_csharp(old: str, new: str, weights: list[tuple[str, str]]) -> None:
    """Components that do not agree make no step."""
    found = [x for x in csharp.find(PAIRS.replace(old, new), "x") if x.b]
    assert [tuple(map(to_text, x)) for table in found for x in table.b] == weights


RESULTS = """
subroutine ralston(t, h)
  real(8), intent(in) :: t, h
  complex(8), dimension(n) :: k1, k2, l1, l2, u, v
  u = p
  v = q
  call rhs(n, t, u, v, k1, l1)
  u = p + 2*h/3.d0*k1
  v = q + 2*h/3.d0*l1
  call rhs(n, t + 2*h/3.d0, u, v, k2, l2)
  p = p + h*(k1 + 3*k2)/4.d0
  q = q + h*(l1 + 3*l2)/4.d0
end subroutine
"""


@pytest.mark.parametrize(
    ("old", "new", "weights"),
    [("", "", [("1/4", "3/4")]), ("u, v, k2, l2", "u, v, l2, k2", []), ("3*l2", "3*k2", [])],
)
def test_several_results_of_a_subroutine(
    old: str, new: str, weights: list[tuple[str, str]]
) -> None:
    found = [x for x in fortran.find(RESULTS.replace(old, new), "x") if x.b]
    assert [tuple(map(to_text, x)) for table in found for x in table.b] == weights


@pytest.mark.parametrize("times", ["mulScalar", "multiplyByScalar", "vec_scale", "times"])
def test_operations_say_that_they_are_of_vectors(times: str) -> None:
    text = (
        "function ralston(y, h, f) { const k = f(y); const l = f(y.add(k.times(2*h/3)));"
        " return y.add(k.times(h/4)).add(l.times(3*h/4)); }"
    )
    (table,) = typescript.find(text.replace("times", times), "x")
    assert [tuple(map(to_text, x)) for x in table.b] == [("1/4", "3/4")]


EULER_STEPS = """
subroutine ssp(u, v)
  real, intent(in) :: u(:)
  real, intent(out) :: v(:)
  real :: u1(size(u)), u2(size(u))
  call forward_euler(u, u1, h, .true.)
  call forward_euler(u1, u2, h, .false.)
  u2 = 0.75*u + 0.25*u2
  call forward_euler(u2, v, h, .false.)
  v = u/3. + 2*v/3.
end subroutine
"""


@pytest.mark.parametrize(
    ("old", "new", "weights"),
    [
        ("", "", [("1/6", "1/6", "2/3")]),
        ("u1, u2, h", "u1, u2, h/2", []),
        ("u1, u2, h", "u1, u2, k", []),
        ("forward_euler", "implicit_euler", []),
        ("2*v/3.", "v/3.", []),
    ],
)
def test_euler_steps_are_multiples_of_slopes(
    old: str, new: str, weights: list[tuple[str, ...]]
) -> None:
    """They are so if all have one step."""
    found = [x for x in fortran.find(EULER_STEPS.replace(old, new), "x") if x.b]
    assert [tuple(map(to_text, x)) for table in found for x in table.b] == weights


VARIADIC = """
function addVectors() { return [].reduce.call(arguments, (x, y) => x.map((z, i) => z + y[i])); }
function ralston(f, y, h) {
  const k = f(y), l = f(addVectors(y, scale(2*h/3, k)));
  return addVectors(y, scale(h/4, k), scale(3*h/4, l));
}
"""


def test_a_sum_of_any_number_of_vectors() -> None:
    """A function with parameters may store the sum in one of them."""
    (table,) = [x for x in typescript.find(VARIADIC, "x") if x.b]
    assert [tuple(map(to_text, x)) for x in table.b] == [("1/4", "3/4")]
    text = VARIADIC.replace("addVectors()", "addVectors(x, y, z)")
    assert [x for x in typescript.find(text, "x") if x.b] == []


COLUMNS = """
function (step::Ralston)(f, x, h)
    @inbounds let
        @. step.y = x
        step.k[:, 1] .= f(step.y)
        @. step.y = x + step.k[:, 1] * 2 * h / 3
        step.k[:, 2] .= f(step.y)
        @. step.new = x + (step.k[:, 1] + 3 * step.k[:, 2]) * h / 4
    end
end
"""
ROWS = """
def ralston(self, f, x, h):
    self.k[0, :] = f(x)
    self.k[1, :] = f(x + 2*h/3*self.k[0, :])
    return x + h/4*(self.k[0, :] + 3*self.k[1, :])
"""


@pytest.mark.parametrize(("find", "text"), [(julia.find, COLUMNS), (python.find, ROWS)])
def test_slopes_in_the_columns_or_rows_of_a_field(find: Find, text: str) -> None:
    (table,) = find(text, "x")
    assert [tuple(map(to_text, x)) for x in table.b] == [("1/4", "3/4")]


IN_RUST = """
fn ralston(f: &dyn Fn(&State) -> State, y: &mut State, h: f64) {
    let k = f(y);
    let l = f(&y.add(&k.mul(2.0 * h / 3.0)));
    y.add_assign(&k.mul(h / 4.0));
    y.add_assign(&l.mul(3.0 * h / 4.0));
}
"""
IN_JAVASCRIPT = """
function ralston(f, y, h) {
  let k = f(y);
  k.multiplyScalar(h);
  let l = f(y.clone().addScaledVector(k, 2/3));
  l.multiplyScalar(h);
  let sum = k;
  sum.addScaledVector(l, 3);
  sum.multiplyScalar(1/4);
  y.add(sum);
  return y;
}
"""


@pytest.mark.parametrize(
    ("find", "text", "misprint"),
    [
        (rust.find, IN_RUST, ("2.0 * h / 3", "1.0 * h / 3")),
        (typescript.find, IN_JAVASCRIPT, ("2/3", "1/3")),
    ],
)
def test_methods_that_change_their_object(find: Find, text: str, misprint: tuple[str, str]) -> None:
    """Operations called for their effect: the last one is the same in a sum."""
    for written, entry in ((text, "2/3"), (text.replace(*misprint), "1/3")):
        (table,) = find(written, "x")
        assert [tuple(map(to_text, x)) for x in table.b] == [("1/4", "3/4")]
        ((rows,),) = table.A
        assert rows is not None
        assert to_text(rows[1][0]) == entry


OUTPUT = """
void solve(double t, double h, State y, double end) {
  while (t < end) {
    State k = f(t, y);
    State l = f(t + 2*h/3, y + 2*h/3*k);
    y = y + h/4*(k + 3*l);
    save("step" + std::to_string(t) + ".txt", y);
    t += h;
  }
}
"""


def test_output_into_a_file_is_no_vector_field() -> None:
    """A function with a text is none, nor is one that makes a text."""
    (table,) = c.find(OUTPUT, "x.cpp")
    assert [tuple(map(to_text, x)) for x in table.b] == [("1/4", "3/4")]
