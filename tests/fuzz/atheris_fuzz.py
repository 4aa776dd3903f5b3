"""Coverage-guided fuzzing: ``python tests/fuzz/atheris_fuzz.py --target files|numbers -runs=100000
[corpus…]``.

Any exception that is not of ``garkcli.errors`` is a fault, as is an input that takes more than five
seconds or makes the process grow by more than 500 MB. Further arguments go to libFuzzer. Without a
corpus folder, one is made from the files of ``methods`` and ``tests/examples``, and grows with
every run.
"""

from __future__ import annotations

import argparse
import resource
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from tests.fuzz.inputs import SIGNS, WORDS, seeds

SECONDS = 5
"""Longest time of an input."""
MEGABYTES = 500
"""Most memory of the process beyond that of its start."""
NODES = 5_000
"""Most YAML values here: instrumented code is some forty times slower, and the usual limit would be
a timeout.
"""
KEPT = Path(".hypothesis")
"""Where faulty inputs are saved, and the inputs with which the next run begins."""
NUMBERS = (
    "1/2 - sqrt(3)/6",
    "root(2, 5)*cbrt(-2)",
    "sqrt(2 + sqrt(2))",
    "1/(1 - sqrt(2))**3",
    "-1.5e-3",
    "(2**-3)",
)
"""Good numbers to begin with."""


def _is_raw(first: int) -> bool:
    return first % 2 == 0


def file_of(data: bytes, provider: Any, files: tuple[str, ...]) -> str:
    """Bytes as a file: after an even byte the text itself; else edits of a file of the project."""
    if not data or _is_raw(data[0]):
        return data[1:].decode("utf-8", "replace")
    provider.ConsumeInt(1)
    text = files[provider.ConsumeIntInRange(0, len(files) - 1)]
    for _ in range(provider.ConsumeIntInRange(1, 5)):
        start = provider.ConsumeIntInRange(0, len(text))
        stop = min(len(text), start + provider.ConsumeIntInRange(0, 12))
        kind = provider.ConsumeIntInRange(0, 2)
        if kind == 0:
            piece = WORDS[provider.ConsumeIntInRange(0, len(WORDS) - 1)]
        elif kind == 1:
            piece = "".join(SIGNS[provider.ConsumeIntInRange(0, len(SIGNS) - 1)] for _ in range(6))
        else:
            piece = provider.ConsumeUnicodeNoSurrogates(8)
        text = text[:start] + piece + text[stop:]
    return text


def targets(atheris: Any) -> Mapping[str, Callable[[bytes], None]]:
    """What can be fuzzed; the modules under test are imported here, instrumented."""
    with atheris.instrument_imports(include=["garkcli.methodfile", "garkcli.exact"]):
        from garkcli.errors import ExpressionError, MethodFileError
        from garkcli.exact.domain import Domain
        from garkcli.exact.expression import parse
        from garkcli.exact.rewriting import substitute
        from garkcli.grammar import nodes
        from garkcli.methodfile.load import loads
    nodes.MAX_NODES = NODES
    files, values = seeds(), {"tau": parse("1/2")}

    def one_file(data: bytes) -> None:
        text = file_of(data, atheris.FuzzedDataProvider(data), files)
        try:
            loads(text)
        except MethodFileError as error:
            if not error.faults or any(
                fault.line < 1 or fault.column < 1 for fault in error.faults
            ):
                raise RuntimeError("a fault without a place") from error

    def one_number(data: bytes) -> None:
        text = data.decode("utf-8", "replace")
        try:
            expression = substitute(parse(text), values)
            Domain([expression]).evaluate(expression)
        except ExpressionError as error:
            if not 0 <= error.start <= len(text):
                raise RuntimeError("an offset outside the text") from error

    return {"files": one_file, "numbers": one_number}


def write_corpus(folder: Path, target: str) -> None:
    """The first inputs of a target, and the words it is made of."""
    inputs = [f"\0{text}" for text in seeds()] if target == "files" else list(NUMBERS)
    for k, text in enumerate(inputs):
        (folder / f"{k}").write_text(text, encoding="utf-8")


def write_words(file: Path, target: str) -> None:
    """The words that libFuzzer puts together."""
    words = WORDS if target == "files" else SIGNS
    escaped = ("".join(f"\\x{byte:02x}" for byte in word.encode()) for word in words)
    file.write_text("".join(f'"{word}"\n' for word in escaped), encoding="ascii")


def main() -> None:
    """Fuzz until libFuzzer stops; it ends the process, with a code that is not 0 after a fault."""
    import atheris  # of the extra ``fuzz``: nothing else needs it

    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--target", choices=("files", "numbers"), required=True)
    options, rest = parser.parse_known_args()
    target = targets(atheris)[options.target]
    megabytes = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024 + MEGABYTES
    place = KEPT / f"atheris-{options.target}"
    corpus, faults = place / "corpus", KEPT / "faults"
    for folder in (corpus, faults):
        folder.mkdir(parents=True, exist_ok=True)
    write_corpus(corpus, options.target)
    write_words(place / "words", options.target)
    folders = [] if any(not argument.startswith("-") for argument in rest) else [str(corpus)]
    limits = [f"-timeout={SECONDS}", f"-rss_limit_mb={megabytes}", "-max_len=4000"]
    files = [f"-dict={place / 'words'}", f"-artifact_prefix={faults}/"]
    atheris.Setup([sys.argv[0], *limits, *files, *rest, *folders], target)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
