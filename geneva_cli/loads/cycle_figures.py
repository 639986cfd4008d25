"""The curves of one or more machines over a cycle: motion and loads by the input angle.

Each smooth piece of a curve is sampled separately, with both ends from inside, so that a jump has
both its values. Peaks are those of the analysis, never the highest of the samples.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError, Notice, cut, few, nearest
from geneva_cli.figure import Axis, Curve, Figure, Mark, Panel, Piece
from geneva_cli.loads import load_tables
from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.cycle_quantities import FORCE, WALL_FORCE, sources
from geneva_cli.loads.load_peaks import LoadSummary, load_summaries
from geneva_cli.loads.stages import MOTION_QUANTITIES, Stage, load_stages, motion_stages, pieces
from geneva_cli.motion import peaks
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import first_entry_deg
from geneva_cli.numerics.tolerances import ROUNDED, SAME_INPUT_DEG

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
USUAL_QUANTITIES = (  # besides the wheel's angle or the rack's travel
    "velocity",
    "acceleration",
    "jerk",
    "pin_force_N",
    "input_torque_Nm",
    "power_W",
)


LeftOut: TypeAlias = tuple[str, str]  # a machine's name, and a sentence on what it lacks


class MachineCurves(NamedTuple):
    """Some quantities of a machine over the window: the pieces, marks and bounds of each."""

    pieces: dict[str, list[Piece]]
    marks: dict[str, tuple[Mark, ...]]
    bounds: dict[str, tuple[float, float]]


def figure(cycles: Mapping[str, Cycle], pick: Sequence[str] = ()) -> tuple[Figure, list[LeftOut]]:
    """The figure of machines by their names, and the curves that it lacks, with reasons.

    ``pick`` are names of quantities; by default the known ones of ``USUAL_QUANTITIES``. Raises
    GenevaError for an unknown name, and for a requested quantity that no machine has.

    >>> from geneva_cli import Design, External
    >>> velocities, left_out = figure({"six": Design(External(6)).cycle}, ["velocity"])
    >>> velocities.panels[0].curves[0].marks
    (Mark(word='peak', x=0.0, y=1.0),)
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
        design: {one.mechanism.output.column, *MOTION_QUANTITIES, *sources(one.mechanism)}
        for design, one in cycles.items()
    }
    shown = [name for name in requested if any(name in known for known in has.values())]
    missing = [name for name in requested if name not in shown]
    if missing and pick:
        raise GenevaError(f"--pick {missing[0]}: {_why(next(iter(cycles.values())), missing[0])}")
    machines = [cycle.mechanism for cycle in cycles.values()]
    start = min(first_entry_deg(m) for m in machines)
    window = start, start + max(m.period_deg for m in machines)
    drawn = {
        design: _drawn(cycle, [n for n in shown if n in has[design]], window)
        for design, cycle in cycles.items()
    }
    panels = tuple(_panel(_axis(name, machines), drawn) for name in shown)
    axis, rests = Axis("input_deg", "Input angle", "deg"), tuple(_rests(machines, window))
    left = []
    for design, cycle in cycles.items():
        names = requested if cycle.is_loaded else shown  # forces are not expected without a load
        lacking = [n for n in names if n not in has[design] and n not in outputs]
        left += [(design, line) for line in _left_out(cycle, lacking)]
    spec, noun = machines[0].spec, machines[0].output.noun
    title = spec.title or spec.path or f"Geneva {noun} of {spec.wheel.z} slots"
    if len(machines) > 1:
        title = f"{len(machines)} designs over a cycle"
    return Figure(title, axis, panels, window, rests), left


def _left_out(cycle: Cycle, names: Sequence[str]) -> Iterator[str]:
    """Sentences on the curves that a figure lacks for a machine, one for each reason."""
    reasons: dict[str, list[str]] = {}
    for name in names:
        reasons.setdefault(_why(cycle, name), []).append(name)
    for why, lacking in reasons.items():
        yield Notice("not-known", f"no curve of {', '.join(lacking)}: {why}")


def _why(cycle: Cycle, name: str) -> str:
    """The reason why a machine does not have a quantity."""
    notices = load_tables.missing(cycle)
    if not cycle.is_loaded:
        return notices[0]
    for line in notices:
        names, _, why = line.partition(": ")
        if name in names.split(", "):
            return why
    if name == "guide_force_N":
        return "the crank itself carries the roller, and there is no guide"
    return f'gearing = "{cycle.mechanism.spec.wheel.NAME}" has another quantity instead'


def _axis(name: str, machines: Sequence[Mechanism]) -> Axis:
    """The axis of a quantity; its label names the part that moves, if it is the same in all."""
    axis, output = AXIS_BY_NAME[name], machines[0].output
    if any(machine.output.noun != output.noun for machine in machines):
        return axis
    label = axis.label.replace("wheel, relative to the input", f"wheel, {output.invariants}")
    label = label.replace("wheel", output.noun).replace("Wheel", output.noun.capitalize())
    return axis._replace(label=label)


def _panel(axis: Axis, drawn: Mapping[str, MachineCurves]) -> Panel:
    """The curves of a quantity."""
    name = axis.name
    curves: list[Curve] = []
    bounds: list[float] = []
    for number, (design, own) in enumerate(drawn.items()):
        if name in own.pieces:
            marks = own.marks[name]
            if len(drawn) > 1 and marks:  # one mark for each design: the greater in size
                marks = (max(marks, key=lambda m: math.inf if m.y is None else abs(m.y)),)
            curves.append(Curve(number, design, tuple(own.pieces[name]), marks))
            bounds += own.bounds.get(name, ())
    return Panel(axis, tuple(curves), (min(bounds), max(bounds)) if bounds else None)


def _drawn(cycle: Cycle, names: Sequence[str], window: tuple[float, float]) -> MachineCurves:
    machine = cycle.mechanism
    column, per_radian = machine.output.column, machine.output.per_radian
    moves = [n for n in names if n in (column, *MOTION_QUANTITIES)]
    loads = [n for n in names if n not in moves]
    step = sum(2.0 * e.half_step for e in machine.engagements) * per_radian
    out = MachineCurves({}, {}, {})
    if moves:
        stages = list(motion_stages(machine, moves))
        rise = [step if n == column else 0.0 for n in moves]
        curves = pieces(stages, machine.period_deg, window, rise)
        out.pieces.update(zip(moves, curves, strict=True))
        out.marks.update((n, _peak(machine, n, i, stages, window)) for i, n in enumerate(moves))
    if loads:
        ends = {name: cycle.extremes[name] for name in loads}
        if FORCE in ends:  # drawn with the sign of the wall that bears
            force = load_summaries(cycle.mechanism, [WALL_FORCE], ())[WALL_FORCE]
            ends[FORCE] = LoadSummary(*(float(row[0]) for row in force[:4]))
        out.bounds.update(_bounds(cycle, ends))
        stages = list(load_stages(cycle, loads, out.bounds))
        curves = pieces(stages, machine.period_deg, window, [0.0] * len(loads))
        out.pieces.update(zip(loads, curves, strict=True))
        for name, bounds in out.bounds.items():
            out.pieces[name] = [cut for p in out.pieces[name] for cut in _within(p, bounds)]
        out.marks.update((n, tuple(_ends(machine, ends[n], window))) for n in loads)
    return out


def _peak(
    machine: Mechanism, name: str, row: int, stages: Sequence[Stage], window: tuple[float, float]
) -> tuple[Mark, ...]:
    """The greatest size of a quantity of the motion, with its sign; none for the wheel's angle."""
    if name == machine.output.column:
        return ()
    peak = peaks.worst_of(machine, name)
    first = first_entry_deg(machine)
    x = _placed(machine, peak.at_deg, (first, first))
    values = [
        float(stage.of(np.array([x]))[row, 0])
        for stage in stages
        if stage.start - SAME_INPUT_DEG <= x <= stage.end + SAME_INPUT_DEG
    ]
    nearest_to = min(values, key=lambda value: abs(abs(value) - peak.max))
    y = math.copysign(peak.max, nearest_to)
    return (Mark("peak", _placed(machine, peak.at_deg, window), y),)


def _ends(
    machine: Mechanism, ends: LoadSummary[float], window: tuple[float, float]
) -> Iterator[Mark]:
    """The greatest value of a load and, if it goes below 0, the least."""
    size = max(abs(ends.max), abs(ends.min))
    for word, value, at_deg, shown in (
        ("max", ends.max, ends.max_at_deg, ends.max > ROUNDED * size),
        ("min", ends.min, ends.min_at_deg, ends.min < -ROUNDED * size),
    ):
        if shown or math.isinf(value):
            y = value if math.isfinite(value) else None
            yield Mark(word, _placed(machine, at_deg, window), y)


def _placed(machine: Mechanism, at_deg: float, window: tuple[float, float]) -> float:
    """An input angle as displayed, moved by whole turns to its first place in the window."""
    whole = machine.whole_deg
    return at_deg + whole * math.ceil((window[0] - SAME_INPUT_DEG - at_deg) / whole)


def _bounds(cycle: Cycle, ends: Mapping[str, LoadSummary[float]]) -> dict[str, tuple[float, float]]:
    """The visible range of each unbounded load, from its sizes half-way between cuts."""
    out = {}
    for name, (top, _, low, *_) in ends.items():
        if math.isfinite(top) and math.isfinite(low):
            continue
        sizes = []
        for engagement, stretch in cycle.stretches:
            middle = np.array([0.5 * (stretch.start + stretch.end)])
            here = cycle.plain(cycle.along(engagement, stretch, middle), name)
            sizes.append(abs(float(here[0])))
        # an unbounded load is visible up to three times its typical size
        high = 3.0 * max((size for size in sizes if math.isfinite(size)), default=1.0)
        out[name] = -high if math.isinf(low) else low, high if math.isinf(top) else top
    return out


def _within(piece: Piece, bounds: tuple[float, float]) -> Iterator[Piece]:
    """A piece that was limited to bounds, without its parts along them."""
    x, y = piece
    begin = 0
    for i, (a, b) in enumerate(pairwise(y), 1):
        if a == b and a in bounds:
            if i - begin > 1:
                yield x[begin:i], y[begin:i]
            begin = i
    if len(x) - begin > 1 or len(x) == 1:
        yield x[begin:], y[begin:]


def _rests(
    machines: Sequence[Mechanism], window: tuple[float, float]
) -> Iterator[tuple[float, float]]:
    """The stretches in which all machines rest."""
    common = [window]
    for machine in machines:
        dwells = [(s.start, s.end) for s in motion_stages(machine, []) if s.flat]
        period = machine.period_deg
        turns = range(-1, 2 + int((window[1] - window[0]) // period))
        own = [(a + k * period, b + k * period) for k in turns for a, b in dwells]
        both = [(max(a, c), min(b, d)) for a, b in common for c, d in own]
        common = [(a, b) for a, b in both if b - a > SAME_INPUT_DEG]
    yield from common
