"""The kinds of remarks on a table."""

EXPLAINED = "careless rounding explains it"
CODES = {
    "order": "the order is lower than the source declares",
    "transposed": "the matrix is transposed",
    "embedded-order": "the embedded order is lower than the source declares",
    "nodes": "nodes are not the row sums",
    "weights": "the weights have another sum than 1",
    "embedded-weights": "the embedded weights have another sum than 1",
    "fsal": "the last stage is not the first of the next step",
    "shape": "arrays of a table do not fit together",
    "order-higher": "the order is higher than the source declares",
    "embedded-order-higher": "the embedded order is higher than declared",
    "open": "the digits leave open whether the order is as declared",
    "sign": "nothing decides the sign of the error estimate",
    "stored": "the numbers of a table say how it is stored",
    "idle": "an array beside a table has no role in it",
    "unread": "coefficients are not written out",
    "unjudged": "judging a table takes too long",
    "other-kind": "the table is not one of a Runge–Kutta method",
}
"""The kinds of remarks, in words."""
