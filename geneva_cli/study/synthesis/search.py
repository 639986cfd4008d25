"""From a wish to the machines that grant it, each with what it costs.

A wish fixes the motion angle (by tau, k, the angle itself, or a time), or bounds the peak
acceleration. For every number of slots, gearing and number of rollers there are up to four ways:
the plain crank where it happens to fit, a side-crank, elliptical gears, and curved slots with an
extra dwell alpha_0. Shafts that meet do so at a right angle, or, with a plain crank, at the angle
that makes the motion.

A side-crank and gears carry one roller: several would move the wheel differently. Straight slots
take as many rollers as leave a dwell. Curved slots take as many as those of the plain wheel, and
more for as long as their parts can be built.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from itertools import count
from typing import Any, NamedTuple, TypeAlias

from geneva_cli.analysis.law_values import Characteristic, characteristic
from geneva_cli.analysis.peaks import acceleration_peak, worst
from geneva_cli.analysis.timing import timings
from geneva_cli.errors import GenevaError
from geneva_cli.machine import registry
from geneva_cli.machine.drives.crank import Crank
from geneva_cli.machine.drives.elliptical_gears import EllipticalGears
from geneva_cli.machine.drives.side_crank import SideCrank
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Motion, Spec
from geneva_cli.machine.wheels.classic import half_motion_deg, rollers_max
from geneva_cli.machine.wheels.gearing import Gearing
from geneva_cli.numerics.angles import omega
from geneva_cli.spec.tables import Limits
from geneva_cli.study.synthesis import closed
from geneva_cli.study.synthesis import limit as limits
from geneva_cli.study.synthesis.parts import parts
from geneva_cli.study.synthesis.target import MARGIN, Wish
from geneva_cli.table import Table, rows_table

ROUNDING = 2e-15  # share of the natural motion: what a difference of two angles may be off by
EXACT = 1e-6  # share of the motion angle by which the plain crank may miss the wish


class Way(NamedTuple):
    """One machine, and one row: what it is, then what it costs (invariants)."""

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
    parts: str | None  # whether they can be built (synthesis_parts)


NAMES = ("no", *Way._fields)
CONSTANT = ("rollers", "law", "motion_deg", "dwell_deg", "tau", "k", "n_rpm", "parts")  # told once


def synthesis(wish: Wish) -> list[tuple[Spec, Way]]:
    """The machines that grant the wish, the lowest peak acceleration first, sized to be built.

    Raises GenevaError, saying what is within reach, where there is none.
    """
    costs = {law: characteristic(registry.law(law)()) for law in wish.laws}
    reached: list[float] = []
    found = []
    for spec in _specs(wish, costs, reached):
        try:
            machine = build(spec)
        except GenevaError:  # no R/L matches the law, or the rollers jam
            continue
        fitted = parts(machine)
        asked = Limits(acceleration_max=wish.acceleration_max)
        found.append((fitted.spec.but(limits=asked), _way(machine, wish, costs, fitted.said)))
    if not found:
        raise GenevaError(_out_of_reach(wish, reached))
    found.sort(key=lambda f: _rank(f[1]))
    return found


def _rank(way: Way) -> tuple[object, ...]:
    """Peaks first; those that differ by rounding only are equal."""
    peaks = (way.acceleration_max, way.jerk_max)
    return (*[float(f"{x:.12g}") for x in peaks], way.rollers, way.z, way.gearing)


def synthesis_table(wish: Wish) -> Table:
    """One row a machine, numbered from 1."""
    ways = synthesis(wish)
    rows = [(i, *way) for i, (_, way) in enumerate(ways, 1)]
    title = (
        f"{len(rows)} machines, lowest peak acceleration first" if len(rows) > 1 else "1 machine"
    )
    return rows_table(NAMES, rows, f"{wish.words}: {title}.")


def for_people(table: Table) -> Table:
    """Without the columns that hold nothing, and with those that hold one value in the title."""
    kept, once = [], []
    for name, column in zip(table.names, table.columns, strict=True):
        first = column[0]
        if all(v is None for v in column):
            continue
        if name in CONSTANT and len(column) > 1 and all(_same(v, first) for v in column):
            once.append(f"{name} {first:.7g}" if isinstance(first, float) else f"{name} {first}")
        else:
            kept.append((name, column))
    title = table.title + (f" All: {', '.join(once)}." if once else "")
    return Table(tuple(n for n, _ in kept), [c for _, c in kept], title=title)


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, float) and isinstance(b, float):
        return math.isclose(a, b, rel_tol=1e-12)
    return bool(a == b)


def _specs(wish: Wish, costs: dict[str, Characteristic], reached: list[float]) -> Iterator[Spec]:
    """The specs to try; peaks that are as low as a drive brings them go to ``reached``."""
    for gearing in wish.gearings:
        for z in wish.z:
            wheel = registry.gearing(gearing)(z)
            if wish.acceleration_max is not None:
                yield from _below(wish, wheel, costs, reached)
            else:
                yield from _lasting(wish, wheel)


def _natural(wheel: Gearing) -> float:
    """The plain crank's motion angle."""
    return 2.0 * wheel.half_motion_deg(wheel.step)


def _rollers(wish: Wish, natural: float) -> range:
    """The numbers of rollers to look at: as many as the straight slots take, or those asked for."""
    if wish.rollers is not None:
        return range(wish.rollers, wish.rollers + 1)
    return range(1, rollers_max(natural) + 1)


def _more_rollers(wish: Wish, natural: float, curved: Callable[[int], Spec]) -> Iterator[Spec]:
    """More rollers than the straight slots take, while the curved ones can be built."""
    if wish.rollers is not None:
        return
    for m in count(rollers_max(natural) + 1):
        spec = curved(m)
        try:
            machine = build(spec)
        except GenevaError:
            return
        if parts(machine).why:
            return
        yield spec


def _lasting(wish: Wish, wheel: Gearing) -> Iterator[Spec]:
    """The ways to a motion angle, in closed form."""
    natural = _natural(wheel)

    def motion(m: int) -> float:
        wanted = wish.motion_for(m)
        return natural if wanted is None or _fits(wanted, natural) else wanted

    for m in _rollers(wish, natural):
        if motion(m) == natural:
            yield _plain(wish, wheel, m)
        elif m == 1:
            yield from _driven(wish, wheel, natural, motion(1))
    if not wheel.FLAT:
        yield from _inclined(wish, wheel)
        return
    for law in wish.laws:

        def curved(m: int, law: str = law) -> Spec:
            return _curved(wish, wheel, m, natural, motion(m), law)

        yield from map(curved, _rollers(wish, natural))
        yield from _more_rollers(wish, natural, curved)


def _driven(wish: Wish, wheel: Gearing, natural: float, motion: float) -> Iterator[Spec]:
    """The drives in front of the crank that make a motion angle."""
    A = closed.side_crank(natural, motion)
    if A is not None:
        yield _side_crank(wish, wheel, A)
    gears = closed.elliptical_gears(natural, motion)
    if gears is not None:
        yield _gears(wish, wheel, *gears)


def _fits(motion: float, natural: float) -> bool:
    return abs(motion - natural) <= EXACT * natural


def _inclined(wish: Wish, wheel: Gearing) -> Iterator[Spec]:
    """Plain cranks on shafts that meet at another angle than a right one."""
    least = 2.0 * half_motion_deg(1.0, 1, wheel.z)
    for m in [wish.rollers] if wish.rollers else range(1, rollers_max(least) + 1):
        motion = wish.motion_for(m)
        if motion is None or _fits(motion, 180.0):
            continue
        axes = closed.axes(wheel.z, motion)
        if axes is not None:
            yield _plain(wish, wheel, m).with_("wheel.axes_deg", axes)


def _below(
    wish: Wish, wheel: Gearing, costs: dict[str, Characteristic], reached: list[float]
) -> Iterator[Spec]:
    """The ways to a peak acceleration: the plain crank, or the least change that brings it down."""
    assert wish.acceleration_max is not None
    natural = _natural(wheel)
    every = _rollers(wish, natural)
    plain = acceleration_peak(build(_plain(wish, wheel, 1)).engagements[0]).max
    if plain <= wish.acceleration_max:
        yield from (_plain(wish, wheel, m) for m in every)
        return
    if not wish.rollers or natural * wish.rollers < 360.0:
        reached.append(plain)
    if not wheel.FLAT:
        return
    limit = wish.acceleration_max * (1.0 - MARGIN)
    if 1 in every:
        yield from _driven_below(wish, wheel, limit, reached)
    for law in wish.laws:
        yield from _curved_below(wish, wheel, limit, costs[law], law, reached)


def _driven_below(wish: Wish, wheel: Gearing, limit: float, reached: list[float]) -> Iterator[Spec]:
    """The drives in front of the crank that bring a peak acceleration down, if they do."""
    for ratio, make in ((limits.side_crank, _side_crank), (limits.elliptical_gears, _eased)):
        x, least = limits.least_parameter(limits.peak_of(wheel, ratio), limit)
        reached.append(least)
        if x is not None:
            yield make(wish, wheel, x)


def _curved_below(
    wish: Wish,
    wheel: Gearing,
    limit: float,
    cost: Characteristic,
    law: str,
    reached: list[float],
) -> Iterator[Spec]:
    """Curved slots over a motion so long that the law's peak acceleration is the limit."""
    natural, step = _natural(wheel), 2.0 * math.pi / wheel.z
    motion = closed.law_motion_deg(step, cost.acceleration, limit)
    inside, fast = wheel.SIGN < 0.0, cost.velocity * step
    if inside and fast >= 0.5 * math.radians(motion) and motion < natural:
        motion = natural  # the limit's own motion is too quick for any R/L inside

    def curved(m: int) -> Spec:
        return _curved(wish, wheel, m, natural, motion, law)

    for m in _rollers(wish, natural):
        whole = 2.0 * math.pi / m
        if not inside or fast < 0.5 * whole:
            reached.append(cost.acceleration * step / whole**2)
        yield curved(m)
    yield from _more_rollers(wish, natural, curved)


def _plain(wish: Wish, wheel: Gearing, m: int) -> Spec:
    return Spec(wheel, Crank(n_rpm=wish.n_rpm(m), rollers=m))


def _side_crank(wish: Wish, wheel: Gearing, A: float) -> Spec:
    return Spec(wheel, SideCrank(A=A, n_rpm=wish.n_rpm(1)))


def _gears(wish: Wish, wheel: Gearing, eccentricity: float, phase: str) -> Spec:
    n = wish.n_rpm(1)
    return Spec(wheel, EllipticalGears(eccentricity=eccentricity, phase=phase, n_rpm=n))


def _eased(wish: Wish, wheel: Gearing, e: float) -> Spec:
    return _gears(wish, wheel, *closed.phased(e))


def _curved(wish: Wish, wheel: Gearing, m: int, natural: float, motion: float, law: str) -> Spec:
    """Curved slots, with the shortest alpha_0 that makes the motion."""
    alpha0, spare = natural - motion, ROUNDING * natural
    # A motion that is shorter, by however little, would break a limit that it just keeps.
    most = alpha0 if wish.acceleration_max else alpha0 + spare
    shortest = closed.shortest(alpha0 - spare, most)
    given = Motion(registry.law(law)(), alpha0_deg=shortest, ratio="matched")
    return _plain(wish, wheel, m).but(motion=given)


def _way(
    machine: Mechanism, wish: Wish, costs: dict[str, Characteristic], parts: str | None
) -> Way:
    spec, time, motion = machine.spec, timings(machine)[0], machine.spec.motion
    own = spec.wheel.own_sizes | vars(spec.drive)
    invariants = _law_costs(machine, costs[motion.law.NAME]) if motion else _costs(machine)
    n = wish.n_rpm(spec.drive.rollers) if wish.cycle_s else None
    return Way(
        spec.wheel.z,
        spec.wheel.NAME,
        spec.drive.rollers,
        spec.drive.NAME,
        own.get("A"),
        own.get("eccentricity"),
        own.get("phase"),
        own.get("axes_deg"),
        motion.alpha0_deg if motion else None,
        motion.law.NAME if motion else None,
        machine.ratio,
        time.motion_deg,
        time.dwell_deg,
        time.tau,
        time.k,
        *invariants,
        n,
        invariants[1] * omega(n) ** 2 if n else None,
        parts,
    )


Five: TypeAlias = tuple[float, float, float, float, float]


def _costs(machine: Mechanism) -> Five:
    found = worst(machine)
    return (
        found.velocity.max,
        found.acceleration.max,
        found.ends.acceleration_entry,
        found.jerk.max,
        found.power.max,
    )


def _law_costs(machine: Mechanism, costs: Characteristic) -> Five:
    """A law's own greatest values, scaled to the step and to the motion angle."""
    engagement = machine.engagements[0]
    step, rate = 2.0 * engagement.half_step, 1.0 / math.radians(engagement.motion_deg)
    C_v, C_a, C_j, C_p = costs
    return (
        C_v * step * rate,
        C_a * step * rate**2,
        abs(engagement.motion(engagement.entry_deg).derivatives()[2]),
        C_j * step * rate**3,
        C_p * step**2 * rate**3,
    )


def _out_of_reach(wish: Wish, reached: list[float]) -> str:
    """What to say where no machine was found: what would be within reach."""
    m = wish.rollers or 1
    wanted = wish.motion_for(m)
    if wish.acceleration_max is not None and reached:
        return (
            f"--acceleration-max {wish.acceleration_max:.7g}: out of reach; with these wheels it "
            f"must be above {min(reached):.6g}, and more slots come lower"
        )
    if wanted is None:
        most = max(
            rollers_max(_natural(registry.gearing(g)(z))) for z in wish.z for g in wish.gearings
        )
        return f"--rollers {m}: they jam on every wheel asked for; at most {most}"
    if m * wanted >= 360.0:
        return (
            f"{wish.words}: {m} motions of {wanted:.7g} deg leave no dwell in a turn of 360; with "
            f"{m} rollers a motion must be below {360.0 / m:.7g} deg (tau below 1)"
        )
    return (
        f"{wish.words}: out of reach with {'one roller' if m == 1 else f'{m} rollers'}: curved "
        "slots turn an internal wheel at most half as fast as the crank"
        + (f", and no drive goes beyond A or eccentricity {closed.MOST}" if m == 1 else "")
        + "; more slots or a longer motion would do"
    )
