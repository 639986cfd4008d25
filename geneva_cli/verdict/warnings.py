"""All warnings about a design: one list, which every command and format shows."""

from __future__ import annotations

from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import Notice
from geneva_cli.machine.both_ways import every_way
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.wheel_inertia import known_wheel_body
from geneva_cli.verdict.carried_warnings import carried_warnings, unlikely_warnings
from geneva_cli.verdict.direction_warnings import direction_warnings
from geneva_cli.verdict.motion_warnings import motion_warnings
from geneva_cli.verdict.parts_warnings import process_warnings, turn_warnings


def warnings(model: PartsModel) -> list[Notice]:
    """Warnings about the motion, the loads and the parts of a machine, in this order.

    A machine that turns both ways also has those that appear backwards only.
    """
    mechanism = model.mechanism
    out = one_way_warnings(model)
    for other in every_way(mechanism)[1:]:
        own = set(map(str, out))
        # the law's name alone makes no other warning
        more = [
            text
            for text in one_way_warnings(PartsModel(other))
            if text.replace(", backwards", "") not in own
        ]
        out += [Notice(text.name, f"backwards, {text}") for text in more]
    return [*direction_warnings(mechanism), *out]


def one_way_warnings(model: PartsModel) -> list[Notice]:
    """Warnings about a machine in its own direction, in the order of ``warnings``."""
    mechanism = model.mechanism
    of_strength = _of_strength(mechanism) if mechanism.spec.is_loaded else []
    return [
        *motion_warnings(mechanism),
        *under_load(mechanism),
        *of_strength,
        *turn_warnings(model),
        *process_warnings(model),
    ]


def under_load(mechanism: Mechanism) -> list[Notice]:
    """Warnings about the loads of a machine, about unlikely numbers, and about what it carries."""
    return [
        *(_of_loads(mechanism) if mechanism.spec.is_loaded else ()),
        *unlikely_warnings(mechanism),
        *carried_warnings(mechanism, known_wheel_body(mechanism)),
    ]


# Machines without a load do not import what these two need.


def _of_strength(mechanism: Mechanism) -> list[Notice]:
    from geneva_cli.verdict.strength import strength

    return strength(mechanism).warnings()


def _of_loads(mechanism: Mechanism) -> list[Notice]:
    from geneva_cli.loads.cycle import cycle_of
    from geneva_cli.loads.summary import summaries
    from geneva_cli.verdict.cycle_warnings import cycle_warnings, load_warnings

    cycle = cycle_of(mechanism)
    return [*load_warnings(mechanism), *cycle_warnings(cycle, summaries(cycle))]
