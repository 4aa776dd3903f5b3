"""Tables as programs of several kinds have them: the method that each is, and what keeps it unread."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from garkcli.bridges.audit import audit
from garkcli.sources.found import FoundTable
from garkcli.sources.languages import c, fortran, julia, matlab, python

RETURNED = """
struct Tableau2 { std::vector<double> c; Eigen::MatrixXd a; std::vector<double> b; };
Tableau2 tableau(const int order) {
  if (order == 2) {
    return { {0.0, 0.5}, (Eigen::MatrixXd(2, 2) << 0.0, 0.0, 0.5, 0.0).finished(), {0.0, 1.0} };
  } else {
    return { {0.0, 0.5, 1.0},
      (Eigen::MatrixXd(3, 3) << 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, -1.0, 2.0, 0.0).finished(),
      {1.0/6.0, 2.0/3.0, 1.0/6.0} };
  }
}
"""
METHODS = """
struct Heun : RungeKutta {
  std::vector<std::vector<double>> getA() const override { return {{0, 0}, {1, 0}}; }
  std::vector<double> b() const override { return {1./2, 1./2}; }
  std::vector<double> c() const override { return {0, 1}; }
};
"""
MACROS = """
#define DEFINE(s, p) Coefficients<s, p>::Coefficients()
DEFINE(2, 2)
{
  order = 2;
  a += 0.0, 0.0, 1.0, 0.0;
  b += 0.5, 0.5;
  c += 0.0, 1.0;
}
DEFINE(3, 3)
{
  a += 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, -1.0, 2.0, 0.0;
  b += 1.0/6.0, 2.0/3.0, 1.0/6.0;
}
"""
CAPITALS = """
#define C2 0.5
#define A21 0.5
#define A32 0.5
#define A43 1.0
#define B1 1.0/6.0
#define B2 1.0/3.0
#define B3 1.0/3.0
#define B4 1.0/6.0
#define C3 0.5
"""
WORDS = """
real, parameter :: A(2,2) = reshape((/ zero, twothirds, zero, zero /), (/2, 2/))
real, parameter :: b(2) = (/ QUARTER, THREE_FOURTHS /)
real, parameter :: c(2) = (/ zero, two_thirds /)
"""
GETTERS = """
classdef ARS < IMEX
  properties
    gamma = 1 - 1/sqrt(2)
  end
  methods
    function Ai = get.Ai(this)
      g = this.gamma;
      Ai = [0 0 0; 0 g 0; 0 1-g g];
    end
    function Ae = get.Ae(this)
      g = this.gamma;
      d = 1 - 1/(2*g);
      Ae = [0 0 0; g 0 0; d 1-d 0];
    end
    function bi = get.bi(this)
      bi = [0 1-this.gamma this.gamma];
    end
    function be = get.be(this)
      g = this.gamma;
      d = 1 - 1/(2*g);
      be = [d 1-d 0];
    end
  end
end
"""
ROSENBROCK = """
def ros2():
    g = 1 + 1/sqrt(2)
    return RosenbrockTableau(
        a=((0, 0), (1/g, 0)), C=((0, 0), (-2/g, 0)), b=(3/(2*g), 1/(2*g)), b_hat=(1/g, 0),
        c=(0, 1), gamma=g, order=2, gamma_stages=(g, -g))
"""
PAPER = """
t = RosenbrockTableau(A=((0, 0), (1, 0)), gamma=((1, 0), (-2, 1)), b=(1/2, 1/2), order=2)
"""
RODAS = """
struct Coefficients {{
  Coefficients() : gamma(double(0.25)), d1(double(0.25)), d2(double(-0.1043)), d3(double(0.1035)),
    d4(double({d4})), c2(double(0.386)), c3(double(0.21)), c4(double(0.63)),
    a21(double(1.544)), a31(double(0.9466785280815826)), a32(double(0.2557011698983284)),
    a41(double(3.314825187068521)), a42(double(2.896124015972201)), a43(double(0.9986419139977817)),
    a51(double(1.221224509226641)), a52(double(6.019134481288629)), a53(double(12.53708332932087)),
    a54(double(-0.687886036105895)),
    c21(double(-5.6688)), c31(double(-2.430093356833875)), c32(double(-0.2063599157091915)),
    c41(double(-0.1073529058151375)), c42(double(-9.594562251023355)), c43(double(-20.47028614809616)),
    c51(double(7.496443313967647)), c52(double(-10.24680431464352)), c53(double(-33.99990352819905)),
    c54(double(11.7089089320616)),
    c61(double(8.083246795921522)), c62(double(-7.981132988064893)), c63(double(-31.52159432874371)),
    c64(double(16.31930543123136)), c65(double(-6.058818238834054)) {{}}
}};
"""
ROS2 = """
function y = ROS2(f, J, y, h)
gamma = 1 + 1/sqrt(2);
gamma21 = -2*gamma;
alpha21 = 1;
b1 = 0.5;
b2 = 0.5;
end
"""
SHAMPINE = """
namespace { const scalar
    Ros::a21 = 2, Ros::a31 = 48.0/25.0, Ros::a32 = 6.0/25.0,
    Ros::c21 = -8, Ros::c31 = 372.0/25.0, Ros::c32 = 12.0/5.0,
    Ros::c41 = -112.0/125.0, Ros::c42 = -54.0/125.0, Ros::c43 = -2.0/5.0,
    Ros::b1 = 19.0/9.0, Ros::b2 = 1.0/2.0, Ros::b3 = 25.0/108.0, Ros::b4 = 125.0/108.0,
    Ros::gamma = 1.0/2.0, Ros::c2 = 1, Ros::c3 = 3.0/5.0, Ros::d1 = 1.0/2.0, Ros::d2 = -3.0/2.0,
    Ros::d3 = 605.0/250.0, Ros::d4 = 29.0/250.0; }
"""
COMPOSITIONS = """
      SUBROUTINE COMPCO (METHC, GAM)
      REAL*8 GAM(100)
      IF (METHC.EQ.43) THEN
        QR2=2.0D0**(1.0D0/3.0D0)
        GAM(1)=1.0D0/(2.0D0-QR2)
        GAM(2)=-QR2*GAM(1)
      END IF
      IF (METHC.EQ.45) THEN
        QR4=4.0D0**(1.0D0/3.0D0)
        GAM(1)=1.0D0/(4.0D0-QR4)
        GAM(2)=GAM(1)
        GAM(3)=-QR4*GAM(1)
      END IF
      IF (METHC.EQ.67) THEN
        GAM(1)= 0.78451361047755726381949763D0
        GAM(2)= 0.23557321335935813368479318D0
        GAM(3)=-1.17767998417887100694641568D0
        GAM(4)= 1.31518632068391121888424973D0
      END IF
      END
"""
LABELS = """
      subroutine step(f, n, y, t, h, yp, w, s)
      do 10 k = 1, n
   10   w(k) = y(k) + h*
     1         yp(k)
      call f(t + h, w, s)
      do 20 k = 1, n
        w(k) = y(k) + h/2*(yp(k) + s(k))
   20 continue
      end
"""
HATS = """
classdef Methods
  methods
    function obj = Methods(name)
      switch name
        case 'ARS111'
          obj.Ahat = [0 0; 1 0];
          obj.A = [0 0; 0 1];
          obj.bhat = [1 0];
          obj.b = [0 1];
        case 'SSP33'
          obj.Ahat = [0 0 0; 1 0 0; 1/4 1/4 0];
          obj.bhat = [1/6 1/6 2/3]; obj.chat = sum(obj.Ahat, 2)';
      end
    end
  end
end
"""
ROOTS = """
function tableau()
    g = 1 − √2 / 2
    d = -2√2 / 3
    A = [0 0 0; g 0 0; d 1-d 0]
    b = [0, 1 - g, g]
    return ButcherTableau(A, b)
end
"""
Find = Callable[[str, str], list[FoundTable]]


@pytest.mark.parametrize(
    ("find", "text", "orders"),
    [
        (c.find, RETURNED, [2, 3]),
        (c.find, METHODS, [2]),
        (c.find, MACROS, [2, 3]),
        (c.find, CAPITALS, [4]),
        (fortran.find, WORDS, [2]),
        (matlab.find, GETTERS, [2]),
        (python.find, ROSENBROCK, [2]),
        (python.find, PAPER, [2]),
        (c.find, RODAS.format(d4=-0.03620000000000023), [4]),
        (c.find, SHAMPINE, [4]),
        (matlab.find, ROS2, [2]),
        (lambda text, _: fortran.find(text, "x.f"), COMPOSITIONS, [4, 4, 6]),
        (lambda text, _: fortran.find(text, "x.f"), LABELS, [2]),
        (matlab.find, HATS, [1, 3]),
        (julia.find, ROOTS, [2]),
    ],
)
def test_the_order_of_each_table(find: Find, text: str, orders: list[int]) -> None:
    found = [x for x in map(audit, find(text, "x")) if x is not None]
    assert [x.order and x.order.order for x in found] == orders
    assert not any(x.has_errors for x in found)


def test_parts_with_letters_are_one_method() -> None:
    """Ai and Ae: halves of a method, each of which would be a method, too."""
    (found,) = matlab.find(GETTERS, "x")
    assert (len(found.b), found.name) == (2, "ARS")


def test_embedded_weights_of_rosenbrock_by_names() -> None:
    (found,) = map(audit, python.find(ROSENBROCK, "x"))
    assert found is not None
    assert found.embedded_order is not None
    assert found.embedded_order.order == 1


@pytest.mark.parametrize(("third", "count"), [("1/3", 1), ("w", 0)])
def test_unknown_weights_are_not_the_last_row(third: str, count: int) -> None:
    """Rows 2 to 4 of RK4: the last one has the sum 1, and is no weights beside unknown ones."""
    text = "A = [[1/2, 0, 0], [0, 1/2, 0], [0, 0, 1]]\nc = [0, 1/2, 1/2, 1]\n"
    found = python.find(text + f"b = [1/6, 1/3, {third}, 1/6]\n", "rk4.py")
    assert [len(x.b[0]) for x in found if x.b] == [4] * count


def test_columns_of_an_array_are_weights_and_embedded_ones() -> None:
    text = """
subroutine bs
  real :: a_bs(3), b_bs(3,3), c_bs(4,2)
  a_bs(1) = 0.5; a_bs(2) = 0.75; a_bs(3) = 1.0
  b_bs = 0.0
  b_bs(1,1) = 0.5; b_bs(2,2) = 0.75; b_bs(1,3) = 2.0/9.0; b_bs(2,3) = 1.0/3.0; b_bs(3,3) = 4.0/9.0
  c_bs(1,1) = 2.0/9.0; c_bs(2,1) = 1.0/3.0; c_bs(3,1) = 4.0/9.0; c_bs(4,1) = 0.0
  c_bs(1,2) = 7.0/24.0; c_bs(2,2) = 0.25; c_bs(3,2) = 1.0/3.0; c_bs(4,2) = 0.125
end subroutine
"""
    (found,) = (x for x in fortran.find(text, "x") if x.b)
    assert found.b == (("2/9", "1/3", "4/9", "0"),)
    assert found.embedded == (("7/24", "1/4", "1/3", "1/8"),)
    assert found.c == (("0", "1/2", "3/4", "1"),)


def test_a_projection_is_no_block_with_a_misprint() -> None:
    """Half of (1, 0, 1, 0) and (0, 1, 0, 1): weights with the sum 1, and two of three rows fit."""
    text = "J40 = [[1/2, 0, 1/2, 0], [0, 1/2, 0, 1/2], [1/2, 0, 1/2, 0], [0, 1/2, 0, 1/2]]"
    assert not any(x.b for x in python.find(text, "x"))


def test_a_wrong_sum_of_rosenbrock_is_found() -> None:
    """RODAS as programs store it: the sign of d4 is that of the row sum of Γ."""
    (found,) = map(audit, c.find(RODAS.format(d4=0.03620000000000023), "x"))
    assert found is not None
    assert found.has_errors


def test_without_order_2_there_is_no_rosenbrock_method() -> None:
    text = ROS2.replace("gamma21 = -2*gamma", "gamma21 = -3*gamma")
    assert not any(x.gamma for x in matlab.find(text, "x"))
    assert any(x.gamma for x in matlab.find(ROS2, "x"))


def test_numbers_that_are_no_nodes_are_left_out() -> None:
    """One of three nodes is a misprint; three of them are something else."""
    text = RODAS.format(d4=-0.03620000000000023)
    one = text.replace("c3(double(0.21))", "c3(double(0.12))")
    three = one.replace("c2(double(0.386))", "c2(double(3))").replace(
        "c4(double(0.63))", "c4(double(5))"
    )
    found = [audit(table) for x in (one, three) for table in c.find(x, "x")]
    assert [x is not None and x.has_errors for x in found] == [True, False]


def test_a_last_row_like_another_one_is_no_weights() -> None:
    """The fifth row of RK4 with its weights has the node 1, too, and a higher order than the last:
    weights are elsewhere.
    """
    rows = "[0]*6, [1/2, 0, 0, 0, 0, 0], [0, 1/2, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0]"
    text = f"rk_a = [{rows}, [1/6, 1/3, 1/3, 1/6, 0, 0], [1/6, 2/3, 0, 0, 1/6, 0]]\n"
    text += "rk_c = [0, 1/2, 1/2, 1, 1, 1]\n"
    assert not any(x.b for x in python.find(text, "rk.py"))


CASES = """
subroutine schemes(scheme)
  real(8), allocatable :: butcher_aA(:,:), butcher_bA(:)
  select case (scheme)
  case ('IJ3')
    butcher_aA = reshape([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, &
      0.0, onethird, 0.0, 0.0, 0.0, -1.0, 2.0, 0.0], [4, 4], order=[2, 1])
    butcher_bA = reshape([0.0, 0.0, 0.75, 0.25], [4])
  case ('SDIRK2')
    butcher_aA = reshape([gammaa, 0.0, 1.0 - gammaa, gammaa], [2, 2], order=[2, 1])
    butcher_bA = reshape([1.0 - gammaa, gammaa], [2])
  end select
end subroutine
"""


def test_a_matrix_of_stages_is_no_block_and_what_is_not_known_is_told() -> None:
    """Rows of zeros agree with every node; gammaa is a number of another procedure."""
    found = [audit(table) for table in fortran.find(CASES, "x")]
    assert not any(x.has_errors for x in found if x is not None)
    messages = [y.message for x in found if x is not None for y in x.findings]
    assert any("the name gammaa" in x for x in messages)
