"""Tables as Python packages have them."""

from fractions import Fraction as F

import numpy as np
from scipy.integrate._ivp.rk import RungeKutta


class BogackiShampine(RungeKutta):
    order = 3
    error_estimator_order = 2
    n_stages = 3
    C = np.array([0, 1 / 2, 3 / 4])
    A = np.array([[0, 0, 0], [1 / 2, 0, 0], [0, 3 / 4, 0]])
    B = np.array([2 / 9, 1 / 3, 4 / 9])
    E = np.array([5 / 72, -1 / 12, -1 / 9, 1 / 8])
    P = np.array(
        [[1, -4 / 3, 5 / 9], [0, 1, -2 / 3], [0, 4 / 3, -8 / 9], [0, -1, 1]]
    )


def heun():
    A = np.zeros((2, 2))
    A[1, 0] = 1
    b = [F(1, 2)] * 2
    c = np.array([0, 1.0])
    order = 2
    return A, b, c, order


KUTTA = {
    "A": [[], [0.5], [-1, 2]],
    "b": ["1/6", "2/3", "1/6"],
    "c": [0, 0.5, 1],
    "order": 3,
}

# no tables: a linear system and what cannot be read
A = [[4.0, 1.0], [1.0, 3.0]]
b = [1.0, 2.0]
C = compute(A, b)
