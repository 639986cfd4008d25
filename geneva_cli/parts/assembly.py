"""A machine in its own plane: where wheel, crank and rollers stand through a whole cycle.

What outlines and the full turn are made from. Lengths in millimetres, angles in radians, the
wheel's axis the origin and the crank's at (L, 0). A drive in front of the crank changes only when
the crank is where, so behind one the crank itself is turned.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.machine import kinds
from geneva_cli.machine.drives.cam import CamDriven
from geneva_cli.machine.engagement import Station
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.wheels.classic import SIGN
from geneva_cli.spec.tables import Drive, Spec

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


class Plane(NamedTuple):
    """The machine as its outlines see it.

    ``rollers`` has for each roller its station and the input angle, degrees, by which its
    mid-motion follows the first roller's; ``slots`` for each slot of the wheel, counterclockwise
    from the first, its station and direction; ``rests`` the directions of the crank's axis while
    the wheel rests, seen from the wheel, each half-way between two slots.
    """

    mechanism: Mechanism
    L: float
    sign: float  # +1 external, -1 internal
    turn_deg: float  # input angle in a whole turn of the crank
    rollers: tuple[tuple[Station, float], ...]
    slots: tuple[tuple[Station, float], ...]
    rests: tuple[float, ...]
    given: Mechanism  # as it was, with what drives its crank
    to_input: Callable[[float], float]  # input angle, degrees, of ``given`` for one of here

    def shown_deg(self, input_deg: float) -> float:
        """An input angle of here as every command shows it: that of the machine's own input."""
        return self.given.shown_deg(self.to_input(input_deg))

    def place_deg(self, shown_deg: float) -> float:
        """The input angle of here that is shown so, to a hundredth of a degree."""
        low, high = self.start_deg, self.start_deg + self.turn_deg
        whole = 360.0 * kinds.turns(self.given.spec)
        best = low
        for _ in range(3):
            grid = np.linspace(low, high, 361)
            off = [abs(math.remainder(self.to_input(x) - shown_deg, whole)) for x in grid]
            best = float(grid[int(np.argmin(off))])
            step = (high - low) / 180.0
            low, high = best - step, best + step
        return best

    def pin(self, number: int, input_deg: Array) -> Array:
        """A roller's centre at input angles, (n, 2)."""
        station, behind = self.rollers[number]
        at = (input_deg - behind + 0.5 * self.turn_deg) % self.turn_deg - 0.5 * self.turn_deg
        if isinstance(station, CamDriven):
            return self.L * _on_cam(station, at)
        x, y = station.pin(at, 0)
        return self.L * np.column_stack((x.c[0], y.c[0]))

    def crank(self, input_deg: Array) -> Array:
        """The direction of the crank in the fixed frame, that of its first roller at input 0."""
        station = self.rollers[0][0]
        if station.crank_sense:
            return self._ahead - self.sign * station.crank_sense * np.radians(input_deg)
        x, y = (self.pin(0, input_deg) - (self.L, 0.0)).T
        angle: Array = np.arctan2(y, x)
        return angle

    @property
    def _ahead(self) -> float:
        """Where the crank points at input 0: at the wheel's axis outside, away from it inside."""
        return math.pi if self.sign > 0.0 else 0.0

    def lock(self, input_deg: float) -> float:
        """Where on the crank the line of centres is: the direction that locks the wheel."""
        return self._ahead - float(self.crank(np.array([input_deg]))[0])

    def wheel(self, input_deg: Array) -> Array:
        """The wheel's angle at input angles of a whole turn from the first station's entry on."""
        out = np.empty(len(input_deg))
        turned = 0.0
        for i, (station, mid) in enumerate(self.rollers):
            begins = mid + station.entry_deg
            after = self.rollers[i + 1] if i + 1 < len(self.rollers) else None
            ends = after[1] + after[0].entry_deg if after else np.inf
            here = (input_deg >= begins) & (input_deg < ends)
            at = np.minimum(input_deg[here] - mid, station.exit_deg)
            out[here] = turned + station.motion(at, 0).c[0]
            turned += station.half_step + (after[0].half_step if after else 0.0)
        return out

    @property
    def kinds(self) -> tuple[Station, ...]:
        """The kinds of slots, each once: most wheels have one."""
        return tuple(dict.fromkeys(station for station, _ in self.slots))

    @property
    def start_deg(self) -> float:
        """Input angle of the first station's entry, from which a whole turn is counted."""
        return self.rollers[0][0].entry_deg


def plane(mechanism: Mechanism) -> Plane:
    """The plane of a mechanism.

    Raises GenevaError for a machine whose parts are not flat outlines.
    """
    spec = mechanism.spec
    if spec.wheel.gearing == "spherical":
        raise GenevaError(
            'gearing = "spherical": its parts are not flat; as tables (-o FILE.csv) `--part wheel` '
            "writes the slots on the sphere, and `--part slot` the flat development of one",
            ("wheel", "gearing"),
        )
    if spec.drive.kind == "gear-sector":
        raise GenevaError(
            'kind = "gear-sector": its toothed sectors are no outline to cut; `--part slot` writes '
            "its slots as a table (-o FILE.csv)",
            ("drive", "kind"),
        )
    if spec.wheel.z > kinds.Z_DRAWN:
        raise GenevaError(
            f"z = {spec.wheel.z}: parts are drawn for up to {kinds.Z_DRAWN} slots", ("wheel", "z")
        )
    given, to_input = mechanism, _same
    if mechanism.law is None and not kinds.own_path(spec.drive.kind):
        to_input = partial(_input_deg, spec)
        keep = spec.drive
        crank = Drive("crank", keep.n_rpm, keep.rollers, keep.roller_angles_deg)
        mechanism = build(spec._replace(drive=crank, kind=None))
    turn = 360.0 * kinds.turns(mechanism.spec)
    each = round(turn / mechanism.period_deg)
    rollers = tuple(
        (station, station.mid_deg + k * mechanism.period_deg)
        for k in range(each)
        for station in mechanism.stations
    )
    L = spec.size.center_distance_mm
    sign = SIGN[spec.wheel.gearing]
    return Plane(mechanism, L, sign, turn, rollers, *_around(mechanism), given, to_input)


def _same(input_deg: float) -> float:
    return input_deg


def _input_deg(spec: Spec, crank_deg: float) -> float:
    """The input angle at which a drive's crank has turned so far from mid-motion.

    The drive's law is known for one turn of the crank, or of a first wheel one step, about that.
    """
    module = kinds.module(spec.drive.kind)
    reach = module.reach_deg(spec.kind) if hasattr(module, "reach_deg") else 180.0
    turns = round(crank_deg / (2.0 * reach))
    front = module.front(spec)(crank_deg - 2.0 * reach * turns)
    return 360.0 * turns + float(front.input_deg)


def _around(mechanism: Mechanism) -> tuple[tuple[tuple[Station, float], ...], tuple[float, ...]]:
    """Slots and rests around the wheel, counterclockwise: those that come later lie behind."""
    stations, z = mechanism.stations, mechanism.spec.wheel.z
    steps = mechanism.spec.wheel.steps_deg
    kinds_ = [stations[k % len(stations)] if steps else stations[0] for k in range(z)]
    slots, rests, at = [], [], 0.0
    for k, station in enumerate(kinds_):
        slots.append((station, at % math.tau))
        rests.append((at - station.half_step) % math.tau)
        at -= station.half_step + kinds_[(k + 1) % z].half_step
    order = sorted(range(z), key=lambda k: slots[k][1])
    return tuple(slots[k] for k in order), tuple(sorted(rests))


def _on_cam(station: CamDriven, input_deg: Array) -> Array:
    """The roller of a cam-Geneva, in units of L: its groove closed on the way back."""
    from geneva_cli.parts.groove import distance

    R = distance(station, input_deg)
    angle = np.radians(input_deg)
    return np.column_stack((1.0 - station.sign * R * np.cos(angle), R * np.sin(angle)))
