"""Pictures of a document: the machine as drawn, and its curves."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.output.document.blocks import Block, Curves, Heading, Picture, Prose


def drawn(design: Design) -> Iterator[Block]:
    """The assembled machine at mid-motion, or a sphere's parts; or the reason for no drawing."""
    yield Heading("The machine")
    try:
        drawing = design.drawing("assembly", tolerance_mm=0.01)  # it is only viewed
        flat = design.spec.wheel.FLAT
        title = "Put together, at mid-motion" if flat else "Wheel and crank, laid flat"
        yield Picture(drawing._replace(title=title))
    except GenevaError as error:
        yield Prose(f"Not drawn: {_without_path(design, str(error))}")


def curves(design: Design) -> Iterator[Block]:
    """Curves of the motion over a cycle, and of its loads."""
    yield Heading("Curves over a cycle")
    loads = ("pin_force_N", "input_torque_Nm") if design.cycle.is_loaded else ()
    figure = design.figure(("velocity", "acceleration", "jerk", *loads))
    yield Curves(figure._replace(title="By the input's angle, from the first entry"))


def _without_path(design: Design, message: str) -> str:
    """An error message without its file and line."""
    path = design.spec.path
    if path and message.startswith(path):
        return message.removeprefix(path).lstrip(":0123456789").lstrip()
    return message
