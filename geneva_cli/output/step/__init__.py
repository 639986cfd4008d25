"""STEP AP214 (ISO 10303-214): the parts of a drawing as closed solids, with names and colours.

The output is equal on every run: its time stamp is empty, for a design has no date.
"""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.errors import clean
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.output.solid_part import solid_part
from geneva_cli.output.step.entities import Entities, words
from geneva_cli.output.step.step_product import Products


def chunks(drawing: Drawing, units: str) -> Iterator[str]:
    """The file's text.

    Raises GenevaError for a drawing without solids, for a unit other than mm, and for a coordinate
    that is not finite.
    """
    file = Entities()
    Products(file, solid_part(drawing, units, "STEP"))
    yield (
        "ISO-10303-21;\nHEADER;\n"
        f"FILE_DESCRIPTION(({words(clean(drawing.title))}),'2;1');\n"
        f"FILE_NAME('','',(''),(''),'','geneva','');\n"
        "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 3 1 1 }'));\nENDSEC;\nDATA;\n"
    )
    block = 1024  # lines at a time
    for start in range(0, len(file.lines), block):
        yield "".join(file.lines[start : start + block])
    yield "ENDSEC;\nEND-ISO-10303-21;\n"
