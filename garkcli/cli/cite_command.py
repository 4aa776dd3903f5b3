"""``gark cite``."""

from __future__ import annotations

from garkcli.cli.options import Output, declared, files_meant
from garkcli.report.citation import FORMATS


@declared("cite", FORMATS)
def command(files: tuple[str, ...], output: Output) -> int:
    """Where methods were published, as an entry of a bibliography.

    FILE is a method file or a name of the catalogue, as for gark check; catalogue: means all of
    it. Methods of one publication have one entry. A file whose `reference` is plain text gives a
    note, one without a reference is told.
    """
    from garkcli.methodfile.bibliography import reference_of
    from garkcli.methodfile.load import read_method_text
    from garkcli.report.citation import REPORT, Cited, bibliography, together

    cited = []
    for path in files_meant(files, output):
        text, source = read_method_text(path)
        cited.append(Cited((source,), *reference_of(text, source)))
    found = together(cited)
    if output.format == "bibtex":
        output.write(bibliography(found))
    else:
        output.tell(REPORT, [found])
    bare = [one.methods[0] for one in found if not one.text]
    if bare:
        shown = bare[0] if len(bare) == 1 else f"{len(bare)} methods"
        output.note(f"note: no reference in the file of {shown}")
    return 0
