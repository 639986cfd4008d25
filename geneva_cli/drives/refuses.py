"""What the core's drives refuse: wheels, laws and rollers with which they make no machine."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.motion.compatible import Conflict, is_set
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.records import KINDS


def other_wheels(spec: Spec) -> Conflict:
    """A wheel of another kind than those that the drive can drive."""
    able = next(kind.gearings for kind in KINDS if kind.drive and kind.name == spec.drive.NAME)
    text = f'kind = "{{spec.drive.NAME}}" drives an {" or ".join(able)} wheel, not gearing = '
    text += '"{spec.wheel.NAME}"'
    return (spec.wheel.NAME not in able, ("wheel", "gearing"), text)


def several_rollers(spec: Spec) -> Iterator[Conflict]:
    """More than one roller, with a drive that carries one."""
    text = 'kind = "{spec.drive.NAME}" carries one roller only'
    yield (spec.drive.rollers > 1, ("drive", "rollers"), text)
    yield (spec.wheel.steps or spec.drive.roller_angles_deg, ("drive", "kind"), text)


def _not_radial(spec: Spec) -> Conflict:
    text = 'kind = "{spec.drive.NAME}" needs one roller and radial slots: remove offset_mm, '
    text += "steps_deg and roller_angles_deg"
    return (spec.drive.roller_angles_deg or spec.wheel.skewed, ("drive", "kind"), text)


def of_pin_path(spec: Spec) -> Iterator[Conflict]:
    """Rules of a drive whose roller has a path of its own."""
    yield _not_radial(spec)
    yield other_wheels(spec)
    text = 'kind = "{spec.drive.NAME}" sets the path of the roller, and the slots are straight: '
    yield (spec.motion is not None, ("motion", "law"), text + "remove law")
    yield from several_rollers(spec)


def of_cam(spec: Spec) -> Iterator[Conflict]:
    """Rules of a roller in a groove that a law gives."""
    yield _not_radial(spec)
    yield other_wheels(spec)
    text = 'kind = "{spec.drive.NAME}" needs a law in [motion]: the groove is cut for it'
    yield (spec.motion is None, ("drive", "kind"), text)


def of_transmission(spec: Spec) -> Iterator[Conflict]:
    """Rules of a roller on a crank: of the slots that a law gives, then of several rollers."""
    drive, wheel, law = spec.drive, spec.wheel, spec.motion is not None
    angles = ("drive", "roller_angles_deg")
    text = "{} is for straight slots, and a law makes curved slots: remove one of them"
    yield (law and wheel.steps, ("wheel", "steps_deg"), text.format("steps_deg"))
    yield (law and wheel.skewed, ("wheel", "offset_mm"), text.format("offset_mm"))
    text = 'gearing = "{spec.wheel.NAME}" has straight slots only: remove law'
    yield (law and not wheel.FLAT, ("motion", "law"), text)
    placed = len(wheel.steps or drive.roller_angles_deg or ())
    text = f"each of the {placed} steps has a roller: roller_angles_deg needs as many angles"
    too_few = wheel.steps and len(drive.roller_angles_deg or wheel.steps) != placed
    yield (too_few, angles, text)
    text = f"rollers = {{spec.drive.rollers}}, but there are {placed} "
    text += f"{'steps' if wheel.steps else 'angles'}: remove rollers"
    yield (placed and drive.rollers not in (1, placed), ("drive", "rollers"), text)
    text = "roller_angles_deg is for straight slots: remove law or roller_angles_deg"
    yield (law and drive.roller_angles_deg, angles, text)
    text = (
        "{spec.drive.rollers} rollers on a {spec.drive.NAME} move the wheel differently, so one "
        "curved slot cannot serve them all; use rollers = 1, or straight slots (no law)"
    )
    yield (law and drive.rollers > 1 and not drive.direct, ("drive", "rollers"), text)


def of_crank(spec: Spec) -> Iterator[Conflict]:
    """Rules of a plain crank, or of several about one wheel."""
    yield from of_transmission(spec)
    drive, wheel, steps = spec.drive, spec.wheel, ("drive", "crank_steps")
    places = drive.cranks
    several = len(places) > 1
    text = "crank_steps needs an external wheel, which has cranks around it, not gearing = "
    text += '"{spec.wheel.NAME}": remove crank_steps'
    able = wheel.FLAT and spec.output.turns and wheel.SIGN > 0.0
    yield (several and not able, steps, text)
    text = "crank_steps must begin with 0 and hold different whole numbers below z = "
    text += "{spec.wheel.z}: one for each crank"
    broken = [*map(int, places)] != [*places]
    wrong = broken or places[0] != 0.0 or len({*places}) < len(places)
    yield (wrong | (max(places) >= wheel.z), steps, text)
    if not several:
        return
    text = "a wheel of unequal steps looks different from each crank of crank_steps: remove one of "
    yield (wheel.steps, ("wheel", "steps_deg"), text + "them")
    text = "the cranks of crank_steps are equal and work in even turns: remove roller_angles_deg"
    yield (drive.roller_angles_deg, ("drive", "roller_angles_deg"), text)
    text = f"crank_steps places {len(places)} cranks with one roller each: set rollers = "
    yield (drive.rollers != len(places), ("drive", "rollers"), f"{text}{len(places)}")
    text = (
        "each crank of crank_steps pushes the wheel from another side, so that a body off its "
        "axis would give each motion other loads: set count to 2 or more, or radius_mm = 0"
    )
    yield (spec.unbalanced, ("mass", "radius_mm"), text)
    text = "[tolerance] has no key for the places of the cranks of crank_steps about the wheel, "
    text += "which add to each step: remove one of them"
    yield (is_set(spec.tolerance), ("tolerance",), text)
