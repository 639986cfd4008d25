"""Readers of drawings that others made: DXF and SVG as lines and arcs in millimetres."""

import math
import os

from geneva_cli.errors import GenevaError, cut
from geneva_cli.geometry.shapes import Arc
from geneva_cli.output.foreign.drawn import Drawn
from geneva_cli.specfile.tree import read_bytes

BYTES_MAX = 1 << 26  # 64 MB; a machine's outline has some kilobytes
PIECES_MAX = 20_000  # more take minutes to turn
SIZE_MAX_MM = 1e6


def read_drawing(path: str) -> Drawn:
    """Return the lines and arcs in a .dxf or .svg file, mm.

    Curves that are no arcs become arcs within ``drawn.CURVE_MM``. Raises GenevaError, which names
    the file and the place, for a file that cannot be read or has something that is no outline.
    """
    shown = cut(path, 300)
    ending = os.path.splitext(path)[1].lower()
    if ending not in (".dxf", ".svg"):
        raise GenevaError(f"{shown}: an outline is read from a .dxf or .svg file")
    data = read_bytes(path, BYTES_MAX, "too large for an outline")
    try:
        if ending == ".dxf":
            from geneva_cli.output.foreign.dxf_pieces import read_dxf

            drawn = read_dxf(data, path)
        else:
            from geneva_cli.output.foreign.svg_pieces import read_svg

            drawn = read_svg(data)
    except GenevaError as error:
        raise GenevaError(f"{shown}: {error}") from None
    if len(drawn.pieces) > PIECES_MAX:
        raise GenevaError(
            f"{shown}: {len(drawn.pieces)} lines and arcs, more than {PIECES_MAX}: draw arcs in "
            "place of lines"
        )
    for piece in drawn.pieces:
        numbers = (*piece.start, *piece.end, piece.bulge if isinstance(piece, Arc) else 0.0)
        if not all(math.isfinite(v) and abs(v) <= SIZE_MAX_MM for v in numbers):
            raise GenevaError(
                f"{shown}: a piece from {piece.start} to {piece.end}: coordinates must be finite, "
                f"and at most {SIZE_MAX_MM:g} mm"
            )
    return drawn
