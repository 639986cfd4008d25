"""DXF, R2000 by default: one closed polyline for each part, circles for bores.

The output is equal on every run.
"""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.geometry.drawing import Drawing, extent
from geneva_cli.geometry.pieces import UNITS, prepared
from geneva_cli.output.dxf_contours import draw
from geneva_cli.output.dxf_file import USUAL, dxf_text, extents, linetype
from geneva_cli.output.ezdxf_alone import Document, Modelspace
from geneva_cli.output.inks import CENTRE_LINES, DASHES, inks


def chunks(drawing: Drawing, units: str, version: str = USUAL) -> Iterator[str]:
    """The file's text; ``units`` is mm or inch, ``version`` one of ``output.DXF_VERSIONS``.

    Raises GenevaError for another unit or version, a coordinate that is not finite, a drawing
    without shapes, or cubics in R12.
    """
    drawing = prepared(drawing, units)

    def fill(document: Document, space: Modelspace) -> None:
        _layers(document, drawing, 1.0 / UNITS[units])
        for shape in drawing.shapes:
            draw(space, shape)
        extents(document, space, extent(drawing))

    yield from dxf_text(drawing.title, units, version, fill)


def _layers(document: Document, drawing: Drawing, millimetre: float) -> None:
    for layer, ink in inks(drawing.layers).items():
        name = "Continuous"
        if layer in CENTRE_LINES:
            name = "CENTER"
            linetype(document, name, tuple(millimetre * d for d in DASHES))
        document.layers.add(layer, color=ink.number, linetype=name)
