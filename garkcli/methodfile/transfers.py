"""The blocks between the methods of a file: by rules, or given one by one."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import permutations

from garkcli.grammar import keys as g
from garkcli.grammar import nodes
from garkcli.methodfile import description as d
from garkcli.methodfile.numbers import UNKNOWN, NumbersReader, name_of_place
from garkcli.methodfile.parameters import NUMBER
from garkcli.transfer import MAX_DEGREE, PAIR_RULES, RULES, SUMMARIES


def _weight(rule: str) -> g.Key:
    text = "The weight of this rule in a combination of rules."
    return g.Key(f"{rule}: 1/2", NUMBER, text, is_word=False)


ALL_RULES = (*RULES, *PAIR_RULES)
_WORDS = g.word(lambda: {rule: SUMMARIES[rule] for rule in ALL_RULES})
_WEIGHTS = g.mapping(*map(_weight, RULES), rules=[g.OfSchema({"minProperties": 1})])
OF_DEGREE = g.mapping(
    g.Key(
        "rule: legendre",
        g.word(lambda: ("legendre",)),
        "The rule that has a degree.",
        is_needed=True,
        is_word=False,
    ),
    g.Key(
        "degree: 2",
        g.count(0, MAX_DEGREE),
        "K, the largest degree of the Legendre polynomials; by default ⌊p/2⌋, where p is the least "
        "order of the symplectic pairs of the diagonal methods.",
        page="docs/pair-order.md",
    ),
    form="write {rule: legendre, degree: 2}",
)
RULE = g.ValueKind(
    lambda: {"oneOf": [*_WORDS.schema()["oneOf"], _WEIGHTS.schema(), OF_DEGREE.schema()]}
)
_OF_RULE = g.defined("rule").schema()
_ALL_UNKNOWN: g.Schema = {
    "const": UNKNOWN,
    "description": "Every entry of the block unknown: gark design finds values.",
}
_PARTS = g.mapping(
    g.Key(
        "default: collocation",
        g.defined("rule", lambda at, node, where: _rule(at, node, where)),
        "The rule for the blocks that blocks does not name.",
    ),
    g.Key(
        'blocks: {"1,2": interpolation}',
        g.by_name(
            g.ValueKind(lambda: {"anyOf": [_OF_RULE, _ALL_UNKNOWN, g.defined("matrix").schema()]}),
            propertyNames={"pattern": r"^\s*[1-9][0-9]{0,3}\s*,\s*[1-9][0-9]{0,3}\s*$"},
        ),
        "Blocks that differ from the default, by the numbers of their colours: a rule, weights of "
        'rules, the matrix itself, or "?": all of its entries are unknown.',
    ),
    rules=[g.OfSchema({"minProperties": 1})],
)
TRANSFER = g.ValueKind(
    lambda: {"anyOf": [_OF_RULE, _PARTS.schema(), _ALL_UNKNOWN]},
    inside=lambda: [*_PARTS.inside(), *_WEIGHTS.inside(), *OF_DEGREE.inside()],
)
_BLOCK_OR_COLOUR = re.compile(r"[1-9][0-9 ,]*")
_BLOCK = re.compile(r"\s*([1-9][0-9]{0,3})\s*,\s*([1-9][0-9]{0,3})\s*")


def _block_of(key: str) -> tuple[int, int]:
    """The colours of a key such as ``1,2``, from 0; equal ones if it is not valid."""
    match = _BLOCK.fullmatch(key)
    if match is None:
        return 0, 0
    l, m = map(int, match.groups())
    return l - 1, m - 1


def rules_of(at: NumbersReader, node: nodes.Node, stages: Sequence[int]) -> d.TransferText:
    if _is_unknown(node):
        edges = permutations(range(len(stages)), 2)
        return d.TransferText(None, {edge: _unknown(at, node, edge, stages) for edge in edges})
    if not nodes.keys_of(node) & {"default", "blocks"}:
        # without quotes {1,2: rule} has the keys 1 and 2
        for key in nodes.key_nodes(node).values():
            if _BLOCK_OR_COLOUR.fullmatch(key.value):
                message = "transfer: single blocks go under blocks"
                cure = 'write transfer: {default: …, blocks: {"1,2": …}}'
                at.source.fault(key, message, cure, code="given-twice")
                return d.TransferText(None, {})
        return d.TransferText(_rule(at, node, "transfer"), {})
    entries: g.ReadMapping = _PARTS.read(at, node, "transfer")
    blocks = _blocks(at, entries["blocks"], stages) if "blocks" in entries else {}
    return d.TransferText(entries.get("default"), blocks)


def _is_unknown(node: nodes.Node) -> bool:
    return isinstance(node, nodes.ScalarNode) and node.value == UNKNOWN


def _unknown(
    at: NumbersReader, node: nodes.Node, edge: tuple[int, int], stages: Sequence[int]
) -> d.MatrixText:
    rows, columns = (range(1, stages[k] + 1) for k in edge)
    name = d.block_name(*edge)
    places = [[f"{name}, row {i}, entry {j}" for j in columns] for i in rows]
    return d.MatrixText(
        node, tuple(tuple(at.numbers.entry(node, x) for x in row) for row in places)
    )


def spelled(blocks: Mapping[tuple[int, int], d.MatrixText]) -> str:
    texts = {}
    for (l, m), block in blocks.items():
        rows = [", ".join(str(name_of_place(x.where)) for x in row) for row in block.rows]
        texts[f'"{l + 1},{m + 1}"'] = f"[{', '.join(f'[{row}]' for row in rows)}]"
    if len(texts) == 1:
        return next(iter(texts.values()))
    lines = ", ".join(f"{key}: {text}" for key, text in texts.items())
    return f"{{blocks: {{{lines}}}}}"


def _blocks(at: NumbersReader, node: nodes.Node, stages: Sequence[int]) -> d.BlockTexts:
    """Reads the blocks given one by one; keys such as ``1,2`` count colours from 1."""
    blocks: d.BlockTexts = {}
    colours = len(stages)
    keys = nodes.key_nodes(node)
    form = 'write for instance {"1,2": interpolation}'
    for key, value in at.source.mapping(node, "transfer, blocks", (), form=form).items():
        l, m = _block_of(key)
        if l == m or max(l, m) >= colours:
            wanted = f"off-diagonal block of {colours} colours"
            message = f"transfer, blocks: {nodes.shortened(key)} names no {wanted}"
            cure = 'write for instance "1,2" for the block A^{1,2}'
            at.source.fault(keys[key], message, cure, code="wrong-value")
            continue
        where = d.block_name(l, m)
        if (l, m) in blocks:
            message = f"transfer, blocks: {where} is given twice"
            at.source.fault(keys[key], message, "keep one of them", code="doubled")
        if _is_unknown(value):
            block: d.BlockText | None = _unknown(at, value, (l, m), stages)
        else:
            block = _block(at, value, where, (stages[l], stages[m]))
        if block is not None:
            blocks[l, m] = block
    return blocks


def _block(
    at: NumbersReader, node: nodes.Node, where: str, shape: tuple[int, int]
) -> d.BlockText | None:
    if not isinstance(node, nodes.SequenceNode):
        return _rule(at, node, where)
    rows = at.numbers.matrix(node, where)
    rows = at.numbers.rectangular(rows, node, where, shape)
    return d.MatrixText(node, rows) if rows else None


def _rule(at: NumbersReader, node: nodes.Node, where: str) -> d.RuleText | None:
    if _is_unknown(node):
        message = f'{where}: "?" is not a rule; it stands for all blocks or for one'
        cure = 'write transfer: "?", or blocks: {"1,2": "?"}'
        at.source.fault(node, message, cure, code="unknown-word")
        return None
    if isinstance(node, nodes.ScalarNode):
        rule = at.source.choice(node, where, ALL_RULES)
        return d.RuleText(node, ((rule, None),)) if rule else None
    if nodes.keys_of(node) & {"rule", "degree"}:
        of_degree: g.ReadMapping | None = OF_DEGREE.read(at, node, where)
        if of_degree is None or not of_degree.is_right:
            return None
        return d.RuleText(node, (("legendre", None),), of_degree.get("degree"))
    of_pairs = sorted(nodes.keys_of(node) & set(PAIR_RULES))
    if of_pairs:
        why = "makes both blocks of a pair of colours"
        message = f"{where}: {of_pairs[0]} {why} and cannot be combined"
        at.source.fault(node, message, f"write {of_pairs[0]} on its own", code="not-together")
        return None
    form = "write one of the rules, for instance transfer: collocation"
    entries = at.source.mapping(node, where, RULES, form=form)
    if isinstance(node, nodes.MappingNode) and not node.value:
        cure = f"one of: {', '.join(ALL_RULES)}"
        at.source.fault(node, f"{where}: no rule", cure, code="missing-key")
    terms = [
        (rule, at.numbers.entry(weight, f"{where}, weight of {rule}"))
        for rule, weight in entries.items()
    ]
    return d.RuleText(node, tuple(terms)) if terms else None
