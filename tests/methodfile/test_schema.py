"""The JSON Schema of method files: it allows what loads, and refuses what can be told from one
value at a time.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml
from jsonschema import Draft7Validator

from garkcli.families.collocation import MOST_OF_GAUSS
from garkcli.families.registry import FAMILIES
from garkcli.methodfile.description import BESIDE, FORMS, PLAIN, STRUCTURES
from garkcli.methodfile.expectations import CLAIMS
from garkcli.methodfile.family import load_family
from garkcli.methodfile.file_keys import KEYS, method_file_schema
from garkcli.methodfile.load import load
from garkcli.methodfile.transfers import ALL_RULES
from garkcli.transfer import RULES
from tests.whole import in_whole

ROOT = Path(__file__).parents[2]
SUFFIX = ".gark.yaml"
SCHEMA = method_file_schema()
VALIDATOR = Draft7Validator(SCHEMA)
RIGHT = sorted(
    path
    for folder in ("methods", "tests/examples/valid", "tests/examples/failing")
    for path in (ROOT / folder).glob(f"*{SUFFIX}")
)
FAMILY_FILES = sorted((ROOT / "tests/examples/families").glob(f"*{SUFFIX}"))
INVALID = {
    path.name.removesuffix(SUFFIX): path
    for path in (ROOT / "tests/examples/invalid").glob(f"*{SUFFIX}")
}

NO_PLAIN_YAML = {
    "control-character",
    "key-is-a-list",
    "not-utf8",
    "not-yaml-bracket",
    "not-yaml-colon",
    "not-yaml-tab",
    "tag-object",
    "transfer-key-is-a-mapping",
    "two-documents",
    "undefined-alias",
    "very-deep-yaml",
}
"""What no reader of YAML gives to a validator: it is not YAML, or not plain data."""
BOMBS = {"alias-bomb"}
"""Small as YAML and endless for a validator, which has no limits."""
BEYOND = {
    "lost by YAML readers": {
        "base-sixty", "doubled-inner-key", "doubled-key", "octal", "underscores",
    },
    "sizes that have to fit": {
        "ark-shapes", "ark-too-many-weights", "block-shape", "methods-shapes", "prk-general-sizes", "prk-shapes",
        "ragged-rows", "structure-colours", "tableau-counts", "tableau-shapes", "transfer-without-default",
        "block-doubled", "plain-tableau-embedded", "plain-tableau-lengths",
        "embedded-of-one-method", "embedded-rows", "embedded-shapes",
    },
    "the grammar of numbers": {
        "deep-parentheses", "huge-exponent", "not-finite", "other-languages", "parameter-free", "parameter-names",
        "parameter-used-before", "parameters-that-explode", "powers-of-powers", "tolerance-irrational",
        "tolerance-no-number", "tolerance-too-large", "unknown-name",
    },
    "families of methods": {"unknown-entries", "unknown-name-taken", "unknown-shapes-apart"},
    "mathematics": {
        "block-beside-gauss-6", "embedded-beside-gauss-6", "embedded-of-conjugate", "coinciding-nodes", "division-by-exact-zero", "division-by-zero",
        "division-by-zero-parameter", "even-root-of-negative", "radicals-of-large-degree", "structure-zero-weight",
        "weights-of-combination", "zero-weight-conjugate", "zero-weight-conjugate-rule",
    },
}  # fmt: skip
"""Invalid examples that the schema allows, by the reason why only the loader can refuse them."""
ONLY_THE_LOADER = {name: why for why, names in BEYOND.items() for name in names}


def data(path: Path) -> Any:
    """The file as an editor's YAML reader gives it to a validator."""
    return yaml.safe_load(path.read_bytes().decode("utf-8-sig"))


def test_the_schema_is_one() -> None:
    """The schema is valid draft-07 and says so, and every reference in it leads somewhere."""
    Draft7Validator.check_schema(SCHEMA)
    assert SCHEMA["$schema"] == "http://json-schema.org/draft-07/schema#"
    references = set(_references(SCHEMA))
    assert references
    assert references <= {f"#/definitions/{name}" for name in SCHEMA["definitions"]}


def _references(part: Any) -> list[str]:
    if isinstance(part, list):
        return [x for item in part for x in _references(item)]
    if not isinstance(part, dict):
        return []
    own = [part["$ref"]] if isinstance(part.get("$ref"), str) else []
    return own + [x for value in part.values() for x in _references(value)]


@pytest.mark.parametrize("path", RIGHT, ids=lambda path: path.name.removesuffix(SUFFIX))
def test_what_loads_is_allowed(path: Path) -> None:
    """Every method of the project and every valid or failing example is a method file for the
    schema too.
    """
    load(str(path))
    assert [error.message[:200] for error in VALIDATOR.iter_errors(data(path))] == []


@pytest.mark.parametrize("path", FAMILY_FILES, ids=lambda path: path.name)
def test_families_are_allowed(path: Path) -> None:
    """A file with unknowns is a method file for the schema too."""
    assert load_family(str(path)).parameters
    assert [error.message[:200] for error in VALIDATOR.iter_errors(data(path))] == []


@pytest.mark.parametrize(
    "name", sorted(set(INVALID) - set(ONLY_THE_LOADER) - NO_PLAIN_YAML - BOMBS)
)
def test_what_is_invalid_is_refused(name: str) -> None:
    """An invalid example that is not excused by name is underlined by an editor with the schema."""
    assert not VALIDATOR.is_valid(data(INVALID[name]))


@pytest.mark.parametrize("name", sorted(ONLY_THE_LOADER))
def test_what_is_excused_needs_its_excuse(name: str) -> None:
    """An excused example is an invalid file there is, and the schema does allow it."""
    assert VALIDATOR.is_valid(data(INVALID[name]))


@in_whole
@pytest.mark.parametrize("name", sorted(NO_PLAIN_YAML))
def test_what_is_no_plain_yaml_is_none(name: str) -> None:
    """What never reaches a validator is no UTF-8, or fails in the YAML reader."""
    with pytest.raises((yaml.YAMLError, UnicodeDecodeError, RecursionError)):
        VALIDATOR.is_valid(data(INVALID[name]))


def test_a_bomb_is_one() -> None:
    """The bomb is excused for its size alone: a few lines that stand for more values than any
    method has.
    """
    for name in BOMBS:
        text = INVALID[name].read_text(encoding="utf-8")
        assert text.count("*") > 50
        assert len(text) < 1000


def test_the_excuses_do_not_overlap() -> None:
    """Every example is excused for one reason at most."""
    groups = [*BEYOND.values(), NO_PLAIN_YAML, BOMBS]
    assert sum(map(len, groups)) == len(set().union(*groups))


def test_the_schema_knows_the_words_of_the_loader() -> None:
    """Keys, structures, rules, claims, families and the largest number of stages are those the
    loader knows.
    """
    properties = SCHEMA["properties"]
    assert set(properties) == set(KEYS)
    *forms, plain = SCHEMA["allOf"][0]["allOf"][0]["oneOf"]
    assert [x["required"] for x in forms] == [[form] for form in (*FORMS, "unknown")]
    assert [x["required"] for x in plain["anyOf"]] == [[key] for key in PLAIN]
    assert set(properties["tableau"]["properties"]) == {*PLAIN, *BESIDE, "predictor"}
    assert properties["structure"]["enum"] == list(STRUCTURES)
    assert set(properties["expect"]["properties"]) == set(CLAIMS)
    *words, combination, of_degree = SCHEMA["definitions"]["rule"]["oneOf"]
    assert [word["const"] for word in words] == list(ALL_RULES)
    assert all(word["description"] for word in words)
    assert set(combination["properties"]) == set(RULES)
    assert set(of_degree["properties"]) == {"rule", "degree"}
    family, _ = SCHEMA["definitions"]["method"]["oneOf"]
    assert family["properties"]["family"]["enum"] == list(FAMILIES)
    stages = {"type": "integer", "minimum": 1, "maximum": MOST_OF_GAUSS}
    assert stages.items() <= family["properties"]["stages"].items()


@pytest.mark.parametrize("name", FAMILIES)
def test_stages_are_needed_where_the_loader_needs_them(name: str) -> None:
    """A family goes without its size where it is one method, without an option that has a default,
    and with nothing that belongs to other families.
    """
    family = FAMILIES[name]
    needed: dict[str, object] = {"family": name, family.size: family.smallest}
    needed |= {x.name: x.smallest or "1/2" for x in family.options if not x.default}
    assert VALIDATOR.is_valid({"methods": [needed]})
    for key in needed:
        less = {other: x for other, x in needed.items() if other != key}
        may_go = key == family.size and family.is_single
        assert VALIDATOR.is_valid({"methods": [less]}) == may_go
    assert not VALIDATOR.is_valid({"methods": [needed | {"sweeps": 0}]})
    if "gamma" not in family.keys:
        assert not VALIDATOR.is_valid({"methods": [needed | {"gamma": 1}]})


@pytest.mark.parametrize(
    "text",
    [
        "methods: [{family: gauss, stages: 2}]\ndescripton: a slip",
        "methods: [{family: gauss, stages: 2}, {family: rk4}]",
        "methods: [{family: gauss, stages: 2, A: [[1]]}]",
        "methods: [{family: gauss, stages: 501}]",
        "methods: [{A: [[1/2]]}]",
        "methods: [{A: [[1/2]], b: []}]",
        "methods: [{A: [['1/2; 3']], b: [1]}]",
        "methods: [{family: rk4}, {family: rk4}]\ntransfer: colocation",
        "methods: [{family: rk4}, {family: rk4}]\ntransfer: {symplectic-collocation: 1}",
        "methods: [{family: rk4}, {family: rk4}]\ntransfer: {default: collocation, blocks: {'0,2': collocation}}",
        "methods: [{family: rk4}]\nlinear: [1]",
        "tableau: {A: [[[[1/2]]]], b: [[1]]}\ntransfer: collocation",
        "tableau: {A: [[[[1/2]]]], b: [[1]]}\nstructure: separable",
        "tableau: {A: [[[[1/2]]]], b: [[1]]}\nlinear: [0]",
        "prk: {q: {A: [[1]], b: [1]}, p: {A: [[1]], b: [1]}}\nstructure: semi-separable",
        "methods: [{family: rk4}]\nexpect: {order: four}",
        "methods: [{family: rk4}]\nexpect: {order: '> 4'}",
        "methods: [{family: rk4}]\nexpect: {B: 4}",
        "methods: [{family: rk4}]\nexpect: {symplectic: 1}",
        "methods: [{family: rk4}]\ngark: 2",
        "methods: [{family: rk4}]\ntableau: {A: [[[[1/2]]]], b: [[1]]}",
        "name: nothing else",
        "c: [0]",
        "A: [[0]]\nc: [0]",
        "unknown: {stages: 2, shape: sdirk}\nlinear: [1]",
        "compose: {of: rk4, steps: [1], scheme: suzuki}",
        "compose: {scheme: suzuki}",
        "compose: {of: rk4, steps: [1], order: 4}",
        "extrapolate: {of: rk4}",
        "extrapolate: {of: rk4, sequence: harmonic}",
        "extrapolate: {of: rk4, sequence: [1, 2], order: 6}",
        "splitting: {a: [1]}",
        "splitting: {a: [1/2, 1/2], b: [1], scheme: strang}",
        "splitting: {terms: 2}",
        "[]",
    ],
)
def test_a_slip_is_refused(text: str) -> None:
    """Slips of every kind that a single value shows are refused by the schema, as they are by the
    loader.
    """
    from garkcli.errors import MethodFileError
    from garkcli.methodfile.load import loads

    assert not VALIDATOR.is_valid(yaml.safe_load(text))
    with pytest.raises(MethodFileError):
        loads(text)
