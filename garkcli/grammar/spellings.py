"""Spellings of other languages, printed matrices, triangles."""

from __future__ import annotations

import re
from collections.abc import Sequence

from yaml.nodes import Node, ScalarNode, SequenceNode

from garkcli.errors import ExpressionError, UndefinedValue
from garkcli.grammar.nodes import shortened
from garkcli.grammar.source import Source


def is_triangle(lengths: Sequence[int]) -> bool:
    """Whether all rows end at the diagonal, or all before it.

    >>> is_triangle([1, 2, 3]), is_triangle([0, 1, 2]), is_triangle([1, 1, 3])
    (True, True, False)
    """
    stages = len(lengths)
    return list(lengths) in ([*range(stages)], [*range(1, stages + 1)])


def opens(node: Node) -> bool:
    """Whether a plain value has a function that YAML split at the comma."""
    if not isinstance(node, ScalarNode) or node.style in {"'", '"'}:
        return False
    text = str(node.value)
    return "root(" in text and text.count("(") > text.count(")")


def first_list_in_rows(items: Sequence[Node]) -> Node | None:
    for row in items:
        for item in row.value if isinstance(row, SequenceNode) else ():
            if isinstance(item, SequenceNode):
                return item
    return None


_SEVERAL = r"[0-9)][ \t]*[,;\n]|[0-9)][ \t]+[0-9.]"
"""Two numbers without an operator between them."""
_IN_PARENTHESES = r"\([^()]*\)"
MAX_PRINTED = 2_000


def holds_several(text: str) -> bool:
    """Whether a text has several numbers separated by blanks, commas or semicolons only.

    >>> holds_several("0 0; 1/2 0"), holds_several("1/2 - 1/3"), holds_several("root(2, 5)")
    (True, False, False)
    """
    if len(text) > MAX_PRINTED or not re.search(_SEVERAL, text):
        return False
    outside = text
    while re.search(_IN_PARENTHESES, outside):
        outside = re.sub(_IN_PARENTHESES, "0", outside)
    return re.search(_SEVERAL, outside) is not None


def bracketed(text: str) -> str:
    """Writes rows, separated by semicolons or line ends, in YAML.

    >>> bracketed("0 0; 1/2 0"), bracketed("1/6, 2/3, 1/6")
    ('[[0, 0], [1/2, 0]]', '[1/6, 2/3, 1/6]')
    """
    lines = re.split("[;\n]", text.replace(",", " "))
    rows = [line.split() for line in lines if line.split()]
    words = [word for row in rows for word in row]
    if len(words) > 16 or not all(re.fullmatch(_PLAIN, word, re.ASCII) for word in words):
        return ""
    texts = [f"[{', '.join(row)}]" for row in rows]
    return texts[0] if len(texts) == 1 else f"[{', '.join(texts)}]"


def is_printed(source: Source, rows: Sequence[Node], where: str, what: str) -> bool:
    """Reports the first row that is a text of several numbers; ``what`` is ``a row`` or so."""
    texts = []
    for row in rows:
        while isinstance(row, SequenceNode) and len(row.value) == 1:
            row = row.value[0]
        texts.append(str(row.value) if isinstance(row, ScalarNode) else "")
    for row, text in zip(rows, texts, strict=True):
        if text and holds_several(text):
            # a semicolon in one of them parted rows, and commas entries: not to be guessed
            is_clear = ";" not in text or len(texts) == 1
            example = "[0, 1/2]" if what == "a row" else "[[0, 0], [1/2, 0]]"
            as_list = (is_clear and bracketed(";".join(texts))) or example
            message = f"{what} is a list, not the text {shortened(text)}"
            cure = f"put it in brackets, with commas: {as_list}"
            source.fault(row, message, cure, where=where, code="list-expected")
            return True
    return False


_PLAIN = r"[-+]?[0-9][0-9./]*"


_SPELLINGS: tuple[tuple[str, str], ...] = (
    (r"(?P<x>[0-9.]+)[dD](?P<n>[-+]?[0-9]+)", "write the exponent with e: {x}e{n}"),
    (r"(?P<x>[0-9.]+([eE][-+]?[0-9]+)?)_[A-Za-z]\w*", "leave the kind out: {x}"),
    (r"(?P<x>[0-9]*\.[0-9]+|[0-9]+\.)[fFlLq]\b", "leave the suffix out: {x}"),
    (r"\b(?P<f>sqrt|cbrt)(?P<x>[0-9]+)", "write {f}({x})"),
    (r"\b(math|np|numpy|sympy|sp|cmath|jnp)\.(?P<f>sqrt|cbrt)", "write {f}(x)"),
    (r"\b(?P<f>Sqrt|SQRT)\b", "write sqrt(x)"),
    (r"\\d?frac", "write fractions as 1/2"),
    (r"\\sqrt", "write sqrt(x)"),
    (r"\b(Fraction|Rational)\b", "write fractions as 1/2"),
    (r"(?P<x>[0-9]+)//(?P<y>[0-9]+)", "write {x}/{y}"),
    (r"(?<![A-Za-z_])[0-9.]*[ijIJ](?![A-Za-z_0-9])", "coefficients are real here: no complex ones"),
    (r"[0-9)][ \t]+[0-9.]+", "put commas between entries and points in decimals: [0.5, 1/2]"),
)


def explained(error: ExpressionError, text: str) -> tuple[ExpressionError, str]:
    start = error.start
    if len(text) > MAX_PRINTED:
        return error, ""
    for pattern, better in _SPELLINGS:
        match = re.search(pattern, text, re.ASCII)
        # the fault lies in what the pattern found, or right behind it
        if match and match.start() <= start <= match.end():
            message, code = error.message, error.code
            if not isinstance(error, UndefinedValue):
                what = shortened(match.group())
                message = f"{what} is not how a number is written here"
                code = "not-a-number"
            cure = better.format(**match.groupdict())
            explanation = ExpressionError(message, cure, match.start(), match.end(), code=code)
            return explanation, pattern
    # a tableau copied with its symbols; a slip in the name of a parameter is another matter
    is_name = isinstance(error, UndefinedValue) and not error.help.startswith("did you mean")
    is_symbol = is_name and re.fullmatch(_SYMBOLS, text[error.start : error.end], re.ASCII)
    return error, _SYMBOLS if is_symbol else ""


_SYMBOLS = r"[A-Za-z]+_?[0-9]+(_[0-9]+)*"
"""Names such as a11, b_2, x1_2: the symbols of a general tableau, all without values."""
_READ_DIFFERENTLY = (
    r"[-+]?(0[0-9_]+|0[xob][0-9a-f_]+|[0-9][0-9_]*(:[0-5]?[0-9])+(\.[0-9_]*)?|[0-9]*_[0-9_.]*)"
)
"""Plain scalars that YAML 1.1 reads as another number: octal, hexadecimal, base 60, with _."""
_WORDS = {"bool", "null", "timestamp", "merge"}
_NO_FINITE_NUMBERS = {".inf", ".nan", "nan", "inf", "infinity"}


def number_text(source: Source, node: Node, where: str) -> str | None:
    """The number as written; None, with a fault, if YAML reads another value."""
    text = source.scalar(node, where)
    if text is None or not isinstance(node, ScalarNode) or node.style in {"'", '"'}:
        return text
    kind = str(node.tag).rpartition(":")[2]
    message, cure, code = "", "", "not-a-number"
    if kind in _WORDS:
        word = repr(text or "nothing")
        message = f"{word} is not a number: YAML reads it as {kind}"
        cure, code = "write a number, such as 1/2", "yaml-word"
    elif re.fullmatch(_READ_DIFFERENTLY, text, re.IGNORECASE):
        readers = "different readers of YAML"
        message = f"{text} means different numbers to {readers}"
        cure, code = "write the number in plain decimal digits", "ambiguous-number"
        if "_" in text:
            cure = "leave out the _"
    elif text.lower().lstrip("+-") in _NO_FINITE_NUMBERS:
        message, cure = f"{text} is not a number", "coefficients are finite"
    if message:
        source.fault(node, message, cure, where=where, code=code)
        return None
    return text
