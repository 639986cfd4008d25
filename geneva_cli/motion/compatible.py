"""What makes no machine: kinds, keys, sizes and tolerances that a spec cannot combine.

Each kind names its own rules; here are those of the core's drives, and those of sizes and
tolerances, whatever the kind.
"""

import math
from collections.abc import Iterator
from functools import partial, reduce
from operator import and_, or_
from typing import TypeAlias

from geneva_cli.errors import GenevaError, refuse, refuse_text
from geneva_cli.kept import load_named
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.kind import Kind
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.registry import KINDS
from geneva_cli.numerics.arrays import choose, smaller
from geneva_cli.spec.rules import is_array
from geneva_cli.spec.schema import SpecTable, fields

SAME_RATIO = 1e-6  # values of R/L that differ by less are the same, written with few digits
# keys below twice the centre distance, and below twice the crank's arm
_IN_WHEEL = (
    *("wheel_bore_mm", "wheel_hub_mm", "arm_hub_mm", "arm_eye_mm", "dial_bolt_mm"),
    *("gear_bolt_mm", "link_pin_mm", "link_bore_mm", "link_width_mm"),
)
_IN_CRANK = (
    *("crank_bore_mm", "crank_hub_mm", "arm_bore_mm", "lock_bolt_mm", "lock_bolt_circle_mm"),
)
# kinds of a spec, in the text of a conflict
GEARING, KIND = 'gearing = "{spec.wheel.NAME}"', 'kind = "{spec.drive.NAME}"'
BEFORE = 'kind = "{spec.drive_before.NAME}"'


# A combination that makes no machine if the first member is true (in a batch an array); the key to
# blame; and a text with values of the spec, as in ``{spec.wheel.z}``.
Conflict: TypeAlias = tuple[object, tuple[str, ...], str]


def refuse_conflicts(spec: Spec) -> None:
    """Raise GenevaError if the spec combines kinds or keys that make no machine together."""
    for when, key, text in _conflicts(spec):
        if is_array(when):
            refuse(when, partial(GenevaError, text))
        elif when:
            raise GenevaError(text.format(spec=spec), key)


def _conflicts(spec: Spec) -> Iterator[Conflict]:
    """The rules of a drive before another, of the kinds in the spec, and of sizes and a limit."""
    if spec.drive_before is not None:
        yield from _of_drive_before(spec, spec.drive_before)
    # the rules of the drive come first, then those of its wheel, then those of what adds to it
    for field in ("drive", "wheel", ""):
        for kind in KINDS:
            own = "drive" if kind.drive else "wheel" if kind.wheel else ""
            if kind.refuses and field == own and concerns(kind, spec):
                yield from load_named(kind.refuses)(spec)
    size, wheel = spec.size, spec.wheel
    has_horns = wheel.FLAT and spec.output.turns
    for key in ("mouth_radius_mm", "horn_tip_mm"):
        is_cut, place = getattr(size, key) > 0.0, ("size", key)
        text = f"{key} is for external and internal wheels, not {GEARING}: remove it"
        yield is_cut & (not has_horns), place, text
        text = f"{key} is for wheels with a recess behind every slot: remove it, or stop"
        yield is_cut & wheel.stopped, place, text
    if spec.limits.dwell_position_max_deg is not None:
        sizes = [key for key in spec.tolerance.as_dict() if key != "distribution"]
        exact = reduce(and_, (getattr(spec.tolerance, key) == 0.0 for key in sizes))
        text = f"dwell_position_max_deg needs one or more of {', '.join(sizes)} in [tolerance]"
        yield exact, ("limits", "dwell_position_max_deg"), text


def concerns(kind: Kind, spec: Spec) -> bool:
    """True if the spec has the kind, or sets a key of the kind's own."""
    if kind.name == (spec.drive.NAME if kind.drive else spec.wheel.NAME if kind.wheel else ""):
        return True
    for key in kind.keys:
        table, _, name = key.partition(".")
        of = vars(spec)[table]
        value, default = vars(of).get(name), getattr(type(of), name, None)
        if value is not default and (is_array(value) or value != default):
            return True
    return False


def _of_drive_before(spec: Spec, before: Drive) -> Iterator[Conflict]:
    """Rules on a drive that turns the shaft of another."""
    drive, key = spec.drive, ("drive", "before")
    text = f"{BEFORE} cannot turn the shaft of another drive: remove [drive.before]"
    yield not before.IN_FRONT, (*key, "kind"), text
    yield drive.FIRST, key, f"{BEFORE} cannot stand before {KIND}: {drive.FIRST}"
    text = "n_rpm, rollers and roller_angles_deg: set them in [drive], not in [drive.before]"
    yield is_set(before, Drive), key, text
    text = f"the crank of {KIND} is on the shaft: set {BEFORE} in [drive] instead"
    yield drive.direct and not (spec.motion or len(drive.cranks) > 1), key, text


def is_set(table: SpecTable, kind: type[SpecTable] | None = None) -> object:
    """True if a key of a table, or of its base, differs from its default; for a batch an array."""
    keys = fields(kind or type(table))
    return reduce(or_, (getattr(table, key.attribute) != key.default for key in keys))


def is_geared(spec: Spec) -> bool:
    """True if the spec's drive, or the one before it, has gears."""
    drives = (spec.drive, spec.drive_before) if spec.drive_before else (spec.drive,)
    return any(drive.gears or drive.round_gears for drive in drives)


def refuse_sizes(spec: Spec, L: float, ratio: float) -> None:
    """Raise GenevaError, naming the key, for a size that makes no machine with this R/L."""
    size, r, distance = spec.size, spec.size.roller_radius(L), f"the {spec.wheel.DISTANCE}"
    radius, given = size.crank_radius_mm, size.center_distance_mm
    if radius is not None and given is not None:  # a crank as built, of a kind that needs its R/L
        text = (
            "crank_radius_mm = {radius:.9g} and center_distance_mm = {L:.9g} have R/L = "
            "{given:.6g}, but this machine needs {ratio:.6g}; straight slots of an external or "
            "internal wheel on a crank or a side-crank are taken as built: crank_radius_mm = "
            "{own:.9g}, or center_distance_mm = {fitting_mm:.9g}, or leave one of them out"
        )
        if spec.motion is not None:
            text += "; or set ratio = {given:.9g} in [motion]"
        values = {"radius": radius, "L": L, "given": radius / L, "ratio": ratio, "own": ratio * L}
        values["fitting_mm"] = spec.drive.distance_mm(spec.wheel, spec.motion, radius)
        off = abs(radius / L - ratio) > SAME_RATIO
        refuse_text(off, ("size", "crank_radius_mm"), text, **values)
    farthest = "the roller's greatest distance from the wheel's axis"
    if not spec.output.turns:  # a rack has no axis: where its roller is farthest from the deepest
        farthest = f"twice {distance}"
    ratios = [ratio]
    if spec.wheel.steps:
        ratios = [math.sin(math.radians(0.5 * step)) for step in spec.wheel.steps]
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
                text = f"{key} = {{value:g}}: it must be below {{below:.6g}}, {meaning}{by}"
                refuse_text(value >= below, ("size", key), text, value=value, below=below)
    face, thick, edge = size.face_width_mm, size.wheel_thickness_mm, size.edge_mm
    if face is not None and thick is not None:
        text = "wheel_thickness_mm = {thick:g}: use at least {least:g}, face_width_mm and two edges"
        least = face + 2.0 * edge
        at = ("size", "wheel_thickness_mm")
        refuse_text(least > thick, at, text, thick=thick, least=least)
    for part in ("wheel", "crank"):
        bore, hub = getattr(size, f"{part}_bore_mm"), getattr(size, f"{part}_hub_mm")
        if bore is not None and hub is not None:
            text = f"{part}_hub_mm = {{hub:g}}: it must be at least {part}_bore_mm = {{bore:g}}, "
            inside, at = (hub > 0.0) & (hub < bore), ("size", f"{part}_hub_mm")
            refuse_text(inside, at, text + "or 0 for none", hub=hub, bore=bore)


def refuse_tolerances(spec: Spec, L: float, ratio: float) -> None:
    """Raise GenevaError, naming the key, for a tolerance that is too large or has no dimension."""
    given, lock = vars(spec.tolerance), spec.size.lock_radius_mm
    unlocked = (not spec.drive.LOCKS) | (lock == 0.0)
    steps = spec.wheel.steps
    arm = L * (math.sin(math.radians(0.5 * min(steps))) if steps else ratio)
    step = min(steps) if steps else 360.0 / spec.wheel.z
    roller = 2.0 * spec.size.roller_radius(L)
    slot = roller + 2.0 * spec.size.allowances.slot_clearance_mm
    disc = arm if lock is None else choose(lock == 0.0, arm, lock)
    for key in ("lock_radius_mm", "recess_radius_mm"):
        text = f"{key} = {{value:g}}: this machine has no locking disc; remove it"
        wrong = unlocked & (given[key] != 0.0)
        refuse_text(wrong, ("tolerance", key), text, value=given[key])
    for key, below, what in (
        ("center_distance_mm", L, "the centre distance"),
        ("crank_radius_mm", arm, "the crank's radius"),
        ("roller_diameter_mm", roller, "the roller's diameter"),
        ("slot_width_mm", slot, "the slot's width"),
        ("slot_angle_deg", 0.5 * step, "half the wheel's step"),
        ("lock_radius_mm", disc, "the locking disc's radius, or the crank's"),
        ("recess_radius_mm", disc, "the locking disc's radius, or the crank's"),
    ):
        text, value = f"{key} = ±{{value:g}}: it must be below {{below:.6g}}, {what}", given[key]
        refuse_text(value >= below, ("tolerance", key), text, value=value, below=below)


def other_wheels(spec: Spec) -> Conflict:
    """A wheel of another kind than those that the drive can drive."""
    able = next(kind.gearings for kind in KINDS if kind.drive and kind.name == spec.drive.NAME)
    text = f"{KIND} drives an {' or '.join(able)} wheel, not {GEARING}"
    return spec.wheel.NAME not in able, ("wheel", "gearing"), text


def several_rollers(spec: Spec) -> Iterator[Conflict]:
    """More than one roller, with a drive that carries one."""
    text, several = f"{KIND} carries one roller only", spec.wheel.steps
    yield spec.drive.rollers > 1, ("drive", "rollers"), text
    yield several or spec.drive.roller_angles_deg, ("drive", "kind"), text


def _not_radial(spec: Spec) -> Conflict:
    text = f"{KIND} needs one roller and radial slots: remove offset_mm, steps_deg and "
    wrong = spec.drive.roller_angles_deg or spec.wheel.skewed
    return wrong, ("drive", "kind"), text + "roller_angles_deg"


def of_pin_path(spec: Spec) -> Iterator[Conflict]:
    """Rules of a drive whose roller has a path of its own."""
    yield _not_radial(spec)
    yield other_wheels(spec)
    text = f"{KIND} sets the path of the roller, and the slots are straight: remove law"
    yield spec.motion is not None, ("motion", "law"), text
    yield from several_rollers(spec)


def of_cam(spec: Spec) -> Iterator[Conflict]:
    """Rules of a roller in a groove that a law gives."""
    yield _not_radial(spec)
    yield other_wheels(spec)
    text = f"{KIND} needs a law in [motion]: the groove is cut for it"
    yield spec.motion is None, ("drive", "kind"), text


def of_transmission(spec: Spec) -> Iterator[Conflict]:
    """Rules of a roller on a crank: of the slots that a law gives, then of several rollers."""
    drive, wheel, law = spec.drive, spec.wheel, spec.motion is not None
    angles, rollers = ("drive", "roller_angles_deg"), ("drive", "rollers")
    text = "{} is for straight slots, and a law makes curved slots: remove one of them"
    yield law and wheel.steps, ("wheel", "steps_deg"), text.format("steps_deg")
    yield law and wheel.skewed, ("wheel", "offset_mm"), text.format("offset_mm")
    text = f"{GEARING} has straight slots only: remove law"
    yield law and not wheel.FLAT, ("motion", "law"), text
    placed = len(wheel.steps or drive.roller_angles_deg or ())
    text = f"each of the {placed} steps has a roller: roller_angles_deg needs as many angles"
    yield wheel.steps and len(drive.roller_angles_deg or wheel.steps) != placed, angles, text
    what = "steps" if wheel.steps else "angles"
    text = f"rollers = {{spec.drive.rollers}}, but there are {placed} {what}: remove rollers"
    yield placed and drive.rollers not in (1, placed), rollers, text
    yield law and drive.roller_angles_deg, angles, "roller_angles_deg is for straight slots: remove"
    text = "several rollers move the wheel differently, so one curved slot cannot serve them: use "
    text += "rollers = 1, or straight slots (no law)"
    yield law and drive.rollers > 1 and not drive.direct, rollers, text


def of_crank(spec: Spec) -> Iterator[Conflict]:
    """Rules of a plain crank, or of several about one wheel."""
    yield from of_transmission(spec)
    drive, wheel, steps = spec.drive, spec.wheel, ("drive", "crank_steps")
    places = drive.cranks
    several = len(places) > 1
    text = f"crank_steps needs an external wheel, not {GEARING}: remove crank_steps"
    able = wheel.FLAT and spec.output.turns and wheel.SIGN > 0.0
    yield several and not able, steps, text
    text = "crank_steps must begin with 0 and hold different whole numbers below {spec.wheel.z}"
    broken = [*map(int, places)] != [*places]
    wrong = broken or places[0] != 0.0 or len({*places}) < len(places)
    yield wrong | (max(places) >= wheel.z), steps, text
    if not several:
        return
    text = "a wheel of unequal steps looks different from each crank of crank_steps: remove one"
    yield wheel.steps, ("wheel", "steps_deg"), text
    text = "the cranks of crank_steps are equal and work in even turns: remove roller_angles_deg"
    yield drive.roller_angles_deg, ("drive", "roller_angles_deg"), text
    count = len(places)
    text = f"crank_steps places {count} cranks with one roller each: set rollers = {count}"
    yield drive.rollers != count, ("drive", "rollers"), text
    text = (
        "each crank of crank_steps pushes the wheel from another side, and would move a body off "
    )
    text += "its axis differently: set count to 2 or more, or radius_mm = 0"
    yield spec.unbalanced, ("mass", "radius_mm"), text
    text = "[tolerance] has no key for the places of the cranks of crank_steps: remove one of them"
    yield is_set(spec.tolerance), ("tolerance",), text
