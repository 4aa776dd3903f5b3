"""What a section of the page is."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

from garkcli.frozen import Frozen

if TYPE_CHECKING:
    from garkcli.webpage.reported import Reported

Content: TypeAlias = Mapping[str, Any]
"""What a template is given, by the names that it has there."""


class Section(Frozen):
    """A section of the page of a method.

    Attributes:
        name: its template is ``templates/NAME.html``, its place on the page ends in it.
        title: its heading.
        content: from a method to what the template is given; None where the section has nothing to
            say, and is left out.
    """

    name: str
    title: str
    content: Callable[[Reported], Content | None]
