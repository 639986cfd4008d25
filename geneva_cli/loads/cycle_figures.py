"""The curves of one or more machines over a cycle: motion and loads by the input angle."""

import math
from collections.abc import Mapping, Sequence
from typing import TypeAlias

from geneva_cli.errors import GenevaError, Notice, cut, few, nearest
from geneva_cli.figure import Axis, Curve, Figure, Panel
from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.cycle_curves import MOTION_QUANTITIES, Drawn, drawn, rests
from geneva_cli.loads.load_tables import no_load
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import first_entry_deg

MACHINES_MAX = 6  # machines in one figure that the eye can tell apart
AXES = (
    Axis("wheel_deg", "Wheel angle", "deg"),
    Axis("rack_mm", "Travel of the rack", "mm"),
    Axis("velocity", "Speed of the wheel, relative to the input"),
    Axis("acceleration", "Acceleration of the wheel, relative to the input"),
    Axis("jerk", "Jerk of the wheel, relative to the input"),
    Axis("power", "Speed times acceleration, relative to the input"),
    Axis("omega_rad_s", "Wheel's velocity", "rad/s"),
    Axis("alpha_rad_s2", "Wheel's acceleration", "rad/s²"),
    Axis("wheel_torque_Nm", "Torque on the wheel", "N m"),
    Axis("rack_speed_m_s", "Speed of the rack", "m/s"),
    Axis("rack_acceleration_m_s2", "Acceleration of the rack", "m/s²"),
    Axis("rack_force_N", "Force on the rack", "N"),
    Axis("pin_force_N", "Pin force", "N"),
    Axis("contact_stress_MPa", "Contact stress", "MPa"),
    Axis("sliding_m_s", "Sliding of the roller", "m/s"),
    Axis("input_torque_Nm", "Torque on the input", "N m"),
    Axis("power_W", "Power of the input", "W"),
    Axis("wheel_bearing_N", "Force on the wheel's bearings", "N"),
    Axis("crank_bearing_N", "Force on the crank's bearings", "N"),
    Axis("pv_W_m2", "Pressure times sliding", "W/m²"),
    Axis("guide_force_N", "Force on the guide", "N"),
    Axis("wheel_near_bearing_N", "Wheel's nearer bearing", "N"),
    Axis("wheel_far_bearing_N", "Wheel's farther bearing", "N"),
    Axis("crank_near_bearing_N", "Crank's nearer bearing", "N"),
    Axis("crank_far_bearing_N", "Crank's farther bearing", "N"),
)
AXIS_BY_NAME = {axis.name: axis for axis in AXES}
# besides the wheel's angle or the rack's travel
USUAL_QUANTITIES = ("velocity", "acceleration", "jerk", "pin_force_N", "input_torque_Nm", "power_W")

LeftOut: TypeAlias = tuple[str, str]  # a machine's name, and a sentence on what it lacks


def figure(cycles: Mapping[str, Cycle], pick: Sequence[str] = ()) -> tuple[Figure, list[LeftOut]]:
    """The figure of machines by their names, and the curves that it lacks, with reasons.

    ``pick`` are names of quantities; by default the known ones of ``USUAL_QUANTITIES``. Raises
    GenevaError for an unknown name, and for a requested quantity that no machine has.
    """
    if len(cycles) > MACHINES_MAX:
        raise GenevaError(
            f"{len(cycles)} designs in one figure; at most {MACHINES_MAX} can be told apart"
        )
    for name in pick:
        if name not in AXIS_BY_NAME:
            raise GenevaError(
                f"--pick {cut(name)}: no quantity of a cycle{nearest(name, AXIS_BY_NAME)}; "
                f"it must be one of {few(name, AXIS_BY_NAME)}"
            )
    outputs = tuple(dict.fromkeys(cycle.mechanism.output.column for cycle in cycles.values()))
    requested = tuple(dict.fromkeys(pick)) or (*outputs, *USUAL_QUANTITIES)
    has = {
        design: {one.mechanism.output.column, *MOTION_QUANTITIES, *one.sources}
        for design, one in cycles.items()
    }
    shown = [name for name in requested if any(name in known for known in has.values())]
    missing = [name for name in requested if name not in shown]
    if missing and pick:
        raise GenevaError(f"--pick {missing[0]}: {_why(next(iter(cycles.values())))}")
    machines = [cycle.mechanism for cycle in cycles.values()]
    start = min(first_entry_deg(m) for m in machines)
    window = start, start + max(m.period_deg for m in machines)
    curves = {
        design: drawn(cycle, [n for n in shown if n in has[design]], window)
        for design, cycle in cycles.items()
    }
    panels = tuple(_panel(name, machines, curves) for name in shown)
    left = list[LeftOut]()
    for design, cycle in cycles.items():
        names = requested if cycle.is_loaded else shown  # forces are not expected without a load
        lacking = [name for name in names if name not in has[design] and name not in outputs]
        if lacking:
            text = f"no curve of {', '.join(lacking)}: {_why(cycle)}"
            left.append((design, Notice("not-known", text)))
    spec, noun = machines[0].spec, machines[0].output.noun
    title = spec.title or spec.path or f"Geneva {noun} of {spec.wheel.z} slots"
    if len(machines) > 1:
        title = f"{len(machines)} designs over a cycle"
    axis, still = Axis("input_deg", "Input angle", "deg"), tuple(rests(machines, window))
    return Figure(title, axis, panels, window, still), left


def _why(cycle: Cycle) -> str:
    """The reason why a machine does not have a quantity."""
    needs = "this machine has none, or needs a key that `geneva loads` names"
    return needs if cycle.is_loaded else no_load(cycle)


def _panel(
    name: str, machines: Sequence[Mechanism], designs: Mapping[str, Mapping[str, Drawn]]
) -> Panel:
    """The curves of a quantity; its label names the part that moves, if it is the same in all."""
    axis, output = AXIS_BY_NAME[name], machines[0].output
    if all(machine.output.noun == output.noun for machine in machines):
        label = axis.label.replace("wheel, relative to the input", f"wheel, {output.invariants}")
        label = label.replace("wheel", output.noun).replace("Wheel", output.noun.capitalize())
        axis = axis._replace(label=label)
    curves: list[Curve] = []
    ends: list[float] = []
    for number, (design, own) in enumerate(designs.items()):
        if name in own:
            pieces, marks, bounds = own[name]
            if len(designs) > 1 and marks:  # one mark for each design: the greater in size
                marks = (max(marks, key=lambda m: math.inf if m.y is None else abs(m.y)),)
            curves.append(Curve(number, design, tuple(pieces), marks))
            ends += bounds or ()
    return Panel(axis, tuple(curves), (min(ends), max(ends)) if ends else None)
