"""The language server.

Each check is a process of its own: it never holds the editor up, and ends when the file has changed
or its time is over.
"""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import msgspec.json
from lsprotocol import types as lsp
from pygls.lsp.server import LanguageServer
from pygls.workspace import TextDocument

from garkcli.editor.judging import LATE, SECONDS, Judgement, TextSpan, is_method
from garkcli.editor.wording import choices_at, meaning_at
from garkcli.version import __version__

PAUSE = 0.25
"""Seconds without a change before a file is checked."""
MOST = SECONDS + 5
SEVERITIES = {
    "error": lsp.DiagnosticSeverity.Error,
    "warning": lsp.DiagnosticSeverity.Warning,
    "note": lsp.DiagnosticSeverity.Information,
    "hint": lsp.DiagnosticSeverity.Information,
}


class Server(LanguageServer):
    def __init__(self) -> None:
        super().__init__("gark", __version__)
        self.judgements: dict[str, Judgement] = {}
        self.running: dict[str, asyncio.Task[None]] = {}
        self.refreshing: asyncio.Task[None] | None = None

    def renew(self, uri: str) -> None:
        """Checks a file anew, once nobody types; an earlier check of it ends."""
        self.forget(uri)
        document = self.workspace.get_text_document(uri)
        if is_method(uri.rpartition("/")[2], document.source):
            self.running[uri] = asyncio.ensure_future(self._check(document))
        else:
            self._show(document, Judgement())

    def forget(self, uri: str) -> None:
        if uri in self.running:
            self.running.pop(uri).cancel()

    async def _check(self, document: TextDocument) -> None:
        await asyncio.sleep(PAUSE)
        text, version = document.source, document.version
        found = await judged_apart(text, document.path or document.uri)
        if document.version == version:
            self._show(document, found)

    def _show(self, document: TextDocument, found: Judgement) -> None:
        self.judgements[document.uri] = found
        diagnostics = [
            lsp.Diagnostic(
                ranged(document, x.span),
                "\n".join(filter(None, (x.remark.message, x.remark.help))),
                SEVERITIES[x.remark.level],
                x.remark.code,
                source="gark",
            )
            for x in found.remarks
        ]
        self.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(document.uri, diagnostics, document.version)
        )
        self.refreshing = asyncio.ensure_future(self._refresh())

    async def _refresh(self) -> None:
        about = self.client_capabilities.workspace
        if about is not None and about.code_lens is not None and about.code_lens.refresh_support:
            with suppress(Exception):  # an editor may refuse
                await self.workspace_code_lens_refresh_async(None)


async def judged_apart(text: str, source: str) -> Judgement:
    command = [sys.executable, "-m", "garkcli", "lsp", "--once", "-", "--name", source]
    process = await asyncio.create_subprocess_exec(
        *command,
        stdin=asyncio.subprocess.PIPE,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.DEVNULL,
    )
    try:
        out, _ = await asyncio.wait_for(process.communicate(text.encode()), MOST)
        return msgspec.json.decode(out, type=Judgement)
    except TimeoutError:
        return Judgement((), (LATE,))
    except msgspec.DecodeError:
        return Judgement((), ("gark cannot judge this file; gark check says more",))
    finally:
        if process.returncode is None:
            with suppress(ProcessLookupError):
                process.kill()
            await process.wait()


def ranged(document: TextDocument, span: TextSpan) -> lsp.Range:
    here = lsp.Range(lsp.Position(span.line, span.start), lsp.Position(span.line, span.end))
    return document.position_codec.range_to_client_units(document.lines, here)


def _placed(server: Server, params: Any) -> tuple[list[str], int, int]:
    document = server.workspace.get_text_document(params.text_document.uri)
    place = document.position_codec.position_from_client_units(document.lines, params.position)
    return document.source.splitlines(), place.line, place.character


def make_server() -> Server:
    server = Server()

    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    @server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
    async def changed(ls: Server, params: Any) -> None:
        ls.renew(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    async def closed(ls: Server, params: lsp.DidCloseTextDocumentParams) -> None:
        uri = params.text_document.uri
        ls.forget(uri)
        ls.judgements.pop(uri, None)
        ls.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri, []))

    @server.feature(lsp.TEXT_DOCUMENT_CODE_LENS)
    def lenses(ls: Server, params: lsp.CodeLensParams) -> Sequence[lsp.CodeLens]:
        found = ls.judgements.get(params.text_document.uri, Judgement())
        line = lsp.Position(found.line, 0)
        return [lsp.CodeLens(lsp.Range(line, line), lsp.Command(x, "")) for x in found.lens]

    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(ls: Server, params: lsp.HoverParams) -> lsp.Hover | None:
        text = meaning_at(*_placed(ls, params))
        return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, text)) if text else None

    @server.feature(
        lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=[" ", "{", "["])
    )
    def completion(ls: Server, params: lsp.CompletionParams) -> Sequence[lsp.CompletionItem]:
        return [
            lsp.CompletionItem(x.word, documentation=x.text, insert_text=x.written)
            for x in choices_at(*_placed(ls, params))
        ]

    @server.feature(
        lsp.TEXT_DOCUMENT_CODE_ACTION, lsp.CodeActionOptions([lsp.CodeActionKind.QuickFix])
    )
    def actions(ls: Server, params: lsp.CodeActionParams) -> Sequence[lsp.CodeAction]:
        uri = params.text_document.uri
        document = ls.workspace.get_text_document(uri)
        found = []
        for x in ls.judgements.get(uri, Judgement()).remarks:
            where = ranged(document, x.span)
            if not _touch(where, params.range):
                continue
            for fix in x.fixes:
                edit = lsp.TextEdit(ranged(document, fix.span), fix.text)
                change = lsp.WorkspaceEdit({uri: [edit]})
                found.append(lsp.CodeAction(fix.title, lsp.CodeActionKind.QuickFix, edit=change))
        return found

    return server


def _touch(one: lsp.Range, other: lsp.Range) -> bool:
    return bool(one.start <= other.end and other.start <= one.end)
