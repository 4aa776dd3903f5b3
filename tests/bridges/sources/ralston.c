/* The method of Ralston with that of Euler, and an implicit-explicit midpoint rule. */
#include <arkode/arkode_butcher.h>
#define TWO_THIRDS (SUN_RCONST(2.0) / SUN_RCONST(3.0))

static ARKodeButcherTable ralston_euler(void)
{
  sunrealtype c[2] = {SUN_RCONST(0.0), TWO_THIRDS};
  sunrealtype A[4] = {SUN_RCONST(0.0), SUN_RCONST(0.0), TWO_THIRDS, SUN_RCONST(0.0)};
  sunrealtype b[2] = {SUN_RCONST(0.25), SUN_RCONST(0.75)}, d[2] = {1.0, 0.0};
  return ARKodeButcherTable_Create(2, 2, 1, c, A, b, d);
}

/* Kutta's rule: { in a comment }, "and a } in a text" */
static const double kutta_A[3][3] = {{0}, {0.5}, {-1, 2}};
static const double kutta_b[] = {1. / 6, 2.0 / 3.0, 1 / 6.}, kutta_c[3] = {0, .5, 1};
static const int kutta_order = 3;
