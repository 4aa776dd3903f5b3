"""The coupling of a multirate infinitesimal method, which its tableau does not show."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.methodfile.build import Builder, families_of, nodes_to_spell_out
from garkcli.methodfile.constructed.multirate import Infinitesimal
from garkcli.methodfile.description import ConstructionText
from garkcli.methodfile.load import NO_SETTINGS, described
from garkcli.methodfile.values import Values

if TYPE_CHECKING:
    from garkcli.constructions.multirate import Coupling
    from garkcli.methodfile.build import MethodFile


def coupling_of(method: MethodFile) -> Coupling | None:
    """What a file with ``multirate: {mis: …}`` or ``{mri: …}`` couples its slow stages by.

    Returns:
        None for other files, and where values were given for parameters of the file.
    """
    if method.form != "multirate":
        return None
    reader, description = described(method.text, method.source, NO_SETTINGS)
    content = description.content
    if not isinstance(content, ConstructionText):
        return None
    make = content.make
    if not isinstance(make, Infinitesimal) or description.is_conjugate:
        return None
    families = families_of(description)
    nodes = nodes_to_spell_out(description, families, reader.numbers)
    values = Values(reader.numbers)
    builder = Builder(reader.source, values, families, nodes)
    is_the_same = make(builder.part, values) == method.tableau
    return make.coupling(builder.part, values) if is_the_same else None
