"""The views that do not need the wheel's outline: links, gears, rollers, shafts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

from geneva_cli.drawings.sheet.crank_views import draw_roller
from geneva_cli.drawings.sheet.link_views import draw_link
from geneva_cli.drawings.sheet.standing import draw_shaft
from geneva_cli.drawings.sheet.view import View
from geneva_cli.geometry.plates import Group, Member, Plate, Shell
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.edged_parts import EdgedParts
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.shafts.fits import Fits
from geneva_cli.parts.shafts.shaft import FIX
from geneva_cli.spec.written import length

Begin: TypeAlias = Callable[..., View]


def titled(rows: Sequence[Mapping[str, object]], scale: float, parts: Parts) -> Begin:
    """Return a function that begins a view, titled with its parts' numbers and thicknesses.

    Its fits are those of the process, for the thickness of the first part.
    """
    process, to_fix = parts.mechanism.spec.size.process, parts.to_fix
    unborne = {one.name for one in parts.unborne}

    def begin(*names: str, thick: bool = True) -> View:
        titles: list[str] = []
        fits = Fits(process)
        for i, row in enumerate(rows, 1):
            if row["name"] in names:
                long = row["thickness_mm"]
                assert isinstance(long, float)
                fits = fits if titles else Fits(process, long)
                titles.append(f"{i} {row['name']}" + f", t = {length(long)}" * thick)
        view = View("; ".join(titles) or names[0], scale, fits)
        for name in names:
            view.to_fix(name, to_fix)
            if name in unborne:
                view.remark("no bearing: hold it from above")
        return view

    return begin


def linked(begin: Begin, parts: FlatParts) -> Iterator[View]:
    """Yield views of links and round gears, each once; two wheels in series have no gears."""
    bars = parts.links
    for one in {member.part: member for member in bars.cut}.values():
        view = begin(one.part.name)
        draw_link(view, one, bars, parts.mechanism)
        yield view
    for gear in parts.toothed:
        from geneva_cli.drawings.sheet.gears import draw_gear  # most machines have no gears

        view = begin(gear.name)
        draw_gear(view, gear, parts.mechanism.spec.size)
        yield view


def geared(begin: Begin, parts: EdgedParts) -> Iterator[View]:
    """Yield the view of noncircular gears in mesh, if there are any."""
    if parts.gear_pair:
        from geneva_cli.drawings.sheet.gears import draw_gears
        from geneva_cli.parts.gears.pair_teeth import pair_teeth

        names = [member.part.name for member in parts.gear_pair]
        view, to_fix = begin(*names), set(names).intersection(parts.to_fix)
        if len(to_fix) == 1:  # of the two gears in this view
            view.notes[view.notes.index(FIX)] = f"{to_fix.pop()}: {FIX}"
        size = parts.mechanism.spec.size
        draw_gears(view, parts.gear_pair, size, pair_teeth(parts.mechanism.spec.gears, size))
        yield view


def rolling(begin: Begin, mechanism: Mechanism) -> Iterator[View]:
    """Yield the view of the roller with its pin."""
    view = begin("roller", "pin")
    draw_roller(view, mechanism)
    yield view


def shafted(begin: Begin, shafts: Iterable[Member]) -> Iterator[View]:
    """Yield a view of each kind of shaft."""
    for part in dict.fromkeys(member.part for member in shafts):
        assert not isinstance(part, Group | Shell)
        view = begin(part.name, thick=False)
        draw_shaft(view, part)
        yield view


def flat_plates(members: Iterable[Member]) -> list[Plate]:
    """Return the plates among some parts."""
    return [one.part for one in members if isinstance(one.part, Plate)]
