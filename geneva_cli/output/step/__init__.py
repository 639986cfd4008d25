"""STEP AP214 (ISO 10303-214): the parts of a drawing as closed solids, with names and colours.

The output is equal on every run, as its time stamp is constant.
"""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.curves.drawing import Drawing
from geneva_cli.errors import GenevaError, clean
from geneva_cli.output.step.entities import Entities, words
from geneva_cli.output.step.product import Products


def chunks(drawing: Drawing, units: str) -> Iterator[str]:
    """The file's text.

    Raises GenevaError for a drawing without solids, for a unit other than mm, and for a coordinate
    that is not finite.
    """
    whole = drawing.shells or drawing.solid
    if whole is None:
        raise GenevaError(
            "no solid to write as STEP: solids are --part wheel, crank, arm and assembly. Write "
            "other drawings, and paths with --kerf, as .dxf or .svg"
        )
    if units != "mm":
        raise GenevaError("--units: a STEP file is always in mm; leave it out")
    file = Entities()
    Products(file, whole)
    yield (
        "ISO-10303-21;\nHEADER;\n"
        f"FILE_DESCRIPTION(({words(clean(drawing.title))}),'2;1');\n"
        f"FILE_NAME('','1970-01-01T00:00:00',(''),(''),'','geneva','');\n"
        "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 3 1 1 }'));\nENDSEC;\nDATA;\n"
    )
    block = 1024  # lines at a time
    for start in range(0, len(file.lines), block):
        yield "".join(file.lines[start : start + block])
    yield "ENDSEC;\nEND-ISO-10303-21;\n"
