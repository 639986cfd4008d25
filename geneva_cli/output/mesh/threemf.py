"""3MF: each kind of solid as an object with its name and colour, and an item at each position.

A 3MF file is an archive of XML. It is not compressed and has the archive's first date, so that its
bytes are equal on every run and with every zlib.
"""

from __future__ import annotations

import io
from collections.abc import Iterator
from html import escape
from zipfile import ZIP_STORED, ZipFile, ZipInfo

from geneva_cli.errors import clean
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.output.inks import inks
from geneva_cli.output.mesh.solids import DECIMALS, Body, Place, bodies
from geneva_cli.table import in_decimals

PACKAGE = "http://schemas.openxmlformats.org/package/2006"
XML = '<?xml version="1.0" encoding="UTF-8"?>\n'
TYPES = (
    f'{XML}<Types xmlns="{PACKAGE}/content-types">'
    '<Default Extension="rels" '
    'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Default Extension="model" '
    'ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>\n'
)
RELATIONS = (
    f'{XML}<Relationships xmlns="{PACKAGE}/relationships"><Relationship Id="model" '
    'Target="/3D/3dmodel.model" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>\n'
)
MATERIALS = 1  # the number of the list of colours; objects are counted from the next one


def data(drawing: Drawing, units: str) -> Iterator[bytes]:
    """The file's bytes. Raises GenevaError as ``bodies`` does."""
    model = "".join(_model(drawing.title, bodies(drawing, units, "3MF")))
    stream = io.BytesIO()
    with ZipFile(stream, "w", ZIP_STORED) as archive:
        for name, text in (
            ("[Content_Types].xml", TYPES),
            ("_rels/.rels", RELATIONS),
            ("3D/3dmodel.model", model),
        ):
            entry = ZipInfo(name)  # dated 1980-01-01, the first day of the format
            entry.create_system = 3  # of any operating system
            archive.writestr(entry, text.encode())
    yield stream.getvalue()


def _model(title: str, kinds: list[Body]) -> Iterator[str]:
    core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
    yield f'{XML}<model unit="millimeter" xml:lang="en" xmlns="{core}">\n'
    yield f'<metadata name="Title">{_text(title)}</metadata>\n<resources>\n'
    layers = list(dict.fromkeys(body.layer for body in kinds))
    colours = inks(tuple(layers))
    yield f'<basematerials id="{MATERIALS}">\n'
    for layer in layers:
        yield f'<base name={_quoted(layer)} displaycolor="{colours[layer].rgb.upper()}"/>\n'
    yield "</basematerials>\n"
    for number, body in enumerate(kinds, MATERIALS + 1):
        yield (
            f'<object id="{number}" type="model" name={_quoted(body.name)} '
            f'pid="{MATERIALS}" pindex="{layers.index(body.layer)}"><mesh>\n<vertices>\n'
        )
        for corner in body.surface.corners.tolist():
            x, y, z = (in_decimals(value, DECIMALS) for value in corner)
            yield f'<vertex x="{x}" y="{y}" z="{z}"/>\n'
        yield "</vertices>\n<triangles>\n"
        for a, b, c in body.surface.triangles.tolist():
            yield f'<triangle v1="{a}" v2="{b}" v3="{c}"/>\n'
        yield "</triangles>\n</mesh></object>\n"
    yield "</resources>\n<build>\n"
    for number, body in enumerate(kinds, MATERIALS + 1):
        for place in body.places:
            yield f'<item objectid="{number}" transform="{_transform(place)}"/>\n'
    yield "</build>\n</model>\n"


def _transform(place: Place) -> str:
    """The position as the format has it: three images of the axes, and the shift."""
    # a rotation acts through a length, so it has more decimals than one
    turn = [f"{round(value, 12) + 0.0:.12g}" for value in place.turn.T.ravel().tolist()]
    return " ".join([*turn, *(in_decimals(value, DECIMALS) for value in place.shift)])


def _text(text: str) -> str:
    # an apostrophe may stay between quotes
    return escape(clean(text), quote=False).replace('"', "&quot;")


def _quoted(text: str) -> str:
    return f'"{_text(text)}"'
