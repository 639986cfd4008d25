"""Machines with varied numbers, for tests of batches: every drive, gearing and law."""

import numpy as np
from words import Motion, Spec, Wheel

from geneva_cli.errors import GenevaError
from geneva_cli.motion import machine_spec as spec
from geneva_cli.motion import registry
from geneva_cli.motion.laws.table_law import TableLaw
from geneva_cli.motion.mechanism import build


def machine(wheel, kind="crank", motion=None, gearing="external", own=(), **keys):
    if kind not in registry.DRIVES:
        return None
    return Spec(Wheel(wheel, gearing, **dict(own)), registry.drive(kind)(**keys), motion=motion)


def behind(spec, kind, **keys):
    """The machine with a drive before its own."""
    return spec.replace(drive_before=registry.drive(kind)(**keys))


POINTS = tuple((u / 11, (u / 11) ** 2 * (3.0 - 2.0 * u / 11)) for u in range(12))
SLOTS = ("wheel.z", 1, 16)  # whole numbers; the others are any
# every kind of drive, gearing and law, with its varied keys: key, least, greatest; some values are
# refused
MACHINES = {
    "crank": (machine(6), [SLOTS]),
    "internal": (machine(6, gearing="internal"), [SLOTS, ("size.roller_radius_mm", -1.0, 30.0)]),
    "side-crank": (machine(6, "side-crank", A=0.5), [("drive.A", -0.95, 1.05), SLOTS]),
    "inside": (
        machine(6, "side-crank", gearing="internal", A=0.5),
        [("drive.A", -0.95, 0.95), SLOTS],
    ),
    "two rollers": (machine(6, "side-crank", A=0.5, rollers=2), [("drive.A", -0.95, 0.95), SLOTS]),
    "placed rollers": (
        machine(6, "side-crank", A=0.5, roller_angles_deg=[0.0, 130.0]),
        [("drive.A", -0.95, 0.95), SLOTS],
    ),
    "unequal steps": (
        machine(6, "side-crank", own={"steps_deg": (50.0, 70.0)}, A=0.5),
        [("drive.A", -0.95, 0.95)],
    ),
    "offset": (machine(6, own={"offset_mm": 1.0}), [("wheel.offset_mm", -80.0, 80.0), SLOTS]),
    "offset, slowed": (
        machine(6, "side-crank", own={"offset_mm": 10.0}, A=0.5),
        [
            ("wheel.offset_mm", -30.0, 30.0),
            ("drive.A", -0.9, 0.9),
            ("size.center_distance_mm", 20.0, 200.0),
        ],
    ),
    "spherical": (machine(6, gearing="spherical"), [("wheel.axes_deg", -5.0, 185.0), SLOTS]),
    "spherical, slowed": (
        machine(6, "side-crank", gearing="spherical", A=0.5),
        [("wheel.axes_deg", 5.0, 175.0), ("drive.A", -0.9, 0.9)],
    ),
    "elliptical gears": (
        machine(6, "elliptical-gears", eccentricity=0.5),
        [("drive.eccentricity", 0.0, 0.95), SLOTS],
    ),
    "elliptical gears, quick": (
        machine(6, "elliptical-gears", eccentricity=0.5, phase="quick"),
        [("drive.eccentricity", -0.1, 0.9)],
    ),
    "noncircular gears": (machine(6, "noncircular-gears", A=0.4), [("drive.A", -0.95, 0.95)]),
    "geneva pair": (
        machine(4, "geneva-pair", first_z=4),
        [("wheel.z", 2, 8), ("drive.first_z", 2, 6)],
    ),
    "epicyclic": (
        machine(4, "epicyclic", planet_ratio=0.01),
        [("drive.planet_ratio", -0.1, 0.05), ("wheel.z", 3, 6)],
    ),
    "in a ring": (
        machine(4, "epicyclic", planet_ratio="shockless", fixed="ring"),
        [("wheel.z", 3, 6)],
    ),
    "planet behind gears": (
        behind(
            machine(4, "epicyclic", planet_ratio="shockless"), "elliptical-gears", eccentricity=0.2
        ),
        [("drive.before.eccentricity", 0.0, 0.5), ("wheel.z", 3, 6)],
    ),
    "carousel": (machine(4, "carousel", wheels=3), [("wheel.z", 3, 8)]),
    "two cranks": (machine(8, rollers=2, crank_steps=(0, 3)), [("wheel.z", 5, 12)]),
    "cam": (machine(6, "cam", Motion("cycloidal")), [("motion.alpha0_deg", -200.0, 130.0), SLOTS]),
    "cam inside": (
        machine(6, "cam", Motion("sine-group", 0.1), gearing="internal"),
        [("motion.lambda", -0.12, 0.12)],
    ),
    "gear sector": (
        machine(3, "gear-sector", sector_deg=60.0),
        [("drive.sector_deg", 0.0, 300.0), ("wheel.z", 3, 6)],
    ),
    "four-bar": (
        machine(
            4,
            "four-bar",
            crank_mm=40.0,
            ground_mm=90.0,
            coupler_mm=100.0,
            rocker_mm=100.0,
            point_mm=160.0,
            point_deg=-36.0,
        ),
        [("drive.crank_mm", 30.0, 50.0), ("drive.point_deg", -60.0, -20.0)],
    ),
    "slider-crank": (
        machine(8, "slider-crank", crank_mm=40.0, rod_mm=100.0, point_mm=80.0, point_deg=90.0),
        [("drive.rod_mm", 30.0, 200.0), ("drive.height_mm", -50.0, 50.0), SLOTS],
    ),
    "tilted law": (
        machine(6, "side-crank", Motion("sine-group", 0.1), A=0.3),
        [("motion.lambda", -0.2, 0.2), ("drive.A", -0.9, 0.9)],
    ),
    "points of a law": (
        machine(6, motion=spec.Motion(TableLaw(points=POINTS))),
        [("motion.alpha0_deg", -40.0, 40.0), SLOTS],
    ),
    "matched": (
        machine(6, motion=Motion("cycloidal", ratio="matched"), gearing="internal"),
        [("motion.alpha0_deg", -200.0, 230.0), SLOTS],
    ),
    **{
        law: (
            machine(6, motion=Motion(law)),
            [("motion.alpha0_deg", -200.0, 130.0), ("motion.ratio", -0.1, 1.1), SLOTS],
        )
        for law in registry.STANDARD_LAWS
    },
}
MACHINES = {name: row for name, row in MACHINES.items() if row[0]}  # of the kinds that there are


def drawn(rules, n, seed):
    random = np.random.default_rng(seed)
    return {
        key: random.integers(low, high + 1, n)
        if isinstance(low, int)
        else random.uniform(low, high, n)
        for key, low, high in rules
    }


def alone(spec, varied, i):
    """The i-th design, built alone; None if it is refused."""
    try:
        return build(spec.with_keys({key: values[i].item() for key, values in varied.items()}))
    except GenevaError:
        return None
