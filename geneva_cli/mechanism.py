"""A design as a machine: its stations over a full cycle, built from a spec."""

from __future__ import annotations

import importlib
import math
from typing import NamedTuple

from geneva_cli import drives, gearing
from geneva_cli.classic import SIGN, gap, half_motion_deg, refuse_jam, rollers_max
from geneva_cli.errors import GenevaError
from geneva_cli.jet import Coefficient, Jet
from geneva_cli.keys import Spec
from geneva_cli.laws import Law, named
from geneva_cli.station import Anchor, LawDriven, SlotDriven, Station


class Mechanism(NamedTuple):
    """A Geneva mechanism.

    ``stations`` holds one station for each kind of motion in a period; rollers that all move
    alike share one, and the period is then one index.
    """

    spec: Spec
    stations: tuple[Station, ...]
    period_deg: float  # input angle after which the stations come round again
    ratio: float  # l = R/L
    rollers_max: int  # most evenly spaced rollers that do not jam
    law: Law | None = None

    @property
    def index_deg(self) -> float:
        """The wheel's step."""
        return 360.0 / self.spec.wheel.z

    def dwell_deg(self, i: int) -> float:
        """Input angle from station i's exit to the next entry."""
        here = self.stations[i]
        after = self.stations[(i + 1) % len(self.stations)]
        turns = self.period_deg if i + 1 == len(self.stations) else 0.0
        return turns + (after.mid_deg + after.entry_deg) - (here.mid_deg + here.exit_deg)


def build(spec: Spec) -> Mechanism:
    """The mechanism of a spec.

    Raises GenevaError, naming the key, where the values do not make a machine together.
    """
    wheel, drive = spec.wheel, spec.drive
    step = gearing.Step(1, wheel.z)
    natural = 2.0 * half_motion_deg(wheel.gearing, *step)
    front = _front(spec)
    alike = drive.kind == "crank"
    if spec.motion.law is None:
        _refuse_motion_keys(spec)
        refuse_jam(drive.rollers, natural, wheel.gearing)
        poses = gearing.radial(wheel.gearing, step)
        count = 1 if alike else drive.rollers
        l, rest = step.sin_cos[0], gap("external", *step)
        kernel = (SIGN[wheel.gearing], l, rest) if alike else None
        stations = tuple(
            _slot_driven(poses, front, step, 360.0 * j / drive.rollers, kernel)
            for j in range(count)
        )
        period = 360.0 / drive.rollers if alike else 360.0
        return Mechanism(spec, stations, period, step.sin_cos[0], rollers_max(natural))
    if drive.rollers > 1 and not alike:
        raise GenevaError(
            f"{drive.rollers} rollers on a {drive.kind} move the wheel differently, so one curved "
            "slot cannot serve them all; use rollers = 1, or straight slots (no law)",
            ("drive", "rollers"),
        )
    law = law_of(spec)
    natural = 2.0 * front(0.5 * natural).input_deg
    motion = natural - spec.motion.alpha0_deg
    _refuse_alpha0(spec, natural)
    refuse_jam(drive.rollers, motion, wheel.gearing)
    ratio = _ratio(spec, law, motion, step, front)
    pose = gearing.middle(wheel.gearing, ratio, 1.0 - SIGN[wheel.gearing] * ratio)
    station = LawDriven(0.0, motion, step.b, law, _anchor(pose, front, 0.0))
    return Mechanism(spec, (station,), 360.0 / drive.rollers, ratio, rollers_max(motion), law)


def _front(spec: Spec) -> drives.Turn:
    module = importlib.import_module(f"geneva_cli.drives.{drives.KINDS[spec.drive.kind]}")
    turn: drives.Turn = module.front(spec.kind)
    return turn


def law_of(spec: Spec) -> Law:
    """The motion law that a spec names."""
    motion = spec.motion
    if motion.lambda_ and motion.law != "sine-group":
        raise GenevaError(
            f'lambda shapes only the law "sine-group", not "{motion.law}"', ("motion", "lambda")
        )
    if motion.law == "table":
        from geneva_cli.law_table import read_law

        return read_law(spec)
    if motion.file is not None:
        raise GenevaError(
            'file goes with law = "table"; remove it or change the law', ("motion", "file")
        )
    try:
        return named(motion.law or "", motion.lambda_)
    except GenevaError as error:
        raise GenevaError(str(error), ("motion", "law")) from None


def _slot_driven(
    poses: tuple[gearing.Pose, ...],
    front: drives.Turn,
    step: gearing.Step,
    crank_deg: float,
    kernel: tuple[float, float, float] | None,
) -> SlotDriven:
    anchors = tuple(_anchor(pose, front, crank_deg) for pose in poses)
    mid = front(crank_deg).input_deg
    return SlotDriven(mid, step.b, anchors, kernel)


def _anchor(pose: gearing.Pose, front: drives.Turn, crank_deg: float) -> Anchor:
    """The pose of a roller that stands ``crank_deg`` behind the first, as the input sees it."""
    here = front(crank_deg + pose.crank_deg)
    from_mid = here.input_deg - front(crank_deg).input_deg

    def displacement(tau: Coefficient, order: int) -> tuple[Jet, Jet]:
        return pose.displacement(*here.advance(tau, order))

    return Anchor(from_mid, pose.wheel, pose.along, displacement)


def _ratio(
    spec: Spec, law: Law, motion_deg: float, step: gearing.Step, front: drives.Turn
) -> float:
    """R/L of a curved slot: given, sin b, or matched to the law's velocity at mid-motion."""
    given = spec.motion.ratio
    if given is None:
        return step.sin_cos[0]
    if given != "matched":
        return float(given)
    matched = matched_ratio(spec, law, motion_deg, step.b, front)
    if matched is None:
        raise GenevaError(
            "no R/L between 0 and 1 matches this motion: at mid-motion the wheel would have to "
            "turn too fast (inside, more than half as fast as the crank) or back; give ratio as a "
            "number, or change alpha0_deg or the law",
            ("motion", "ratio"),
        )
    return matched


def matched_ratio(
    spec: Spec, law: Law, motion_deg: float, half_step: float, front: drives.Turn
) -> float | None:
    """R/L at which the pin crosses the line of centres as fast as the wheel's slot does.

    psi1(0) = l/(1-l) f1(0) outside, l/(1+l) f1(0) inside, with f1 the front drive's ratio; at
    any other R/L the pressure angle at mid-motion is 90 degrees. None where no R/L below 1 does.
    """
    rate: float = front(0.0).advance(0.0, 1)[0].c[1]
    wheel: float = law(0.5, 1).c[1] * 2.0 * half_step / math.radians(motion_deg)
    v = wheel / rate
    if spec.wheel.gearing == "internal":
        return v / (1.0 - v) if 0.0 < v < 0.5 else None
    return v / (1.0 + v) if v > 0.0 else None


def matched_ratio_of(mechanism: Mechanism) -> float | None:
    """The matched R/L of a curved slot, whatever its own."""
    station = mechanism.stations[0]
    assert isinstance(station, LawDriven)
    spec = mechanism.spec
    front = _front(spec)
    return matched_ratio(spec, station.law, station.motion_deg, station.half_step, front)


def _refuse_alpha0(spec: Spec, natural_deg: float) -> None:
    low, high = natural_deg - 360.0, natural_deg
    alpha0 = spec.motion.alpha0_deg
    if not low < alpha0 < high:
        raise GenevaError(
            f"alpha0_deg = {alpha0:.12g} leaves no motion angle between 0 and 360 degrees; "
            f"it must be above {low:.12g} and below {high:.12g}",
            ("motion", "alpha0_deg"),
        )


def _refuse_motion_keys(spec: Spec) -> None:
    """Without a law the straight slots give the motion, and nothing of it is free."""
    default = type(spec.motion)()
    for name, value in spec.motion._asdict().items():
        if value != getattr(default, name):
            key = name.rstrip("_")
            raise GenevaError(
                f'{key} needs a law (law = "cycloidal", say): straight slots leave it no freedom',
                ("motion", key),
            )
