"""A file that is being read, and the faults found in it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TypeAlias

from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli import errors
from garkcli.frozen import Frozen, replace
from garkcli.glossary.key import KINDS, FileKind
from garkcli.grammar.foreign import cure_of_foreign
from garkcli.grammar.nodes import composed, folded_place, keys_of, meant_key, position, shortened

Place: TypeAlias = tuple[int, int]
MAX_PLACES = 3
"""Further places that are listed for a cause with many faults."""


class NotedFault(Frozen):
    """``cause`` is empty for a single fault; if ``is_one``, its faults are always reported once."""

    fault: errors.Remark
    cause: str = ""
    is_one: bool = False


def place_of(noted: NotedFault) -> Place:
    return noted.fault.line, noted.fault.column


def told_once(noted: Sequence[NotedFault]) -> list[errors.Remark]:
    """The faults in file order, those of one cause at its first place."""
    causes = Counter(one.cause for one in noted)
    together: dict[object, list[NotedFault]] = {}
    for number, one in enumerate(noted):
        is_shared = one.cause and (one.is_one or causes[one.cause] > MAX_PLACES)
        together.setdefault(one.cause if is_shared else number, []).append(one)
    told: list[errors.Remark] = []
    for group in together.values():
        _, *others = dict.fromkeys(map(place_of, group))
        fault = group[0].fault
        told.append(replace(fault, message=fault.message + _elsewhere(others)))
    return told


def _elsewhere(others: Sequence[Place]) -> str:
    """``(also at 4:12 and in 3 more places)``."""
    if not others:
        return ""
    places = ", ".join(f"{line}:{column}" for line, column in others[:MAX_PLACES])
    left = len(others) - MAX_PLACES
    more = f" and in {errors.counted(left, 'more place')}" if left > 0 else ""
    return f" (also at {places}{more})"


MAX_BYTES = 1_000_000
_MOST_DIGITS = 6
MAX_FAULTS = 200
MAX_FAULTS_READ = 1_000
"""Reading stops after this number of faults."""


Entries: TypeAlias = dict[str, Node]


class Home(Frozen):
    """The key of the mapping that contains a key, and an example with it."""

    key: str
    line: str


_SHORT_VALUE = re.compile(r"[A-Za-z0-9<>=./+ -]{1,30}")
_PLAIN_VALUE = re.compile(r"[A-Za-z0-9]\S*")


def _moved(key: str, value: Node, example: str) -> str:
    """A key with its value in the file, or an example if the value is longer."""
    if not isinstance(value, ScalarNode) or not _SHORT_VALUE.fullmatch(value.value):
        return example
    text = value.value
    return f"{key}: {text}" if _PLAIN_VALUE.fullmatch(text) else f'{key}: "{text}"'


Cures: TypeAlias = Callable[[], Mapping[str, str | Home]]
_NOTHING: Mapping[str, str] = {}
_PYTHON = "tag:yaml.org,2002:python"
"""The prefix of tags that create Python objects."""


class Source:
    def __init__(self, name: str, text: str, kind: FileKind) -> None:
        self.name = name
        self.text = text
        self.kind = kind
        self.faults: list[errors.Remark] = []
        self._found: list[NotedFault] = []

    def fault(
        self,
        node: Node | None,
        message: str,
        cure: str = "",
        offset: int = 0,
        where: str = "",
        cause: str = "",
        *,
        code: str,
        meant: str = "",
    ) -> None:
        """Reports a fault ``offset`` characters into the text of ``node``, or of the file as a
        whole.

        ``where`` says what the value is, such as ``A^{1,1}, row 2``. The same message about a word
        of the file, with another ``where``, has the same cause and is reported once, with its other
        places; so is any message that occurs often, and messages with equal ``cause``. ``meant`` is
        the word that was meant. Raises MethodFileError after ``MAX_FAULTS_READ`` faults.
        """
        line, column = (1, 1) if node is None else self._place(node, offset)
        text = f"{where}: {message}" if where else message
        is_one = bool(cause) or "'" in message
        cause = cause or (f"{message}: {cure}" if where else "")
        fault = errors.Remark(
            errors.printable(text), errors.printable(cure), line, column, code=code, meant=meant
        )
        self._note(fault, cause, is_one)

    def _note(self, fault: errors.Remark, cause: str = "", is_one: bool = False) -> None:
        self.faults.append(fault)
        self._found.append(NotedFault(fault, cause, is_one))
        if len(self._found) >= MAX_FAULTS_READ:
            raise self.error()

    def _place(self, node: Node, offset: int) -> tuple[int, int]:
        line, column = position(node.start_mark)
        if not isinstance(node, ScalarNode):
            return line, column + offset
        if node.style in {"|", ">"} or node.end_mark.line >= line:
            return folded_place(self.text, node, offset)
        return line, column + (node.style in {"'", '"'}) + offset

    def expression_fault(
        self, node: Node, where: str, error: errors.ExpressionError, cause: str = ""
    ) -> None:
        told = error.message, error.help, error.start, where, cause
        self.fault(node, *told, code=error.code, meant=error.meant)

    def close(self) -> None:
        """Raises MethodFileError with all faults, if there are some."""
        if self._found:
            raise self.error()

    def error(self) -> errors.MethodFileError:
        """All faults in file order, each cause once."""
        if not self._found:
            message = f"this is not a {self.kind.name}"
            self.fault(None, message, f"see {self.kind.page}", code="other-file")
        faults = told_once(sorted(dict.fromkeys(self._found), key=place_of))
        if len(faults) > MAX_FAULTS:
            last = faults[MAX_FAULTS]
            more = f"and {len(faults) - MAX_FAULTS} more faults"
            rest = errors.Remark(
                more, "fix these first", last.line, last.column, code="more-faults"
            )
            faults = [*faults[:MAX_FAULTS], rest]
        return errors.MethodFileError(self.name, faults, self.text)

    def error_with(self, note: Callable[[], None]) -> errors.MethodFileError:
        """Returns the error with faults that ``note`` reports, which it then forgets."""
        before = len(self._found)
        note()
        error = self.error()
        del self._found[before:], self.faults[before:]
        return error

    def compose(self) -> MappingNode | None:
        if len(self.text) > MAX_BYTES:
            message = f"a file of more than {MAX_BYTES} characters"
            self.fault(None, message, "split it", code="file-too-large")
            return None
        root = composed(self.text)
        if isinstance(root, errors.Remark):
            self._note(replace(root, help=self._foreign(False) or root.help))
            return None
        if root is None:
            self.fault(None, "the file is empty", self.kind.smallest, code="empty-file")
            return None
        if not isinstance(root, MappingNode):
            message = f"a {self.kind.name} is a mapping of keys to values"
            self.fault(root, message, self._foreign(True) or self.kind.start, code="other-file")
            return None
        other = self._kind_of(root)
        if other is not None:
            message = f"this is a {other.name}, not a {self.kind.name}"
            self.fault(root, message, other.use, code="other-file")
            return None
        return root

    def _kind_of(self, root: MappingNode) -> FileKind | None:
        keys, own = keys_of(root) - {"gark"}, set(self.kind.keys)
        others = (
            kind
            for kind in KINDS.values()
            if keys & (set(kind.keys) - own) and not keys & (own - set(kind.keys))
        )
        return max(others, key=lambda kind: len(keys.intersection(kind.keys)), default=None)

    def _foreign(self, is_yaml: bool) -> str:
        return cure_of_foreign(self.text, self.name, is_yaml) if self.kind.is_imported else ""

    def mapping(
        self,
        node: Node,
        where: str,
        allowed: Iterable[str],
        cures: Cures = dict,
        form: str = "",
        words: Mapping[str, str] = _NOTHING,
    ) -> Entries:
        """The entries of a mapping by key; repeated and unknown keys are reported.

        A misspelt key counts as the intended one, so that a typing error is not also a missing key.
        ``allowed`` has the known keys, all if empty; ``words`` has other spellings.
        """
        if not isinstance(node, MappingNode):
            message = f"{where}: a mapping of keys to values is expected here"
            self.fault(node, message, form, code="mapping-expected")
            return {}
        known = list(allowed)
        given = keys_of(node)
        entries: Entries = {}
        unknown: list[ScalarNode] = []
        for key_node, value in node.value:
            if not isinstance(key_node, ScalarNode):
                cure = "write a word before the colon: name: Heun"
                self.fault(key_node, f"{where}: a key is a plain word", cure, code="no-key")
                continue
            key = key_node.value
            if key in entries:
                twice = f"the key {shortened(key)} appears twice"
                self.fault(key_node, f"{where}: {twice}", "keep one of them", code="doubled")
            elif not known or key in known:
                entries[key] = value
            else:
                unknown.append(key_node)
                # no more are reported, so no more are compared with the known ones
                if len(unknown) > MAX_FAULTS or key in cures():
                    continue
                meant = meant_key(key, known, words)
                if meant and meant not in given:
                    entries[meant] = value
        if unknown:
            values = {id(key_node): value for key_node, value in node.value}
            self._unknown_keys(unknown, values, where, known, cures(), words)
        return entries

    def _unknown_keys(
        self,
        unknown: Sequence[ScalarNode],
        values: Mapping[int, Node],
        where: str,
        known: Sequence[str],
        cures: Mapping[str, str | Home],
        words: Mapping[str, str],
    ) -> None:
        """Reports keys that belong in one other place as one fault."""
        together: dict[object, list[ScalarNode]] = {}
        for number, key_node in enumerate(unknown[:MAX_FAULTS]):
            there = cures.get(key_node.value, number)
            group = there.key if isinstance(there, Home) else there
            together.setdefault(group, []).append(key_node)
        for nodes in together.values():
            shown = nodes[:MAX_PLACES]
            noun = "key" if len(nodes) == 1 else "keys"
            names = ", ".join(shortened(x.value) for x in shown)
            first = nodes[0].value
            cure, meant = cures.get(first), ""
            if isinstance(cure, Home):
                homes = ((x, cures[x.value]) for x in shown)
                lines = [
                    _moved(x.value, values[id(x)], home.line)
                    for x, home in homes
                    if isinstance(home, Home)
                ]
                cure = f"write {cure.key}: {{{', '.join(lines)}}}"
            elif cure is None:
                meant = meant_key(first, known, words)
                cure = f"did you mean {meant!r}?" if meant else errors.did_you_mean(first, known)
            message = f"{where}: unknown {noun} {names}"
            self.fault(nodes[0], message, cure, code="unknown-key", meant=meant)
        if len(unknown) > MAX_FAULTS:
            count = len(unknown) - MAX_FAULTS
            message = f"{where}: and {count} more unknown keys"
            self.fault(unknown[MAX_FAULTS], message, "fix these first", code="more-faults")

    def check_version(self, node: Node | None) -> None:
        if node is not None and self.scalar(node, "gark") != "1":
            message = "gark: this program reads version 1 of the format"
            self.fault(node, message, "write gark: 1", code="wrong-version")

    def items(self, node: Node, where: str, cure: str = "") -> list[Node]:
        if not isinstance(node, SequenceNode):
            cure = cure or "write it in brackets: [ , ]"
            self.fault(node, "a list is expected here", cure, where=where, code="list-expected")
            return []
        return list(node.value)

    def scalar(self, node: Node, where: str) -> str | None:
        if not isinstance(node, ScalarNode):
            message, cure = "a single value is expected here", "write one number or word"
            self.fault(node, message, cure, where=where, code="value-expected")
            return None
        tag = str(node.tag)
        if not tag.startswith("tag:yaml.org,2002:") or tag.startswith(_PYTHON):
            message = f"the tag {shortened(tag)} is not allowed here"
            self.fault(node, message, "leave it out", where=where, code="tag")
            return None
        return str(node.value)

    def whole(
        self, node: Node, where: str, smallest: int = 0, largest: int | None = None
    ) -> int | None:
        """The whole number; only decimal digits without leading zeros are one."""
        text = self.scalar(node, where)
        if text is None:
            return None
        is_padded = text.startswith("0") and text != "0"
        is_plain = text.isascii() and text.isdigit() and not is_padded
        if is_plain and len(text) > _MOST_DIGITS:
            limit = f"most {_MOST_DIGITS} digits"
        elif not is_plain or int(text) < smallest:
            limit = f"least {smallest}"
        elif largest is not None and int(text) > largest:
            limit = f"most {largest}"
        else:
            return int(text)
        shown = text if limit == f"most {largest}" else shortened(text)
        message = f"{where}: a whole number of at {limit} is expected, not {shown}"
        example = min(max(smallest, 2), largest or 2)
        self.fault(node, message, f"write plain digits, such as {example}", code="wrong-value")
        return None

    def choice(self, node: Node, where: str, known: Iterable[str]) -> str | None:
        text = self.scalar(node, where)
        words = list(known)
        if text is None or text in words:
            return text
        message = f"{where}: {shortened(text)} is not known"
        self.unknown_word(node, message, text, words)
        return None

    def unknown_word(self, node: Node, message: str, word: str, known: Iterable[str]) -> None:
        words = list(known)
        cure, meant = errors.did_you_mean(word, words), errors.nearest(word, words)
        self.fault(node, message, cure, code="unknown-word", meant=meant)
