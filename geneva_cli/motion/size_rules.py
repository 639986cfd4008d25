"""Sizes and tolerances that make no machine, whatever the other sizes: refused as it is built."""

from __future__ import annotations

import math

from geneva_cli.errors import refuse_text
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics.arrays import Truth, choose, smaller

SAME_RATIO = 1e-6  # values of R/L that differ by less are the same, written with few digits
# keys below twice the centre distance, and below twice the crank's arm
_IN_WHEEL = (
    *("wheel_bore_mm", "wheel_hub_mm", "arm_hub_mm", "arm_eye_mm", "dial_bolt_mm"),
    *("gear_bolt_mm", "link_pin_mm", "link_bore_mm", "link_width_mm"),
)
_IN_CRANK = (
    *("crank_bore_mm", "crank_hub_mm", "arm_bore_mm", "lock_bolt_mm", "lock_bolt_circle_mm"),
)


def _refuse(when: Truth, key: tuple[str, str], text: str, **values: object) -> None:
    refuse_text(when, key, text, key=key[1], **values)


def refuse_sizes(spec: Spec, L: float, ratio: float) -> None:
    """Raise GenevaError, naming the key, for a size that makes no machine with this R/L."""
    size, r, distance = spec.size, spec.roller_radius_mm(L), f"the {spec.wheel.DISTANCE}"
    radius, given = size.crank_radius_mm, size.center_distance_mm
    if radius is not None and given is not None:  # a crank as built, of a kind that needs its R/L
        text = (
            "{key} = {radius:.9g} and center_distance_mm = {L:.9g} have R/L = {given:.6g}, but "
            "this machine needs {ratio:.6g}; straight slots of an external or internal wheel on a "
            "crank or a side-crank are taken as built: {key} = {own:.9g}, or center_distance_mm = "
            "{fitting_mm:.9g}, or leave one of them out"
        )
        if spec.motion is not None:
            text += "; or set ratio = {given:.9g} in [motion]"
        values = {"radius": radius, "L": L, "given": radius / L, "ratio": ratio, "own": ratio * L}
        values["fitting_mm"] = spec.drive.distance_mm(spec.wheel, spec.motion, radius)
        off = abs(radius / L - ratio) > SAME_RATIO
        _refuse(off, ("size", "crank_radius_mm"), text, **values)
    farthest = "the roller's greatest distance from the wheel's axis"
    if not spec.output.turns:  # a rack has no axis: where its roller is farthest from the deepest
        farthest = f"twice {distance}"
    ratios = [math.sin(math.radians(0.5 * step)) for step in spec.wheel.steps] or [ratio]
    short, long = L * min(ratios), L * max(ratios)
    narrow, what = short, "the crank's arm"
    if not spec.drive.ONE_ARM:
        short = long = narrow = L  # a roller whose arm changes has no fixed arm length
        what = distance
    elif spec.wheel.FLAT and spec.wheel.SIGN > 0.0:
        narrow = smaller(short, L - long)
        what = "the smaller of the crank radius R and the rest of the centre distance, L - R"
    allowed = size.allowances._asdict()  # from the process, where a key is left out
    for below, meaning, keys in (
        (narrow, what, ("roller_radius_mm", "slot_clearance_mm")),
        (short, "the crank's arm", ("lock_radius_mm", "lock_clearance_mm")),
        (L, distance, ("slot_bottom_clearance_mm", "relief_clearance_mm")),
        (L + long, farthest, ("wheel_radius_mm",)),
        (2.0 * L, f"twice {distance}", _IN_WHEEL),
        (2.0 * short, "twice the crank's arm", _IN_CRANK),
        (2.0 * r, "the roller's diameter", ("pin_mm", "press_fit_mm", "shaft_fit_mm")),
        (4.0 * L, f"four times {distance}", ("dial_bolt_circle_mm", "gear_bolt_circle_mm")),
    ):
        for key in keys:
            own = getattr(size, key)
            value = allowed.get(key, own)
            if value is not None:
                by = "" if own is not None else f'; the value comes from process = "{size.process}"'
                text = "{key} = {value:g}: it must be below {below:.6g}, " + meaning + by
                _refuse(value >= below, ("size", key), text, value=value, below=below)
    face, thick, edge = size.face_width_mm, size.wheel_thickness_mm, size.edge_mm
    if face is not None and thick is not None:
        text = "{key} = {thick:g}: the contact line cannot be longer than the wheel is thick; use "
        text += "at least face_width_mm = {face:g}"
        if isinstance(edge, (int, float)) and edge > 0.0:
            text += " and two edges of {edge:g}"
        at, values = ("size", "wheel_thickness_mm"), {"thick": thick, "face": face, "edge": edge}
        _refuse(face + 2.0 * edge > thick, at, text, **values)
    for part in ("wheel", "crank"):
        bore, hub = getattr(size, f"{part}_bore_mm"), getattr(size, f"{part}_hub_mm")
        if bore is not None and hub is not None:
            text = "{key} = {hub:g}: a hub must be larger than its bore: at least "
            text += f"{part}_bore_mm = {{bore:g}}, or 0 for none"
            inside = (hub > 0.0) & (hub < bore)
            _refuse(inside, ("size", f"{part}_hub_mm"), text, hub=hub, bore=bore)


def refuse_tolerances(spec: Spec, L: float, ratio: float) -> None:
    """Raise GenevaError, naming the key, for a tolerance that is too large or has no dimension."""
    values, lock = vars(spec.tolerance), spec.size.lock_radius_mm
    unlocked = (not spec.drive.LOCKS) | (lock == 0.0)
    steps = spec.wheel.steps
    arm = L * (math.sin(math.radians(0.5 * min(steps))) if steps else ratio)
    step = min(steps) if steps else 360.0 / spec.wheel.z
    roller = 2.0 * spec.roller_radius_mm(L)
    slot = roller + 2.0 * spec.size.allowances.slot_clearance_mm
    disc = arm if lock is None else choose(lock == 0.0, arm, lock)
    for key in ("lock_radius_mm", "recess_radius_mm"):
        text = "{key} = {value:g}: this machine has no locking disc; remove it"
        _refuse(unlocked & (values[key] != 0.0), ("tolerance", key), text, value=values[key])
    for key, below, what in (
        ("center_distance_mm", L, "the centre distance"),
        ("crank_radius_mm", arm, "the crank's radius"),
        ("roller_diameter_mm", roller, "the roller's diameter"),
        ("slot_width_mm", slot, "the slot's width"),
        ("slot_angle_deg", 0.5 * step, "half the wheel's step"),
        ("lock_radius_mm", disc, "the locking disc's radius, or the crank's"),
        ("recess_radius_mm", disc, "the locking disc's radius, or the crank's"),
    ):
        text = "{key} = ±{value:g} is as large as the dimension itself: it must be below "
        text, value = text + "{below:.6g}, " + what, values[key]
        _refuse(value >= below, ("tolerance", key), text, value=value, below=below)
