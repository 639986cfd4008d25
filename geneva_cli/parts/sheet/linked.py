"""The views of what the wheel's outline is not needed for: links, gears, rollers, shafts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

from geneva_cli.curves.plates import Member, Plate
from geneva_cli.curves.shapes import Shape
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.gear_curves import required_gears
from geneva_cli.parts.links import Links
from geneva_cli.parts.sheet.crank import draw_roller
from geneva_cli.parts.sheet.gears import draw_gear, draw_gears
from geneva_cli.parts.sheet.links import draw_link
from geneva_cli.parts.sheet.standing import draw_shaft
from geneva_cli.parts.sheet.view import View, number

Begin: TypeAlias = Callable[..., View]


def titled(rows: Sequence[Mapping[str, object]], scale: float) -> Begin:
    """What begins a view: some parts' names with their numbers in the list, and thicknesses."""

    def begin(*names: str, thick: bool = True) -> View:
        titles = []
        for i, row in enumerate(rows, 1):
            if row["name"] in names:
                long = row["thickness_mm"]
                assert isinstance(long, float)
                titles.append(f"{i} {row['name']}" + f", t = {number(long)}" * thick)
        return View("; ".join(titles) or names[0], scale)

    return begin


def linked(
    begin: Begin, bars: Links, mechanism: Mechanism, in_series: bool = False
) -> Iterator[View]:
    """Links and gears, each once; of two wheels in series the first is no gear."""
    for one in {member.part: member for member in bars.cut}.values():
        made = begin(one.part.name)
        draw_link(made, one, bars, mechanism)
        yield made
    for gear in () if in_series else bars.gears:
        made = begin(gear.name)
        draw_gear(made, gear)
        yield made


def geared(begin: Begin, shapes: Sequence[Shape], mechanism: Mechanism) -> Iterator[View]:
    """Noncircular gears as they mesh; none without them."""
    if shapes:
        L, C = mechanism.center_distance_mm, required_gears(mechanism).distance_mm
        made = begin("driven gear", "driver gear")
        draw_gears(made, shapes, ((L, 0.0), (L + C, 0.0)))
        yield made


def rolling(begin: Begin, mechanism: Mechanism) -> Iterator[View]:
    """The roller with its pin."""
    made = begin("roller", "pin")
    draw_roller(made, mechanism)
    yield made


def shafted(begin: Begin, shafts: Iterable[Member]) -> Iterator[View]:
    """Each shaft."""
    for plate in flat_plates(shafts):
        made = begin(plate.name, thick=False)
        draw_shaft(made, plate)
        yield made


def flat_plates(members: Iterable[Member]) -> list[Plate]:
    """The plates among some parts."""
    return [one.part for one in members if isinstance(one.part, Plate)]
