"""The rows of a synthesis: each machine's description and costs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.timing import timings
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.spec.load_limits import LIMITED
from geneva_cli.study.batches import numbers
from geneva_cli.study.synth.families.family import Family, allows
from geneva_cli.study.synth.fast_parts import machine_and_parts
from geneva_cli.study.synth.parts_data import compute_parts_data, parts_data, with_one_roller
from geneva_cli.study.target import Target
from geneva_cli.verdict.checks.all_checks import LIMITS, MOTION, applicable
from geneva_cli.verdict.checks.motion_checks import GROOVE_MAX_DEG, driven_fraction, groove_pressure

NEAR_DEG = 3.0  # below its limit, within which the pressure angle is searched between samples
COSTS = ("velocity.max", "acceleration.max", "acceleration.entry", "jerk.max", "power.max")
# Known with a cycle time: the input speed, times, and the peak in rad/s² or of a rack in m/s².
TIMED = ("n_rpm", "motion_s", "dwell_s", "acceleration_max_rad_s2", "acceleration_max_m_s2")
# Keys of wheel and drive that only some machines have, and that describe a row.
OWN_KEYS = (
    *("A", "eccentricity", "phase", "axes_deg", "offset_mm", "planet_ratio", "fixed"),
    *("crank_mm", "ground_mm", "coupler_mm", "rocker_mm", "point_mm", "point_deg", "entry_deg"),
    *("sector_deg", "first_z", "wheels"),
)


class Candidate(NamedTuple):
    """One machine as a row: its description, costs (invariants), and whether it can be built."""

    z: int
    gearing: str
    rollers: int
    drive: str
    A: float | None
    eccentricity: float | None
    phase: str | None
    axes_deg: float | None
    alpha0_deg: float | None
    law: str | None
    ratio: float
    motion_deg: float
    dwell_deg: float
    tau: float
    k: float
    velocity_max: float
    acceleration_max: float
    acceleration_entry: float
    jerk_max: float
    power_max: float
    n_rpm: float | None  # with a cycle time: the input speed, and the peak in rad/s²
    acceleration_max_rad_s2: float | None
    parts: str | None  # whether they can be built; None if they are not drawn
    offset_mm: float | None
    planet_ratio: float | str | None
    fixed: str | None
    motion_s: float | None  # with a cycle time
    dwell_s: float | None
    crank_mm: float | None  # a four-bar's keys
    ground_mm: float | None
    coupler_mm: float | None
    rocker_mm: float | None
    point_mm: float | None
    point_deg: float | None
    entry_deg: float | None
    sector_deg: float | None
    first_z: int | None
    index_mm: float | None  # of a rack
    acceleration_max_m_s2: float | None
    wheels: int | None  # on a carrier

    @property
    def is_driven(self) -> bool:
        """Return True if a side-crank or gears drive the crank."""
        return self.A is not None or self.eccentricity is not None

    @property
    def peak(self) -> float:
        """The greatest acceleration, in rad/s² or m/s² if the speed is required."""
        rates = self.acceleration_max_rad_s2, self.acceleration_max_m_s2, self.acceleration_max
        return next(rate for rate in rates if rate is not None)

    @property
    def of_two_numbers(self) -> bool:
        """Return True if both the drive and the wheel differ from the plain machine."""
        return self.is_driven and bool(self.axes_deg not in (None, 90.0) or self.offset_mm)


class MachineRow(NamedTuple):
    """A machine: its spec, description and costs, and further requested quantities.

    ``extra`` are those quantities. ``family`` is the family whose best it is, if that has other
    machines. With ``is_replacement`` it replaces a better machine that cannot be built.
    """

    spec: Spec
    candidate: Candidate
    extra: tuple[float | int | str | bool | None, ...] = ()
    family: Family | None = None
    is_replacement: bool = False

    def moves_as(self, other: MachineRow) -> bool:
        """Return True if another row is the same machine apart from sizes."""
        one, two = self.spec, other.spec
        return (one.wheel, one.drive, one.motion) == (two.wheel, two.drive, two.motion)

    @property
    def trouble(self) -> str:
        """The reason why its parts cannot be built; empty if none is known."""
        return (self.candidate.parts or "").partition(": ")[2]

    @property
    def is_impossible(self) -> bool:
        """Return True if its parts are known to be impossible."""
        return bool(self.trouble)

    @property
    def breaks_limit(self) -> bool:
        """Return True if it breaks a limit of its frame."""
        return not LIMITED.keys().isdisjoint(self.trouble.split(", "))


def with_peak_limit(target: Target, spec: Spec) -> Spec:
    """The spec with the required peak acceleration as a further limit."""
    if target.acceleration_max is None:
        return spec
    return spec.replace(limits=spec.limits.replace(acceleration_max=target.acceleration_max))


def rows(target: Target, specs: Sequence[Spec], errors: list[str]) -> list[MachineRow | None]:
    """The rows of the specs; None for one that cannot be built or breaks the required motion.

    The reasons are added to ``errors``.
    """
    specs = [with_peak_limit(target, spec) for spec in specs]
    alone = [with_one_roller(spec) for spec in specs]
    different = [*dict.fromkeys(alone)]
    costs = dict(zip(different, numbers(different, COSTS), strict=True))
    # ``search`` keeps the required limit itself
    limits = target.frame.limits.as_dict().values() if target.frame else ()
    limited = any(value is not None for value in limits)
    compute_parts_data(specs)
    out: list[MachineRow | None] = []
    for spec, one in zip(specs, alone, strict=True):
        row, values = None, costs[one]
        try:
            machine, parts = machine_and_parts(spec)
        except GenevaError as error:
            errors.append(str(error))
            values = None
        if values:
            if not parts.why:
                sized = machine._replace(spec=parts.spec)
                failed = _failing(sized, values) if limited else _slot_failure(machine)
                parts = parts._replace(why=failed or parts.why)
            row = MachineRow(parts.spec, _candidate(machine, target, values, parts.entry))
        out.append(row if row and _moves_as_required(target, row) else None)
    return out


def _moves_as_required(target: Target, row: MachineRow) -> bool:
    drive = row.spec.drive
    limit, motion = target.acceleration_max, target.motion_for(drive.rollers / drive.turns)
    if motion is not None and not allows(motion, row.candidate.motion_deg):
        return False
    return limit is None or keeps(row.candidate.acceleration_max, "at most", limit)


def _failing(machine: Mechanism, costs: Sequence[float]) -> str:
    """The checks that fail among those that need no parts; the peaks are known."""
    limits, known = machine.spec.limits.as_dict(), dict(zip(COSTS, costs, strict=True))
    peaks = {key: known[name] for key, name in LIMITED.items() if name in known}
    over = [
        key
        for key, x in peaks.items()
        if limits[key] is not None and not keeps(x, "at most", limits[key])
    ]
    others = {name: check for name, check in LIMITS.items() if name not in peaks}
    motion, rest = (
        [check.name for check in applicable(among, machine) if check.passes is False]
        for among in (MOTION, others)
    )
    return ", ".join([*motion, *over, *rest])


def _slot_failure(machine: Mechanism) -> str:
    """The check of a cam's groove, or of a curved slot's drive, that fails; else empty."""
    if machine.engagements[0].groove is None:
        name, check = "driven_fraction", driven_fraction("driven_fraction", machine)
    else:
        name = "groove_pressure_deg"
        pressure_deg = parts_data(machine.spec).pressure_deg
        # samples are never above the peak, and 1e-6 is beyond rounding
        if not -NEAR_DEG <= pressure_deg - GROOVE_MAX_DEG <= 1e-6:
            return name if pressure_deg > GROOVE_MAX_DEG else ""
        check = groove_pressure(name, machine)
    return name if check and check.passes is False else ""


def _candidate(
    machine: Mechanism, target: Target, costs: Sequence[float], parts: str | None
) -> Candidate:
    spec, time, output = machine.spec, timings(machine)[0], machine.output
    motion = spec.motion
    keys = spec.wheel.as_dict() | spec.drive.as_dict()
    own: dict[str, Any] = {name: keys.get(name) for name in OWN_KEYS}
    own |= {key: getattr(time, key) for key in ("motion_deg", "dwell_deg", "tau", "k", "index_mm")}
    own |= {name.replace(".", "_"): cost for name, cost in zip(COSTS, costs, strict=True)}
    own["offset_mm"] = own["offset_mm"] or None
    timed: dict[str, Any] = dict.fromkeys(TIMED)
    if target.timed:
        n = spec.drive.n_rpm
        timed |= {"n_rpm": n, "motion_s": time.motion_s, "dwell_s": time.dwell_s}
        rate = costs[1] * omega(n) ** 2 * output.rate_per_radian
        timed[f"acceleration_max_{output.rate_unit}_s2"] = rate
    return Candidate(
        z=spec.wheel.z,
        gearing=spec.wheel.NAME,
        rollers=spec.drive.rollers,
        drive=spec.drive.NAME,
        alpha0_deg=motion.alpha0_deg if motion else None,
        law=motion.law.NAME if motion else None,
        ratio=machine.ratio,
        parts=parts,
        **own,
        **timed,
    )
