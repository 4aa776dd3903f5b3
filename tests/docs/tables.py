"""The parts of pages that are made from the entries of the glossary."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from garkcli.glossary import read
from garkcli.glossary import term as glossary
from garkcli.glossary.faults import TOPICS, faults_of, findings_of
from garkcli.glossary.fields import field_text
from garkcli.glossary.key import KeyMeaning, keys_of
from garkcli.glossary.term import Term
from garkcli.properties.definitions import every_definition
from garkcli.properties.registry import KEYS
from garkcli.report.schemas import REFERENCES, REPORTS, report_schema


def codes_page() -> str:
    """Every code of an error in Markdown, a row per topic; gark explain says what one means."""
    return table(
        ("of", "codes"),
        [(title, ", ".join(f"`{x.code}`" for x in faults_of(x))) for x, title in TOPICS.items()],
    )


def terms_tables() -> str:
    """The terms in Markdown, a table per topic: the name, which leads to the page that defines it if
    there is one, and what it is. The page of properties has those that files may claim.
    """
    elsewhere = {claim.key for claim in every_definition()} - {"order", "symplectic"}
    parts = []
    for topic, title in glossary.TOPICS.items():
        terms = glossary.terms_of(topic)
        rows = [_term_row(x) for x in terms if x.name.lower().replace(" ", "-") not in elsewhere]
        parts.append(f"## {title}\n\n{table(('term', 'what it is'), rows)}")
    return "\n".join(parts)


def _term_row(term: Term) -> tuple[str, str]:
    brief, _, rest = _phrase(term.text).partition(": ")
    is_said = len(brief.split()) >= _BRIEF
    is_short = len(term.formula.split()) <= _LONGEST_FORMULA
    parts = [
        brief,
        "" if is_said else rest,
        "" if (is_said and rest) or not is_short else term.formula,
    ]
    text = ": ".join(filter(None, parts))
    page = re.search(r"this project, docs/([\w-]+\.md)", term.source)
    name = f"[{cell(term.name)}]({page[1]})" if page else cell(term.name)
    return f"**{name}**", cell(text)


_BRIEF = 7
"""So many words before a colon say enough; ``gark explain`` says more."""
_LONGEST_FORMULA = 5
"""In words; ``gark explain`` shows longer ones, and knows other names of terms."""


def _first_sentence(text: str) -> str:
    return re.split(r"(?<=\.) (?=[A-Z])", text)[0]


def claims_tables() -> str:
    """What each claim means, in a sentence, a table for each kind of values; claims on embedded
    weights in one row.
    """
    rows: dict[str, list[tuple[str, str]]] = {}
    embedded: list[str] = []
    for claim in every_definition():
        if claim.key.startswith("embedded-"):
            embedded.append(f"`{claim.key}`")
            continue
        text = _phrase(claim.text, ":") + (f"; for {claim.meaning}" if claim.meaning else "")
        rows.setdefault(claim.values, []).append((f"`{claim.key}`", cell(text)))
    orders = next(iter(rows.values()))
    orders.append((", ".join(embedded), "The named order with the embedded weights"))
    heads = ("claim", "what it means")
    parts = [f"Values: {values}.\n\n{table(heads, found)}" for values, found in rows.items()]
    return "\n".join(parts)


def keys_table(kind: str) -> str:
    """The keys of a kind of files as a table in Markdown; ``kind`` is of ``glossary.key.KINDS``."""
    paths: dict[str, list[str]] = {}
    for key in keys_of(kind).values():
        if kind == "method" and key.path.partition(".")[0] in (*IN_SECTIONS, *OF_DESIGNS):
            continue
        paths.setdefault(_said(key, ";" if kind == "method" else ""), []).append(f"`{key.path}`")
    return table(("key", "what it is"), ((", ".join(x), cell(text)) for text, x in paths.items()))


IN_SECTIONS = (
    *("A", "b", "c", "embedded", "dense", "methods", "transfer", "tableau", "ark", "prk"),
    *("compose", "adjoint", "extrapolate", "splitting", "multirate", "conjugate", "structure"),
    *("reference", "tolerance", "expect", "predictor", "shu-osher", "low-storage", "rosenbrock"),
    *("nystrom", "nprk", "derivatives"),
)
"""Keys of method files with a section on the page, which tells of them and what is below."""
OF_DESIGNS = ("unknown", "design")
"""Keys that docs/design.md tells of, with what is below."""


def _said(key: KeyMeaning, end: str) -> str:
    """What a key is, and what holds without it."""
    text = _phrase(_first_sentence(key.text), end)
    if key.default is None:
        return text
    default = str(key.default)
    if isinstance(key.default, bool):
        default = default.lower()
    return f"{text}; by default {default}"


def findings_table(command: str) -> str:
    """The findings of a command as a table in Markdown: what each means, and what to do."""
    found = findings_of(command).values()
    rows = [(f"`{x.code}`", cell(_phrase(x.text, ";:")), cell(_phrase(x.cure))) for x in found]
    return table(("code", "what it means", "what to do"), rows)


def fields_page() -> str:
    """The fields of JSON reports in Markdown: how they are nested, and what each holds."""
    return f"## Reports\n\n{_outlines()}\n## Fields\n\n{_fields_table()}"


def _outlines() -> str:
    """The fields of each report as they are nested; what has the same fields is written once."""
    alike: dict[str, list[str]] = {}
    for report in REPORTS:
        alike.setdefault(_nested(report_schema(report), {}), []).append(report)
    written: dict[str, str] = {}
    parts, before = [], ("", "")
    for first, *others in alike.values():
        text = _nested(report_schema(first), written)
        told = text.replace(*before) if len(before[0]) > _LONG else text
        parts.append(f"### {', '.join((first, *others))}\n\n{told}\n")
        before = text.removeprefix("* "), f"{{as {first}}}"
    return "\n".join(parts)


def _nested(schema: Any, written: dict[str, str], indent: str = "") -> str:
    """The names in a schema as a list; those below a name in brackets, many of them as a list."""
    names, long = [], []
    fields = _below(schema)
    properties = {name for name in fields if name.replace("_", "-") in KEYS}
    has_all = len(properties) > _MOST_PROPERTIES
    for name, below in fields.items():
        if name.endswith((*_ENDINGS,)):
            continue
        if has_all and name in properties:
            if _EACH not in names:
                names.append(_EACH)
            continue
        inner = _nested(below, {})
        is_list = any("items" in x for x in _choices(below))
        brackets = "[]" if is_list else "{}"
        if inner in written:
            same = "…" if written[inner] == name else f"as {written[inner]}"
            names.append(f"{name} {brackets[0]}{same}{brackets[1]}")
            continue
        if inner and name not in written.values():
            written[inner] = name
        if "\n" in inner or len(inner) > _LONG:
            long.append(f"{name} {brackets}\n{_nested(below, written, f'{indent}  ')}")
        elif inner:
            names.append(f"{name} {brackets[0]}{inner.removeprefix('* ')}{brackets[1]}")
        else:
            names.append(name)
    entries = [", ".join(names)] if names else []
    return "\n".join(f"{indent}* {entry}" for entry in [*entries, *long])


_LONG = 60
_MOST_PROPERTIES = 12
_EACH = "each [property](properties.md)"
"""The entry of more of them."""


def _below(schema: Any) -> dict[str, list[Any]]:
    """The fields next below in a schema: by their names what each may be."""
    found: dict[str, list[Any]] = {}
    for choice in _choices(schema):
        for name, value in choice.get("properties", {}).items():
            found.setdefault(name, []).append(value)
        for word in ("items", "additionalProperties", "patternProperties"):
            for name, value in _below(choice.get(word)).items():
                found.setdefault(name, []).extend(value)
    return found


def _choices(schema: Any) -> Iterator[dict[str, Any]]:
    """A schema and those of which it is a choice."""
    if isinstance(schema, list):
        for part in schema:
            yield from _choices(part)
    elif isinstance(schema, dict):
        yield schema
        for word in ("anyOf", "oneOf", "allOf"):
            yield from _choices(schema.get(word))


_ENDINGS = {x: text for x, text in read("fields").items() if x.startswith("_")}


def fields_of(node: Any, path: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Any]]:
    """The path of each field of a schema, with the schema of its values."""
    if isinstance(node, list):
        for part in node:
            yield from fields_of(part, path)
    if not isinstance(node, dict):
        return
    for word, part in node.items():
        if word == "properties":
            for name, value in part.items():
                yield (*path, name), value
                yield from fields_of(value, (*path, name))
        else:
            yield from fields_of(part, path)


def _fields_table() -> str:
    """What fields hold, without those that other pages define: claims, and parts of references."""
    meanings: dict[str, dict[tuple[str, str], dict[str, None]]] = {}
    for report in REPORTS:
        for path, schema in fields_of(report_schema(report), (report,)):
            text = field_text(path)
            if text and path[-2:-1] not in REFERENCES and not path[-1].endswith((*_ENDINGS,)):
                meaning = (_phrase(text), _one_of(schema, text))
                meanings.setdefault(path[-1], {}).setdefault(meaning, {})[report] = None
    rows = [(f"`…{ending}`", _phrase(text)) for ending, text in _ENDINGS.items()]
    for name, found in sorted(meanings.items()):
        (first, words), *others = sorted(found, key=lambda x: -len(found[x]))
        if not others and (name in _PLAIN or (not words and len(first.split()) <= _SAYS_LITTLE)):
            continue
        parts = [f"{first}: {words}" if words else first]
        for text, words in others:
            said = ": ".join(x for x in (text, words) if x not in ("", first))
            if said:
                parts.append(f"{', '.join(found[text, words])}: {said}")
        rows.append((f"`{name}`", cell("; ".join(parts))))
    return table(("field", "what it holds"), rows)


_SAYS_LITTLE = 5
"""Words of a text that adds nothing to the name of its field."""
_PLAIN = set(
    re.findall(
        r"\w+",
        """
    A_alpha R R_alike R_infinity admissible agrees aliases all among at at_least at_most best bibtex
    blame blew_up blocks by_colour by_order by_root c choices claim claims classes classical_order
    coefficient column columns compared complete condition conjugate conjugate_consistent
    conjugate_witness consistent continuous cosine count coupling culprit cure decided decimal
    declared_embedded declared_order default defects degree degrees denominator derivation
    description determinant determinant_minus_1 difference differences differs_from digits dimension_before
    direction doubt drift_in_all drift_uncertainty drifts drives effective_order
    embedded_nonautonomous_witness embedded_witness energies energy_error energy_order entries
    equation error_constants error_estimate errors escaped_at eta evaluations every_property
    every_value exact_order example expected explicit factors facts failed failing families fast
    field file files findings first first_only float folder format formulas found from from_included
    function functions genuine h h_exact has_test help holds ideal implicit in_every in_none
    inconsistent_blocks inf_norm initial interrupted invariant_errors jacobians kept largest
    leading_term left_behind limits line linear lowest_terms max_error max_order max_power meanings
    members message methods minimisers misprint modulus multiplicity new newton_iterations
    no_conjugate no_value_at nonautonomous_witness not_claimed notes numerator objective
    observed_order of_entries ok old omega open_points orders pair pair_witness parameter parameters
    pareto point power pp predicted_order problem problems properties property proved publication qp
    qq quantities r radius reached reads_back real real_ideal reference references repairs repeated
    representative required restores restrictions results right_hand_sides root_of round_off
    rounded_coefficients rounding row rows same_as schema schemes second_only seconds seed set
    shapes sigma slope slope_at_end slope_at_start solutions spaces spec splittings springs ssp
    ssp_radii stability stable_ideal stages_by_colour start starts step step_exact steps stiffness strips suffix
    suggestion symplectic_order t t_end t_end_exact tableau tables term terms title to to_included
    tolerance toward trace trees two_norm two_norm_squared uncertainty unknown unknowns unread up_to
    upto version visible_order wanted witness word worst worst_value written written_by wrong xi
    zeta
    """,
    )
)
"""Fields whose names say enough beside the outline, or that docs/json.md tells of."""


def _phrase(text: str, end: str = ";") -> str:
    """The first sentence, or what stands before ``end`` in it, without article and stop."""
    first = re.split(rf"(?<=[.{end}]) ", text)[0]
    phrase = first.rstrip(".;:").removeprefix("The ")
    return phrase[0].upper() + phrase[1:]


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [_row(heads), "|" + "---|" * len(heads)]
    lines += map(_row, rows)
    return "\n".join(lines) + "\n"


def _row(cells: Sequence[str]) -> str:
    return f"|{'|'.join(cells)}|"


def _one_of(schema: Any, text: str) -> str:
    """The words that the values of a field are; nothing where they are others, or told."""
    words = schema.get("enum", []) if isinstance(schema, dict) else []
    named = [x for x in words if isinstance(x, str) and x]
    is_told = all(x in text for x in named)
    return "" if is_told or not 1 < len(named) <= _MOST_WORDS else ", ".join(named)


_MOST_WORDS = 14


def cell(text: str) -> str:
    """A text in a cell of a table: its signs are no signs of Markdown."""
    return re.sub(r"[\\*|]|(?<!\w)_|_(?!\w)", r"\\\g<0>", text)
