module tables
  use, intrinsic :: iso_fortran_env, only: wp => real64
  implicit none
  ! entry by entry, and without the blanks of tables
contains
  subroutine ralston(A, b, c)
    real(wp), parameter :: third = 1.0_wp/3
    integer, parameter :: order = 2
    real(wp) :: A(2,2), b(2), c(2)
    A = 0
    A(2,1) = 2*third
    b = [0.25_wp, 0.75_wp]
    c = (/ 0.0_wp, 2.0_wp/3.0_wp /)
  end subroutine ralston
  subroutine kutta_step(f, x, h)
    real(wp), parameter :: a2 = 1.0_wp/2.0_wp, a3 = 1
    real(wp), parameter :: b21 = 1.0_wp/2.0_wp, b31 = -1.0_wp, b32 = 2.0_wp
    real(wp), parameter :: c1 = 1.0_wp/6.0_wp, c2 = 2.0_wp/3.0_wp, c3 = 1.0_wp/6.0_wp
    x = x + h * (c1 * f(x) + c2 * f(x + b21 * h))
  end subroutine kutta_step
end module tables
