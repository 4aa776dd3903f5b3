"""The blocks between diagonal methods: by transfer rules, or as the file gives them."""

from __future__ import annotations

from typing import TypeAlias

from garkcli.errors import GarkError, MethodError, ShapeMismatch
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix
from garkcli.methodfile.description import MatrixText, MethodsText, RuleText, block_name
from garkcli.methodfile.source import Source
from garkcli.methodfile.values import Values
from garkcli.order.certificate import find_order
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Method
from garkcli.transfer import PAIR_RULES, RULES, Rule, build_on, combination, symplectic_blocks

Blocks: TypeAlias = dict[tuple[int, int], Matrix]


class BlockBuilder:
    """Makes the off-diagonal blocks of one file.

    Args:
        source: where what the mathematics refuses becomes a fault.
        values: of the coefficients.
        text: what the file says.
        methods: the diagonal ones.
    """

    def __init__(
        self, source: Source, values: Values, text: MethodsText, methods: list[Method]
    ) -> None:
        self.source = source
        self.values = values
        self.text = text
        self.methods = methods
        self._orders: dict[int, int] = {}

    def built(self, is_general: bool) -> Blocks:
        """All blocks; the one at which the second colour sees the first where the structure of
        the problem needs no other.

        Raises:
            MethodFileError: a block cannot be made.
        """
        needed = [(1, 0)]
        if is_general:
            colours = range(len(self.methods))
            needed = [(l, m) for l in colours for m in colours if l != m]
        blocks: Blocks = {}
        for l, m in needed:
            text = self._text_of(l, m)
            try:
                blocks[l, m] = self._block(text, l, m)
            except GarkError as error:
                place = self.text.methods[0] if text is None else text
                message = f"{block_name(l, m)}: {error.message}"
                self.source.fault(place.node, message, error.help, code=error.code)
        self.source.close()
        return blocks

    def _text_of(self, l: int, m: int) -> MatrixText | RuleText | None:
        """What the file says of a block: itself, with the opposite one, or of all."""
        transfer = self.text.transfer
        own = transfer.blocks.get((l, m))
        return own or self._rule_of_both(m, l) or transfer.default

    def _rule_of_both(self, l: int, m: int) -> RuleText | None:
        """The rule given for the block (l, m), when it makes the opposite block too."""
        block = self.text.transfer.blocks.get((l, m))
        if not isinstance(block, RuleText):
            return None
        rule, _ = block.terms[0]
        return block if rule in PAIR_RULES else None

    def _block(self, text: MatrixText | RuleText | None, l: int, m: int) -> Matrix:
        if text is None:
            cure = "give it one, or a default, under transfer"
            raise MethodError("it has no rule", cure, code="missing-key")
        if isinstance(text, MatrixText):
            return self._matrix(text, l, m)
        return self._by_rule(text, l, m)

    def _matrix(self, text: MatrixText, l: int, m: int) -> Matrix:
        """A block that the file spells out."""
        rows = self.methods[l].stages
        columns = self.methods[m].stages
        found_rows = len(text.rows)
        found_columns = len(text.rows[0])
        if (found_rows, found_columns) != (rows, columns):
            found = f"a matrix of {found_rows} by {found_columns}"
            message = f"{found} should be {rows} by {columns}"
            cure = f"a row for each stage of method {l + 1},"
            cure += f" a column for each of method {m + 1}"
            raise ShapeMismatch(message, cure)
        return self.values.matrix(text.rows)

    def _by_rule(self, text: RuleText, l: int, m: int) -> Matrix:
        """A block by one rule, or by several with weights."""
        rule, weight = text.terms[0]
        if weight is not None:
            return self._combined(text, l, m)
        if rule in PAIR_RULES:
            return self._of_both(rule, l, m)
        make = RULES[rule]
        return make(self.methods[l], self.methods[m])

    def _of_both(self, rule: str, l: int, m: int) -> Matrix:
        """A block by a rule that makes it together with the opposite one."""
        orders = [self._order(k) for k in range(len(self.methods))]
        base = build_on(self.methods, orders, l, m)
        other = l if base == m else m
        made = symplectic_blocks(PAIR_RULES[rule], self.methods, base, other)
        return made[l, m]

    def _combined(self, text: RuleText, l: int, m: int) -> Matrix:
        """A combination of blocks by rules.

        Raises:
            MethodError: its weights do not sum to 1.
        """
        terms: list[tuple[Number, Rule]] = []
        for name, tau in text.terms:
            if tau is not None:
                terms.append((self.values.number(tau), RULES[name]))
        total = sum((tau for tau, _ in terms), start=ZERO)
        if total != ONE:
            raise MethodError(
                f"the weights of the combination sum to {total}, not to 1",
                "weights that sum to 1 keep the block consistent",
                code="weights-of-combination",
            )
        return combination(terms, self.methods[l], self.methods[m])

    def _order(self, l: int) -> int:
        """The order of a diagonal method on its own, found once."""
        if l not in self._orders:
            alone = gark([self.methods[l]], {})
            self._orders[l] = find_order(alone).order
        return self._orders[l]
