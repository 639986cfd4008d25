"""The sizes of a machine's parts, in millimetres, and their outlines.

The sizes are those of the spec, or defaults. Under a load default sizes are as large as it needs
(``load_sizes``).
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.outlines.cut_outlines import drawn
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.sizes.plain_sizes import Sizes, pin_radius
from geneva_cli.parts.sizes.sizes import refuse_sizes, usual_sizes
from geneva_cli.parts.slots.roller_paths import RollerPaths, roller_paths
from geneva_cli.spec.tables import Size

if TYPE_CHECKING:
    from geneva_cli.loads.strength.part_loads import PartLoads

Layout: TypeAlias = tuple[Assembly, Sizes]  # of one machine


def sized(mechanism: Mechanism, loads: PartLoads | None = None) -> Layout | None:
    """Return a machine's assembly and sizes; None where no flat parts can be cut.

    ``loads`` are those on its parts, if computed already.
    """
    if not mechanism.spec.is_flat:
        return None
    try:
        if loads is None:
            return machine_sizes(mechanism)
        where = assembly(mechanism)
        return where, sizes(where, loads=loads)
    except GenevaError:
        return None  # the check of the parts reports the error


@lru_cache(maxsize=16)
def machine_sizes(mechanism: Mechanism) -> Layout:
    """Return a machine's assembly and sizes, cached for its strength, checks and parts.

    Raises GenevaError, naming the key, where a size leaves no wheel or no lock.
    """
    where = assembly(mechanism)
    return where, sizes(where)


def sizes(
    assembly: Assembly, known: RollerPaths | None = None, loads: PartLoads | None = None
) -> Sizes:
    """Return the sizes of a machine's parts.

    ``known`` are its roller paths, and ``loads`` those on its parts, if computed already.
    Raises GenevaError, naming the key, where a size leaves no wheel or no lock.
    """
    usual, space = usual_sizes(assembly, known or roller_paths(assembly))
    out = usual
    if assembly.full.spec.is_loaded:
        # without a load none is needed
        from geneva_cli.parts.outlines.cut_lock import cut_lock
        from geneva_cli.parts.sizes.load_sizes import load_sizes

        first = None
        if assembly.full.first_wheel:
            from geneva_cli.parts.sizes.first_sizes import first_sizes

            first = first_sizes(assembly.full, sized)
        by = cut_lock(assembly, usual) if usual.lock else None  # no load changes it
        out = load_sizes(assembly, usual, space, by, loads, first)._replace(first=first)
    refuse_sizes(assembly, out)
    return out


def outlines(mechanism: Mechanism) -> Outlines:
    """Return the outlines in lines and arcs, as accurate as the full turn needs them.

    Raises GenevaError where the machine has no flat parts, or its sizes leave none.
    """
    return drawn(*machine_sizes(mechanism))


def built(mechanism: Mechanism) -> Size:
    """Return the spec's sizes with the machine's values for the keys left out, mm and diameters.

    Without flat parts only centre distance, roller and clearances are added.
    """
    size = mechanism.spec.size
    known: dict[str, float] = {
        "center_distance_mm": mechanism.center_distance_mm,
        "roller_radius_mm": mechanism.roller_radius_mm,
        "slot_clearance_mm": size.allowances.slot_clearance_mm,
        "lock_clearance_mm": size.allowances.lock_clearance_mm,
        "press_fit_mm": size.allowances.press_fit_mm,
        "shaft_fit_mm": size.allowances.shaft_fit_mm,
        "pin_gap_mm": size.allowances.pin_gap_mm,
    }
    if flat := sized(mechanism):
        _, own = flat
        known |= {
            "wheel_radius_mm": own.rim,
            "slot_bottom_clearance_mm": own.slot_bottom,
            "lock_radius_mm": own.lock,
            "relief_clearance_mm": own.relief,
            "wall_min_mm": own.wall_min,
            "wheel_bore_mm": 2.0 * own.wheel_bore,
            "wheel_hub_mm": 2.0 * own.wheel_hub,
            "crank_bore_mm": 2.0 * own.crank_bore,
            "crank_hub_mm": 2.0 * own.crank_hub,
            "pin_mm": 2.0 * own.pin,
            "wheel_thickness_mm": own.wheel_thickness,
            "lock_thickness_mm": own.lock_thickness,
            "arm_thickness_mm": own.arm_thickness,
        }
        known |= {"wheel_outer_radius_mm": own.outer} if own.outer else {}
    values = size.as_dict()
    return size.replace(**{key: x for key, x in known.items() if values[key] is None})


def drawn_pin_radius(mechanism: Mechanism) -> float:
    """Return the radius of a roller's pin as its machine has it, 0 for none."""
    flat = sized(mechanism)
    parts = flat[1] if flat else None
    return pin_radius(mechanism.spec.size, mechanism.roller_radius_mm, parts)
