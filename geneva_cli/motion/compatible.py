"""What makes no machine: kinds, keys, sizes and tolerances that a spec cannot combine.

Each kind names its own rules; here are those of the core's drives, and those of sizes and
tolerances, whatever the kind.
"""

import math
from collections.abc import Iterator
from functools import partial, reduce
from operator import and_
from typing import TypeAlias, cast

from geneva_cli.errors import GenevaError, refuse, refuse_size, refuse_text
from geneva_cli.kept import load_named
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.kind import Kind
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.registry import KINDS
from geneva_cli.numerics.arrays import Truth, choose, smaller
from geneva_cli.spec.rules import is_array
from geneva_cli.spec.schema import SpecTable

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
ONE_ROLLER = "drive.rollers drive.roller_angles_deg wheel.steps_deg"  # unset for one roller
HORNS = "size.mouth_radius_mm size.horn_tip_mm"  # of a wheel with a recess behind every slot
BELOW = "it must be below {below:.6g}, {what}"
UNBALANCED = "set count to 2 or more, or radius_mm = 0"  # what to do


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
    for kind in KINDS:
        if kind.gearings and kind.name == spec.drive.NAME:
            text = f"{KIND} drives an {' or '.join(kind.gearings)} wheel, not {GEARING}"
            yield spec.wheel.NAME not in kind.gearings, ("wheel", "gearing"), text
        if kind.refuses and concerns(kind, spec):
            yield from load_named(kind.refuses)(spec)
    if not (spec.wheel.FLAT and spec.output.turns):
        yield from unset(spec, HORNS, f"is for external and internal wheels, not {GEARING}")
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
        own = is_set(vars(spec)[table], name)
        if is_array(own) or own:
            return True
    return False


def is_set(table: SpecTable, key: str = "") -> Truth:
    """True if a key of a table, or any, differs from its default; for a batch an array."""
    kind, out = type(table), cast("Truth", False)
    for name in (key,) if key else kind._parameters:
        out = out | (vars(table).get(name) != getattr(kind, name, None))
    return out


def unset(spec: Spec, keys: str, why: str) -> Iterator[Conflict]:
    """Rules of tables and keys, as ``load.mass_kg``, that must not be set; why is behind each."""
    for word in keys.split():
        table, _, key = word.partition(".")
        of, place = vars(spec)[table], (table, key) if key else (table,)
        if of is not None:
            yield is_set(of, key), place, f"{key or f'[{table}]'} {why}: remove it"


def _of_drive_before(spec: Spec, before: Drive) -> Iterator[Conflict]:
    """Rules on a drive that turns the shaft of another."""
    drive, key = spec.drive, ("drive", "before")
    text = f"{BEFORE} cannot turn the shaft of another drive: remove [drive.before]"
    yield not before.IN_FRONT, (*key, "kind"), text
    yield drive.FIRST, key, f"{BEFORE} cannot stand before {KIND}: {drive.FIRST}"
    for name in Drive._parameters:
        text = f"{name} is for [drive]: set it there, not in [drive.before]"
        yield is_set(before, name), (*key, name), text
    text = f"the crank of {KIND} is on the shaft: set {BEFORE} in [drive] instead"
    yield drive.direct and not (spec.motion or len(drive.cranks) > 1), key, text


def is_geared(spec: Spec) -> bool:
    """True if the spec's drive, or the one before it, has gears."""
    drives = (spec.drive, spec.drive_before) if spec.drive_before else (spec.drive,)
    return any(drive.gears or drive.round_gears for drive in drives)


def refuse_sizes(spec: Spec, L: float, ratio: float) -> None:
    """Raise GenevaError, naming the key, for a size that makes no machine with this R/L."""
    size, r, distance = spec.size, spec.size.roller_radius(L), f"the {spec.wheel.DISTANCE}"
    radius, given = size.crank_radius_mm, size.center_distance_mm
    if radius is not None and given is not None:  # a crank as built, of a kind that needs its R/L
        text = "with center_distance_mm it has R/L = {given:.9g}, but this machine "
        text += "needs {ratio:.9g}: set crank_radius_mm = {fit:.9g}, or leave one of them out"
        if spec.motion is not None:
            text += "; or set ratio = {given:.9g} in [motion]"
        off, values = abs(radius / L - ratio) > SAME_RATIO, {"ratio": ratio, "given": radius / L}
        refuse_size(off, "crank_radius_mm", text, radius, fit=ratio * L, **values)
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
                refuse_size(value >= below, key, BELOW, value, below=below, what=meaning + by)
    face, thick, edge = size.face_width_mm, size.wheel_thickness_mm, size.edge_mm
    if face is not None and thick is not None:
        text, least = "use at least {least:g}, face_width_mm and two edges", face + 2.0 * edge
        refuse_size(least > thick, "wheel_thickness_mm", text, thick, least=least)
    for part in ("wheel", "crank"):
        bore, hub = getattr(size, f"{part}_bore_mm"), getattr(size, f"{part}_hub_mm")
        if bore is not None and hub is not None:
            text = f"it must be at least {part}_bore_mm = {{bore:g}}, or 0 for none"
            refuse_size((hub > 0.0) & (hub < bore), f"{part}_hub_mm", text, hub, bore=bore)


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
        text = f"{key}: this machine has no locking disc; remove it"
        refuse_text(unlocked & (given[key] != 0.0), ("tolerance", key), text)
    for key, below, what in (
        ("center_distance_mm", L, "the centre distance"),
        ("crank_radius_mm", arm, "the crank's radius"),
        ("roller_diameter_mm", roller, "the roller's diameter"),
        ("slot_width_mm", slot, "the slot's width"),
        ("slot_angle_deg", 0.5 * step, "half the wheel's step"),
        ("lock_radius_mm", disc, "the locking disc's radius, or the crank's"),
        ("recess_radius_mm", disc, "the locking disc's radius, or the crank's"),
    ):
        wrong, text = given[key] >= below, f"{key} = {{value:g}}: {BELOW}"
        refuse_text(wrong, ("tolerance", key), text, value=given[key], below=below, what=what)


def of_pin_path(spec: Spec) -> Iterator[Conflict]:
    """Rules of a drive whose roller has a path of its own."""
    why = f"is not for {KIND}, whose one roller enters equal, straight and radial slots"
    yield from unset(spec, f"motion.law wheel.offset_mm {ONE_ROLLER}", why)


def of_cam(spec: Spec) -> Iterator[Conflict]:
    """Rules of a roller in a groove that a law gives."""
    why = f"is not for {KIND}, whose roller enters equal, radial slots"
    yield from unset(spec, "wheel.offset_mm wheel.steps_deg drive.roller_angles_deg", why)
    text = f"{KIND} needs a law in [motion]: the groove is cut for it"
    yield spec.motion is None, ("drive", "kind"), text


def of_transmission(spec: Spec) -> Iterator[Conflict]:
    """Rules of a roller on a crank: of the slots that a law gives, then of several rollers."""
    drive, wheel, places = spec.drive, spec.wheel, ("drive", "roller_angles_deg")
    if spec.motion:
        yield not wheel.FLAT, ("motion", "law"), f"{GEARING} has straight slots only: remove law"
        why = "is for straight slots; leave out law, which makes curved slots, or"
        yield from unset(spec, "wheel.offset_mm wheel.steps_deg drive.roller_angles_deg", why)
        text = "several rollers move the wheel differently, so one curved slot cannot serve them: "
        text += "use rollers = 1, or straight slots (no law)"
        yield drive.rollers > 1 and not drive.direct, ("drive", "rollers"), text
    placed = len(wheel.steps or drive.roller_angles_deg or ())
    text = f"each of the {placed} steps has a roller: roller_angles_deg needs as many angles"
    yield wheel.steps and len(drive.roller_angles_deg or wheel.steps) != placed, places, text
    what = "steps" if wheel.steps else "angles"
    text = f"rollers = {{spec.drive.rollers}}, but there are {placed} {what}: remove rollers"
    yield placed and drive.rollers not in (1, placed), ("drive", "rollers"), text


def of_crank(spec: Spec) -> Iterator[Conflict]:
    """Rules of a plain crank, or of several about one wheel."""
    yield from of_transmission(spec)
    drive, wheel, steps = spec.drive, spec.wheel, ("drive", "crank_steps")
    places, count = drive.cranks, len(drive.cranks)
    text = f"crank_steps needs an external wheel, not {GEARING}: remove crank_steps"
    able = wheel.FLAT and spec.output.turns and wheel.SIGN > 0.0
    yield count > 1 and not able, steps, text
    text = "crank_steps must begin with 0 and hold different whole numbers below {spec.wheel.z}"
    broken = [*map(int, places)] != [*places]
    wrong = broken or places[0] != 0.0 or len({*places}) < count
    yield wrong | (max(places) >= wheel.z), steps, text
    if count > 1:
        why = "is not for crank_steps, whose cranks are equal and work in even turns"
        yield from unset(spec, "wheel.steps_deg drive.roller_angles_deg tolerance", why)
        text = f"crank_steps places {count} cranks with one roller each: set rollers = {count}"
        yield drive.rollers != count, ("drive", "rollers"), text
        text = "each crank of crank_steps would move a body off the wheel's axis differently: "
        yield spec.unbalanced, ("mass", "radius_mm"), text + UNBALANCED
