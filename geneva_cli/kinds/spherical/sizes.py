"""The sizes of a spherical wheel and its crank: angles at the sphere's centre, in radians.

All walls lead to the centre, and so does the surface of the roller, a cone. Its radius, the slots
and the clearances are arcs on the sphere of radius ``center_distance_mm``. Radii of the lock and of
bores are distances from their axes. Below the wheel on a plane is outside the wheel here: a height
above the wheel's lower face is a distance inwards from its outer sphere.
"""

from __future__ import annotations

import math
from contextlib import suppress
from functools import lru_cache
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.sphere import Region
from geneva_cli.kinds.spherical.ball import Ball, PartDoesNotFit, crank_hub, inner_edge, wheel_axle
from geneva_cli.kinds.spherical.regions import sectors
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.rollers import places
from geneva_cli.numerics.preferred import to_digits
from geneva_cli.numerics.roots import boundary
from geneva_cli.parts.machine_sizes import (
    keys_by_load,
    lock_between,
    refuse_edges,
    require_lock_between,
)
from geneva_cli.parts.sizes import (
    NO_SIZES,
    KeySizes,
    arm_bore,
    drawn_thicknesses,
    hole_radius,
    hub_and_eye,
    pin_radius,
    refuse_stepped_shaft,
    refuse_wide_pin,
)
from geneva_cli.spec.default_sizes import Thicknesses, value_or
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.spec.tables import Z_DRAWN, Size

if TYPE_CHECKING:
    from geneva_cli.parts.stressed import Stressed


def fitted(mechanism: Mechanism, advice: bool = True) -> tuple[Ball, list[Region]]:
    """Return the sizes of a spherical machine, and its locking sectors.

    Raises GenevaError, naming the key, where they leave no wheel or no lock. With ``advice`` the
    message names the largest roller that fits, if there is one.
    """

    def fits(roller_mm: float) -> bool:
        spec = mechanism.spec.with_("size.roller_radius_mm", roller_mm)
        try:
            sectors(ball(mechanism._replace(spec=spec)))
        except GenevaError:
            return False
        return True

    try:
        sizes = ball(mechanism)
        return sizes, sectors(sizes)
    except PartDoesNotFit as error:
        # 10 halvings give the two digits that are shown
        most = advice and boundary(fits, 0.0, mechanism.roller_radius_mm, 10)
        if not most:
            raise
        text = f"{error}; a roller of {to_digits(most, 2, math.floor):g} mm fits"
        raise GenevaError(text, error.key) from None


def ball(mechanism: Mechanism) -> Ball:
    """Return the sizes of a spherical machine.

    Those that the spec leaves out are as large as its load needs. Raises GenevaError, naming the
    key, where they leave no wheel or no lock.
    """
    usual = _ball(mechanism, mechanism.spec.size.wheel_thickness_mm)
    if not mechanism.spec.is_loaded:
        return usual
    from geneva_cli.kinds.spherical.loaded_ball import horn_thickness_mm, sphere_load_sizes

    thick = horn_thickness_mm(mechanism, usual)
    if thick is not None:
        usual = _ball(mechanism, thick)
    return sphere_load_sizes(mechanism, usual)


@lru_cache(maxsize=16)
def sized_ball(mechanism: Mechanism) -> Ball | None:
    """Return the cached sizes of a spherical machine; None where it has no parts."""
    try:
        return ball(mechanism) if mechanism.spec.has_parts else None
    except GenevaError:
        return None  # the check of the parts reports the error


def stressed(mechanism: Mechanism) -> Stressed | None:
    """Return the sizes of stressed parts; None if the sizes leave no shells."""
    from geneva_cli.kinds.spherical.loaded_ball import sphere_stressed

    sizes = sized_ball(mechanism)
    return sphere_stressed(mechanism.spec, sizes) if sizes else None


def key_sizes(mechanism: Mechanism) -> KeySizes:
    """Return the sizes of a spherical machine by the keys of the spec; none without parts."""
    sizes = sized_ball(mechanism)
    if sizes is None:
        return NO_SIZES
    size = mechanism.spec.size
    spans = {"wheel": sizes.span_mm, "lock": sizes.lock_span_mm, "arm": sizes.arm_span_mm}
    # the digits beyond the twelfth are rounding of the faces' radii
    thick = {f"{part}_thickness_mm": _less(*span) for part, span in spans.items()}
    known = {
        "slot_bottom_clearance_mm": _bottom_mm(size, mechanism.roller_radius_mm),
        "lock_radius_mm": sizes.lock_mm,
        "wheel_bore_mm": 2.0 * sizes.bore_mm,
        "pin_mm": 2.0 * sizes.pin_mm,
    }
    if sizes.arm_bore_mm:
        known["arm_bore_mm"] = 2.0 * sizes.arm_bore_mm
        with suppress(GenevaError):  # reported by the check of the parts
            pin, passing = hole_radius(size, sizes.pin_mm), sizes.passing_mm(sizes.opening_mm)
            wall = wall_min(size, sizes.radius_mm)
            hub, eye = hub_and_eye(size, wall, pin, sizes.arm_bore_mm, passing)
            known |= {"arm_hub_mm": 2.0 * hub, "arm_eye_mm": 2.0 * eye}
    return KeySizes(known | thick, keys_by_load(mechanism, bool(sizes.recess)))


def _less(inside: float, outside: float) -> float:
    return float(f"{outside - inside:.12g}")


def horn_sizes(mechanism: Mechanism) -> tuple[float, float, float] | None:
    """Return the angles of half a slot, the recess and the shafts; None without parts."""
    sizes = sized_ball(mechanism)
    return (sizes.half_width, sizes.recess, sizes.axes) if sizes else None


def _ball(mechanism: Mechanism, thickness_mm: float | None) -> Ball:
    """Return the sizes for a thickness of the wheel, or else its default."""
    spec, L, radius_mm = mechanism.spec, mechanism.center_distance_mm, mechanism.roller_radius_mm
    size, z, allowed = spec.size, spec.wheel.z, spec.size.allowances
    if z > Z_DRAWN:
        raise GenevaError(f"z = {z}: parts are drawn up to {Z_DRAWN} slots", ("wheel", "z"))
    first, *others = places(spec.wheel, spec.drive, spec.given_distance_mm)
    arm = math.atan2(first.ratio, first.cone)
    engagement = mechanism.engagements[0]
    mouth, deepest = (float(engagement.slot(x, 0)[0].c[0]) for x in (engagement.entry_deg, 0.0))
    axes = deepest + arm
    roller = radius_mm / L
    w = roller + allowed.slot_clearance_mm / L
    bottom = deepest - _bottom_mm(size, radius_mm) / L
    # the roller touches the wall that faces the crank's axis at the foot of the perpendicular
    rim = math.acos(math.cos(mouth) * math.cos(w))
    if bottom <= 0.0 or math.sin(bottom) * math.sin(math.pi / z) <= math.sin(w):
        raise PartDoesNotFit(
            "the slots meet near their ends: reduce roller_radius_mm, slot_clearance_mm or "
            f"slot_bottom_clearance_mm, or use fewer than {z} slots",
            ("size", "roller_radius_mm"),
        )
    thick = drawn_thicknesses(size.replace(wheel_thickness_mm=thickness_mm), L)
    pin = pin_radius(size, radius_mm)
    _refuse_thick(thick, size, L, roller, pin)
    refuse_edges(size, min(thick.wheel, thick.lock, thick.arm))
    inside, outside = L - 0.5 * thick.wheel, L + 0.5 * thick.wheel
    under = outside + allowed.pin_gap_mm  # the arm's inner face, on which the sectors stand
    bore, hub = wheel_axle(spec, L, inside, bottom - w)
    lock_mm = _lock_mm(mechanism, arm - w, abs(axes - rim), roller)
    lock = math.asin(lock_mm / L)
    turns = [p.crank_deg for p in (first, *others)]
    if len(turns) == 1:
        turns = [360.0 * i / spec.drive.rollers for i in range(spec.drive.rollers)]
    ball = Ball(
        radius_mm=L,
        z=z,
        axes=axes,
        arm=arm,
        half_motion=math.radians(first.half_motion_deg),
        rollers=tuple(math.radians(t) for t in turns),
        roller=roller,
        half_width=w,
        bottom=bottom,
        mouth=mouth,
        rim=rim,
        inner=inner_edge(bottom - w, roller, math.asin(max(bore, hub) / inside)),
        lock=lock,
        lock_mm=lock_mm,
        recess=lock + allowed.lock_clearance_mm / L if lock else 0.0,
        span_mm=(inside, outside),
        lock_span_mm=(under - thick.lock, under),
        arm_span_mm=(under, under + thick.arm),
        bore_mm=bore,
        hub_mm=hub,
        pin_mm=pin,
        arm_bore_mm=_arm_bore(spec, pin, L, arm),
        about_crank_mm=max(0.5 * (size.crank_bore_mm or 0.0), crank_hub(size, L)),
    )
    if ball.inner <= 0.0:
        raise PartDoesNotFit(
            "the wheel's middle is not open: the slots end within a roller's width of its axis; "
            "set a wheel_bore_mm or reduce the roller",
            ("size", "wheel_bore_mm"),
        )
    # a horn thinner than a thousandth of half a step counts as none
    if ball.opened + ball.corner > (1.0 - 1e-3) * ball.half_step:
        raise PartDoesNotFit(
            "no horn is left between slot and recess at the rim: reduce lock_radius_mm",
            ("size", "lock_radius_mm"),
        )
    return ball


def _bottom_mm(size: Size, roller_mm: float) -> float:
    """Return the clearance of the deepest roller from the end of its slot."""
    usual = max(size.allowances.slot_clearance_mm, roller_mm / 20.0)
    return value_or(size.slot_bottom_clearance_mm, usual)


def _arm_bore(spec: Spec, pin: float, L: float, arm: float) -> float:
    """Return the radius of the bore in the arm's hub; 0 without a crank, or without pins."""
    if not (spec.drive.crank and pin):
        return 0.0
    disc, space = 0.5 * (spec.size.crank_bore_mm or 0.0), L * arm - hole_radius(spec.size, pin)
    refuse_stepped_shaft(spec.size, disc, L)
    return arm_bore(spec, disc, L, space)


def _lock_mm(mechanism: Mechanism, limit: float, least: float, roller: float) -> float:
    """Return the radius of the locking sectors' edge about the crank's axis, 0 for none."""
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    if not mechanism.spec.has_lock:
        return 0.0
    limit -= size.allowances.lock_clearance_mm / L
    low, high = (L * math.sin(max(0.0, x)) for x in (least, limit))
    if limit <= least:
        raise PartDoesNotFit(
            f"the locking sector does not fit: lock_radius_mm must be above {low:.4g} to reach the "
            f"rim, but the roller limits it to {high:.4g}; 0 omits it",
            ("size", "lock_radius_mm"),
        )
    if size.lock_radius_mm is None:
        return L * math.sin(lock_between(least, limit, roller))
    require_lock_between(size.lock_radius_mm, low, high)
    return size.lock_radius_mm


def _refuse_thick(thick: Thicknesses, size: Size, L: float, roller: float, pin_mm: float) -> None:
    if thick.wheel >= L:
        raise GenevaError(
            f"wheel_thickness_mm = {thick.wheel:g}: half of it lies inside the sphere of radius "
            f"{L:g} mm; it must be below {L:g}",
            ("size", "wheel_thickness_mm"),
        )
    most = L + 0.5 * thick.wheel + size.allowances.pin_gap_mm
    if thick.lock >= most:
        raise GenevaError(
            f"lock_thickness_mm = {thick.lock:g}: the locking sectors reach inwards from the arm, "
            f"which is {most:g} mm from the sphere's centre; it must be below {most:g}",
            ("size", "lock_thickness_mm"),
        )
    refuse_wide_pin(size, pin_mm, (L - 0.5 * thick.wheel) * math.sin(roller))
