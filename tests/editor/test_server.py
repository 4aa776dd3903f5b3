"""The language server, spoken to by a client of the protocol as editors are."""

from __future__ import annotations

import asyncio
import os
import signal
import subprocess
import sys
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("pygls", reason="the extra lsp is not installed")
pytest_lsp = pytest.importorskip("pytest_lsp", reason="the extra test is not installed")

import pytest_asyncio  # noqa: E402
from lsprotocol import types as lsp  # noqa: E402

PATIENCE = 60.0
WRONG = (
    "name: ℝ Kutta\n"
    "A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/3, 0, 0], [0, 0, 1, 0]]\n"
    "b: [1/6, 1/3, 1/3, 1/6]\n"
    "expect: {order: 4}\n"
)


def test_somebody_who_types_is_told_that_an_editor_is_missing() -> None:
    """In a terminal the server names the call that needs no editor; an interrupt ends it."""
    pty = pytest.importorskip("pty", reason="this system has no pseudo-terminals")
    ours, theirs = pty.openpty()
    # also where the tests ignore interrupts, as what runs behind a shell does
    heard = "import signal, runpy; signal.signal(2, signal.default_int_handler); "
    server = subprocess.Popen(
        [sys.executable, "-c", f"{heard}runpy.run_module('garkcli', run_name='__main__')", "lsp"],
        stdin=theirs,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert server.stderr is not None
        assert "gark lsp --once FILE" in server.stderr.readline()
        server.send_signal(signal.SIGINT)
        assert server.wait(PATIENCE) == -signal.SIGINT
    finally:
        server.kill()
        server.communicate()
        os.close(ours)
        os.close(theirs)


@pytest_asyncio.fixture
async def client(tmp_path: Path) -> AsyncIterator[Any]:
    """A client whose server runs in an empty folder."""
    config = pytest_lsp.ClientServerConfig([sys.executable, "-m", "garkcli", "lsp"])
    made = await config.start()
    made.folder = tmp_path
    made.feature(lsp.WORKSPACE_CODE_LENS_REFRESH)(lambda _: None)
    await made.initialize_session(
        lsp.InitializeParams(
            capabilities=pytest_lsp.client_capabilities("visual-studio-code"),
            root_uri=tmp_path.as_uri(),
        )
    )
    yield made
    await made.shutdown_session()
    await made.stop()


def type_in(client: Any, text: str, name: str = "mine.gark.yaml", version: int = 1) -> str:
    """Open a file, or change it; its address."""
    uri: str = (client.folder / name).as_uri()
    if version == 1:
        document = lsp.TextDocumentItem(uri, "yaml", version, text)
        client.text_document_did_open(lsp.DidOpenTextDocumentParams(document))
    else:
        about = lsp.VersionedTextDocumentIdentifier(version, uri)
        change = lsp.TextDocumentContentChangeWholeDocument(text)
        client.text_document_did_change(lsp.DidChangeTextDocumentParams(about, [change]))
    return uri


async def told(client: Any, uri: str) -> list[lsp.Diagnostic]:
    """The diagnostics of a file, once new ones have come."""
    for _ in range(int(PATIENCE * 20)):
        if uri in client.diagnostics:
            return list(client.diagnostics.pop(uri))
        await asyncio.sleep(0.05)
    raise AssertionError("no diagnostics")


def at(uri: str, line: int, character: int) -> dict[str, Any]:
    """The arguments of a question about a place."""
    return {
        "text_document": lsp.TextDocumentIdentifier(uri),
        "position": lsp.Position(line, character),
    }


@pytest.mark.asyncio
async def test_a_wrong_entry_is_underlined_and_mended(client: Any) -> None:
    """A squiggle at the claim and one at the entry, the orders above the tableau, a quick fix at
    the entry; once it is carried out nothing is left.
    """
    uri = type_in(client, WRONG)
    found, hint = await told(client, uri)
    assert (found.range.start, found.range.end) == (lsp.Position(3, 16), lsp.Position(3, 17))
    assert (hint.code, hint.severity) == ("misprint", lsp.DiagnosticSeverity.Information)
    assert found.message.startswith("order: expected 4, found 1")
    assert (found.source, found.code) == ("gark", "claim")
    about = lsp.TextDocumentIdentifier(uri)
    lenses = await client.text_document_code_lens_async(lsp.CodeLensParams(about))
    titles = [x.command.title for x in lenses]
    assert titles[0] == "order 1, proved; order 2 fails at [[]] by -1/18"
    assert {x.range.start.line for x in lenses} == {1}
    (action,) = await client.text_document_code_action_async(
        lsp.CodeActionParams(about, found.range, lsp.CodeActionContext([found]))
    )
    (edit,) = action.edit.changes[uri]
    assert edit.range == hint.range
    line = WRONG.splitlines()[edit.range.start.line]
    assert line[edit.range.start.character : edit.range.end.character] == "1/3"
    mended = line[: edit.range.start.character] + edit.new_text
    mended += line[edit.range.end.character :]
    assert type_in(client, WRONG.replace(line, mended), version=2) == uri
    assert await told(client, uri) == []
    lenses = await client.text_document_code_lens_async(lsp.CodeLensParams(about))
    assert lenses[0].command.title.startswith("order 4, proved; order 5 fails")


@pytest.mark.asyncio
async def test_a_misspelt_key_is_mended(client: Any) -> None:
    """Also beyond letters of two units of UTF-16."""
    text = "A: [[0]]\nb: [1]\ndescription: {𝒜: 1}\nexpct: {order: 1}\n"
    uri = type_in(client, text)
    found = next(x for x in await told(client, uri) if x.code == "unknown-key")
    assert found.range.start == lsp.Position(3, 0)
    about = lsp.TextDocumentIdentifier(uri)
    (action,) = await client.text_document_code_action_async(
        lsp.CodeActionParams(about, found.range, lsp.CodeActionContext([found]))
    )
    assert action.title == "Write expect"
    (edit,) = action.edit.changes[uri]
    assert (edit.new_text, edit.range) == (
        "expect",
        lsp.Range(lsp.Position(3, 0), lsp.Position(3, 5)),
    )


@pytest.mark.asyncio
async def test_words_under_the_cursor_and_to_come(client: Any) -> None:
    """Keys, claims, families, rules and methods."""
    text = "methods:\n  - {family: gauss, stages: 2}\n  - lobatto-iiia-3\ntransfer: collocation\nexpect:\n  order: 4\n  \n\n"
    uri = type_in(client, text)
    assert await told(client, uri) == []
    places = {
        (1, 5): "**methods.family**",
        (1, 14): "**gauss**",
        (2, 6): "**lobatto-iiia**",
        (3, 3): "**transfer**",
        (3, 14): "**collocation**",
        (5, 4): "**order**: ",
    }
    for (line, column), begin in places.items():
        hover = await client.text_document_hover_async(lsp.HoverParams(**at(uri, line, column)))
        assert begin in hover.contents.value, (line, column)
    nothing = await client.text_document_hover_async(lsp.HoverParams(**at(uri, 7, 0)))
    assert nothing is None

    async def choices(line: int, column: int) -> set[str]:
        asked = lsp.CompletionParams(**at(uri, line, column))
        found = await client.text_document_completion_async(asked)
        items = getattr(found, "items", found)
        return {x.label for x in items}

    assert {"A", "b", "expect", "transfer", "tolerance"} <= await choices(7, 0)
    assert {"gauss", "radau-iia", "rk4"} <= await choices(1, 13)
    assert {"collocation", "interpolation"} <= await choices(3, 10)
    assert {"order", "symplectic", "pair-order"} <= await choices(6, 2)
    assert "transfer" not in await choices(6, 2)
    assert {"family", "stages"} <= await choices(1, 5)


@pytest.mark.asyncio
async def test_other_files_and_unknowns_are_left_alone(client: Any) -> None:
    """YAML that is no method has no squiggles; free numbers have a lens alone."""
    assert await told(client, type_in(client, "jobs:\n  build: [1\n", "ci.yaml")) == []
    uri = type_in(client, 'A: [[0, 0], ["?", 0]]\nb: ["?", "?"]\n', "free.yaml")
    assert await told(client, uri) == []
    about = lsp.TextDocumentIdentifier(uri)
    (lens,) = await client.text_document_code_lens_async(lsp.CodeLensParams(about))
    assert "gark design" in lens.command.title


@pytest.mark.asyncio
async def test_typing_goes_on_while_gark_is_busy(client: Any) -> None:
    """An earlier version that takes long is given up; the last one is judged."""
    slow = "methods: [gauss-30, lobatto-iiia-31]\ntransfer: collocation\n"
    uri = type_in(client, slow)
    await asyncio.sleep(1)
    type_in(client, WRONG, version=2)
    assert [x.code for x in await told(client, uri)] == ["claim", "misprint"]
    type_in(client, slow, version=3)
    assert await told(client, uri) == []
    about = lsp.TextDocumentIdentifier(uri)
    (lens,) = await client.text_document_code_lens_async(lsp.CodeLensParams(about))
    assert lens.command.title.startswith("not decided in time")
    client.text_document_did_close(lsp.DidCloseTextDocumentParams(lsp.TextDocumentIdentifier(uri)))
    assert await told(client, uri) == []
