"""Summary of ``geneva loads``: the motor first, then input, pin, impact, wheel and flywheel."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from geneva_cli.answer import WARNS, Answer, Summary, SummaryLine, phrases, value_text
from geneva_cli.design import Design
from geneva_cli.errors import open_warnings
from geneva_cli.loads.load_peaks import LoadSummary
from geneva_cli.loads.load_tables import RATED_kW, no_load, recommended_motor
from geneva_cli.names import unit_of
from geneva_cli.numerics.tolerances import TIE
from geneva_cli.study.verdicts import chosen_lines, warning
from geneva_cli.table import Table
from geneva_cli.verdict.failures import below_summary

NO_BOUND = "no bound: see the warnings"


def of_loads(design: Design, is_whole: bool) -> Answer:
    """The answer of ``geneva loads``: motor and greatest loads; if ``is_whole``, all below them."""
    first = summary_of(design, load_lines(design), design.warnings)
    if not is_whole:
        more = SummaryLine("more", "-v: powers, all loads, sizing, life, and what is not known")
        return Answer((first._replace(lines=(*first.lines, more)),), None, design.loads_table)
    powers = tuple(_powers(design))
    summaries = (first, Summary("Required power", powers)) if powers else (first,)
    return Answer(summaries, design.loads_page, design.loads_table)


def load_lines(design: Design) -> Iterator[SummaryLine]:
    """Motor, input, pin, impact, wheel, flywheel of a machine; without a load, the needed keys."""
    if not design.cycle.is_loaded:
        yield SummaryLine("loads", f"not known: {no_load(design.cycle)}")
        return
    yield motor_line(design)
    yield from cycle_lines(design)
    if design.spec.drive.stop_s:  # what braking and starting the rotor in each dwell takes
        known, text = design.strength.table("input_stop"), "not known: set inertia_kgm2 in [motor]"
        if known["inertia_kgm2"] is not None:
            torques = "stops with {brake_torque_Nm}, ", "starts with {start_torque_Nm}, "
            text = phrases(known, *torques, "{energy_J} each time, {power_W}")
            if known["brake_torque_Nm"] is None or known["start_torque_Nm"] is None:
                text += "; set brake_s and start_s in [drive] for both torques"
        yield SummaryLine("brake", text)
    yield from flywheel_line(design)
    yield from chosen_lines(design.chosen_by_load, design.spec.path)


def flywheel_line(design: Design) -> Iterator[SummaryLine]:
    """The line of the flywheel, if the spec allows the input's speed to vary."""
    sizing = design.strength.table("sizing")
    whole, add = sizing["flywheel_kgm2"], sizing["flywheel_to_add_kgm2"]
    if whole is not None:
        variation = value_text(100.0 * (design.spec.motor.speed_variation or 0.0), "%")
        more = "" if add == whole else ", {flywheel_to_add_kgm2} of it besides the motor"
        text = "{flywheel_kgm2} on the input for a speed variation of "
        yield SummaryLine("flywheel", phrases(sizing, text) + variation + phrases(sizing, more))


def cycle_lines(design: Design) -> Iterator[SummaryLine]:
    """The loads of input, pin and wheel over the cycle, and the impact at a change of sides."""
    loads = design.loads
    torque = design.cycle.extremes["input_torque_Nm"]  # with its signs
    if not math.isfinite(torque.max - torque.min):
        yield SummaryLine("input", f"torque {NO_BOUND}")
    else:
        text = f"{value_text(torque.min)} to {value_text(torque.max, 'N m')}"
        text += f", rms {value_text(torque.rms)}" if torque.rms is not None else ""
        driven = "never drives the motor"
        if torque.min < 0.0:
            driven = f"drives the motor with up to {value_text(-torque.min, 'N m')}"
        yield SummaryLine("input", f"{text}; the {design.spec.output.noun} {driven}")
    stress = "needs face_width_mm in [size]"
    if design.spec.size.face_width_mm is not None:
        stress = _greatest(loads, "contact_stress_MPa")
    yield SummaryLine("pin", f"{_greatest(loads, 'pin_force_N')}; contact stress {stress}")
    impact = design.strength.table("shock.reversal")  # of the roller on the other wall of its slot
    if impact["jump"] is not None and impact["at_deg"] is not None:
        first = "speed jumps by {jump} of the input's" if impact["force_N"] is None else "{force_N}"
        where = " at {at_deg}, where the roller changes sides"
        text = phrases(impact, first, where, "; contact stress {contact_stress_MPa}")
        yield SummaryLine("impact", text, "geneva explain reversal_shock_N")
    label, moved, what, pushed = "rack", "rack_acceleration_m_s2", "force", "rack_force_N"
    if design.spec.output.turns:
        label, moved, what, pushed = "wheel", "alpha_rad_s2", "torque", "wheel_torque_Nm"
    yield SummaryLine(label, f"{_greatest(loads, moved)}; {what} {_greatest(loads, pushed)}")


def greatest(ends: LoadSummary[float | None]) -> tuple[float, float | None] | None:
    """Greatest size of a load and its input angle, the earlier of two equal ones; or None."""
    if ends.max is None or ends.min is None:
        return None
    both = (ends.max, ends.max_at_deg), (-ends.min, ends.min_at_deg)
    bar = (1.0 - TIE) * max(ends.max, -ends.min)
    return min((p for p in both if p[0] >= bar), key=lambda p: p[1] or 0.0)


def _greatest(loads: Mapping[str, LoadSummary[float | None]], name: str) -> str:
    """Greatest size of a load, and its input angle, in words."""
    known = greatest(loads[name])
    if known is None:
        return NO_BOUND
    where = "" if known[1] is None else f" at {value_text(known[1], 'deg')}"
    return f"{value_text(known[0], unit_of(name) or '')}{where}"


def motor_line(design: Design) -> SummaryLine:
    """The recommended motor, and its reason."""
    motor = recommended_motor(design.strength.table("sizing"))
    if motor is None:
        return SummaryLine("motor", "none suffices: nothing bounds the input's torque", "", WARNS)
    keys = design.spec.motor
    why = "at most over the exact cycle"
    if motor.formula_W >= motor.peak_W:  # the cam-indexer formula decides
        why = f"with service factor {value_text(keys.service_factor)} and all losses"
    needed = f"{value_text(motor.needed_W, 'W')} {why}"
    if motor.rated_kW is None:
        text = f"{needed}: more than any standard motor has"
        return SummaryLine("motor", text, "geneva explain motor", WARNS)
    power, source = value_text(motor.rated_kW, "kW"), "the next power of IEC 60072-1"
    if motor.needed_W < 1e3 * RATED_kW[0]:
        source = f"less than the smallest motor of IEC 60072-1, {power}"
        torque_Nm = motor.needed_W * 60.0 / (motor.rpm * math.tau)
        power = f"{value_text(motor.needed_W, 'W')}, {value_text(torque_Nm, 'N m')}"
    four_poles_rpm = 1400.0  # at full load, of small motors with four poles at 50 Hz
    geared = f", gear ratio {value_text(keys.ratio)}"
    if keys.gear_ratio is None and 2.0 * motor.rpm <= four_poles_rpm:  # a slow input
        ratio = value_text(four_poles_rpm / motor.rpm, digits=3)
        fast = value_text(four_poles_rpm, "rpm")
        geared = f" behind its reducer, as gear ratio {ratio} from {fast}"
    torque = f"{value_text(motor.input_torque_Nm, 'N m')} on the input by the cam-indexer formula"
    note = f"{needed}; {torque}; {source} (geneva explain motor)"
    return SummaryLine("motor", f"{power}, {value_text(motor.rpm, 'rpm')}{geared}", note)


def _powers(design: Design) -> Iterator[SummaryLine]:
    """The powers of a machine in descending order, each with its definition."""
    motor = recommended_motor(design.strength.table("sizing"))
    power, inertia = design.loads["power_W"], design.strength["loads.kinetic_power_W"]
    powers: list[tuple[float | None, str]] = [
        (power.max, "greatest at the input, over the exact cycle"),
        (power.rms, "root mean square at the input, dwells included: what heats the motor"),
        (power.mean, "mean at the input: the energy of a cycle over its time"),
        (inertia, "greatest that the inertia alone takes from the input"),
    ]
    if motor:
        text = "at the motor by the cam-indexer formula, with service factor and all losses"
        powers.append((motor.formula_W, text))
    if motor and design.spec.motor.gear_efficiency < 1.0:
        text = "greatest at the motor over the exact cycle, with the reducer's losses"
        powers.append((motor.peak_W, text))
    known = [(size, text) for size, text in powers if size is not None]
    for size, text in sorted(known, key=lambda pair: -pair[0]):
        yield SummaryLine(value_text(size, "W"), text)


def record_answer(
    design: Design, record: Table, lines: Iterable[SummaryLine], warnings: Sequence[str]
) -> Answer:
    """An answer of some lines and warnings, with the other values of a record below them."""
    summary = summary_of(design, lines, warnings)
    return Answer((summary,), below_summary(record, without=("title", "chosen")), record)


def summary_of(design: Design, lines: Iterable[SummaryLine], warnings: Sequence[str]) -> Summary:
    """Some lines and warnings about a design, whose headline counts the warnings."""
    many = len(open_warnings(warnings))
    counted = f": {many} warning{'s' * (many != 1)}" if many else ""
    state = WARNS if many else ""
    return Summary(title_of(design) + counted, (*lines, *map(warning, warnings)), state)


def title_of(design: Design) -> str:
    """The title of a design, or else its description."""
    return design.spec.title or design.spec.wheel.title
