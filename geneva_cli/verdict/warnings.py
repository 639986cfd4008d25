"""All warnings about a design in one list, which every command and format shows."""

from __future__ import annotations

from geneva_cli.errors import Notice
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.wheel_body import known_wheel_body
from geneva_cli.verdict.carried_warnings import carried_warnings, unlikely_warnings
from geneva_cli.verdict.motion_warnings import motion_warnings
from geneva_cli.verdict.parts_warnings import bearing_warnings, process_warnings, turn_warnings


def warnings(parts: Parts) -> list[Notice]:
    """Warnings about the motion, the loads and the parts of a machine, in this order."""
    mechanism = parts.mechanism
    is_loaded = mechanism.spec.is_loaded
    return [
        *motion_warnings(mechanism),
        *(_of_loads(mechanism) if is_loaded else ()),
        *unlikely_warnings(mechanism),
        *carried_warnings(mechanism, known_wheel_body(mechanism)),
        *(_of_strength(mechanism) if is_loaded else ()),
        *turn_warnings(parts),
        *bearing_warnings(parts),
        *process_warnings(parts),
    ]


# Machines without a load do not import what these two need.


def _of_strength(mechanism: Mechanism) -> list[Notice]:
    from geneva_cli.verdict.strength import strength

    return strength(mechanism).warnings()


def _of_loads(mechanism: Mechanism) -> list[Notice]:
    from geneva_cli.loads.cycle import cycle_of
    from geneva_cli.loads.load_tables import summaries
    from geneva_cli.verdict.cycle_warnings import cycle_warnings, load_warnings

    cycle = cycle_of(mechanism)
    return [*load_warnings(mechanism), *cycle_warnings(cycle, summaries(cycle))]
