"""A Geneva mechanism against a cam indexer and a servo, with the same step, time and load.

Each alternative is a machine whose wheel follows a law, with one index a turn of its input; it has
the same functions of loads, sizing and vibration. A cam indexer has the modified sine. A servo has
the seven segments of ``s-curve``, drives the dial through the motor's reducer, and speeds up its
own rotor, too.
"""

import math
from collections.abc import Sequence

import numpy as np

from geneva_cli.design import Design, load
from geneva_cli.drives.crank import Crank
from geneva_cli.errors import GenevaError, cut
from geneva_cli.extras.servo.s_curve import SCurve
from geneva_cli.loads.load_case import inertia_kgm2, resisting_torques_Nm
from geneva_cli.motion.laws.law import Law, Motion
from geneva_cli.motion.laws.standard import ModifiedSine
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.wheels.external import External
from geneva_cli.spec.tables import Load
from geneva_cli.study.compare import over
from geneva_cli.study.fields import Cell, pick
from geneva_cli.table import Table, rows_table

# The rows, and their quantities.
ROWS = {
    "motion_s": "timing.motion_s",
    "dwell_s": "timing.dwell_s",
    "velocity_max_rad_s": "velocity.max_rad_s",
    "acceleration_max_rad_s2": "acceleration.max_rad_s2",
    "acceleration_entry_rad_s2": "acceleration.entry_rad_s2",
    "jerk_max_rad_s3": "jerk.max_rad_s3",
    "wheel_torque_max_Nm": "loads.torque_Nm.max",
    "motor_torque_max_Nm": "sizing.motor_torque_max_Nm",
    "motor_torque_rms_Nm": "sizing.motor_torque_rms_Nm",
    "power_max_W": "loads.power_W.max",
    "inertia_ratio": "sizing.inertia_ratio",
    "residual_deg": "vibration.residual_deg",
}
# What no number says of the design and the alternatives; its lock or detent holds its dwell.
WORDS = {
    "holds_the_dwell_by": ("", "cam", "motor torque"),
    "impact_at_entry": ("if R/L is off", "none", "none"),
    "without_power": ("follows crank", "follows cam", "coasts"),
    "another_step_or_time": ("a new wheel", "a new cam", "a parameter"),
}
LAWS: dict[str, Law] = {"cam": ModifiedSine(), "servo": SCurve()}


def against(path: str, settings: Sequence[str], names: Sequence[str]) -> Table:
    """A column for the design and each alternative, a row for each quantity."""
    for name in names:
        if name not in LAWS:
            raise GenevaError(f"--against {cut(name)}: it must be one of {', '.join(LAWS)}")
    design = load(path, settings)
    columns = {name: _values(design, name) for name in dict.fromkeys(("geneva", *names))}
    rows: list[tuple[Cell, ...]] = [(row, *(own[row] for own in columns.values())) for row in ROWS]
    for row, (own_words, *words) in WORDS.items():
        cells = {"geneva": own_words or design.spec.dwell_holder or "nothing"}
        cells |= zip(LAWS, words, strict=True)
        rows.append((row, *(cells[name] for name in columns)))
    known = [row for row in rows if any(cell is not None for cell in row[1:])]
    return rows_table(("quantity", *columns), known, design.spec.title, mixed=True)


def alternative(design: Design, name: str, rotor: bool = False) -> Mechanism:
    """The machine of a cam indexer or a servo with the step, the times and the load of a design."""
    times = design.timings
    steps = [t.index_deg for t in times if t.index_deg is not None]
    spans = [(round(t.motion_s, 12), round(t.cycle_s, 12)) for t in times]
    differ = len({*zip(spans, [round(step, 9) for step in steps], strict=False)}) > 1
    if design.spec.drive.wheels_on_carrier or not steps or differ:
        raise GenevaError(
            "--against: cam and servo turn one wheel on the ground by one index a turn; this "
            "machine's engagements differ, it moves a rack, or its wheels are on a carrier"
        )
    first = times[0]
    z = round(360.0 / steps[0])  # equal steps fill a turn
    spec, own = design.spec, design.spec.motor
    n_rpm = 60.0 / first.cycle_s
    inertia, torque = inertia_kgm2(spec), sum(resisting_torques_Nm(spec))
    # A cam's reducer lets the motor turn as fast as before.
    motor = own.replace(gear_ratio=own.ratio * spec.drive.n_rpm / n_rpm)
    efficiency = spec.load.efficiency
    if name == "servo":
        motor, efficiency = own, 1.0
    if rotor:
        inertia = inertia / own.gear_efficiency + own.inertia_kgm2 * own.ratio**2
        torque = torque / own.gear_efficiency
    # The extra dwell angle takes the place of the motion angle that z slots would have.
    extra = 180.0 - 360.0 / z - 360.0 * first.motion_s / first.cycle_s
    return build(
        Spec(
            External(z),
            Crank(n_rpm=n_rpm),
            Motion(LAWS[name], alpha0_deg=extra, ratio="matched"),
            load=Load(inertia_kgm2=inertia, torque_Nm=torque, efficiency=efficiency),
            motor=motor,
            shaft=spec.shaft,
        )
    )


def _values(design: Design, name: str) -> dict[str, Cell]:
    machine = alternative(design, name) if name in LAWS else design.mechanism
    values = dict(zip(ROWS, pick([*ROWS.values()]).of(machine), strict=True))
    if name != "servo":
        return values
    motor = design.spec.motor
    rotating = alternative(design, name, rotor=True)
    most, power = pick(("loads.torque_Nm.max", "loads.power_W.max")).of(rotating)
    values |= {
        "motor_torque_max_Nm": over(most, motor.ratio),
        "motor_torque_rms_Nm": _servo_rms_Nm(design) if most is not None else None,
        "power_max_W": power,
    }
    inertia = inertia_kgm2(design.spec)
    values["inertia_ratio"] = over(inertia, motor.inertia_kgm2 * motor.ratio**2)
    return values


def _servo_rms_Nm(design: Design) -> float:
    """The root mean square of a servo's motor torque over a cycle."""
    motor, first, law = design.spec.motor, design.timings[0], LAWS["servo"]
    inertia, resisting = inertia_kgm2(design.spec), sum(resisting_torques_Nm(design.spec))
    unit = math.radians(first.index_deg or 0.0) / first.motion_s**2
    # the acceleration follows lines, and the torque too, but where the load begins to drive
    u = np.array([0.0, *law.breaks, 1.0])
    a = unit * np.asarray(law(u, 2).derivatives()[2])
    load = inertia * a + resisting
    i = np.flatnonzero(load[:-1] * load[1:] < 0.0)
    u, a = (np.insert(x, i + 1, x[i] - load[i] * np.diff(x)[i] / np.diff(load)[i]) for x in (u, a))
    load = inertia * a + resisting
    drives = load[:-1] + load[1:] > 0.0
    eta = np.where(drives, 1.0 / motor.gear_efficiency, motor.gear_efficiency)
    rotor = motor.inertia_kgm2 * motor.ratio * a
    one, two = (load[x] * eta / motor.ratio + rotor[x] for x in (slice(-1), slice(1, None)))
    mean = float((np.diff(u) * (one * one + one * two + two * two)).sum()) / 3.0
    return math.sqrt(mean * first.motion_s / first.cycle_s)
