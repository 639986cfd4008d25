"""All warnings about a design in one list; those about its parts and their whole turn."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError, Notice
from geneva_cli.geometry.measure import bounds
from geneva_cli.motion.compatible import is_geared
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.turn.full_turn import SAME, FullTurn
from geneva_cli.parts.wheel_body import known_wheel_body
from geneva_cli.spec.workshops import workshop
from geneva_cli.verdict.carried_warnings import carried_warnings, unlikely_warnings
from geneva_cli.verdict.checks.play_checks import motion_play_max, slips_deg
from geneva_cli.verdict.motion_warnings import motion_warnings

if TYPE_CHECKING:
    from geneva_cli.geometry.plates import Solid
    from geneva_cli.parts.projection import Missing, NamedParts

STEEP_DEG = 60.0  # a pressure angle that friction of 0.58 would hold, more than a dry pair has


def warnings(parts: Parts) -> list[Notice]:
    """Warnings about the motion, the loads and the parts of a machine, in this order."""
    mechanism = parts.mechanism
    of_loads, of_strength = list[Notice](), list[Notice]()
    if mechanism.spec.is_loaded:  # machines without a load do not import what these need
        from geneva_cli.verdict.cycle_warnings import cycle_warnings
        from geneva_cli.verdict.strength import strength

        of_loads, of_strength = cycle_warnings(mechanism), strength(mechanism).warnings()
    return [
        *motion_warnings(mechanism),
        *of_loads,
        *unlikely_warnings(mechanism),
        *carried_warnings(mechanism, known_wheel_body(mechanism)),
        *of_strength,
        *turn_warnings(parts),
        *_bearing_warnings(parts),
        *_process_warnings(parts),
    ]


def _process_warnings(parts: Parts) -> Iterator[Notice]:
    """Warnings about holes, clearances, and shells to be cut from a plate."""
    spec = parts.mechanism.spec
    if not (spec.has_parts and spec.size.process):
        return
    yield from gears_without_teeth(spec)
    shop = workshop(spec.size.process)
    try:
        named = list(parts.built.by_name())
    except GenevaError:  # the check of the parts has the reason
        return
    if parts.LAID_FLAT and math.isfinite(shop.plate_mm):
        yield Notice(
            "bent-parts",
            f"a {spec.size.process} cuts flat plates, but these parts are shells of a sphere: cut "
            "them laid flat (geneva help drawing-sheet) and roll them to their cones, or set "
            'process = "mill" or "print"',
        )
    yield from _small_holes(named, shop.hole)
    if spec.is_flat and shop.cut_mm:
        yield from _narrow(parts.mechanism, parts.outlines.sizes)


def _bearing_warnings(parts: Parts) -> Iterator[Notice]:
    """A warning for each shaft that turns and has no bearing."""
    if not parts.mechanism.spec.has_parts:
        return
    try:
        unborne = parts.built.unborne
    except GenevaError:  # the check of the parts has the reason
        return
    for name, reason in unborne:
        part = name.partition("'")[0]
        yield Notice(
            "no-bearing",
            f"the {name} has no bearing: {reason}. Hold it from above: "
            f"{part}_shaft_high_mm makes it longer",
        )


def gears_without_teeth(spec: Spec) -> Iterator[Notice]:
    """A warning about gears that end at their pitch curves; for machines that go to a shop."""
    if is_geared(spec) and spec.size.gear_module_mm is None:
        yield Notice(
            "gears-without-teeth",
            "the gears have no teeth. Their solids end at the pitch curves, and files to cut leave "
            "them out: set gear_module_mm in [size]",
        )


def _small_holes(named: list[NamedParts], least: float) -> Iterator[Notice]:
    """A warning that names each part with a hole below ``least`` thicknesses."""
    from geneva_cli.geometry.plates import solids
    from geneva_cli.parts.projection import built_of

    if not least:
        return
    missing: list[Missing] = []  # the check of the parts reports them
    cut = dict.fromkeys(one for part in built_of(named, missing) for one in solids(part))
    small: dict[str, tuple[float, float]] = {}
    for solid in cut:
        for wide, thick in _holes(solid):
            if not keeps(wide, "at least", least * thick):
                small[solid.name] = min(small.get(solid.name, (wide, thick)), (wide, thick))
    if not small:
        return
    names = ", ".join(f"{name} Ø {wide:.4g}" for name, (wide, _) in sorted(small.items()))
    name, (wide, _) = min(small.items(), key=lambda one: one[1][0] / one[1][1])
    yield Notice(
        "small-hole",
        f"holes below {least:g} of their plate's thickness, which a laser does not cut well: "
        f"{names} mm. Drill them, or make the {name} at most {wide / least:.4g} mm thick",
    )


def _holes(solid: Solid) -> Iterator[tuple[float, float]]:
    """Yield the widths of a part's holes and its thickness, if it is cut out of a plate."""
    from geneva_cli.drawings.single_parts import is_cut
    from geneva_cli.geometry.plates import Plate, Shell

    if isinstance(solid, Shell):
        for bored in solid.holes:
            yield 2.0 * bored.radius, solid.outer - solid.inner
    elif isinstance(solid, Plate) and (is_cut(solid) or solid.layer == "ROLLER"):
        for hole in solid.holes:
            box = bounds(hole)
            yield min(box.x1 - box.x0, box.y1 - box.y0), solid.thickness


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
        if keeps(own, "at least", needed):
            continue
        why = f"is that of the default thickness; the wheel is {sizes.wheel_thickness:.4g} mm thick"
        if getattr(size, key) is not None:
            why = (
                f'is less than process = "{size.process}" holds at these sizes, so that the parts '
                "may not go together"
            )
        yield Notice("narrow-for-process", f"{key} = {own:g} {why}: set {key} to {needed:g}")


def turn_warnings(parts: Parts) -> Iterator[Notice]:
    """Warnings about the parts' whole turn; none without such a turn."""
    if not parts.mechanism.spec.is_turned or parts.mechanism.no_turn:
        return
    try:
        turn = parts.turned.turn
    except GenevaError:
        return
    yield from _steep(parts, turn)
    yield from _one_wall(parts, turn)


def _steep(parts: Parts, turn: FullTurn) -> Iterator[Notice]:
    """A warning for a wheel that the roller pushes into line at a steep angle."""
    most = slips_deg(parts.assembly.full.spec.load.friction)
    if parts.locked and turn.push.deg > STEEP_DEG and keeps(turn.push.deg, "at most", most):
        yield Notice(
            "steep-hand-over",
            f"the roller meets a wheel that is off by its play at a pressure angle of "
            f"{turn.push.deg:.4g}°, at {turn.push.at_deg:.4g}°: from {most:.4g}° on, friction of "
            f"{1.0 / math.tan(math.radians(most)):.3g} would hold it there. Less "
            "lock_clearance_mm or a larger wheel_radius_mm makes it less steep",
        )


def _one_wall(parts: Parts, turn: FullTurn) -> Iterator[Notice]:
    """A warning for a wheel that one wall of its slot alone drives."""
    ahead, behind, limit = turn.ahead, turn.behind, motion_play_max(parts)
    # Play to both sides has a limit of its own.
    free = max(ahead.deg, behind.deg)
    if free <= limit or turn.motion.deg >= free * (1.0 - SAME):
        return
    first = ahead.deg >= behind.deg * (1.0 - SAME)
    side, at_deg = ("ahead", ahead.at_deg) if first else ("behind", behind.at_deg)
    if len(parts.assembly.rollers) > len(parts.assembly.motions):
        yield Notice(
            "driven-by-one-wall",
            f"in its slots the wheel is free ahead by {ahead.deg:.4g}° at "
            f"{ahead.at_deg:.4g}° and behind by {behind.deg:.4g}° at "
            f"{behind.at_deg:.4g}°. One wall starts it and one stops it: it leaves them if "
            "its load overruns the first roller, or stays behind the second",
        )
        return
    helps = "a load that overruns the roller" if first else "a load that holds back"
    yield Notice(
        "driven-by-one-wall",
        f"in its slot the wheel is free {side} by {free:.4g}° at {at_deg:.4g}°, where "
        f"one wall alone drives it: {helps} meets a corner. Friction or a brake keeps it on "
        "that wall",
    )
