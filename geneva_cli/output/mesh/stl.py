"""Binary STL: the triangles of all solids at their positions.

The format has no unit, no names and no colours. Programs that read it take millimetres.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from geneva_cli.geometry.sheet import Drawing
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.mesh.solids import bodies

if TYPE_CHECKING:
    import numpy.typing as npt


def data(drawing: Drawing, units: str) -> Iterator[bytes]:
    """The file's bytes. Raises GenevaError as ``bodies`` does."""
    blocks = [
        _records(place(body.surface.corners)[body.surface.triangles])
        for body in bodies(drawing, units, "STL")
        for place in body.places
    ]
    # "solid" at the start would mean an STL in text
    yield b"geneva, millimetres".ljust(80, b"\0")
    yield sum(map(len, blocks)).to_bytes(4, "little")
    yield from (block.tobytes() for block in blocks)


def _records(corners: Array) -> npt.NDArray[Any]:
    """Return the records of triangles, (m, 3, 3), in mm."""
    single = corners.astype("<f4")
    p, q, r = (single[:, k] for k in range(3))
    flat = (p == q).all(axis=1) | (q == r).all(axis=1) | (r == p).all(axis=1)
    single = single[~flat]
    record = [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]
    records = np.zeros(len(single), dtype=record)
    records["corners"] = single
    p, q, r = (corners[~flat, k] for k in range(3))
    out = np.cross(q - p, r - p)
    length = np.sqrt((out * out).sum(axis=1, keepdims=True))
    records["normal"] = out / np.where(length > 0.0, length, 1.0)  # none without an area
    return records
