"""The publication of the method."""

from __future__ import annotations

from garkcli.report.citation import Cited, bibliography
from garkcli.webpage.reported import Content, Reported

_ADDRESSES = ("https://", "http://")


def content(method: Reported) -> Content | None:
    if not method.reference:
        return None
    fields = method.bibliography
    cited = Cited((method.outcome.file,), method.reference, method.bibliography)
    found = {
        "text": method.reference,
        "doi": "",
        "url": "",
        "coefficients": "",
        "note": "",
        "bibtex": bibliography([cited]),
    }
    if fields is not None:
        found["doi"] = fields.doi
        found["coefficients"] = fields.coefficients
        found["note"] = fields.note
        if fields.url.startswith(_ADDRESSES):
            found["url"] = fields.url
    return found
