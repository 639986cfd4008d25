"""Pictures of a document: the machine as drawn, and its curves."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.design import Design
from geneva_cli.document import Block, Curves, Heading, Picture, Prose
from geneva_cli.errors import GenevaError

SHOWN = ("velocity", "acceleration", "jerk", "pin_force_N", "input_torque_Nm")
UNLOADED = SHOWN[:3]
TOLERANCE_MM = 0.01  # of a drawing that is only viewed


def drawn(design: Design) -> Iterator[Block]:
    """The assembled machine at mid-motion, or a sphere's parts; or the reason for no drawing."""
    yield Heading("The machine")
    try:
        found = design.drawing("assembly", TOLERANCE_MM)
        flat = design.spec.wheel.FLAT
        title = "Put together, at mid-motion" if flat else "Wheel and crank, laid flat"
        yield Picture(found._replace(title=title))
    except GenevaError as error:
        yield Prose(f"Not drawn: {_bare(design, str(error))}")


def curves(design: Design) -> Iterator[Block]:
    """Curves of the motion over a cycle, and of its loads."""
    yield Heading("Curves over a cycle")
    found = design.figure(SHOWN if design.cycle.is_loaded else UNLOADED)
    yield Curves(found._replace(title="By the input's angle, from the first entry"))


def _bare(design: Design, said: str) -> str:
    """An error message without its file and line."""
    path = design.spec.path
    if path and said.startswith(path):
        return said.removeprefix(path).lstrip(":0123456789").lstrip()
    return said
