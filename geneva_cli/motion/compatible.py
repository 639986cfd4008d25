"""Rules for combining wheels, drives and motions, from the properties that each declares."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial, reduce
from operator import or_
from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.errors import GenevaError, refuse
from geneva_cli.motion.drive import Drive, Needs
from geneva_cli.spec.rules import is_array
from geneva_cli.spec.schema import SpecTable, fields
from geneva_cli.spec.tables import Shaft

if TYPE_CHECKING:
    from geneva_cli.motion.machine_spec import Spec


class Conflict(NamedTuple):
    """A combination that makes no machine: its condition, the key to blame, and the message.

    For a batch of designs the condition may be an array of truth values.
    """

    when: Callable[[Spec], object]
    key: tuple[str, ...]
    text: str


def _several(spec: Spec) -> int:
    """Number of rollers that ``steps_deg`` or ``roller_angles_deg`` place; 0 without either."""
    return len(spec.wheel.steps or spec.drive.roller_angles_deg or ())


def _cranks(spec: Spec) -> int:
    """Number of cranks that ``crank_steps`` places about the wheel; 0 without it."""
    return len(spec.drive.cranks) if len(spec.drive.cranks) > 1 else 0


def _off_steps(spec: Spec) -> object:
    """True if cranks do not stand on whole steps, each on one of its own, the first one on 0."""
    places = spec.drive.cranks
    whole = all(place == int(place) for place in places)
    wrong = not whole or places[0] != 0.0 or len({*places}) < len(places)
    return wrong | (max(places) >= spec.wheel.z)


def _is_set(table: SpecTable) -> object:
    """True if a key of a table differs from its default; for a batch an array."""
    default = type(table)().as_dict()
    return reduce(or_, (value != default[key] for key, value in table.as_dict().items()))


def _table_of_wheels(table: str, spec: Spec) -> object:
    """True if a rack's spec sets a table that only wheels have."""
    if spec.output.turns:
        return False
    name = table.strip("[]")
    return bool(spec.mass) if name == "mass" else _is_set(getattr(spec, name))


def _shaft_of_wheels(key: str, spec: Spec) -> object:
    """True if a rack's spec sets a key of the shaft that only wheels have."""
    value = getattr(spec.shaft, key)
    return not spec.output.turns and value is not None and value != getattr(Shaft(), key)


def _set_on(before: Drive) -> object:
    """True if a key of the machine's input is set on the drive before it."""
    own = before.as_dict()
    return reduce(or_, (own[key.key] != key.default for key in fields(Drive)))


def is_geared(spec: Spec) -> bool:
    """True if the spec's drive, or the one before it, has gears."""
    drives = (spec.drive, spec.drive_before) if spec.drive_before else (spec.drive,)
    return any(drive.TOOTHED or drive.GEARED for drive in drives)


CONFLICTS = (
    Conflict(
        lambda s: s.drive_before and not s.drive_before.IN_FRONT,
        ("drive", "before", "kind"),
        'kind = "{before}" cannot turn the shaft of another drive: remove [drive.before]',
    ),
    Conflict(
        lambda s: s.drive_before and s.drive.FIRST,
        ("drive", "before"),
        'kind = "{before}" cannot stand before kind = "{drive}": {first}',
    ),
    Conflict(
        lambda s: s.drive_before and _set_on(s.drive_before),
        ("drive", "before"),
        "n_rpm, rollers, roller_angles_deg and both_ways belong to the machine: set them in "
        "[drive], not in [drive.before]",
    ),
    Conflict(
        lambda s: s.drive_before and s.drive.direct and not (s.motion or _cranks(s)),
        ("drive", "before"),
        'the crank of kind = "{drive}" is on the shaft: set kind = "{before}" in [drive] instead',
    ),
    Conflict(
        lambda s: s.drive.RADIAL and (s.drive.roller_angles_deg or s.wheel.skewed),
        ("drive", "kind"),
        'kind = "{drive}" needs one roller and radial slots: remove offset_mm, steps_deg and '
        "roller_angles_deg",
    ),
    Conflict(
        lambda s: s.drive.GEARINGS and s.wheel.NAME not in s.drive.GEARINGS,
        ("wheel", "gearing"),
        'kind = "{drive}" drives an {gearings} wheel, not gearing = "{gearing}"',
    ),
    Conflict(
        lambda s: s.drive.LAW is Needs.LAW and s.motion is None,
        ("drive", "kind"),
        'kind = "{drive}" needs a law in [motion]: the groove is cut for it',
    ),
    Conflict(
        lambda s: s.drive.LAW is Needs.NO_LAW and s.motion is not None,
        ("motion", "law"),
        'kind = "{drive}" sets the path of the roller, and the slots are straight: remove law',
    ),
    Conflict(
        lambda s: s.motion is not None and s.wheel.steps,
        ("wheel", "steps_deg"),
        "steps_deg is for straight slots, and a law makes curved slots: remove one of them",
    ),
    Conflict(
        lambda s: s.motion is not None and s.wheel.skewed,
        ("wheel", "offset_mm"),
        "offset_mm is for straight slots, and a law makes curved slots: remove one of them",
    ),
    Conflict(
        lambda s: s.motion is not None and not s.wheel.FLAT,
        ("motion", "law"),
        'gearing = "{gearing}" has straight slots only: remove law',
    ),
    Conflict(
        lambda s: s.drive.ONE_ROLLER and s.drive.rollers > 1,
        ("drive", "rollers"),
        'kind = "{drive}" carries one roller only',
    ),
    Conflict(
        lambda s: s.drive.ONE_ROLLER and _several(s),
        ("drive", "kind"),
        'kind = "{drive}" carries one roller only',
    ),
    Conflict(
        lambda s: s.wheel.steps and len(s.drive.roller_angles_deg or s.wheel.steps) != _several(s),
        ("drive", "roller_angles_deg"),
        "each of the {several} steps has a roller: roller_angles_deg needs as many angles",
    ),
    Conflict(
        lambda s: _several(s) and s.drive.rollers not in (1, _several(s)),
        ("drive", "rollers"),
        "rollers = {rollers}, but there are {several} {places}: remove rollers",
    ),
    Conflict(
        lambda s: s.motion is not None and s.drive.roller_angles_deg,
        ("drive", "roller_angles_deg"),
        "roller_angles_deg is for straight slots: remove law or roller_angles_deg",
    ),
    Conflict(
        lambda s: s.motion is not None and s.drive.rollers > 1 and not s.drive.ALIKE,
        ("drive", "rollers"),
        "{rollers} rollers on a {drive} move the wheel differently, so one curved slot cannot "
        "serve them all; use rollers = 1, or straight slots (no law)",
    ),
    Conflict(
        lambda s: _cranks(s) and not (s.wheel.FLAT and s.output.turns and s.wheel.SIGN > 0.0),
        ("drive", "crank_steps"),
        'crank_steps needs an external wheel, which has cranks around it, not gearing = "{gearing}"'
        ": remove crank_steps",
    ),
    Conflict(
        _off_steps,
        ("drive", "crank_steps"),
        "crank_steps must begin with 0 and hold different whole numbers below z = {z}: one for "
        "each crank",
    ),
    Conflict(
        lambda s: _cranks(s) and s.wheel.steps,
        ("wheel", "steps_deg"),
        "a wheel of unequal steps looks different from each crank of crank_steps: remove one of "
        "them",
    ),
    Conflict(
        lambda s: _cranks(s) and s.drive.roller_angles_deg,
        ("drive", "roller_angles_deg"),
        "the cranks of crank_steps are equal and work in even turns: remove roller_angles_deg",
    ),
    Conflict(
        lambda s: _cranks(s) and s.drive.rollers != _cranks(s),
        ("drive", "rollers"),
        "crank_steps places {cranks} cranks with one roller each: set rollers = {cranks}",
    ),
    Conflict(
        lambda s: _cranks(s) and s.unbalanced,
        ("mass", "radius_mm"),
        "each crank of crank_steps pushes the wheel from another side, so that a body off its "
        "axis would give each motion other loads: set count to 2 or more, or radius_mm = 0",
    ),
    Conflict(
        lambda s: _cranks(s) and _is_set(s.tolerance),
        ("tolerance",),
        "[tolerance] has no key for the places of the cranks of crank_steps about the wheel, which "
        "add to each step: remove one of them",
    ),
    Conflict(
        lambda s: s.drive.wheels_on_carrier and s.motion is not None and s.unbalanced,
        ("mass", "radius_mm"),
        'kind = "{drive}" with a law needs balanced wheels: set count to 2 or more evenly spaced '
        "bodies, or radius_mm = 0, or remove law",
    ),
    Conflict(
        lambda s: s.drive.wheels_on_carrier > 1 and (s.drive.rollers > 1 or _several(s)),
        ("drive", "wheels"),
        "several wheels meet one finger, each in turn: remove rollers, roller_angles_deg and "
        "steps_deg, or set wheels = 1",
    ),
    Conflict(
        lambda s: s.drive.wheels_on_carrier > 1 and s.wheel.SIGN < 0.0,
        ("drive", "wheels"),
        "an internal wheel surrounds the finger, so that one alone fits: set wheels = 1",
    ),
    Conflict(
        lambda s: s.drive.wheels_on_carrier and s.product.runs_straight,
        ("product", "pitch_mm"),
        'a chain or belt needs a wheel on the ground, not kind = "{drive}": set radius_mm instead',
    ),
    Conflict(
        lambda s: s.drive.wheels_on_carrier and s.support.gear_ratio != 1.0,
        ("support", "gear_ratio"),
        'gear_ratio is for a table on the ground, not for kind = "{drive}": set it to 1',
    ),
    Conflict(
        lambda s: s.output.turns & ((s.load.mass_kg != 0.0) | (s.load.force_N != 0.0)),
        ("load", "mass_kg"),
        "mass_kg and force_N are a rack's load; a wheel that turns has inertia_kgm2 and torque_Nm",
    ),
    Conflict(
        lambda s: (not s.output.turns) & ((s.load.inertia_kgm2 != 0.0) | (s.load.torque_Nm != 0.0)),
        ("load", "inertia_kgm2"),
        "inertia_kgm2 and torque_Nm are of a wheel that turns; a rack has mass_kg and force_N",
    ),
    Conflict(
        lambda s: not s.guided and s.load.guide_friction is not None,
        ("load", "guide_friction"),
        "guide_friction is of the guide of a rack that a plain crank or gears drive: remove it",
    ),
    Conflict(
        lambda s: not s.output.turns and s.load.dwell_torque_Nm is not None,
        ("load", "dwell_torque_Nm"),
        "dwell_torque_Nm acts on a wheel's shaft, and is not available for a rack: remove it",
    ),
    *(
        Conflict(
            partial(_table_of_wheels, table),
            (table.strip("[]"),),
            f"{table} is for a wheel on a shaft; a rack's load is mass_kg and force_N in [load]",
        )
        for table in ("[[mass]]", "[support]")
    ),
    *(
        Conflict(
            partial(_table_of_wheels, table),
            (table.strip("[]"),),
            f"{table} is for a wheel on a shaft, and not available for a rack: remove it",
        )
        for table in ("[tolerance]", "[product]")
    ),
    *(
        Conflict(
            partial(_shaft_of_wheels, key),
            ("shaft", key),
            f"{key} is of a wheel's shaft, and a rack has none: remove it",
        )
        for key in (
            *("stiffness_Nm_rad", "damping_ratio"),
            *("wheel_diameter_mm", "wheel_overhang_mm", "wheel_span_mm"),
        )
    ),
    Conflict(
        lambda s: s.wheel.stopped and (not s.drive.CRANKED or s.drive.IN_SERIES or s.motion),
        ("wheel", "stop"),
        "stop needs straight slots and a crank without a first wheel: remove stop, or law and kind",
    ),
    Conflict(
        lambda s: s.wheel.stopped and (s.drive.rollers > 1 or s.drive.roller_angles_deg),
        ("wheel", "stop"),
        "stop needs a crank with one roller: remove rollers and roller_angles_deg",
    ),
    Conflict(
        lambda s: s.wheel.stopped and s.wheel.skewed,
        ("wheel", "stop"),
        "stop needs radial slots and equal steps: remove offset_mm and steps_deg",
    ),
    Conflict(
        lambda s: s.wheel.stopped and s.size.lock_radius_mm == 0.0,
        ("size", "lock_radius_mm"),
        "stop needs the locking disc, which meets the convex face: remove lock_radius_mm = 0",
    ),
    Conflict(
        lambda s: not s.wheel.stopped and s.load.winding_torque_Nm is not None,
        ("load", "winding_torque_Nm"),
        "winding_torque_Nm acts on a stop: set stop = true in [wheel] of an external wheel",
    ),
    Conflict(
        lambda s: not s.wheel.stopped and s.limits.stop_stress_max_MPa is not None,
        ("limits", "stop_stress_max_MPa"),
        "stop_stress_max_MPa limits a stop: set stop = true in [wheel] of an external wheel",
    ),
    Conflict(
        lambda s: s.size.gear_module_mm is not None and not is_geared(s),
        ("size", "gear_module_mm"),
        'gear_module_mm cuts the teeth of gears, and kind = "{drive}" has none: remove it',
    ),
    Conflict(
        lambda s: s.size.gear_module_mm is None and s.size.gear_shift is not None,
        ("size", "gear_shift"),
        "gear_shift moves the teeth of gears: set gear_module_mm, or remove gear_shift",
    ),
    Conflict(
        lambda s: s.size.gear_module_mm is None and s.size.gear_teeth is not None,
        ("size", "gear_teeth"),
        "gear_teeth counts the teeth of gears: set gear_module_mm, or remove gear_teeth",
    ),
)


def refuse_conflicts(spec: Spec) -> None:
    """Raise GenevaError if the spec combines kinds that make no machine together."""
    for conflict in CONFLICTS:
        when = conflict.when(spec)
        if is_array(when) or when:
            refuse(when if is_array(when) else True, partial(_error, conflict, spec))


def _error(conflict: Conflict, spec: Spec) -> GenevaError:
    text = conflict.text.format(
        drive=spec.drive.NAME,
        before=spec.drive_before.NAME if spec.drive_before else "",
        first=spec.drive.FIRST,
        gearing=spec.wheel.NAME,
        gearings=" or ".join(spec.drive.GEARINGS),
        rollers=spec.drive.rollers,
        cranks=_cranks(spec),
        z=spec.wheel.z,
        several=_several(spec),
        places="steps" if spec.wheel.steps else "angles",
    )
    return GenevaError(text, conflict.key)
