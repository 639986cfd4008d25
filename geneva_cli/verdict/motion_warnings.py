"""Warnings about a machine's motion and slots: the problem, its place, and a remedy."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import lru_cache

from geneva_cli.errors import Notice
from geneva_cli.motion.engagement import WheelMotion
from geneva_cli.motion.laws.law import Law
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peaks import greatest_jumps, peak
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.shafts.fits import closest_mm, loosest_mm
from geneva_cli.spec.tables import Z_USUAL, Size
from geneva_cli.spec.workshops import workshop

SHOWN_UNDERCUT = 0.005  # mm: a wall cut back by less is within a shop's tolerance


def motion_warnings(mechanism: Mechanism) -> list[Notice]:
    """The warnings about a machine that need neither its loads nor its parts."""
    return [
        *_of_wheel(mechanism),
        *_of_distance(mechanism),
        *_stops(mechanism),
        *_as_built(mechanism),
        *_fits(mechanism),
        *_rounded_points(mechanism),
        *_overtaken(mechanism),
        *(_of_law(mechanism, mechanism.law) if mechanism.law else ()),
    ]


def _stops(mechanism: Mechanism) -> Iterator[Notice]:
    """A warning for an input that cannot stop and start while the wheel rests."""
    drive = mechanism.spec.drive
    if not drive.stop_s:
        return
    brake, start = drive.brake_and_start_deg
    least = min(mechanism.dwell_deg(i) for i in range(len(mechanism.engagements)))
    if not keeps(brake + start, "at most", least):
        yield Notice(
            "stop-in-motion",
            f"the input turns {brake:.4g}° while it brakes and {start:.4g}° while it starts, but "
            f"the dwell has only {least:.4g}°. The roller would be in a slot. At this speed "
            f"brake_s and start_s may take {least / (3.0 * drive.n_rpm):.4g} s together",
        )


def _of_wheel(mechanism: Mechanism) -> Iterator[Notice]:
    """Warnings about many slots, and about a wheel that nothing holds."""
    z = mechanism.spec.wheel.z
    if z > Z_USUAL and mechanism.output.turns:  # a rack only becomes longer
        yield Notice(
            "many-slots",
            f"z = {z}: more than {Z_USUAL} slots leave little of the wheel between them",
        )
    if mechanism.spec.dwell_holder is None:
        yield Notice(
            "nothing-holds",
            "nothing holds the wheel in the dwell, because there is no locking disc: set "
            'held_by = "brake", "detent" or "pin" in [wheel]',
        )


def _of_distance(mechanism: Mechanism) -> Iterator[Notice]:
    """A warning for a rim that is given without the centre distance on which it depends."""
    size = mechanism.spec.size
    given = size.center_distance_mm is not None or size.crank_radius_mm is not None
    if size.wheel_radius_mm is None or given:
        return
    L = mechanism.center_distance_mm
    if mechanism.spec.given_distance_mm == L:  # some drives solve for it
        yield Notice(
            "no-centre-distance",
            f"wheel_radius_mm = {size.wheel_radius_mm:g} is given without a centre distance, so "
            f"L = {L:g} mm is taken: set center_distance_mm in [size]{_of_mouth(mechanism)}",
        )


def _of_mouth(mechanism: Mechanism) -> str:
    """The centre distance at which the roller's centre enters at the spec's rim, in words.

    Empty for wheels whose mouth is not proportional to L, and for spheres and racks.
    """
    spec, engagement = mechanism.spec, mechanism.engagements[0]
    if spec.wheel.skewed or not (spec.wheel.FLAT and spec.output.turns):
        return ""
    x, y = engagement.path(engagement.entry_deg, 0)
    L = (spec.size.wheel_radius_mm or 0.0) / math.hypot(x.c[0], y.c[0])
    return f"; with {L:.6g} the roller would enter at this radius"


def _as_built(mechanism: Mechanism) -> Iterator[Notice]:
    """A warning for a crank as built, whose impact the loads leave out."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    if mechanism.engagements[0].built is None:
        return
    own = spec.wheel.place(spec.wheel.step, L).ratio
    jumps = greatest_jumps(mechanism.engagements)
    sizes = [abs(jump) for jump in jumps if jump is not None]
    impact = (
        f"the wheel's velocity jumps by up to {max(sizes):.4g} of the input's, an impact that the "
        "loads leave out"
        if sizes
        else "the roller's centre never crosses the axis of the slot at rest inside the rim"
    )
    yield Notice(
        "taken-as-built",
        f"crank_radius_mm = {spec.size.crank_radius_mm:.9g} and center_distance_mm = {L:.9g} have "
        f"R/L = {mechanism.ratio:.6g}, but the slots need {own:.6g}: taken as built. There "
        f"{impact}. Leave out one of the two keys for a machine without it",
    )


def _of_law(mechanism: Mechanism, law: Law) -> Iterator[Notice]:
    """Warnings about a wheel that follows a law, and about its slots."""
    back = turns_back(mechanism)
    if back:
        yield Notice(
            "turns-back",
            f"the wheel turns back: velocity {back[0]:.4g} at {back[1]:.4g}°; {law.TURNS_BACK}",
        )
    from geneva_cli.motion.pitch_curve import retraces

    engagement = mechanism.engagements[0]
    if engagement.slot.curved and not retraces(engagement):
        yield _off_the_mid_condition(mechanism)
    if max(abs(half(0.0, 2).scalars()[2]) for half in (law.first, law.second)) > 1e-9:
        yield Notice(
            "soft-shock-at-ends",
            f'the law "{law.NAME}" starts and stops with a jump in acceleration: a soft shock at '
            "both ends",
        )
    if abs(law.first(0.5, 2).scalars()[2] + law.second(0.5, 2).scalars()[2]) > 1e-9:
        yield Notice(
            "soft-shock-at-mid",
            f'the law "{law.NAME}" jumps from acceleration to deceleration: a soft shock at '
            "mid-motion",
        )
    if engagement.slot.curved:
        yield from _not_driven(mechanism)
    yield from _undercut(mechanism)


def _fits(mechanism: Mechanism) -> Iterator[Notice]:
    """Clearances larger than the loosest running fit, or the process, needs; and too small ones.

    A default locking disc is smaller than the crank, whose fit is looser.
    """
    size, disc = mechanism.spec.size, mechanism.spec.size.lock_radius_mm
    pairs = [("slot_clearance_mm", "roller", "slot", mechanism.roller_radius_mm)]
    if mechanism.spec.has_lock:
        radius = mechanism.ratio * mechanism.center_distance_mm if disc is None else disc
        pairs.append(("lock_clearance_mm", "locking disc", "recess", radius))
    shop = workshop(size.process)
    is_cut = mechanism.spec.is_flat and shop.cut_mm
    for key, part, mate, radius in pairs:
        clearance, fit = getattr(size, key), loosest_mm(2.0 * radius)
        if clearance is None:
            continue
        own = getattr(size.replace(**{key: None}).allowances, key)
        least, most = _least_clearance_mm(size, own, radius), max(0.5 * (fit or math.inf), own)
        if not keeps(clearance, "at most", most):
            helps = "" if size.process else ", or name the process that needs it"
            yield Notice(
                "loose-fit",
                f"{key} = {clearance:g}: the {part} is loose in its {mate}. At Ø "
                f"{2.0 * radius:.4g} mm the loosest running fit of ISO 286, H11/c11, leaves at "
                f"most {0.5 * (fit or 0.0):.4g} mm a side: reduce {key} to {most:.4g}{helps}",
            )
        # what plates need that a laser cuts is known with their thickness (``process_warnings``);
        # at nominal sizes the fits of the sheet make the clearance
        elif not (
            is_cut or (shop.fits and clearance == 0.0) or keeps(clearance, "at least", least)
        ):
            yield Notice(
                "narrow-for-process",
                f'{key} = {clearance:g}: with process = "{size.process}" {part} and {mate} '
                f"(Ø {2.0 * radius:.4g} mm) are off by up to {least:.4g} mm a side together, and "
                f"may not go together: set {key} to {least:.4g}",
            )


def _least_clearance_mm(size: Size, own: float, radius: float) -> float:
    """The clearance per side that takes the deviations of the process; 0 without a process.

    ``own`` is the clearance that the process sets.
    """
    shop = workshop(size.process)
    if size.process is None:
        return 0.0
    if shop.cut_mm:  # a cut's clearance is its deviation
        return own
    return 0.5 * (closest_mm(2.0 * radius) or 0.0) if shop.fits else min(own, shop.deviation_mm)


def _overtaken(mechanism: Mechanism) -> Iterator[Notice]:
    """A warning for a roller that presses into the wall that it drove, as gears slow the wheel."""
    lead = mechanism.engagements[0].overtaking / DEGREE
    if lead > 1e-6:  # degrees: less is rounding
        yield Notice(
            "roller-overtakes",
            f"the roller overtakes the wheel by {lead:.4g}° while the gears drive. Near the "
            "line of centres its slot would turn the wheel faster than the gears do. It presses "
            'into the wall that it drove: gear_ratio = "shockless" keeps it behind',
        )


def _rounded_points(mechanism: Mechanism) -> Iterator[Notice]:
    """A warning about the uncertainty of the jerk from the rounding of a file's points."""
    engagement, law = mechanism.engagements[0], mechanism.law
    doubt = law.doubt() if law else None
    if doubt is None:
        return
    decimals, move = doubt
    engagement = engagement.own  # the law holds by the angle of its shaft
    whole = (engagement.motion_deg * DEGREE) ** 3
    move *= 2.0 * engagement.half_step / whole
    fraction = move / peak(engagement.motion, "jerk").max
    if not fraction < 0.01:  # less is not worth a warning
        yield Notice(
            "rounded-points",
            f"the points have {decimals} decimals, so the jerk is known only to about "
            f"{float(f'{100.0 * fraction:.2g}'):g} %: use more decimals, or fewer points",
        )


def turns_back(mechanism: Mechanism) -> tuple[float, float] | None:
    """The least velocity and its input angle if the wheel turns back; else None."""
    if mechanism.law and not _law_turns_back(mechanism.law):
        return None
    engagement = mechanism.engagements[0]
    back = _least_velocity(engagement.motion)
    return back and (back[0], mechanism.shown_deg(engagement.mid_deg + back[1]))


@lru_cache(maxsize=128)
def _law_turns_back(law: Law) -> bool:
    """Return True if a wheel turns back with a law, whatever its step and its motion angle."""
    from geneva_cli.motion.path_and_motion import LawMotion

    return _least_velocity(LawMotion(-0.5, 0.5, 0.5, law)) is not None


def _least_velocity(motion: WheelMotion) -> tuple[float, float] | None:
    """The least velocity of a motion and its place if it is below 0; else None."""
    from geneva_cli.motion.peak_search import curves, search_motion

    result = search_motion(motion, curves(motion, ["velocity"]), sized=False)
    most, back = result.most[:, 0].tolist()
    # Where a law stands still, rounding leaves a few units in the last place on either side of 0.
    return (-back, result.x[1].item()) if back > 1e-12 * most else None


def _off_the_mid_condition(mechanism: Mechanism) -> Notice:
    matched = mechanism.matched_ratio
    helps = (
        f'ratio = "matched" (R/L = {matched:.6g}) avoids it'
        if matched is not None
        else "no R/L avoids it with this law and motion angle"
    )
    return Notice(
        "off-mid-condition",
        f"pressure angle 90° at mid-motion (0°), because R/L = {mechanism.ratio:.6g} does "
        "not meet the mid condition. Without friction the pin force there has no bound unless the "
        f"torque is zero: {helps}",
    )


def _not_driven(mechanism: Mechanism) -> Iterator[Notice]:
    from geneva_cli.loads.positive_drive import positive_drives

    drive = positive_drives(mechanism)
    if drive is None or not drive.loose_deg:
        return
    where = ", ".join(f"{round(a, 9):.4g} to {round(b, 9):.4g}" for a, b in drive.loose_deg)
    percent, gap_mm = 100.0 * drive.fraction.item(), drive.loose_gap_mm.item()
    yield Notice(
        "not-positively-driven",
        f"not positively driven from {where}° ({percent:.3g} % of the motion). The slot's other "
        f"branch, up to {gap_mm:.3g} mm off, cuts away the wall that the torque needs "
        "there. Less torque_Nm against the inertia shortens the interval; "
        'kind = "cam" drives any law through straight slots',
    )


def _undercut(mechanism: Mechanism) -> Iterator[Notice]:
    from geneva_cli.motion.undercut import undercut

    place = undercut(mechanism)
    if place is None or place.depth_mm < SHOWN_UNDERCUT:
        return
    r = mechanism.roller_radius_mm + mechanism.spec.size.allowances.slot_clearance_mm
    free = place.radius_mm - mechanism.spec.size.allowances.slot_clearance_mm
    helps = (
        "a smaller roller or a longer motion reduces it"
        if place.to_cusp or free <= 0.0
        else f"a roller radius below {free:.4g} mm avoids it"
    )
    yield Notice(
        "undercut",
        f"undercut of the {place.wall} flank from {place.from_deg:.4g} to {place.to_deg:.4g}°, "
        f"by up to {place.depth_mm:.3g} mm. The roller's radius, {r:.4g} mm, exceeds the radius "
        f"of curvature, {place.radius_mm:.4g} mm at {place.at_deg:.4g}°: {helps}",
    )
