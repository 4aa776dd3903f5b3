"""The look of a text on its stream."""

from garkcli.frozen import Frozen


class Look(Frozen):
    """The signs that a text may have; ``is_drawn`` if a terminal shows tables and links of it."""

    has_colour: bool = False
    encoding: str = "utf-8"
    is_drawn: bool = False


PLAIN = Look()
