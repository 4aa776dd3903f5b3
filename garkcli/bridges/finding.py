"""The kinds of remarks on a table."""

EXPLAINED = "careless rounding explains it"
CODES = (
    "order",
    "transposed",
    "embedded-order",
    "nodes",
    "weights",
    "embedded-weights",
    "fsal",
    "shape",
    "order-higher",
    "embedded-order-higher",
    "open",
    "rounded",
    "sign",
    "stored",
    "idle",
    "unread",
    "unjudged",
    "other-kind",
)
