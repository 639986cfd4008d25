"""All parts of a counter at their positions, when all its number wheels go to 0 at once.

The pinions' axis is the origin, and that of driver and number wheels is on the x axis. Each part is
built once, on first use. Drawing, solid, list of parts and sheet are projections of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from geneva_cli.curves.hole_walls import require_faces
from geneva_cli.curves.plates import Group, Member, Plate, plates
from geneva_cli.curves.shapes import Contour, Point, Shape
from geneva_cli.layout.bores import Bore
from geneva_cli.layout.gear_mesh import GearMesh
from geneva_cli.layout.missing import NamedParts
from geneva_cli.outlines.counter import (
    CounterSizes,
    counter_sizes,
    driver_rim,
    driver_teeth,
    number_teeth,
    pinion_teeth,
)
from geneva_cli.outlines.counter_mesh import counter_mesh
from geneva_cli.parts.counter_frame import Heights, bore, heights, shafts_and_frame
from geneva_cli.parts.edged_parts import EdgedParts

if TYPE_CHECKING:
    from geneva_cli.curves.gear_teeth import Writer
    from geneva_cli.machine.mechanism import Mechanism


class CounterParts(EdgedParts):
    """The parts of a counter.

    Parts that the sizes leave no place for raise GenevaError, naming the key. Teeth are ``curves``,
    "arcs" or "cubics", within ``tolerance`` mm; without one as accurate as the checks need them.
    """

    def __init__(
        self, mechanism: Mechanism, tolerance: float | None = None, curves: str = "arcs"
    ) -> None:
        super().__init__(mechanism, tolerance, curves)

    def within(self, tolerance: float, curves: str) -> CounterParts:
        """Return these parts with curves of a kind within a tolerance, mm."""
        return CounterParts(self.mechanism, tolerance, curves)

    @cached_property
    def sizes(self) -> CounterSizes:
        """The sizes of teeth and rim."""
        return counter_sizes(self.mechanism)

    @property
    def axis(self) -> Point:
        """The axis of driver and number wheels."""
        return self.sizes.distance, 0.0

    @cached_property
    def mesh(self) -> GearMesh:
        """The teeth of all gears."""
        return counter_mesh(self.sizes)

    @cached_property
    def heights(self) -> Heights:
        """The heights of the parts."""
        return heights(self.mechanism)

    @property
    def _write(self) -> Writer:
        return self.writer(1e-9 * self.sizes.distance)

    @cached_property
    def _bores(self) -> tuple[Bore, Bore]:
        """The bores of the pinions, and of the driver."""
        both = (bore(self.mechanism, self.sizes, part) for part in ("wheel", "crank"))
        pinion, driver = both
        return pinion, driver

    @cached_property
    def _pinion_hole(self) -> Shape:
        # below a tooth, where the wall is thickest
        return self._bores[0].shape("BORE", math.pi)

    @cached_property
    def _driver_hole(self) -> Shape:
        # opposite the driver's teeth
        return self._bores[1].shape("BORE", math.pi)

    @cached_property
    def _number_hole(self) -> Shape:
        turned = self.mechanism.spec.size.shafts == "turned"
        return self._bores[1].running(turned).shape("BORE", 0.0)

    @cached_property
    def pinions(self) -> tuple[Member, ...]:
        """The pinions, from the lowest up; each has a wide tooth between the driver's two."""
        tall, write = self.heights, self._write
        all_, wide = (pinion_teeth(self.sizes, only, write) for only in (False, True))
        hole, out = (self._pinion_hole,), []
        for k in range(tall.pinions):
            low = k * tall.pitch
            middle, high = low + tall.narrow, low + tall.pinion
            teeth = Plate("pinion's teeth", "WHEEL", all_, hole, low, middle)
            above = Plate("pinion's wide teeth", "WHEEL", wide, hole, middle, high)
            out.append(Member(Group("pinion", (Member(teeth), Member(above)))))
        return tuple(out)

    @cached_property
    def number_wheels(self) -> tuple[Member, ...]:
        """The number wheels but the driver, from the lowest up."""
        tall, write, hole = self.heights, self._write, self._number_hole
        gear, out = number_teeth(self.sizes, write), []
        for k in range(tall.pinions):
            high = k * tall.pitch + tall.tooth
            carry: tuple[Member, ...] = ()
            low = high - tall.tooth
            if k:
                low -= tall.gap
                carry = self._carrying("number wheel", k - 1, low, hole)
            plate = Plate("number wheel", "CRANK", gear, (hole,), low, high)
            group = Group("number wheel", (Member(plate), *carry))
            out.append(Member(group, self.axis, math.pi))
        return tuple(out)

    @cached_property
    def driver(self) -> Member:
        """The driver: its two teeth, and the locking rim on them."""
        last = self.heights.pinions - 1
        carry = self._carrying("driver", last, self.heights.top, self._driver_hole)
        return Member(Group("driver", carry), self.axis, math.pi)

    def _carrying(self, name: str, k: int, high: float, hole: Shape) -> tuple[Member, ...]:
        """Return the two teeth and the rim, up to a height, that turn and lock the k-th pinion."""
        two, rim = self._carry
        tall = self.heights
        low = k * tall.pitch + tall.tooth + tall.gap
        middle = k * tall.pitch + tall.narrow + tall.gap
        return (
            Member(Plate(f"{name}'s two teeth", "CRANK", two, (hole,), low, middle)),
            Member(Plate(f"{name}'s rim", "CRANK", rim, (hole,), middle, high)),
        )

    @cached_property
    def _carry(self) -> tuple[Contour, Contour]:
        """The outlines of two teeth and of the rim."""
        write = self._write
        return driver_teeth(self.sizes, write), driver_rim(self.sizes, write)

    @cached_property
    def _framed(self) -> tuple[tuple[Member, ...], Plate]:
        return shafts_and_frame(self.mechanism, self.sizes)

    @cached_property
    def shafts(self) -> tuple[Member, ...]:
        """The shafts of pinions and of number wheels."""
        return self._edged(self._framed[0])

    @cached_property
    def frame(self) -> Member:
        """The frame, which holds both shafts."""
        return self._edged([Member(self._framed[1])])[0]

    @property
    def moving(self) -> tuple[Member, ...]:
        """The parts on the shafts."""
        return (*self.pinions, *self.number_wheels, self.driver)

    @property
    def members(self) -> tuple[Member, ...]:
        """All parts."""
        return (*self.moving, *self.shafts, self.frame)

    def require(self) -> None:
        """Raise GenevaError for a part that cannot be built, with its teeth to 1e-5 L."""
        for member in self.within(1e-5 * self.sizes.distance, "arcs").members:
            for plate in plates(member.part):
                require_faces(plate)

    def by_name(self) -> Iterator[NamedParts]:
        """Yield all parts in the order of a list, as names and functions that build them."""
        yield "pinions", lambda: [one.part for one in self.pinions]
        yield "number wheels", lambda: [one.part for one in self.number_wheels]
        yield "driver", lambda: [self.driver.part]
        yield "shafts", lambda: [one.part for one in self.shafts]
        yield "frame", lambda: [self.frame.part]
