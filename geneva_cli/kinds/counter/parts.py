"""All parts of a counter at their positions, when all its number wheels go to 0 at once.

The pinions' axis is the origin, and that of driver and number wheels is on the x axis. Each part is
built once, on first use. Drawing, solid, list of parts and sheet are projections of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.geometry.gear_teeth import Writer
from geneva_cli.geometry.hole_walls import require_faces
from geneva_cli.geometry.plates import Group, Member, Plate, plates
from geneva_cli.geometry.shapes import Contour, Point, Shape
from geneva_cli.kept import cached_property
from geneva_cli.kinds.counter.frame import Heights, bore, heights, shafts_and_frame
from geneva_cli.kinds.counter.outlines import (
    CounterSizes,
    counter_mesh,
    counter_sizes,
    driver_rim,
    driver_teeth,
    number_teeth,
    pinion_teeth,
)
from geneva_cli.parts.edged_parts import EdgedParts, FrameAndShafts
from geneva_cli.parts.gears.gear_mesh import GearMesh
from geneva_cli.parts.missing import NamedParts
from geneva_cli.parts.shafts.bores import Bore


class CounterParts(EdgedParts):
    """The parts of a counter.

    Parts that the sizes leave no place for raise GenevaError, naming the key.
    """

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
    def _driver_bore(self) -> Bore:
        return bore(self.mechanism, self.sizes, "crank")

    @cached_property
    def pinions(self) -> tuple[Member, ...]:
        """The pinions, from the lowest up; each has a wide tooth between the driver's two."""
        tall = self.heights
        # the bore's shape is below a tooth, where the wall is thickest
        hole = (bore(self.mechanism, self.sizes, "wheel").shape("BORE", math.pi),)
        all_teeth, wide_teeth = pinion_teeth(self.sizes, self._write)
        members = []
        for k in range(tall.pinions):
            low = k * tall.pitch
            middle, high = low + tall.narrow, low + tall.pinion
            teeth = Plate("pinion's teeth", "WHEEL", all_teeth, hole, low, middle)
            above = Plate("pinion's wide teeth", "WHEEL", wide_teeth, hole, middle, high)
            members.append(Member(Group("pinion", (Member(teeth), Member(above)))))
        return tuple(members)

    @cached_property
    def number_wheels(self) -> tuple[Member, ...]:
        """The number wheels but the driver, from the lowest up."""
        tall, turned = self.heights, self.mechanism.spec.size.shafts == "turned"
        hole = self._driver_bore.running(turned).shape("BORE", 0.0)
        gear, members = number_teeth(self.sizes, self._write), []
        for k in range(tall.pinions):
            high = k * tall.pitch + tall.tooth
            below: tuple[Member, ...] = ()  # the lowest turns no pinion
            low = high - tall.tooth
            if k:
                low -= tall.gap
                below = self._teeth_and_rim("number wheel", k - 1, low, hole)
            plate = Plate("number wheel", "CRANK", gear, (hole,), low, high)
            group = Group("number wheel", (Member(plate), *below))
            members.append(Member(group, self.axis, math.pi))
        return tuple(members)

    @cached_property
    def driver(self) -> Member:
        """The driver: its two teeth, and the locking rim on them."""
        last = self.heights.pinions - 1
        hole = self._driver_bore.shape("BORE", math.pi)  # with its shape opposite the teeth
        members = self._teeth_and_rim("driver", last, self.heights.top, hole)
        return Member(Group("driver", members), self.axis, math.pi)

    def _teeth_and_rim(self, name: str, k: int, high: float, hole: Shape) -> tuple[Member, ...]:
        """Return the two teeth and the rim, up to a height, that turn and lock the k-th pinion."""
        two, rim = self._teeth_and_rim_outlines
        tall = self.heights
        low = k * tall.pitch + tall.tooth + tall.gap
        middle = k * tall.pitch + tall.narrow + tall.gap
        return (
            Member(Plate(f"{name}'s two teeth", "CRANK", two, (hole,), low, middle)),
            Member(Plate(f"{name}'s rim", "CRANK", rim, (hole,), middle, high)),
        )

    @cached_property
    def _teeth_and_rim_outlines(self) -> tuple[Contour, Contour]:
        write = self._write
        return driver_teeth(self.sizes, write), driver_rim(self.sizes, write)

    @cached_property
    def _framed(self) -> FrameAndShafts:
        return shafts_and_frame(self.mechanism, self.sizes)

    @property
    def to_fix(self) -> tuple[str, ...]:
        """Names of the plates that turn with a shaft in a round bore, which holds nothing."""
        named = {"pinion": "pinion's teeth", "driver": "driver's rim"}
        return tuple(named[name] for name in self._framed.to_fix)

    @property
    def moving(self) -> tuple[Member, ...]:
        """The parts on the shafts."""
        return (*self.pinions, *self.number_wheels, self.driver)

    @property
    def members(self) -> tuple[Member, ...]:
        """All parts."""
        return (*self.moving, *self.shafts, self.frame)

    @cached_property
    def coarse(self) -> CounterParts:
        """These parts with teeth to 1e-5 L, for checks that do not measure teeth."""
        return self.within(1e-5 * self.sizes.distance, "arcs")

    def require(self) -> None:
        """Raise GenevaError for a part that cannot be built, with its teeth to 1e-5 L."""
        for member in self.coarse.members:
            for plate in plates(member.part):
                require_faces(plate)

    def by_name(self) -> Iterator[NamedParts]:
        """Yield all parts in the order of a list, as names and functions that build them."""
        yield "pinions", lambda: [one.part for one in self.pinions]
        yield "number wheels", lambda: [one.part for one in self.number_wheels]
        yield "driver", lambda: [self.driver.part]
        yield "shafts", lambda: [one.part for one in self.shafts]
        yield "frame", lambda: [self.frame.part]
