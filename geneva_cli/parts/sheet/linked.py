"""The views that do not need the wheel's outline: links, gears, rollers, shafts."""

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
    """Return a function that begins a view, titled with its parts' numbers and thicknesses."""

    def begin(*names: str, thick: bool = True) -> View:
        titles = []
        for i, row in enumerate(rows, 1):
            if row["name"] in names:
                long = row["thickness_mm"]
                assert isinstance(long, float)
                titles.append(f"{i} {row['name']}" + f", t = {number(long)}" * thick)
        return View("; ".join(titles) or names[0], scale)

    return begin


def linked(begin: Begin, bars: Links, mechanism: Mechanism, series: bool = False) -> Iterator[View]:
    """Yield views of links and gears, each once; two wheels in series have no gears."""
    for one in {member.part: member for member in bars.cut}.values():
        view = begin(one.part.name)
        draw_link(view, one, bars, mechanism)
        yield view
    for gear in () if series else bars.gears:
        view = begin(gear.name)
        draw_gear(view, gear)
        yield view


def geared(begin: Begin, shapes: Sequence[Shape], mechanism: Mechanism) -> Iterator[View]:
    """Yield the view of noncircular gears in mesh, if there are any."""
    if shapes:
        L, C = mechanism.center_distance_mm, required_gears(mechanism).distance_mm
        view = begin("driven gear", "driver gear")
        draw_gears(view, shapes, ((L, 0.0), (L + C, 0.0)))
        yield view


def rolling(begin: Begin, mechanism: Mechanism) -> Iterator[View]:
    """Yield the view of the roller with its pin."""
    view = begin("roller", "pin")
    draw_roller(view, mechanism)
    yield view


def shafted(begin: Begin, shafts: Iterable[Member]) -> Iterator[View]:
    """Yield a view of each shaft."""
    for plate in flat_plates(shafts):
        view = begin(plate.name, thick=False)
        draw_shaft(view, plate)
        yield view


def flat_plates(members: Iterable[Member]) -> list[Plate]:
    """Return the plates among some parts."""
    return [one.part for one in members if isinstance(one.part, Plate)]
