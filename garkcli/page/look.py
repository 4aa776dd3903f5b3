"""The look of a text on its stream."""

from garkcli.frozen import Frozen


class Look(Frozen):
    """The signs and marks that a text may have.

    Attributes:
        has_colour: whether styles are marked by colours, which are never the only information.
        encoding: of the stream; characters that it lacks are replaced before columns are aligned.
        is_drawn: whether a terminal shows the text, with tables and links.
    """

    has_colour: bool = False
    encoding: str = "utf-8"
    is_drawn: bool = False


PLAIN = Look()
"""A file or a pipe."""
