"""Warnings about parts that the process of the spec makes badly."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.curves.measure import bounds
from geneva_cli.curves.plates import Plate, plates
from geneva_cli.drawings.model import PartsModel
from geneva_cli.drawings.single_parts import is_cut
from geneva_cli.errors import GenevaError, Notice
from geneva_cli.layout.missing import Missing, built_of
from geneva_cli.layout.plain_sizes import Sizes
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.keeps import keeps
from geneva_cli.spec.workshops import workshop


def process_warnings(model: PartsModel) -> Iterator[Notice]:
    """Warnings about small holes and narrow clearances in plates that are cut."""
    spec = model.mechanism.spec
    if not (spec.is_flat and spec.size.process):
        return
    try:
        sizes = model.outlines.sizes
    except GenevaError:  # the check of the parts has the reason
        return
    yield from _small_holes(model, workshop(spec.size.process).hole)
    yield from _narrow(model.mechanism, sizes)


def _small_holes(model: PartsModel, least: float) -> Iterator[Notice]:
    """A warning that names each part with a hole below ``least`` thicknesses."""
    if not least:
        return
    missing: list[Missing] = []  # the check of the parts reports them
    parts = built_of(model.flat.by_name(), missing)
    cut = dict.fromkeys(one for part in parts for one in plates(part))
    small: dict[str, tuple[float, Plate]] = {}
    for plate in cut:
        if not is_cut(plate) and plate.layer != "ROLLER":
            continue
        for hole in plate.holes:
            box = bounds(hole)
            wide = min(box.x1 - box.x0, box.y1 - box.y0)
            if not keeps(wide, "at least", least * plate.thickness):
                known = small.get(plate.name, (wide, plate))
                small[plate.name] = min(known, (wide, plate), key=lambda one: one[0])
    if not small:
        return
    names = ", ".join(f"{name} Ø {wide:.4g}" for name, (wide, _) in sorted(small.items()))
    wide, plate = min(small.values(), key=lambda one: one[0] / one[1].thickness)
    yield Notice(
        "small-hole",
        f"holes below {least:g} of their plate's thickness, which a laser does not cut well: "
        f"{names} mm. Drill them, or make the {plate.name} at most {wide / least:.4g} mm thick",
    )


def _narrow(mechanism: Mechanism, sizes: Sizes) -> Iterator[Notice]:
    """Warnings about clearances of the process that are narrow for the plates as they are."""
    size = mechanism.spec.size
    built = size.replace(
        center_distance_mm=mechanism.center_distance_mm,
        roller_radius_mm=sizes.roller,
        wheel_thickness_mm=sizes.wheel_thickness,
        lock_thickness_mm=sizes.lock_thickness,
        arm_thickness_mm=sizes.arm_thickness,
    )
    for key in ("slot_clearance_mm", *(["lock_clearance_mm"] if sizes.lock else [])):
        own, needed = getattr(size.allowances, key), getattr(built.allowances, key)
        if getattr(size, key) is None and not keeps(own, "at least", needed):
            yield Notice(
                "narrow-for-process",
                f"{key} = {own:g} is that of the default thickness; the wheel is "
                f"{sizes.wheel_thickness:.4g} mm thick: set {key} to {needed:g}",
            )
