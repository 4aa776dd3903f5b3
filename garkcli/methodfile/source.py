"""YAML text to nodes with positions, within limits, and the list in which faults are collected.

``yaml.compose`` keeps what ``safe_load`` loses: where each value stands, keys that occur twice, and
the text of a number as it was written.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import yaml
from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.errors import ExpressionError, Fault, MethodFileError, did_you_mean

MAX_BYTES = 4_000_000
"""Largest file that is read."""
MAX_NODES = 400_000
"""Most YAML values in one file, with aliases counted each time they are used."""
MAX_FAULTS = 200
"""Most faults of one file that are reported one by one."""
MAX_NESTING = 12
"""Deepest nesting of lists and mappings; files need six."""

_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


@dataclass(frozen=True)
class FileKind:
    """What a file is for.

    Attributes:
        name: what people call it.
        smallest: what the smallest one has.
        start: how one begins.
        page: where it is described.
    """

    name: str
    smallest: str
    start: str
    page: str


METHOD_FILE = FileKind(
    "method file",
    "the smallest file has methods and transfer",
    "start with methods: or tableau:",
    "docs/method-file.md",
)
PROBLEM_FILE = FileKind(
    "problem file",
    "the smallest file has variables, hamiltonian and initial",
    "start with variables:",
    "docs/problem-file.md",
)


class Source:
    """One file being read: its name, its text, its kind, and the faults found so far."""

    def __init__(self, name: str, text: str, kind: FileKind = METHOD_FILE) -> None:
        self.name = name
        self.text = text
        self.kind = kind
        self.faults: list[Fault] = []

    def fault(self, node: Node | None, message: str, cure: str = "", offset: int = 0) -> None:
        """Note a fault at ``node``, ``offset`` characters into its text."""
        if node is None:
            self.faults.append(Fault(message, cure, 1, 1))
            return
        self.faults.append(Fault(message, cure, *self._place(node, offset)))

    def _place(self, node: Node, offset: int) -> tuple[int, int]:
        """Line and column of the text of a value, ``offset`` characters into it."""
        mark = node.start_mark
        if not isinstance(node, ScalarNode):
            return mark.line + 1, mark.column + 1 + offset
        if node.style in {"|", ">"} or node.end_mark.line > mark.line:
            return _folded_place(self.text, node, offset)
        return mark.line + 1, mark.column + 1 + (node.style in {"'", '"'}) + offset

    def expression_fault(self, node: Node, where: str, error: ExpressionError) -> None:
        """Note what is wrong with the text of a number."""
        self.fault(node, f"{where}: {error.message}", error.help, error.start)

    def close(self) -> None:
        """Raise what has been found.

        Raises:
            MethodFileError: there are faults; all of them, in file order.
        """
        if self.faults:
            raise self.error()

    def error(self) -> MethodFileError:
        """What has been found, as one error; faults in file order, each once, and at least one."""
        if not self.faults:
            self.fault(None, f"this is not a {self.kind.name}", f"see {self.kind.page}")
        faults = sorted(dict.fromkeys(self.faults), key=_place)
        if len(faults) > MAX_FAULTS:
            rest = Fault(
                f"and {len(faults) - MAX_FAULTS} more faults",
                "mend these first",
                *_place(faults[MAX_FAULTS]),
            )
            faults = [*faults[:MAX_FAULTS], rest]
        return MethodFileError(self.name, faults, self.text)

    def compose(self) -> MappingNode | None:
        """The root of the file; None, with faults noted, where there is no mapping."""
        if len(self.text) > MAX_BYTES:
            self.fault(None, f"a file of more than {MAX_BYTES} characters", "split it")
            return None
        try:
            if len(self.text) > _SHALLOW:
                _refuse_deep(self.text)
            root = yaml.compose(self.text, Loader=_LOADER)
            if root is None:
                self.fault(None, "the file is empty", self.kind.smallest)
                return None
            _walk(root)
        except RecursionError:
            self.fault(None, f"nested more than {MAX_NESTING} deep", "write it flatter")
            return None
        except UnicodeEncodeError as error:  # half of a surrogate pair, which no file has
            place = _place_of_sign(self.text, ord(self.text[error.start]))
            self.faults.append(
                Fault("half a sign, which no text has", "write the text as Unicode", *place)
            )
            return None
        except yaml.MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            place = (mark.line + 1, mark.column + 1) if mark else (1, 1)
            self.faults.append(
                Fault(f"this is not YAML: {error.problem or error.context}", "", *place)
            )
            return None
        except yaml.YAMLError as error:
            place = _place_of_sign(self.text, getattr(error, "character", None))
            self.faults.append(Fault(f"this is not YAML: {str(error).splitlines()[0]}", "", *place))
            return None
        except _TooLargeError as error:
            self.faults.append(Fault(error.message, error.cure, error.line, error.column))
            return None
        if not isinstance(root, MappingNode):
            self.fault(root, f"a {self.kind.name} is a mapping of keys to values", self.kind.start)
            return None
        return root

    def mapping(self, node: Node, where: str, allowed: Iterable[str]) -> dict[str, Node]:
        """The entries of a mapping by key; doubled and unknown keys are noted."""
        if not isinstance(node, MappingNode):
            self.fault(node, f"{where}: a mapping of keys to values is expected here")
            return {}
        known = list(allowed)
        entries: dict[str, Node] = {}
        for key_node, value in node.value:
            if not isinstance(key_node, ScalarNode):
                self.fault(key_node, f"{where}: a key is a plain word")
                continue
            key = key_node.value
            if key in entries:
                self.fault(
                    key_node,
                    f"{where}: the key {shortened(key)} stands here twice",
                    "keep one of them",
                )
            elif known and key not in known:
                self.fault(
                    key_node, f"{where}: unknown key {shortened(key)}", did_you_mean(key, known)
                )
            else:
                entries[key] = value
        return entries

    def items(self, node: Node, where: str) -> list[Node]:
        """The items of a list."""
        if not isinstance(node, SequenceNode):
            self.fault(node, f"{where}: a list is expected here", "write it in brackets: [ , ]")
            return []
        return list(node.value)

    def scalar(self, node: Node, where: str) -> str | None:
        """The text of a single value, as written."""
        if not isinstance(node, ScalarNode):
            self.fault(node, f"{where}: a single value is expected here")
            return None
        if not str(node.tag).startswith("tag:yaml.org,2002:") or str(node.tag).startswith(_PYTHON):
            self.fault(
                node,
                f"{where}: the tag {shortened(str(node.tag))} has no place here",
                "leave it out",
            )
            return None
        return str(node.value)

    def whole(self, node: Node, where: str, smallest: int = 0) -> int | None:
        """A whole number written in plain decimal digits."""
        text = self.scalar(node, where)
        if text is None:
            return None
        plain = text.isascii() and text.isdigit() and (text == "0" or not text.startswith("0"))
        if not plain or len(text) > 6 or int(text) < smallest:
            self.fault(
                node,
                f"{where}: a whole number of at least {smallest} is expected, not {shortened(text)}",
            )
            return None
        return int(text)

    def choice(self, node: Node, where: str, known: Iterable[str]) -> str | None:
        """One of a few words."""
        text = self.scalar(node, where)
        if text is None or text in (known := list(known)):
            return text
        self.fault(node, f"{where}: {shortened(text)} is not known", did_you_mean(text, known))
        return None


class _TooLargeError(Exception):
    def __init__(self, at: Node | yaml.Event, message: str, cure: str) -> None:
        super().__init__(message)
        mark = at.start_mark
        self.line, self.column = (mark.line + 1, mark.column + 1) if mark else (1, 1)
        self.message, self.cure = message, cure


_PYTHON = "tag:yaml.org,2002:python"
_TOO_DEEP = f"nested more than {MAX_NESTING} deep"
_SHALLOW = 5_000
"""Texts up to this length cannot be nested deeply enough to hurt the parser."""


def _refuse_deep(text: str) -> None:
    """Refuse deep nesting while it is still a flat list of events: composing it recurses in C."""
    depth = 0
    for event in yaml.parse(text, Loader=_LOADER):
        if isinstance(event, (yaml.SequenceStartEvent, yaml.MappingStartEvent)):
            depth += 1
            if depth > MAX_NESTING:
                raise _TooLargeError(event, _TOO_DEEP, "no file needs that")
        elif isinstance(event, (yaml.SequenceEndEvent, yaml.MappingEndEvent)):
            depth -= 1


def _walk(root: Node) -> None:
    """Count every value as often as it is used, so that no alias multiplies work unseen."""
    count = 0
    pending: list[tuple[Node, int]] = [(root, 1)]
    while pending:
        node, depth = pending.pop()
        count += 1
        if count > MAX_NODES:
            raise _TooLargeError(
                root, f"more than {MAX_NODES} values in one file", "aliases count each time"
            )
        if depth > MAX_NESTING:
            raise _TooLargeError(
                node, _TOO_DEEP, "no file needs that; or an anchor contains itself"
            )
        pending += ((child, depth + 1) for child in _children(node))


def _children(node: Node) -> Iterator[Node]:
    if isinstance(node, SequenceNode):
        yield from node.value
    elif isinstance(node, MappingNode):
        for key, value in node.value:
            yield key
            yield value


def _place(fault: Fault) -> tuple[int, int]:
    return fault.line, fault.column


def _folded_place(text: str, node: ScalarNode, offset: int) -> tuple[int, int]:
    """Where a value over several lines has its character ``offset``: YAML changes nothing but the
    space between.
    """
    position = node.start_mark.index
    if node.style in {"|", ">"}:
        line_end = text.find("\n", position)
        position = len(text) if line_end < 0 else line_end
    elif node.style:
        position += 1
    for sign in node.value[:offset]:
        found = position if sign.isspace() else text.find(sign, position) + 1
        if not found:  # written as an escape
            break
        position = found
    while position < len(text) and text[position].isspace():
        position += 1
    line = text.count("\n", 0, position)
    return line + 1, position - text.rfind("\n", 0, position)


def _place_of_sign(text: str, code: object) -> tuple[int, int]:
    """Where a sign that YAML refuses stands first; its parser in C counts bytes, not signs."""
    position = (
        text.find(chr(code), 1 if text.startswith("\ufeff") else 0) if isinstance(code, int) else 0
    )
    position = max(position, 0)
    return text.count("\n", 0, position) + 1, position - text.rfind("\n", 0, position)


def keys_of(node: Node) -> set[str]:
    """The keys of a mapping that are plain texts; none for anything else."""
    if not isinstance(node, MappingNode):
        return set()
    return {key.value for key, _ in node.value if isinstance(key, ScalarNode)}


def one_line(text: str) -> str:
    r"""A name as it can stand in a heading: blanks for line ends and for what a terminal would act
    on.

    >>> one_line("Gauss 2\n  and \x1b more")
    'Gauss 2 and more'
    """
    return " ".join("".join(x if x.isprintable() else " " for x in text).split())


def shortened(text: str, length: int = 60) -> str:
    """``text`` in quotes, cut where it is long."""
    return repr(text if len(text) <= length else text[:length] + "…")


def is_null(node: Node) -> bool:
    """Whether the value is YAML's null."""
    return isinstance(node, ScalarNode) and node.tag == "tag:yaml.org,2002:null"
