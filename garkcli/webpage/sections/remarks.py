"""Warnings and hints, which are about no claim."""

from __future__ import annotations

from markupsafe import Markup

from garkcli.check.findings import asides
from garkcli.webpage.mathml import Typeset
from garkcli.webpage.reported import Content, Reported


def content(method: Reported) -> Content | None:
    d = Typeset()
    remarks = [
        {"code": x.code, "help": x.help, "message": Markup(d.reason(x.reason))}
        for x in asides(method.outcome)
    ]
    return {"remarks": remarks} if remarks else None
