"""Warnings about a machine's motion and slots: the problem, its place, and a remedy."""

import math
from collections.abc import Iterator
from functools import lru_cache

from geneva_cli.errors import Notice
from geneva_cli.motion.laws.law import Law
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.spec.tables import Z_USUAL
from geneva_cli.spec.workshops import WORKSHOPS, closest_mm, loosest_mm

SHOWN_UNDERCUT = 0.005  # mm: a wall cut back by less is within a shop's tolerance


def motion_warnings(mechanism: Mechanism) -> Iterator[Notice]:
    """The warnings about a machine that need neither its loads nor its parts."""
    spec, L, engagement = mechanism.spec, mechanism.center_distance_mm, mechanism.engagements[0]
    z, size, drive = spec.wheel.z, spec.size, spec.drive
    if z > Z_USUAL and mechanism.output.turns:  # a rack only becomes longer
        text = f"z = {z}: more than {Z_USUAL} slots leave little of the wheel between them"
        yield Notice("many-slots", text)
    if spec.dwell_holder is None:
        text = 'nothing holds the wheel in the dwell: set held_by = "brake", "detent" or "pin"'
        yield Notice("nothing-holds", text)
    # the rim depends on the centre distance; some drives solve for it
    given = size.center_distance_mm is not None or size.crank_radius_mm is not None
    if size.wheel_radius_mm is not None and not given and spec.given_distance_mm == L:
        text = f"wheel_radius_mm = {size.wheel_radius_mm:g} is given without a centre distance, so "
        text += f"L = {L:g} mm is taken: set center_distance_mm in [size]"
        yield Notice("no-centre-distance", text)
    if drive.stop_s:
        brake, start = drive.brake_and_start_deg
        least = min(map(mechanism.dwell_deg, range(len(mechanism.engagements))))
        if not keeps(brake + start, "at most", least):
            text = f"the input turns {brake:.4g}° while it brakes and {start:.4g}° while it "
            text += f"starts, but the dwell has only {least:.4g}°: at this speed brake_s and "
            text += f"start_s may take {least / (3.0 * drive.n_rpm):.4g} s together"
            yield Notice("stop-in-motion", text)
    if engagement.built is not None:
        needed = spec.wheel.place(spec.wheel.step, L).ratio
        text = f"crank_radius_mm = {size.crank_radius_mm:.9g} and center_distance_mm = {L:.9g} "
        text += f"have R/L = {mechanism.ratio:.6g}, but the slots need {needed:.6g}: taken as "
        text += "built, with an impact that the loads leave out (the check entry_velocity_max)"
        yield Notice("taken-as-built", text)
    yield from _fits(mechanism)
    if mechanism.law:
        yield from _of_law(mechanism, mechanism.law)


def _fits(mechanism: Mechanism) -> Iterator[Notice]:
    """Clearances larger than the loosest running fit, or the process, needs; and too small ones."""
    size, disc = mechanism.spec.size, mechanism.spec.size.lock_radius_mm
    pairs = [("slot_clearance_mm", "roller", "slot", mechanism.roller_radius_mm)]
    if mechanism.spec.has_lock:
        radius = mechanism.ratio * mechanism.center_distance_mm if disc is None else disc
        pairs.append(("lock_clearance_mm", "locking disc", "recess", radius))
    shop = WORKSHOPS[size.process]
    for key, part, mate, radius in pairs:
        clearance, fit = getattr(size, key), loosest_mm(2.0 * radius)
        if clearance is None:
            continue
        own = getattr(size.replace(**{key: None}).allowances, key)  # that of the process
        most, least = max(0.5 * (fit or math.inf), own), 0.0
        # what plates need that a laser cuts is known with their thickness (``warnings``); at
        # nominal sizes the fits of the sheet make the clearance
        is_cut = shop.cut_mm is not None and mechanism.spec.is_flat
        if size.process is not None and not (is_cut or (shop.fits and clearance == 0.0)):
            if shop.cut_mm:  # a cut's clearance is its deviation
                least = own
            elif shop.fits:
                least = 0.5 * (closest_mm(2.0 * radius) or 0.0)
            else:
                least = min(own, shop.deviation_mm)
        if not keeps(clearance, "at most", most):
            helps = "" if size.process else ", or name the process that needs it"
            text = f"{key} = {clearance:g}: the {part} is loose in its {mate}. At Ø "
            text += f"{2.0 * radius:.4g} mm the loosest running fit of ISO 286, H11/c11, leaves at "
            text += f"most {0.5 * (fit or 0.0):.4g} mm a side: reduce {key} to {most:.4g}{helps}"
            yield Notice("loose-fit", text)
        elif not keeps(clearance, "at least", least):
            text = f'{key} = {clearance:g}: with process = "{size.process}" {part} and {mate} '
            text += f"(Ø {2.0 * radius:.4g} mm) are off by up to {least:.4g} mm a side together, "
            text += f"and may not go together: set {key} to {least:.4g}"
            yield Notice("narrow-for-process", text)


def _of_law(mechanism: Mechanism, law: Law) -> Iterator[Notice]:
    """Warnings about a wheel that follows a law, and about its slots."""
    from geneva_cli.motion.path_and_slot import retraces

    engagement = mechanism.engagements[0]
    if doubt := law.doubt():  # points of a file that round the jerk
        from geneva_cli.motion.peaks import peak

        own = engagement.own  # the law holds by the angle of its shaft
        move = doubt[1] * 2.0 * own.half_step / (own.motion_deg * DEGREE) ** 3
        fraction = move / peak(own.motion, "jerk").max
        if not fraction < 0.01:  # less is not worth a warning
            text = f"the points have {doubt[0]} decimals, so the jerk is known only to about "
            text += f"{float(f'{100.0 * fraction:.2g}'):g} %: use more decimals, or fewer points"
            yield Notice("rounded-points", text)
    if back := turns_back(mechanism):
        text = f"the wheel turns back: velocity {back[0]:.4g} at {back[1]:.4g}°"
        yield Notice("turns-back", text)
    if engagement.slot.curved and not retraces(engagement):
        matched, helps = mechanism.matched_ratio, "no R/L avoids it with this law and motion angle"
        if matched is not None:
            helps = f'ratio = "matched" (R/L = {matched:.6g}) avoids it'
        text = f"pressure angle 90° at mid-motion (0°), because R/L = {mechanism.ratio:.6g} does "
        text += f"not meet the mid condition: {helps}"
        yield Notice("off-mid-condition", text)
    if max(abs(half(0.0, 2).derivatives()[2]) for half in (law.first, law.second)) > 1e-9:
        text = f'the law "{law.NAME}" starts and stops with a jump in acceleration: a soft shock '
        yield Notice("soft-shock-at-ends", text + "at both ends")
    if abs(law.first(0.5, 2).derivatives()[2] + law.second(0.5, 2).derivatives()[2]) > 1e-9:
        text = f'the law "{law.NAME}" jumps from acceleration to deceleration: a soft shock at '
        yield Notice("soft-shock-at-mid", text + "mid-motion")
    yield from _of_slots(mechanism)


def _of_slots(mechanism: Mechanism) -> Iterator[Notice]:
    """Warnings about slots whose walls are missing where they would drive the wheel."""
    from geneva_cli.motion.undercut import undercut

    if mechanism.engagements[0].slot.curved:
        from geneva_cli.loads.positive_drive import positive_drives

        driven = positive_drives(mechanism)
        if driven is not None and driven.loose_deg:
            where = ", ".join(
                f"{round(a, 9):.4g} to {round(b, 9):.4g}" for a, b in driven.loose_deg
            )
            percent, gap_mm = 100.0 * driven.fraction.item(), driven.loose_gap_mm.item()
            text = f"not positively driven from {where}° ({percent:.3g} % of the motion): the "
            text += f"slot's other branch, up to {gap_mm:.3g} mm off, cuts away the wall that the "
            text += 'torque needs. Less torque_Nm against the inertia helps; kind = "cam" drives '
            text += "any law"
            yield Notice("not-positively-driven", text)
    place = undercut(mechanism)
    if place is not None and place.depth_mm >= SHOWN_UNDERCUT:
        clearance = mechanism.spec.size.allowances.slot_clearance_mm
        free, helps = place.radius_mm - clearance, "a smaller roller or a longer motion reduces it"
        if not place.to_cusp and free > 0.0:
            helps = f"a roller radius below {free:.4g} mm avoids it"
        text = f"undercut of the {place.wall} flank from {place.from_deg:.4g} to "
        text += f"{place.to_deg:.4g}°, by up to {place.depth_mm:.3g} mm: the roller's radius "
        text += f"exceeds that of curvature, {place.radius_mm:.4g} mm at {place.at_deg:.4g}°: "
        yield Notice("undercut", text + helps)


@lru_cache(maxsize=16)
def turns_back(mechanism: Mechanism) -> tuple[float, float] | None:
    """The least velocity and its input angle if the wheel turns back; else None."""
    from geneva_cli.motion.peak_search import curves, search_motion

    engagement = mechanism.engagements[0]
    result = search_motion(engagement.motion, curves(engagement.motion, ["velocity"]), sized=False)
    most, back = result.most[:, 0].tolist()
    # Where a law stands still, rounding leaves a few units in the last place on either side of 0.
    if back <= 1e-12 * most:
        return None
    return -back, mechanism.shown_deg(engagement.mid_deg + result.x[1].item())
