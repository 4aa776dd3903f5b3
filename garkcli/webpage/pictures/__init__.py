"""Pictures of a method as SVG that stands in a page: of our own, matplotlib is not needed."""

from __future__ import annotations

from garkcli.webpage.pictures.drawing import STYLE as STYLE
from garkcli.webpage.pictures.picture import Picture as Picture
from garkcli.webpage.pictures.registry import compared_pictures as compared_pictures
from garkcli.webpage.pictures.registry import pictures as pictures
