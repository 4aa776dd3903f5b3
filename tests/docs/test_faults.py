"""Every error of the program has a code, and the code says what it means."""

from __future__ import annotations

import shlex
from importlib import import_module

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.api.files import loads_problem
from garkcli.check.meanings import explain
from garkcli.errors import UNKNOWN, GarkError, MethodFileError
from garkcli.glossary.faults import HOLE, FaultKind, by_code, code_of, codes_of
from garkcli.methodfile.load import loads
from tests.cli.harness import ROOT, gark
from tests.docs.fault_sites import ERRORS, sites, source
from tests.whole import at_most, in_whole

KINDS = list(by_code().values())
AROUND = ("{}", "a: {}", "; {}", "it's {}", '"{}\\n')
"""Where the words of another message stand in a text."""
FILLED = "\N{BLACK SQUARE}"
"""Stands where a message is filled; no kind has it among its words."""
ENTRIES = "garkcli/glossary/data/faults-*.toml"
HANDED_ON = {
    *("", "{}", "{}: {}", "{} {}", "{}: {}: {}", "{} {}: {}", "{}, not {}"),
    *("initial: {}", "colour {}: {}"),
}
"""What is put around a message that was made elsewhere, where it is a site of its own."""
OF_THE_COMMAND_LINE = {
    *("no such option {}", "no such command {}", "invalid value for {}: {}"),
    *("missing argument {}", "missing parameter: {}"),
    "option {} requires an argument",
}
"""Messages that click makes, or that are made for it."""
NO_MESSAGES = {
    *("MethodFileError", "HasFreeParameters"),  # have faults, with messages
    "StepFailed",  # makes its message of what it is given
    *("Unreadable", "Misshapen", "TooLarge"),  # are caught where they are made
}


def test_every_message_has_one_code() -> None:
    """Whatever the program says of what it is given belongs to one kind of fault, and to no
    second.
    """
    found = sites()
    assert len(found) > 700
    wrong = []
    for site in found:
        if site.message in HANDED_ON:
            continue
        codes = codes_of(site.message.replace(HOLE, FILLED))
        if len(codes) != 1:
            wrong.append((site.place, site.message, codes))
    assert wrong == [], f"each belongs among the messages of a kind in {ENTRIES}"


def test_every_error_says_its_code() -> None:
    """Where an error is raised it says of which kind it is, itself or by its class, and its message
    is one of that kind; an error that hands on another one has its code.
    """
    assert {site.place for site in sites() if not site.code} == set()
    said: dict[tuple[str, str], set[str]] = {}
    for site in sites():
        # a variable may hold the messages of several sites of its function
        codes = said.setdefault((site.place, site.code), set())
        if site.code == HOLE or site.message in HANDED_ON:
            codes.add(site.code)
        codes.update(codes_of(site.message.replace(HOLE, FILLED)))
    assert {code for _, code in said} <= {HOLE, *by_code()}
    assert [(place, code) for (place, code), codes in said.items() if code not in codes] == []


def test_no_site_escapes() -> None:
    """The errors whose messages are looked for are all that there are."""
    for name in ("ntrees.notation", "bridges.cannot", "catalogue.facts"):
        import_module(f"garkcli.{name}")
    found, left = set(), [GarkError]
    while left:
        error = left.pop()
        left += error.__subclasses__()
        if error.__module__.startswith("garkcli."):
            found.add(error.__name__)
    assert found - NO_MESSAGES <= ERRORS


def test_every_message_of_a_kind_is_said() -> None:
    """The messages by which kinds are told are those of the program: none is left behind by a
    sentence that was changed.
    """
    messages = "\n".join(site.message for site in sites())
    rare = {
        (part.strip(), kind.code)
        for kind in KINDS
        for message in set(kind.says) - OF_THE_COMMAND_LINE
        for part in message.split(HOLE)
        if part.strip() not in messages
    }
    said = source()
    assert {part for part in rare if part[0] not in said} == set()


@in_whole
def test_no_message_is_of_two_kinds() -> None:
    """Each message leads to one kind."""
    every = [message for kind in KINDS for message in kind.says]
    assert len(every) == len(set(every))
    for kind in KINDS:
        for message in kind.says:
            filled = message.replace(HOLE, FILLED)
            assert codes_of(filled) == [kind.code], message


def _codes_of_file(text: str) -> set[str]:
    """What is wrong with a method file."""
    with pytest.raises(MethodFileError) as caught:
        loads(text + "\n")
    return {code_of(fault.message) for fault in caught.value.faults}


def _codes_of_run(command: str) -> set[str]:
    """What is wrong with a command."""
    run = gark(*shlex.split(command.removeprefix("$ gark ")))
    assert run.code == 2
    lines = (run.err + run.out).splitlines()
    said = [x.partition("gark: ")[2] for x in lines if x.startswith("gark: ")]
    said += [x.partition("]: ")[2] for x in lines if "error[" in x]
    return set(map(code_of, said))


@pytest.mark.parametrize("kind", [x for x in KINDS if x.example], ids=lambda x: x.code)
def test_the_example_has_the_fault(kind: FaultKind, monkeypatch: pytest.MonkeyPatch) -> None:
    """What stands as the example of a kind is met with it."""
    monkeypatch.chdir(ROOT)
    is_command = kind.example.startswith("$ ")
    found = (_codes_of_run if is_command else _codes_of_file)(kind.example)
    assert kind.code in found
    (meaning,) = [x for x in explain(kind.code) if x.kind == "error"]
    assert meaning.cure.endswith(".")
    assert meaning.text.endswith(".")


def test_messages_are_words_of_explain() -> None:
    """A message that is pasted leads to its kind; nonsense does not."""
    (meaning,) = explain("the file: unknown key 'nam'; did you mean 'name'?")
    (alone,) = explain("gark: --slow and --fast belong together")
    assert alone.name == "option-alone"
    assert (meaning.kind, meaning.name) == ("error", "unknown-key")
    assert code_of("nonsense") == UNKNOWN
    run = gark("explain", "zzzq")
    assert run.err.endswith("help: gark explain lists the terms\n")


OTHERS = [said.replace(HOLE, "x") for kind in KINDS for said in kind.says]
"""What people may write into a file: the words of each message."""


@pytest.mark.parametrize("kind", KINDS, ids=lambda x: x.code)
@settings(max_examples=at_most(1, 5))
@given(said=st.sampled_from(OTHERS), around=st.sampled_from(AROUND))
def test_what_is_quoted_has_no_say(kind: FaultKind, said: str, around: str) -> None:
    """A message keeps its code when what it quotes of a file reads like another message."""
    text = repr(around.format(said))
    for message in kind.says:
        filled = message.replace(HOLE, text, 1).replace(HOLE, FILLED)
        assert codes_of(filled) == [kind.code]


def test_names_that_read_like_messages_are_quoted() -> None:
    """A name of a file that is no plain word stands in quotes, so that it does not tell the code
    of the message that it is in.
    """
    said = "a: --emit: no method has the infimum of x"
    method = "A: [[0]]\nb: [1]\n"
    assert _codes_of_file(f'{method}parameters: {{"{said}": 2}}') == {"name-taken"}
    shape = f'unknown: {{stages: 2, shape: "{said}"}}'
    assert _codes_of_file(shape) == {"unknown-word"}
    problem = "variables: [q]\nhamiltonian: q\ninitial: {q: 1, pq: 0}\n"
    with pytest.raises(MethodFileError) as caught:
        loads_problem(f'{problem}parameters: {{"{said}": 2}}\n')
    (fault,) = caught.value.faults
    assert code_of(fault.message) == "name-taken"


@pytest.mark.parametrize(
    ("message", "code"),
    [
        ("parameters: pi has a meaning already", "name-taken"),
        ("f{1}: right-hand sides by the names of variables are expected", "mapping-expected"),
        ("aliases: an empty name", "name-taken"),
        ("aliases: 'a' appears twice", "doubled"),
        ("rhs: the problem is given by hamiltonian already", "given-twice"),
        ("hamiltonian: a coefficient of about 9000 digits", "number-too-large"),
    ],
)
def test_messages_that_are_put_together_have_codes(message: str, code: str) -> None:
    """What is made of several texts, which the source does not show as one, has its kind."""
    assert codes_of(message) == [code]


def test_texts_have_codes() -> None:
    """The report on a file that cannot be read names the code of each fault."""
    run = gark("check", "tests/examples/invalid/capitals.gark.yaml")
    assert "1:1: error[unknown-key]: the file: unknown key 'a'" in run.out
