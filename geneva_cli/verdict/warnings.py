"""All warnings about a design: here those about loads, numbers, keys, parts and their turn."""

import math
from collections.abc import Iterator
from operator import attrgetter
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError, Notice
from geneva_cli.geometry.plates import MassProperties, Plate, Shell, solids
from geneva_cli.geometry.shapes import bounds
from geneva_cli.loads.load_case import G, inertia_kgm2, weight_kg
from geneva_cli.motion.compatible import is_geared
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.machine_sizes import wheel_body
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.turn.full_turn import SAME
from geneva_cli.spec.tables import Motor
from geneva_cli.spec.workshops import WORKSHOPS
from geneva_cli.verdict.checks.motion_checks import motion_play_max, slips_deg
from geneva_cli.verdict.motion_warnings import motion_warnings

if TYPE_CHECKING:
    from geneva_cli.parts.projection import NamedParts

STEEP_DEG = 60.0  # a pressure angle that friction of 0.58 would hold, more than a dry pair has


def warnings(parts: Parts) -> Iterator[Notice]:
    """Warnings about the motion, the loads and the parts of a machine, in this order."""
    mechanism = parts.mechanism
    yield from motion_warnings(mechanism)
    if mechanism.spec.is_loaded:  # machines without a load do not import what it needs
        from geneva_cli.loads.cycle import cycle_warnings

        yield from cycle_warnings(mechanism)
    yield from carried_warnings(mechanism, wheel_body(mechanism))
    yield from key_warnings(mechanism.spec)
    if mechanism.spec.is_loaded:
        from geneva_cli.verdict.strength import strength

        yield from strength(mechanism).warnings()
    yield from turn_warnings(parts)
    yield from _process_warnings(parts)


def carried_warnings(mechanism: Mechanism, plate: MassProperties | None) -> Iterator[Notice]:
    """Warnings about lengths and inertias in another unit, a wheel left out, and weight aside."""
    spec, L, inertia = mechanism.spec, mechanism.center_distance_mm, inertia_kgm2(mechanism.spec)
    least_mm = 5.0  # the smallest watches have stops of some mm
    if not least_mm <= L:
        text = f"the {spec.wheel.DISTANCE} of {L:.4g} mm is below {least_mm:g} mm: check that it "
        text += f"is in mm. If it is in metres, write {1e3 * L:.4g}; if in inches, {25.4 * L:.4g}"
        yield Notice("tiny-machine", text)
    # The largest table expected is solid steel, 6 L across and L/2 thick; J = pi rho h D^4 / 32. A
    # larger inertia is nearly always meant in kg cm2.
    most = math.pi * 7850.0 * 0.5e-3 * L * (6e-3 * L) ** 4 / 32.0
    if mechanism.output.turns and inertia > most:
        text = f"an inertia of {inertia:.4g} kg m² is more than that of a steel table {6 * L:.4g} "
        text += f"mm across: if it is in kg cm², write {1e-4 * inertia:.4g}"
        yield Notice("heavy-inertia", text)
    # a [[mass]] of this name is the wheel itself; a twentieth is within what loads are known to
    counted = "wheel" in map(attrgetter("name"), spec.mass)
    if plate and inertia and not counted and plate.inertia_kgm2 > 0.05 * inertia:
        own = plate.inertia_kgm2
        helps = f"{own:.4g} on inertia_kgm2 in [load]"
        if spec.support.gear_ratio == 1.0:  # masses are on the table, behind its gears
            across = 1e3 * math.sqrt(8.0 * own / plate.mass_kg)
            helps = f'[[mass]] with name = "wheel", shape = "disc", mass_kg = {plate.mass_kg:.4g} '
            helps += f"and diameter_mm = {across:.4g}"
        text = f"the wheel's own inertia, as drawn, is {own:.4g} kg m², "
        text += f"{100.0 * own / inertia:.3g} % of the {inertia:.4g} kg m² of the load: if the "
        text += f"load leaves it out, add {helps}"
        yield Notice("wheel-left-out", text)
    for mass in spec.mass if spec.support.axis == "horizontal" else ():
        if mass.to_one_side:
            torque = spec.support.gear_ratio * weight_kg(mass) * G * mass.radius_mm * 1e-3
            text = f"{mass.name or mass.shape} stands {mass.radius_mm:g} mm off a horizontal axis. "
            text += f"Its weight puts up to {torque:.4g} N m on the wheel, which is not counted: "
            text += "balance it (count = 2), or add the torque to torque_Nm in [load]"
            yield Notice("weight-to-one-side", text)


def key_warnings(spec: Spec) -> Iterator[Notice]:
    """Warnings about keys of motor and support without effect, because they lack others."""
    support = spec.support
    if not spec.is_loaded and spec.motor != Motor():
        text = "[motor] has no load to drive, so no motor or flywheel is computed: set "
        yield Notice("nothing-to-act-on", text + spec.output.load_keys)
    if bool(support.friction) != bool(support.radius_mm):
        keys = ("friction", "radius_mm")
        present, lacking = keys if support.friction else reversed(keys)
        text = f"{present} in [support] has no effect without {lacking}: set {lacking}"
        yield Notice("nothing-to-act-on", f"{text}, or remove {present}")
    elif support.friction and not (spec.mass or support.force_N):
        text = "friction in [support] has no effect, because nothing presses on the support: set "
        yield Notice("nothing-to-act-on", text + "force_N there, or give the weight as [[mass]]")


def _process_warnings(parts: Parts) -> Iterator[Notice]:
    """Warnings about gears, holes and clearances, and shafts without a bearing."""
    spec = parts.mechanism.spec
    if spec.no_parts:
        return
    try:
        unborne, named = parts.built.unborne, [*parts.built.by_name()] if spec.size.process else []
    except GenevaError:  # the check of the parts has the reason
        unborne, named = (), []
    for name, reason in unborne:
        part = name.partition("'")[0]
        text = f"the {name} has no bearing: {reason}. Hold it from above: "
        text += f"{part}_shaft_high_mm makes it longer"
        yield Notice("no-bearing", text)
    if spec.size.process:
        shop = WORKSHOPS[spec.size.process]
        yield from gears_without_teeth(spec)
        yield from _small_holes(named, shop.hole)
        if named and spec.is_flat and shop.cut_mm:
            yield from _narrow(parts.mechanism, parts.outlines.sizes)


def gears_without_teeth(spec: Spec) -> Iterator[Notice]:
    """A warning about gears that end at their pitch curves; for machines that go to a shop."""
    if is_geared(spec):
        text = "the gears have no teeth. Their solids end at the pitch curves, and files to cut "
        text += "leave them out: have them made for these curves"
        yield Notice("gears-without-teeth", text)


def _small_holes(named: list["NamedParts"], least: float) -> Iterator[Notice]:
    """A warning that names each part with a hole below ``least`` thicknesses."""
    if not least:
        return
    from geneva_cli.drawings.parts_list import is_cut
    from geneva_cli.parts.projection import Missing, built_of

    missing: list[Missing] = []  # the check of the parts reports them
    small: dict[str, tuple[float, float]] = {}
    for solid in dict.fromkeys(one for part in built_of(named, missing) for one in solids(part)):
        wide, thick = list[float](), 0.0
        if isinstance(solid, Shell):
            wide, thick = [2.0 * bored.radius for bored in solid.holes], solid.outer - solid.inner
        elif isinstance(solid, Plate) and (is_cut(solid) or solid.layer == "ROLLER"):
            boxes = [bounds(hole) for hole in solid.holes]
            wide = [min(box.x1 - box.x0, box.y1 - box.y0) for box in boxes]
            thick = solid.thickness
        narrow = min(wide, default=math.inf)
        if not keeps(narrow, "at least", least * thick):
            small[solid.name] = min(small.get(solid.name, (narrow, thick)), (narrow, thick))
    if not small:
        return
    names = ", ".join(f"{name} Ø {one:.4g}" for name, (one, _) in sorted(small.items()))
    name, (narrow, _) = min(small.items(), key=lambda one: one[1][0] / one[1][1])
    text = f"holes below {least:g} of their plate's thickness, which a laser does not cut well: "
    text += f"{names} mm. Drill them, or make the {name} at most {narrow / least:.4g} mm thick"
    yield Notice("small-hole", text)


def _narrow(mechanism: Mechanism, sizes: Sizes) -> Iterator[Notice]:
    """Warnings about clearances that are narrower than a cut needs for the plates."""
    size = mechanism.spec.size
    built = size.replace(
        center_distance_mm=mechanism.center_distance_mm,
        roller_radius_mm=sizes.roller,
        wheel_thickness_mm=sizes.wheel_thickness,
        lock_thickness_mm=sizes.lock_thickness,
        arm_thickness_mm=sizes.arm_thickness,
    )
    for key in ("slot_clearance_mm", *(["lock_clearance_mm"] if sizes.lock else [])):
        own = getattr(size.allowances, key)
        needed = getattr(built.replace(**{key: None}).allowances, key)
        if not keeps(own, "at least", needed):
            text = f'{key} = {own:g} is less than process = "{size.process}" holds at these '
            text += f"thicknesses, so that the parts may not go together: set {key} to {needed:g}"
            yield Notice("narrow-for-process", text)


def turn_warnings(parts: Parts) -> Iterator[Notice]:
    """Warnings about a wheel that is pushed at a steep angle, or that one wall alone drives."""
    if not parts.mechanism.spec.is_turned or parts.mechanism.no_turn:
        return
    try:
        turn = parts.built.turn
    except GenevaError:
        return
    most = slips_deg(parts.assembly.full.spec.load.friction)
    if parts.locked and turn.push.deg > STEEP_DEG and keeps(turn.push.deg, "at most", most):
        text = "the roller meets a wheel that is off by its play at a pressure angle of "
        text += f"{turn.push.deg:.4g}°, at {turn.push.at_deg:.4g}°: from {most:.4g}° on, friction "
        text += "would hold it. Less lock_clearance_mm or a larger wheel_radius_mm helps"
        yield Notice("steep-hand-over", text)
    # play to both sides has a limit of its own
    ahead, behind = turn.ahead, turn.behind
    free = max(ahead.deg, behind.deg)
    if free > motion_play_max(parts) and turn.motion.deg < free * (1.0 - SAME):
        to_sides = " and ".join(
            f"{way} by {play.deg:.4g}° at {play.at_deg:.4g}°"
            for way, play in (("ahead", ahead), ("behind", behind))
            if play.deg > SAME * free
        )
        text = f"in its slot the wheel is free {to_sides}, where one wall alone drives it. "
        text += "Friction or a brake keeps it on that wall"
        yield Notice("driven-by-one-wall", text)
