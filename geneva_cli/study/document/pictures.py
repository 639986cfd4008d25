"""What is looked at: the machine as it is drawn, and its curves."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.design import Design
from geneva_cli.document import Block, Curves, Heading, Picture, Prose
from geneva_cli.errors import GenevaError

SHOWN = ("velocity", "acceleration", "jerk", "pin_force_N", "input_torque_Nm")
UNLOADED = SHOWN[:3]
TOLERANCE_MM = 0.01  # of a drawing that is looked at


def drawn(design: Design) -> Iterator[Block]:
    """The machine put together at mid-motion, or a sphere's parts; or why it is not drawn."""
    yield Heading("The machine")
    try:
        found = design.drawing("assembly", TOLERANCE_MM)
        flat = design.spec.wheel.FLAT
        title = "Put together, at mid-motion" if flat else "Wheel and crank, laid flat"
        yield Picture(found._replace(title=title))
    except GenevaError as error:
        yield Prose(f"Not drawn: {_bare(design, str(error))}")


def curves(design: Design) -> Iterator[Block]:
    """The motion over a cycle, and under a load what it costs."""
    yield Heading("Curves over a cycle")
    found = design.figure(SHOWN if design.cycle.is_loaded else UNLOADED)
    yield Curves(found._replace(title="By the input's angle, from the first entry"))


def _bare(design: Design, said: str) -> str:
    """What is wrong, without the file and line at which it is given."""
    path = design.spec.path
    if path and said.startswith(path):
        return said.removeprefix(path).lstrip(":0123456789").lstrip()
    return said
