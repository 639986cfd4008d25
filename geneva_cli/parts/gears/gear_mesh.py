"""Numbers of teeth and profile shifts of two round gears, for the distance a of their axes.

Whole gears get the numbers of teeth whose distance without shift comes nearest to a. The sum of the
shifts x makes up the rest:

    inv w = inv 20° + 2 (x1 + x2) tan 20°/(z1 + z2),    cos w = cos 20° (z1 + z2) m/(2 a)

With a ring it holds for differences, gear 2 being the ring. A sector is part of a gear whose number
of teeth need not be whole. Tips end a quarter of a module from the other gear's root, and where the
other gear's flank ends.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.gear_teeth import Rack, RoundTeeth, involute
from geneva_cli.geometry.shapes import Point
from geneva_cli.motion.pivots import Dimension, Link
from geneva_cli.numerics.preferred import gear_modules
from geneva_cli.spec.tables import Size

# directions of the middles of a gear's teeth, of each sector, radians; of a ring, of its spaces
Middles: TypeAlias = tuple[tuple[float, ...], ...]


class ToothedGear(NamedTuple):
    """One of two gears in mesh: its teeth about its axis, and the directions of their middles."""

    teeth: RoundTeeth
    z: float  # teeth of the whole circle; of a sector not a whole number
    shift: float  # profile shift in modules, before the backlash is taken off
    middles: Middles
    last_tip: float = 0.0  # of a driving sector: the radius at which its last tooth ends, mm

    @property
    def span(self) -> tuple[int, float]:
        """A number of teeth, and the distance over them between parallel jaws, mm.

        The jaws touch the flanks near their middle. The number is 0 for a ring, and for a sector
        with fewer teeth.
        """
        teeth, rack = self.teeth, self.teeth.rack
        base_pitch = rack.pitch * math.cos(rack.angle)
        # a tooth on the base circle, as long as its arc
        thick = teeth.thickness(teeth.base)
        middle = teeth.radius + self.shift * rack.module
        count = 1 + max(1, round((2.0 * teeth.tangent(middle) - thick) / base_pitch))
        if teeth.opening or count > len(self.middles[0]):
            return 0, 0.0
        return count, (count - 1) * base_pitch + thick


class GearMesh(NamedTuple):
    """Two gears in mesh, by their names, and the mean number of their teeth in contact."""

    gears: dict[str, ToothedGear]
    pressure_angle: float  # at work, radians
    contact_ratio: float

    @property
    def layout(self) -> tuple[Dimension, ...]:
        """Dimensions of both gears and of their mesh."""
        rack = next(iter(self.gears.values())).teeth.rack
        return (
            *self._of_gears(),
            Dimension("gears' module", rack.module, "mm"),
            Dimension("gears' pressure angle", math.degrees(rack.angle), "deg"),
            Dimension("gears' pressure angle at work", math.degrees(self.pressure_angle), "deg"),
            Dimension("gears' contact ratio", self.contact_ratio),
        )

    def _of_gears(self) -> Iterator[Dimension]:
        for name, gear in self.gears.items():
            teeth, (over, span), each = gear.teeth, gear.span, len(gear.middles[0])
            yield Dimension(f"{name}: teeth{' of a sector' * (gear.z != each)}", each)
            yield Dimension(f"{name}: profile shift x", gear.shift)
            root = teeth.tip if teeth.opening else teeth.root
            for what, radius in (
                ("reference", teeth.radius),
                ("base", teeth.base),
                ("tip", teeth.opening or teeth.tip),
                ("last tooth's tip", gear.last_tip),
                ("root", root),
            ):
                if radius:
                    yield Dimension(f"{name}: {what} diameter", 2.0 * radius, "mm")
            if over:
                yield Dimension(f"{name}: span over {over} teeth", span, "mm")


def with_tips(
    one: RoundTeeth, other: RoundTeeth, shifts: tuple[float, float], distance: float, angle: float
) -> tuple[RoundTeeth, RoundTeeth]:
    """Return two outer gears at a distance of their axes, mm, with tips."""
    far, module = distance * math.sin(angle), one.rack.module
    tips = [
        min(
            distance - against.radius + module * (1.0 - shift),
            math.hypot(own.base, far - against.flank_end),
        )
        for own, against, shift in ((one, other, shifts[1]), (other, one, shifts[0]))
    ]
    return one._replace(tip=tips[0]), other._replace(tip=tips[1])


def contact_ratio(small: RoundTeeth, large: RoundTeeth, distance: float, angle: float) -> float:
    """Return the mean number of teeth in contact of two gears, or of a gear in a ring."""
    sign, rack = -1.0 if large.opening else 1.0, small.rack
    path = small.tangent(small.tip) - sign * distance * math.sin(angle)
    path += sign * large.tangent(large.opening or large.tip)
    return path / (rack.pitch * math.cos(rack.angle))


def gear_mesh(driver: Link, driven: Link, at: tuple[Point, Point], size: Size) -> GearMesh:
    """Return the teeth of two links that are gears in mesh, about axes at two points.

    Raises GenevaError, naming the key, for teeth that would be undercut, pointed or out of contact.
    """
    pair = _Pair(driver, driven, at, size)
    try:
        return pair.mesh()
    except GenevaError as error:
        for remedy, other in _remedies(size):
            try:
                _Pair(driver, driven, at, other).mesh()
            except GenevaError:
                continue
            raise GenevaError(f"{error}; {remedy}", error.key) from None
        raise


def _remedies(size: Size) -> Iterator[tuple[str, Size]]:
    """Yield sizes that may let gears mesh, each with its words: one key differs."""
    now, modules = size.gear_module_mm or 0.0, gear_modules()
    for module in (m for m in modules if m < now):
        yield f"gear_module_mm = {module:g} is small enough", size.replace(gear_module_mm=module)
    for key in ("gear_shift", "gear_teeth"):
        if vars(size)[key] is not None:
            yield f"remove {key}", size.replace(**{key: None})
    yield "reduce gear_backlash_mm", size.replace(gear_backlash_mm=0.0)
    for module in (m for m in reversed(modules) if m > now):
        yield f"gear_module_mm = {module:g} is large enough", size.replace(gear_module_mm=module)


class _Pair:
    """A smaller and a larger gear, or a ring, with pitch circles that roll on each other."""

    def __init__(self, driver: Link, driven: Link, at: tuple[Point, Point], size: Size) -> None:
        assert size.gear_module_mm is not None
        self.driver, self.driven, self.size = driver, driven, size
        pairs = sorted(zip((driver, driven), at, strict=True), key=lambda one: one[0].radius_mm)
        (self.small, near), (self.large, far) = pairs
        self.links = self.small, self.large
        self.module = size.gear_module_mm
        self.rack = Rack(self.module)
        self.ring = self.large.teeth.inside
        self.sign = -1.0 if self.ring else 1.0
        self.whole = all(link.teeth.all_round for link in self.links)
        self.distance = self.large.radius_mm + self.sign * self.small.radius_mm
        # a ring's teeth meet its gear on the far side of the gear's axis
        ahead = self.sign * (complex(*far) - complex(*near))
        self.towards = cmath.phase(ahead), cmath.phase(-self.sign * ahead)
        small, large = (2.0 * link.radius_mm / self.module for link in self.links)
        self.counts = small, large
        if self.whole:
            count = max(round(small), 1) if size.gear_teeth is None else size.gear_teeth
            self.counts = count, round(count * large / small)
        elif size.gear_teeth is not None:
            raise GenevaError(
                f"gear_teeth = {size.gear_teeth}: the module sets the number of teeth on sectors; "
                "remove gear_teeth",
                ("size", "gear_teeth"),
            )

    def mesh(self) -> GearMesh:
        """Return the teeth of both gears; raises GenevaError where they do not mesh."""
        if max(self.counts) > 1000.0:  # as many as gear_teeth allows
            raise self._error("teeth are more than the 1000 of a gear")
        apart = 0.5 * self.module * (self.counts[1] + self.sign * self.counts[0])
        cosine = math.cos(self.rack.angle) * apart / self.distance
        if cosine >= 1.0:
            raise self._error("teeth are too many for the distance of the axes")
        angle = math.acos(cosine)
        # the shift, in modules, that thins each tooth by half of the backlash; that is measured
        # along the pitch circles at work
        thinner = 0.5 * self.size.allowances.gear_backlash_mm * (apart / self.distance)
        off = 0.5 * thinner / (self.module * math.tan(self.rack.angle))
        shifts = self._shifts(angle, off)
        both = self._teeth(shifts, off, angle)
        for teeth, link in zip(both, self.links, strict=True):
            self._refuse(teeth, link)
        contact = contact_ratio(*both, self.distance, angle)
        if contact < 1.0:
            raise self._error(f"teeth lose contact: their contact ratio would be {contact:.3g}")
        middles, last_tip = self._all_round(*both) if self.whole else self._sectors(*both)
        gears = {}
        for link, teeth, z, x in zip(self.links, both, self.counts, shifts, strict=True):
            lower = last_tip if link is self.driver else 0.0
            gears[link.name] = ToothedGear(teeth, z, x, middles[link.name], lower)
        return GearMesh(gears, angle, contact)

    def _shifts(self, angle: float, off: float) -> tuple[float, float]:
        """Return the profile shifts of the smaller and the larger gear, in modules."""
        both = self.counts[1] + self.sign * self.counts[0]
        rolled = involute(angle) - involute(self.rack.angle)
        total = both * rolled / (2.0 * math.tan(self.rack.angle))
        small = self.size.gear_shift
        if small is None:
            straight, radius = self.rack.straight, 0.5 * self.module * self.counts[0]
            least = (straight - radius * math.sin(self.rack.angle) ** 2) / self.module + off
            small = max(0.0, least, 0.0 if self.ring else 0.5 * total)
        return small, total - self.sign * small

    def _teeth(
        self, shifts: tuple[float, float], off: float, angle: float
    ) -> tuple[RoundTeeth, RoundTeeth]:
        """Return the teeth of the smaller and the larger gear."""
        m, a = self.module, self.distance
        racks = Rack(m, shifts[0] - off), Rack(m, shifts[1] - self.sign * off)
        small, large = (
            RoundTeeth(rack, 0.5 * m * count, 0.0)
            for rack, count in zip(racks, self.counts, strict=True)
        )
        if not self.ring:
            return with_tips(small, large, shifts, a, angle)
        small = small._replace(tip=small.radius + m * (1.0 + shifts[0]))
        reached = math.hypot(large.base, a * math.sin(angle) + small.flank_end)
        opening = max(large.radius - m * (1.0 - shifts[1]), reached)
        root = large.radius + m * (self.rack.dedendum + large.rack.shift)
        return small, large._replace(tip=root, opening=opening)

    def _refuse(self, teeth: RoundTeeth, link: Link) -> None:
        """Raise GenevaError for teeth that are undercut, pointed or shifted too far."""
        if teeth.opening:
            pointed = teeth.space_corner is None
        else:
            # the rack's corners must pass below the pitch circle, a hundredth of a module or more
            if teeth.rack.corner[1] > -0.01 * self.module:
                raise self._error(
                    f"teeth of the {link.name} would be shifted by more than 0.86 modules"
                )
            if teeth.rack.least_radius > teeth.radius * (1.0 + 1e-9):
                raise self._error(f"teeth of the {link.name} would be undercut")
            least = teeth.rack.least_tip
            pointed = teeth.tip <= teeth.base or teeth.thickness(teeth.tip) < least
        if pointed:
            raise self._error(f"teeth of the {link.name} would be pointed")

    def _error(self, what: str) -> GenevaError:
        key, value = "gear_module_mm", self.module
        if self.size.gear_shift is not None:
            key, value = "gear_shift", self.size.gear_shift
        small, large = self.counts
        return GenevaError(
            f"{key} = {value:g}: of {small:.4g} and {large:.4g}, {what}", ("size", key)
        )

    def _all_round(self, *both: RoundTeeth) -> tuple[dict[str, Middles], float]:
        """Return the directions of all teeth: the smaller gear has one on the line of centres."""
        out: dict[str, Middles] = {}
        firsts = 0.0, 0.0 if self.ring else 0.5
        for link, teeth, towards, first in zip(self.links, both, self.towards, firsts, strict=True):
            count = round(math.tau / teeth.step)
            out[link.name] = (
                tuple(towards + math.tau * (k + first) / count for k in range(count)),
            )
        return out, 0.0

    def _sectors(self, *both: RoundTeeth) -> tuple[dict[str, Middles], float]:
        """Return the directions of the teeth on sectors, and the driver's last tip, mm.

        Before and after the driving arc the driven gear is slower than the teeth. So the first pair
        comes into contact where the arc starts. The driver's last tooth is lower, so that it leaves
        where the arc ends; else it would jam.
        """
        names = [link.name for link in self.links]
        teeth, towards = (
            dict(zip(names, both, strict=True)),
            dict(zip(names, self.towards, strict=True)),
        )
        one, two = teeth[self.driver.name], teeth[self.driven.name]
        arc = self.driver.radius_mm * math.radians(self.driver.teeth.each_deg)
        pitch = one.rack.pitch
        recess, approach = (-t.roll(t.tangent(t.tip)) + t.rack.half for t in (one, two))
        first = approach - 0.5 * arc
        # a billionth of a pitch is rounding, and is no reason for one more tooth
        count = 1 + max(0, math.ceil((arc - recess - approach) / pitch - 1e-9))
        # each tooth's flanks pass the line of centres at these lengths of the driving arc
        passes = [first + k * pitch for k in range(count)]
        after = min(0.5 * arc - passes[-1], recess)
        tangent = one.radius * math.sin(one.rack.angle) + after * math.cos(one.rack.angle)
        for link in (self.driver, self.driven):
            if count * pitch * link.teeth.sectors > math.tau * link.radius_mm:
                raise self._error(f"teeth of the {link.name} overlap: {count} are on each sector")
        start, sectors = towards[self.driven.name], self.driven.teeth.sectors
        middles: dict[str, Middles] = {
            self.driver.name: (
                tuple(towards[self.driver.name] + (s + one.rack.half) / one.radius for s in passes),
            ),
            self.driven.name: tuple(
                tuple(
                    start + math.tau * j / sectors + (two.rack.half - s) / two.radius
                    for s in reversed(passes)
                )
                for j in range(sectors)
            ),
        }
        return middles, math.hypot(one.base, tangent)
