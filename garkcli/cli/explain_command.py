"""``gark explain``."""

from __future__ import annotations

import click
from click.shell_completion import CompletionItem

from garkcli.cli.options import Output, declared
from garkcli.tell.report import FORMATS


class _Word(click.ParamType):  # type: ignore[type-arg]
    """A word that is known; shells complete it."""

    name = "word"

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        from garkcli.check.meanings import known_words

        words = [word for word in known_words() if word.startswith(incomplete)]
        return [CompletionItem(word) for word in words]


@declared("explain", FORMATS, WORD={"type": _Word()})
def command(words: tuple[str, ...], output: Output) -> int:
    """What a word of a report or of a file means: its definition, its formula, its source.

    WORD is a term such as density or "stage order", a line of a report, a claim, a key of a file
    such as compose.steps, a family, a transfer rule, a problem, the code of an error or its
    message. Without one the terms are listed.
    """
    from garkcli.check.meanings import explain
    from garkcli.report.meaning import REPORT, every_term, list_text, told

    word = " ".join(words)
    if not word and output.format == "text":
        output.write(list_text(output.width))
    else:
        output.tell(REPORT, told(word, explain(word)) if word else every_term())
    return 0
