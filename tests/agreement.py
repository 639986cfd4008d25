"""When a quantity of a batch and of a design alone agree: apart from rounding, by its kind."""

import math
from functools import lru_cache

import numpy as np

from geneva_cli.loads.cycle import cycle_of
from geneva_cli.loads.load_tables import summaries
from geneva_cli.parts.parts import parts_of
from geneva_cli.study.fields import values
from geneva_cli.verdict.quantities.groups import GROUPS

UNITS = 16 * np.finfo(float).eps
# Four times that after a root: of a horn's thickness, and of the wheel that a linkage drives.
ROOTS, FOURFOLD = ("strength.horn",), 4
UNBOUNDED = 1000.0  # N: a force without a peak; the load's torque gives it at a lever of 5 mm
SUMS = 1e-12  # accuracy of sums, and of quantities that follow from them (load_summaries)
PLACE = 1e-6  # degrees: a peak is flat


@lru_cache(maxsize=64)
def quantities(mechanism):
    """The quantities of a single design without its parts, and the sizes of its loads."""
    every = summaries(cycle_of(mechanism)).items() if mechanism.spec.is_loaded else ()
    bounded = {load: one for load, one in every if None not in (one.max, one.min)}
    sizes = {f"loads.{load}.size": max(one.max, -one.min) for load, one in bounded.items()}
    groups = [group for group in GROUPS if group.batched or not group.makes_parts]
    return sizes | values(parts_of(mechanism), groups)


def agrees(name, value, single, spec):
    """True if a value is that of a single design, of all whose quantities some may be scales."""
    alone = single[name]
    if value is None or alone is None or isinstance(alone, str):
        return value == alone
    group, _, own = name.rpartition(".")
    if own.endswith("at_deg"):
        return abs(value - alone) <= PLACE or _is_level(single, group, own)
    near = UNITS * (1 if spec.drive.ONE_ARM and group not in ROOTS else FOURFOLD)
    if own in ("min", "max") and single.get(f"{group}.size", single.get(f"{group}.max")) is None:
        # beside a place without a bound: p v of a matched slot varies by 42 units in the last place
        # from one double to the next about its least value
        near = UNITS * FOURFOLD
    if own in ("mean", "rms") or group in ("sizing", "life"):
        near = SUMS
    return abs(value - alone) <= near * max(abs(alone), _size(name, single))


def _size(name, single):
    """The scale of a signed value's error: its curve's peak, a radian for an angle, or 1."""
    group, _, own = name.rpartition(".")
    if own.endswith("_deg"):
        return math.degrees(1.0)
    if "share" in own or own == "margin":
        return 1.0
    if group.startswith("shock") and own in ("jump", "force_N", "moment_Nms"):
        # a root of a path length: its relative rounding grows as the root becomes smaller
        return abs(single[name] / single[f"{group}.jump"]) if single[name] else 0.0
    if own == "drag_Nm":  # a difference of two loads
        return single.get("loads.wheel_torque_Nm.size") or 0.0
    peak = single.get(f"{group}.size") or single.get(f"{group}.max")
    return UNBOUNDED if peak is None and group.endswith("_N") else peak or 0.0


def _is_level(single, group, own):
    """True if a curve has its extreme in several places or none: if it is 0 or unbounded."""
    return not single.get(f"{group}.{'min' if own == 'min_at_deg' else 'max'}")
