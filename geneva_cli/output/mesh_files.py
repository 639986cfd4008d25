"""Meshes as files: binary STL, and 3MF with a name and a colour for each kind of solid.

STL has no unit, no names and no colours; programs that read it take millimetres. A 3MF file is an
archive of XML. It is not compressed and has the archive's first date, so that its bytes are equal
on every run and with every zlib.
"""

import io
from collections.abc import Iterator
from html import escape
from zipfile import ZIP_STORED, ZipFile, ZipInfo

import numpy as np

from geneva_cli.errors import clean
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.inks import INKS
from geneva_cli.output.meshes import DECIMALS, Body, bodies, placed
from geneva_cli.output.templates import filled, template
from geneva_cli.table import in_decimals

RECORD = [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]


def stl(drawing: Drawing) -> Iterator[bytes]:
    """Yield an STL file's bytes. Raises GenevaError as ``bodies`` does."""
    blocks = []
    for body in bodies(drawing, "STL"):
        for place in body.places:
            corners = placed(body.corners, place)[body.triangles]
            single = corners.astype("<f4")
            p, q, r = (single[:, k] for k in range(3))
            flat = (p == q).all(axis=1) | (q == r).all(axis=1) | (r == p).all(axis=1)
            records = np.zeros(int((~flat).sum()), dtype=RECORD)
            records["corners"] = single[~flat]
            p, q, r = (corners[~flat, k] for k in range(3))
            out = np.cross(q - p, r - p)
            length = np.sqrt((out * out).sum(axis=1, keepdims=True))
            records["normal"] = out / np.where(length > 0.0, length, 1.0)  # none without an area
            blocks.append(records)
    # "solid" at the start would mean an STL in text
    yield b"geneva, millimetres".ljust(80, b"\0")
    yield sum(map(len, blocks)).to_bytes(4, "little")
    yield from (block.tobytes() for block in blocks)


def threemf(drawing: Drawing) -> Iterator[bytes]:
    """Yield a 3MF file's bytes. Raises GenevaError as ``bodies`` does."""
    kinds, objects, items = bodies(drawing, "3MF"), "", ""
    layers = list(dict.fromkeys(body.layer for body in kinds))
    colours = ((_text(layer), INKS[layer].rgb.upper()) for layer in layers)
    materials = "".join(f'<base name="{n}" displaycolor="{rgb}"/>\n' for n, rgb in colours)
    for number, body in enumerate(kinds, 2):  # 1 is the list of colours
        objects += "".join(_object(body, number, layers.index(body.layer)))
        items += "".join(_item(number, *place) for place in body.places)
    parts = {"TITLE": _text(drawing.title), "MATERIALS": materials}
    parts |= {"OBJECTS": objects, "ITEMS": items}
    stream = io.BytesIO()
    with ZipFile(stream, "w", ZIP_STORED) as archive:
        for name, text in (
            ("[Content_Types].xml", template("threemf_types.xml")),
            ("_rels/.rels", template("threemf_relations.xml")),
            ("3D/3dmodel.model", filled("threemf_model.xml", parts)),
        ):
            entry = ZipInfo(name)  # dated 1980-01-01, the first day of the format
            entry.create_system = 3  # of any operating system
            archive.writestr(entry, text.encode())
    yield stream.getvalue()


def _object(body: Body, number: int, colour: int) -> Iterator[str]:
    """Yield a kind of solid."""
    yield f'<object id="{number}" type="model" name="{_text(body.name)}" '
    yield f'pid="1" pindex="{colour}"><mesh>\n<vertices>\n'
    for corner in body.corners.tolist():
        x, y, z = (in_decimals(value, DECIMALS) for value in corner)
        yield f'<vertex x="{x}" y="{y}" z="{z}"/>\n'
    yield "</vertices>\n<triangles>\n"
    for a, b, c in body.triangles.tolist():
        yield f'<triangle v1="{a}" v2="{b}" v3="{c}"/>\n'
    yield "</triangles>\n</mesh></object>\n"


def _item(number: int, turn: Array, shift: Array) -> str:
    """A solid in its place."""
    # the images of the axes, with more decimals as they act through a length; the shift
    words = [f"{round(value, 12) + 0.0:.12g}" for value in turn.T.ravel().tolist()]
    words += [in_decimals(value, DECIMALS) for value in shift]
    return f'<item objectid="{number}" transform="{" ".join(words)}"/>\n'


def _text(text: str) -> str:
    # an apostrophe may stay between quotes
    return escape(clean(text), quote=False).replace('"', "&quot;")
