"""A spherical machine's part of the list of parts: shells, and the angles to make them by."""

from __future__ import annotations

import math
from collections.abc import Iterator

from geneva_cli.curves.mass import MM
from geneva_cli.curves.plates import Shell
from geneva_cli.curves.sphere import Vector
from geneva_cli.machine.layout import Dimension
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.sphere.crank import rollers
from geneva_cli.parts.sphere.drawings import crank_cone, crank_shells, wheel_cone, wheel_shell
from geneva_cli.parts.sphere.sizes import Ball, ball
from geneva_cli.parts.sphere.wheel import POLE


def shell_rows(proof: Proof) -> Iterator[dict[str, object]]:
    """Wheel, locking sectors and rollers, each kind once; inertia about the axis each turns on.

    Raises GenevaError where the sizes leave none.
    """
    mechanism = proof.mechanism
    spec, found, locks = mechanism.spec, proof.shells.ball, proof.shells.crank
    yield _row(wheel_shell(found), POLE, 1, "wheel", spec.material_wheel.density_kgm3)
    shells = crank_shells(found, locks)
    for count, name, axis in (
        (len(locks), "wheel", POLE),
        (len(found.rollers), "roller", rollers(found)[0].middle),
    ):
        material = spec.material_wheel if name == "wheel" else spec.material_roller
        if count:
            yield _row(shells[0], axis, count, name, material.density_kgm3)
        shells = shells[count:]


def _row(one: Shell, axis: Vector, count: int, name: str, density: float) -> dict[str, object]:
    return {
        "row": "part",
        "name": one.name,
        "count": count,
        "material": f"material.{name}",
        "density_kgm3": density,
        "thickness_mm": one.outer - one.inner,
        "mass_kg": density * one.volume * MM**3,
        "inertia_kgm2": density * one.inertia(axis) * MM**5,
    }


def dimensions(mechanism: Mechanism) -> Iterator[Dimension]:
    """What the shells are turned and cut by. Raises GenevaError where the sizes leave none."""
    found = ball(mechanism)
    inner, outer = found.span_mm
    yield Dimension("shells' inner radius", inner, "mm")
    yield Dimension("shells' outer radius", outer, "mm")
    yield Dimension("roller's cone, half angle", math.degrees(found.roller), "deg")
    yield Dimension("slot, between its walls", found.slot_width_deg, "deg")
    yield Dimension("slot's last round, from the wheel's axis", math.degrees(found.bottom), "deg")
    yield Dimension("rim, from the wheel's axis", math.degrees(found.rim), "deg")
    yield Dimension("wheel's inner edge, from its axis", math.degrees(found.inner), "deg")
    if found.lock:
        yield Dimension("lock, from the crank's axis", math.degrees(found.lock), "deg")
        yield Dimension("recess, from the crank's axis", math.degrees(found.recess), "deg")
    yield from _cones(found)


def _cones(found: Ball) -> Iterator[Dimension]:
    for whose, cone in (("wheel", wheel_cone(found)), ("crank", crank_cone(found))):
        at = math.degrees(cone.polar)
        yield Dimension(f"{whose} laid flat: cone touches the sphere at", at, "deg")
        yield Dimension(f"{whose} laid flat: from there to its apex", abs(cone.apex_mm), "mm")
        yield Dimension(f"{whose} laid flat: sector", cone.sector_deg, "deg")
