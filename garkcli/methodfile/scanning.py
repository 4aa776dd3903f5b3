"""PyYAML's loader in Python, with its commonest steps made short.

What PyYAML does sign by sign is done here at once where a pattern shows that nothing else can come
of it: spaces between tokens, numbers and words that end at a comma, a bracket or a colon. All else
is left to PyYAML, so the nodes, their places and the faults are its own.
"""

from __future__ import annotations

import re
from typing import Any

import yaml
from yaml.tokens import ScalarToken

_LINE_ENDS = r"\n\r\x85\u2028\u2029"
_BLANKS = r"\0 \t" + _LINE_ENDS
_SPACES = re.compile(r" *")
_NO_TOKEN = frozenset("#\n\r\x85\u2028\u2029")
"""Behind spaces: a comment, or the end of the line."""
_ENDS_AT_COLON = rf"(?=:[{_BLANKS}])"
_WORD_IN_BLOCK = re.compile(rf"[^{_BLANKS}:#]+{_ENDS_AT_COLON}")
_WORD_IN_FLOW = re.compile(rf"[^{_BLANKS}:#,?\[\]{{}}]+(?:(?=[,\[\]{{}}])|{_ENDS_AT_COLON})")
"""A plain scalar on which the next sign puts an end, whatever comes then."""


class QuickLoader(yaml.SafeLoader):
    """PyYAML's scanner and parser, sooner; for one text as a whole."""

    # set by PyYAML
    buffer: str
    pointer: int
    index: int
    column: int
    flow_level: int
    tokens: list[yaml.Token]
    tokens_taken: int
    states: list[Any]

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self._settled = -1

    def forward(self, length: int = 1) -> None:
        """Move on by so many signs."""
        end = self.pointer + length
        passed = self.buffer[self.pointer : end]
        if end >= len(self.buffer) or not passed.isprintable():
            # among others line ends, which do more to a position than moving it a column on
            super().forward(length)
            return
        self.pointer = end
        self.index += length
        self.column += length

    def scan_to_next_token(self) -> None:
        """Pass what is between two tokens."""
        if self.index:
            spaces = _SPACES.match(self.buffer, self.pointer)
            if spaces and spaces.end() > self.pointer:
                self.forward(spaces.end() - self.pointer)
            if self.buffer[self.pointer] not in _NO_TOKEN:
                return
        super().scan_to_next_token()

    def scan_plain(self) -> ScalarToken:
        """A scalar without quotation marks."""
        pattern = _WORD_IN_FLOW if self.flow_level else _WORD_IN_BLOCK
        word = pattern.match(self.buffer, self.pointer)
        if not word:
            token: ScalarToken = super().scan_plain()
            return token
        start = self.get_mark()
        self.forward(word.end() - word.start())
        self.allow_simple_key = False
        return ScalarToken(word.group(), True, start, self.get_mark())

    def need_more_tokens(self) -> bool:
        """Whether the scanner has to go on; the parser asks many times before it takes a token."""
        if self.tokens_taken == self._settled:
            return False
        if not self.tokens:
            return not self.done
        if self.possible_simple_keys and super().need_more_tokens():
            return True
        self._settled = self.tokens_taken
        return False

    def check_token(self, *choices: Any) -> bool:
        """Whether the next token is one of ``choices``, or whether there is one; as PyYAML has it,
        without a call for a token that is settled.
        """
        if self.tokens_taken != self._settled:
            while self.need_more_tokens():
                self.fetch_more_tokens()
        if not self.tokens:
            return False
        return not choices or isinstance(self.tokens[0], choices)

    def parse_node(self, block: bool = False, indentless_sequence: bool = False) -> yaml.Event:
        """The event of one value; most are scalars without anchor and tag."""
        if not self.check_token(ScalarToken):
            event: yaml.Event = super().parse_node(block, indentless_sequence)
            return event
        token: ScalarToken = self.get_token()  # type: ignore[no-untyped-call]
        self.state = self.states.pop()
        # whether its tag follows from its text, and whether from its quotation marks
        implicit = (True, False) if token.plain else (False, True)
        return yaml.ScalarEvent(
            None, None, implicit, token.value, token.start_mark, token.end_mark, style=token.style
        )
