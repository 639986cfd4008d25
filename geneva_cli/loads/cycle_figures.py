"""The curves of one or more machines over a cycle: motion and loads by the input angle."""

import math
from collections.abc import Mapping, Sequence
from typing import TypeAlias

from geneva_cli.errors import GenevaError, Notice, cut, few, nearest
from geneva_cli.figure import Axis, Curve, Figure, Panel
from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.cycle_curves import MOTION_QUANTITIES, Drawn, drawn, rests
from geneva_cli.loads.load_tables import SHOWN_QUANTITIES, no_load
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import first_entry_deg
from geneva_cli.names import capital, described, spoken

MACHINES_MAX = 6  # machines in one figure that the eye can tell apart
# all that have curves
QUANTITIES = ("wheel_deg", "rack_mm", *MOTION_QUANTITIES, *SHOWN_QUANTITIES)
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
        if name not in QUANTITIES:
            raise GenevaError(
                f"--pick {cut(name)}: no quantity of a cycle{nearest(name, QUANTITIES)}; "
                f"it must be one of {few(name, QUANTITIES)}"
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
    """The curves of a quantity; the label of an invariant says of what, if that is one in all."""
    label, unit = capital(described(name)[0]), spoken(name)[1]
    if name in MOTION_QUANTITIES:
        of = {f" of the {m.output.noun}, {m.output.invariants}" for m in machines}
        label += of.pop() if len(of) == 1 else ", relative to the input"
    curves: list[Curve] = []
    ends: list[float] = []
    for number, (design, own) in enumerate(designs.items()):
        if name in own:
            pieces, marks, bounds = own[name]
            if len(designs) > 1 and marks:  # one mark for each design: the greater in size
                marks = (max(marks, key=lambda m: math.inf if m.y is None else abs(m.y)),)
            curves.append(Curve(number, design, tuple(pieces), marks))
            ends += bounds or ()
    return Panel(Axis(name, label, unit), tuple(curves), (min(ends), max(ends)) if ends else None)
