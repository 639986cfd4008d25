"""Motion of wheel, crank, rollers and links over a whole turn, and the forces of the rollers."""

import cmath
import math
from collections.abc import Callable, Iterator
from functools import partial
from itertools import pairwise, product
from typing import Any

import numpy as np
from numpy.polynomial.chebyshev import Chebyshev, chebtrim

from geneva_cli.loads.contact import contact
from geneva_cli.loads.cycle import Cycle
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import AxisPlace, turned_points
from geneva_cli.numerics.angles import distinct
from geneva_cli.numerics.arrays import Array, within_half_turn
from geneva_cli.output.scene import Place, Push, Track
from geneva_cli.parts.assembly import assembly, links_at

STILL = Track((0.0, 360.0), ((0.0,),))  # of what stands at the angle 0
ANGLE_ERROR = 1e-7  # rad, of wheel and crank: a tenth of the page's own error


class MachineTurn:
    """A machine's whole turn: input angles from the first entry on."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.assembly = assembly(mechanism, flat=False, by_input=True)
        self.L, self.turn_deg = self.assembly.L, self.assembly.turn_deg
        self.passages = self.assembly.motions
        self.start = self.passages[0].entry
        self.end = self.start + self.turn_deg
        self.ahead = math.pi if mechanism.spec.wheel.SIGN > 0.0 else 0.0  # of the crank, mid-motion
        # where the derivatives of angles and places jump, but for those of a drive
        self.knots = sorted(
            self.start + (x + place.behind_deg - self.start) % self.turn_deg
            for one, place in product(self.passages, mechanism.wheel_places)
            for x in (one.entry, one.mid, one.exit)
        )

    def wheel(self, place: AxisPlace, scale: float = 1.0) -> Track:
        """A wheel's angle, with a slot ahead of the crank's axis half-way through its first step.

        A wheel behind the first one rests before. A rack's travel is the angle times a ``scale``.
        """
        gain = math.fsum(2.0 * one.engagement.half_step for one in self.passages)

        def angle(x: Array) -> Array:
            return scale * (place.turn + self.assembly.wheel(x - place.behind_deg))

        return self.track(angle, scale * ANGLE_ERROR, scale * gain)

    def on_crank(self, number: int) -> AxisPlace:
        """The place of the crank that carries a roller."""
        places = self.mechanism.crank_places
        return places[number % len(places)]

    def steady(self, speed: float, zero_deg: float) -> Track:
        """The angle, radians, of what turns at a speed over the input's, from 0 at an angle."""
        gain = speed * math.radians(self.turn_deg)
        return self.track(lambda x: speed * np.radians(x - zero_deg), ANGLE_ERROR, gain)

    def own_shaft(self, sense: float) -> Track:
        """The angle of the drive's own input shaft, radians, for a sense of rotation."""
        one, turns = self.passages[0], self.mechanism.spec.drive.turns

        def angle(x: Array) -> Array:
            at = (x - one.mid + 180.0) % 360.0 - 180.0
            ahead = within_half_turn(np.radians(one.engagement.own_deg(at) - at))
            return sense * (np.radians(x - one.mid) + ahead)

        return self.track(angle, ANGLE_ERROR, sense * math.tau * turns)

    def crank(self, place: AxisPlace, zero: float = 0.0) -> Track:
        """The direction of a crank's first roller about the crank's axis from ``zero``, radians."""
        one, sign = self.passages[0], self.mechanism.spec.wheel.SIGN
        sense = one.engagement.crank_sense
        gain = -sign * (sense or 1.0) * math.tau
        rate = gain / self.turn_deg
        # cranks turn at one rate, if that varies too
        turned = place.turn - zero - rate * place.behind_deg

        def angle(x: Array) -> Array:
            even = self.ahead + rate * (x - one.mid)
            if sense:
                at = self.assembly.from_mid(x, one.mid)
                return turned + even + rate * (one.engagement.own_deg(at) - at)
            u, v = (self.centre(0, x) - (self.L, 0.0)).T
            return turned + even + within_half_turn(np.arctan2(v, u) - even)

        return self.track(angle, ANGLE_ERROR, gain)

    def centre(self, number: int, input_deg: Array) -> Array:
        """The centre of a roller by its number, mm, (n, 2)."""
        about_first, place = self.assembly.pin(number, input_deg), self.on_crank(number)
        return turned_points(about_first, np.full(len(input_deg), place.turn))

    def rollers(self) -> tuple[Place, ...]:
        """The centres of all rollers over the turn."""
        numbers = range(len(self.assembly.rollers))
        return tuple(self._place(partial(self.centre, number)) for number in numbers)

    def joint(self, link: int, number: int) -> Place:
        """The place of a joint of a link, both by their numbers."""

        def place(x: Array) -> Array:
            own = links_at(self.mechanism, self.assembly.from_mid(x, 0.0))[link]
            return np.column_stack([c + 0.0 * x for c in own.joints[number]])

        return self._place(place)

    def _place(self, place: Callable[[Array], Array]) -> Place:
        error = 2e-6 * self.L  # of joints and rollers: less than a screen shows
        x = self.track(lambda at: place(at)[:, 0], error)
        return x, self.track(lambda at: place(at)[:, 1], error)

    def track(self, f: Callable[[Array], Array], error: float, gain: float = 0.0) -> Track:
        """The track of a function over the whole turn, within ``error``."""
        ends, series = [self.start], list[tuple[float, ...]]()
        for a, b in pairwise(distinct([self.start, *self.knots, self.end], 1e-9)):
            for end, terms in _series(a, b, f, error):
                ends.append(end)
                series.append(terms)
        return Track(tuple(x - self.start for x in ends), tuple(series), gain)


def pushes(cycle: Cycle, turn: MachineTurn) -> Iterator[Push]:
    """The force of each passage over a turn; none without a load."""
    if not cycle.is_loaded:
        return
    each = len(cycle.mechanism.engagements)
    for i, one in enumerate(turn.passages):
        local = np.linspace(one.engagement.entry_deg, one.engagement.exit_deg, 73)
        local *= 1.0 - 1e-6  # forces may be undefined at the ends of a motion
        turns = "wheel_torque_Nm" in cycle.sources
        names = ["pin_force_N", "wheel_torque_Nm" if turns else "rack_force_N"]
        force, torque = cycle.states(local + turn.passages[i % each].mid, names)
        force = np.abs(force)
        sound = np.isfinite(force)
        if not sound.any():
            continue
        pin = turn.assembly.pin(i, one.mid + local, drives=True) @ (1.0, 1j)
        wall = contact(one.engagement, local, reactions=False)
        lever, normal = wall.lever.c[0], 1j * pin * (wall.lever.c[0] + 1j * wall.offset.c[0])
        if not turns:  # a rack is pushed along y
            lever, normal = 1.0, 1j + 0.0 * pin
        normal *= np.where(lever * torque < 0.0, -1.0, 1.0) / np.abs(normal)
        places = (pin + turn.mechanism.roller_radius_mm * normal)[sound]
        arrow = (force * normal)[sound]
        at = (one.mid + local - turn.start)[sound]
        # the first crank's forces as those at its own crank, and those at the other wheels
        own = turn.on_crank(i)._replace(behind_deg=0.0)
        for place, axis in ((own, 0.0), *((x, turn.L) for x in turn.mechanism.wheel_places[1:])):
            turned = cmath.rect(1.0, place.turn)
            there, pushed = (places - axis) * turned + axis, arrow * turned
            columns = (at + place.behind_deg, there.real, there.imag, pushed.real, pushed.imag)
            yield Push(*(tuple(column.tolist()) for column in columns))


def _series(
    a: float, b: float, f: Callable[[Array], Array], error: float
) -> Iterator[tuple[float, tuple[float, ...]]]:
    """Ends and terms of series from a to b, degrees: one, or those of both halves."""
    terms: Any = Chebyshev.interpolate(f, 32, (a, b)).coef
    if b - a > 1e-3 and (abs(terms[-3:]) > error).any():
        middle = 0.5 * (a + b)
        yield from _series(a, middle, f, error)
        yield from _series(middle, b, f, error)
        return
    terms[abs(terms) < 1e-3 * error] = 0.0
    yield b, tuple(chebtrim(terms).tolist())
