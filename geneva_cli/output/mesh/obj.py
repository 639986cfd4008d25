"""OBJ: each solid as an object with its name, at its position, in mm."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.errors import clean
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.output.mesh.solids import DECIMALS, bodies


def data(drawing: Drawing, units: str) -> Iterator[bytes]:
    """The file's bytes. Raises GenevaError as ``bodies`` does."""
    first = 1  # corners are counted from 1, through the whole file
    yield b"# geneva, millimetres\n"
    for body in bodies(drawing, units, "OBJ"):
        name = clean(body.name).replace(" ", "_")  # a space ends a name
        for place in body.places:
            corners = place(body.surface.corners)
            lines = [f"o {name}"]
            lines += [f"v {_shown(x)} {_shown(y)} {_shown(z)}" for x, y, z in corners.tolist()]
            triangles = (body.surface.triangles + first).tolist()
            lines += [f"f {a} {b} {c}" for a, b, c in triangles]
            yield ("\n".join(lines) + "\n").encode()
            first += len(corners)


def _shown(value: float) -> str:
    return f"{value:.{DECIMALS}f}"
