"""A drawing sheet as DXF, in millimetres on paper, its dimensions as DIMENSION entities.

Each dimension has a block with its lines and its text, so that every reader shows it as the other
formats do. Each scale has a style, with which a CAD program that measures again gets the part's own
size.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.errors import clean
from geneva_cli.geometry.shapes import Contour, Layer
from geneva_cli.geometry.sheet import DASHED, DIMENSION, TEXT, WIDTHS, Label, Measure, Sheet
from geneva_cli.output.dxf import USUAL, draw, dxf_text, extents, linetype
from geneva_cli.output.ezdxf_alone import BaseLayout, Document, Modelspace

# group code 70 of a DIMENSION, and the attributes that hold its points
KINDS = {
    "length": (0, ("defpoint2", "defpoint3", "defpoint")),
    "angular": (5, ("defpoint4", "defpoint2", "defpoint3", "defpoint")),
    "diameter": (3, ("defpoint", "defpoint4")),
    "radius": (4, ("defpoint", "defpoint4")),
}


def chunks(sheet: Sheet, version: str = USUAL) -> Iterator[str]:
    """The file's text. Raises GenevaError for an unknown version, or for cubics in R12."""

    def fill(document: Document, space: Modelspace) -> None:
        _layers(document)
        for shape in sheet.shapes:
            draw(space, shape)
        for label in sheet.labels:
            _text(space, label, TEXT)
        for measure in sheet.measures:
            _measure(document, space, measure, 1.0 if sheet.units == "mm" else 25.4)
        extents(document, space, (0.0, 0.0, sheet.width, sheet.height))

    yield from dxf_text(sheet.title, "mm", version, fill)


def _layers(document: Document) -> None:
    for name, width in WIDTHS.items():
        pattern = "Continuous"
        if name in DASHED:
            pattern = {2: "HIDDEN", 4: "CENTER"}[len(DASHED[name])]
            linetype(document, pattern, DASHED[name])
        document.layers.add(name, color=7, linetype=pattern, lineweight=round(100.0 * width))
    document.styles.add("SHEET", font="arial.ttf")


def _measure(document: Document, space: Modelspace, measure: Measure, unit_mm: float) -> None:
    if measure.kind != "angular":
        measure = measure._replace(value=measure.value / unit_mm)
    if measure.kind not in KINDS:
        _drawn(space, measure)
        return
    block = document.blocks.new_anonymous_block(type_char="D")
    _drawn(block, measure)
    number, names = KINDS[measure.kind]
    # 32: no other dimension uses this block; 128: the text stays at its place
    attributes = {
        "layer": DIMENSION,
        "dimstyle": _style(document, measure),
        "dimtype": number + 32 + 128,
        "geometry": block.name,
        "text": _signed(measure.label.text),
        "text_midpoint": measure.label.middle,
        "angle": math.degrees(measure.turn),
        "actual_measurement": (
            math.radians(measure.value) if measure.kind == "angular" else measure.value
        ),
        **dict(zip(names, measure.points, strict=True)),
    }
    space.new_entity("DIMENSION", attributes)


def _style(document: Document, measure: Measure) -> str:
    factor = 1.0
    if measure.kind != "angular":
        a, b = measure.points[:2]
        c, s = math.cos(measure.turn), math.sin(measure.turn)
        long = math.dist(a, b)
        if measure.kind == "length":
            long = abs((b[0] - a[0]) * c + (b[1] - a[1]) * s)
        factor = measure.value / long
    name = f"TIMES_{factor:.4g}".replace(".", "_")
    if name not in document.dimstyles:
        document.dimstyles.new(
            name,
            dxfattribs={
                "dimlfac": float(f"{factor:.9g}"),
                "dimtxt": measure.label.height,
                "dimasz": 3.0,
                "dimexe": 1.5,
                "dimexo": 0.8,
                "dimgap": 0.8,
                "dimtad": 1,  # text above the line
                "dimtih": 0,  # and along it
                "dimtoh": 0,
                "dimdec": 3,
                "dimtxsty": "SHEET",
            },
        )
    return name


def _drawn(space: BaseLayout, measure: Measure) -> None:
    for piece in measure.lines:
        draw(space, Contour(DIMENSION, (piece,), closed=False))
    for arrow in measure.arrows:
        tip, left, right = arrow.corners
        space.add_solid([tip, left, right, right], dxfattribs={"layer": DIMENSION})
    _text(space, measure.label, DIMENSION)


def _text(space: BaseLayout, label: Label, layer: Layer) -> None:
    space.add_text(
        _signed(label.text),
        height=label.height,
        rotation=math.degrees(label.turn),
        dxfattribs={"layer": layer, "style": "SHEET", "insert": label.at},
    )


def _signed(text: str) -> str:
    """A text with DXF's own signs; accidental ones are separated."""
    shown = clean(text).replace("%%", "% %")
    signs = {"Ø": "%%c", "°": "%%d", "±": "%%p"}  # every version of DXF has these
    return "".join(signs.get(c, c) for c in shown)
