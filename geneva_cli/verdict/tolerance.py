"""The effects of tolerances on dwell, motion, entry and clearances: ``geneva tolerance``.

The clearances needed are those of the tightest machine: the largest roller in the narrowest slot,
and the largest disc in the smallest recess. At entry the wheel rests in its lock. The deviations of
crank radius, centre distance and slot angle then offset the roller from the slot. The wheel yields
by the least play of its lock; the slot's clearance must take the rest. The deviation of the centre
distance reduces the lock's clearance. These sums are exact if the roller enters along the slot.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import product
from typing import Any, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError, Notice, cut
from geneva_cli.loads.impacts.entry import arm_mm
from geneva_cli.loads.tolerance import locking, motion_error, random_machines
from geneva_cli.loads.tolerance.locking import Effect
from geneva_cli.loads.tolerance.random_machines import Draws, Spread, spread
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.registry import thing
from geneva_cli.numerics.arrays import Mask
from geneva_cli.numerics.jet import Jet
from geneva_cli.parts.outlines.cut_outlines import cut_arcs
from geneva_cli.parts.parts import Parts
from geneva_cli.spec.rules import POSITIVE, require_mm
from geneva_cli.table import Table, record_table, rows_table

SAME = 1e-6  # fraction of the centre distance, or radians: nearer radii and angles are equal
# The locks of a machine as it is cut, one for each shape, and the clearance that they need.
Locks: TypeAlias = tuple[Sequence[Effect], float | None]
# The reasons why effects are unknown.
UNKNOWN = {
    "dwell_position": "no drawn locking disc holds the wheel at rest",
    "motion_play": "curved slots are computed for a path without errors",
    "entry_jump": "the law, not the path, sets how the roller enters",
}


def flat_locks(parts: Parts, sizes: Mapping[str, float]) -> Locks:
    """Each corner of a recess with each locking arc of the crank; none without a locking disc.

    ``sizes`` are the tolerances that apply, in millimetres and radians.
    """
    outlines = parts.outlines
    size, assembly = outlines.sizes, outlines.assembly
    if not outlines.crank:
        return [], None
    L, near = assembly.L, SAME * assembly.L
    arcs = cut_arcs([outlines.wheel], size.recess, L, near)
    radii = [math.hypot(*end) for arc in arcs for end in (arc.start, arc.end)]
    sweeps = [abs(arc.sweep) for arc in cut_arcs(outlines.crank, size.lock, 0.0, near)]
    halves = [0.5 * sweep for sweep in sweeps if sweep > 2.0 * SAME]
    own = L, assembly.sign, size.lock, size.recess
    shapes = product(_distinct(radii, near), _distinct(halves, SAME))
    locks = [locking.Lock(*own, *shape) for shape in shapes]
    ring = sizes["lock_radius_mm"] + sizes["recess_radius_mm"]
    return locks, ring + sizes["center_distance_mm"]


def _distinct(values: Iterable[float], near: float) -> Iterable[float]:
    """The values, of those that are nearly equal one."""
    return {round(value / near): value for value in values}.values()


def cut_locks(parts: Parts, sizes: Mapping[str, float]) -> Locks:
    """The locks, which a kind of wheel may have in its own way."""
    of: Callable[[Parts, Mapping[str, float]], Locks]
    of = thing(parts.mechanism.spec.wheel.NAME, "locks") or flat_locks
    return of(parts, sizes)


def needed_mm(
    mechanism: Mechanism, parts: Parts | None, sizes: dict[str, float]
) -> tuple[float, float | None]:
    """The clearances per side that slot and lock need; without ``parts`` only the slot's."""
    locks, lock_mm = cut_locks(parts, sizes) if parts else ([], None)
    ends = locking.corners(list(sizes.values()))
    play = min((np.min(lock(ends)[0].c[0]).item() for lock in locks), default=0.0)
    L, most = mechanism.center_distance_mm, 0.0
    for one in mechanism.engagements:
        fraction = sizes["crank_radius_mm"] / arm_mm(mechanism, one)
        for at in (one.entry_deg, one.exit_deg):
            x, y = one.path(at, 1)
            (px, vx), (py, vy) = x.derivatives(), y.derivatives()
            # the roller runs along the slot there, which gives its normal; on a sphere the
            # meridian's
            tx, ty = (vx, vy) if one.slot.height is None else (px, py)
            far = math.hypot(tx, ty)
            nx, ny = -ty / far, tx / far
            of_arm = abs(nx * (px - one.hub) + ny * py) * L * fraction
            of_distance = abs(nx) * sizes["center_distance_mm"]
            lever = abs(ny * px - nx * py) * L
            of_angle = lever * (math.sin(sizes["slot_angle_deg"]) - math.sin(play))
            most = max(most, of_arm + of_distance + of_angle)
    return 0.5 * (sizes["roller_diameter_mm"] + sizes["slot_width_mm"]) + most, lock_mm


def worst_dwell_deg(mechanism: Mechanism, parts: Parts) -> float | None:
    """The greatest error of the resting wheel's angle within the tolerances, degrees."""
    use = locking.used(mechanism.spec)
    _refuse_large(mechanism, use)
    loosest = _loosest_lock(mechanism, parts, use)
    return math.degrees(loosest[1]) if loosest else None


def _loosest_lock(
    mechanism: Mechanism, parts: Parts, use: dict[str, float]
) -> tuple[Effect, float] | None:
    """The error of the wheel in the lock that lets it turn farthest, and the greatest, radians.

    None if no drawn lock holds the wheel.
    """
    ends, best = locking.corners(list(use.values())), None
    for lock in cut_locks(parts.built, use)[0] if mechanism.spec.is_turned else []:

        def error(by: locking.Deviations, lock: Effect = lock) -> tuple[Jet, Mask]:
            angle, jams = lock(by)
            return angle + by.slot_angle_deg, jams

        most = np.max(error(ends)[0].c[0]).item()
        best = (error, most) if best is None or most > best[1] else best
    return best


def _refuse(mechanism: Mechanism, samples: int, seed: int) -> None:
    if not 1 <= samples <= 10_000_000:
        raise GenevaError(f"--samples {cut(samples)}: it must be from 1 to 10000000")
    if seed < 0:
        raise GenevaError(f"--seed {cut(seed)}: it must be 0 or more")
    if not mechanism.output.turns:
        raise GenevaError(
            f"tolerances are computed for a wheel on a shaft, not for a {mechanism.output.noun}",
            ("wheel", "gearing"),
        )
    if not mechanism.spec.tolerance.is_given:
        raise GenevaError(
            "the spec gives no tolerances: set one or more of "
            + ", ".join(locking.Deviations._fields)
            + " in [tolerance], each a plus or minus",
            ("tolerance",),
        )


def _refuse_large(mechanism: Mechanism, use: dict[str, float]) -> None:
    """Raise GenevaError if some machine's roller may reach the wheel's axis or the crank's."""
    for one in motion_error.motion_errors(mechanism):
        margin_mm = one.margin_mm(mechanism.spec, use)
        if not use["center_distance_mm"] + use["crank_radius_mm"] < margin_mm:
            raise GenevaError(
                "the tolerances are too wide: center_distance_mm and crank_radius_mm must add up "
                f"to less than {max(margin_mm, 0.0):.6g} mm. Beyond that the roller could reach "
                "the wheel's axis or the crank's",
                ("tolerance", "center_distance_mm"),
            )


def tolerance_table(
    mechanism: Mechanism, parts: Parts, samples: int, seed: int, radius_mm: float | None = None
) -> Table:
    """The study of a machine by its ``[tolerance]``, with micrometres at ``radius_mm``."""
    if radius_mm is not None:
        require_mm("--radius", radius_mm, POSITIVE)
    _refuse(mechanism, samples, seed)
    spec, use = mechanism.spec, locking.used(mechanism.spec)
    given, sizes = spec.tolerance.as_dict(), list(use.values())
    warnings = [
        Notice("tolerance-left-out", f"{name} is left out: {reason}")
        for name, reason in locking.without_effect(spec).items()
        if given[name]
    ]
    _refuse_large(mechanism, use)
    draws = Draws(tuple(sizes), spec.tolerance.distribution == "normal", seed)
    # of angles: the effects whose spreads are shown, with their greatest sizes in radians
    shown, drawn = dict[str, tuple[Effect, float]](), dict[str, Effect]()
    unknown, at_deg, jump = list[str](), None, list[float | None]([None] * 4)
    try:
        if loosest := _loosest_lock(mechanism, parts, use):
            shown["dwell_position"], drawn["dwell_position"] = loosest, loosest[0]
    except GenevaError as error:
        unknown.append(f"no parts: {error}")
    if motions := motion_error.motion_errors(mechanism):
        each = [
            (one, one.greatest(sizes).T, one.greatest(sizes, squared=True).T) for one in motions
        ]
        one, ((most, place, _),), _ = max(each, key=lambda row: row[1][0, 0])
        at_deg = mechanism.shown_deg(one.engagement.mid_deg + place.item())
        one, _, ((_, place, side),) = max(each, key=lambda row: row[2][0, 0])
        shown["motion_play"] = one.at(place, side), most
        drawn["motion_play"] = random_machines.likely_effect(draws, samples, motions)
    ends, worst_jump = locking.corners(sizes), -1.0
    for own in motion_error.entry_jumps(mechanism):
        if (worst := np.max(own(ends)[0].c[0]).item()) > worst_jump:
            drawn["entry_jump"], worst_jump = own, worst
    errors, masks = random_machines.random_errors(draws, samples, drawn.values())
    angles = dict[str, Spread | None].fromkeys(("dwell_position", "motion_play"))
    for (name, (effect, most)), drawn_ones in zip(shown.items(), errors, strict=False):
        angles[name] = spread(effect, sizes, most, drawn_ones)
    jams = masks[: len(shown)].any(axis=0).mean().item() if shown else None
    if "entry_jump" in drawn:
        jump = [errors[-1].mean().item(), errors[-1].std().item(), worst_jump]
        jump.append(masks[-1].mean().item())
    unknown += [f"{name} is not known: {why}" for name, why in UNKNOWN.items() if name not in drawn]
    warnings += [Notice("not-known", text) for text in unknown]
    clearances = _clearances(mechanism, parts, use, warnings)
    known = [name for name, of in angles.items() if of]
    warnings = spec.accept.applied(warnings)
    if radius_mm is None and known:
        text = f"micrometres of {' and '.join(known)}: need --radius"
        warnings.append(Notice("not-known", text))
    values: dict[str, Any] = {"spec": spec.path, "title": spec.title, "samples": samples}
    values |= {"seed": seed, "distribution": spec.tolerance.distribution, "radius_mm": radius_mm}
    micron = None if radius_mm is None else math.radians(1.0) * radius_mm * 1e3
    for name, of in angles.items():
        for unit, scale in {"deg": 1.0, "arcsec": 3600.0, "um": micron}.items():
            for angle in Spread._fields[:-1]:  # but for the parts
                value = getattr(of, angle) * scale if of and scale is not None else None
                values[f"{name}.{angle}_{unit}"] = value
    values |= {"motion_play.at_deg": at_deg, "contributions": _contributions(angles, given)}
    for end, value in zip(("mean", "std", "worst", "missed_share"), jump, strict=True):
        values[f"entry_jump.{end}"] = value
    values |= clearances | {"clearances.jam_share": jams, "warnings": tuple(warnings)}
    return record_table(values, spec.title)


def _contributions(angles: Mapping[str, Spread | None], given: Mapping[str, float]) -> Table:
    """A row for each dimension that deviates: its fraction of the squares, its plus or minus."""
    names = ("dimension", "share", "dwell_position_deg", "motion_share", "motion_play_deg")
    rows = []
    for i, name in enumerate(locking.Deviations._fields):
        each = [(of.fractions[i], of.parts[i]) if of else (None, None) for of in angles.values()]
        if given[name]:
            rows.append((name, *each[0], *each[1]))
    return rows_table(names, sorted(rows, key=lambda row: -(row[1] or 0.0)))


def _clearances(
    mechanism: Mechanism, parts: Parts, use: dict[str, float], warnings: list[Notice]
) -> dict[str, float | bool | None]:
    """The clearances that slot and lock have and need; adds a warning unless they are enough."""
    turned, fault = None, mechanism.no_turn or "there are no drawn parts to turn"
    try:
        turned = parts.built if mechanism.spec.is_turned and not mechanism.no_turn else None
    except GenevaError as error:
        fault = str(error)
    slot_mm, lock_mm = needed_mm(mechanism, turned, use)
    own = mechanism.spec.size.allowances
    pairs = {"slot": (own.slot_clearance_mm, slot_mm), "lock": (own.lock_clearance_mm, lock_mm)}
    short = [
        f"{name}_clearance_mm must be at least {needed:.6g}"
        for name, (mm, needed) in pairs.items()
        if needed is not None and mm < needed * (1.0 - 1e-12)
    ]
    if short or not turned:
        text = f"not every machine turns: {' and '.join(short)}"
        text = text if turned else f"no turn was computed: {fault}"
        warnings.append(Notice("not-every-machine-turns", text))
    return {
        "clearances.slot_mm": own.slot_clearance_mm,
        "clearances.slot_needed_mm": slot_mm,
        "clearances.lock_mm": None if lock_mm is None else own.lock_clearance_mm,
        "clearances.lock_needed_mm": lock_mm,
        "clearances.turns": not short if turned else None,
    }
