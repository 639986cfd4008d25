"""The checks of shocks: what they hold, what they say, and that what they say is so."""

import functools
import math
import re

import numpy as np
import pytest
from impact_witness import contact_of, force_of, impacts_in
from scipy.integrate import quad
from scipy.optimize import brentq

from geneva_cli import Cam, Design, External, Limits, Load, ModifiedSine, Motion, Size, Tolerance
from geneva_cli.loads.impacts.entry import RestingAxis, mouth_contacts
from geneva_cli.loads.impacts.reversal import changes
from geneva_cli.loads.load_case import load_case
from geneva_cli.parts.machine_sizes import built
from geneva_cli.study.summary.load_lines import load_lines
from geneva_cli.verdict.checks import checks

LOOSE = Size(face_width_mm=18.0, slot_clearance_mm=0.02)
WIDE = Tolerance(crank_radius_mm=0.02, center_distance_mm=0.03, slot_width_mm=0.02)


def design(force=None, **more):
    given = {"size": LOOSE, "load": Load(inertia_kgm2=0.4, torque_Nm=2.0), "tolerance": WIDE}
    return Design(External(6), limits=Limits(pin_force_max_N=force), **(given | more))


def row(of, name):
    return next((c for c in checks(of.mechanism, parts=False) if c.name == name), None)


def test_no_tolerance_no_row():
    bare = design(tolerance=Tolerance(distribution="normal"))
    assert row(bare, "entry_shock_N") is None
    assert row(bare, "reversal_shock_N") is None  # nothing limits it, but the pin's stress has it
    tight = design(100.0, size=LOOSE.replace(slot_clearance_mm=0.0), tolerance=Tolerance())
    assert row(tight, "reversal_shock_N") is None
    # a crank as long as it should be; and nothing that turns on
    assert row(design(tolerance=Tolerance(slot_width_mm=0.01)), "entry_shock_N") is None
    assert row(design(load=Load(torque_Nm=2.0)), "reversal_shock_N") is None


def test_values_are_those_of_the_worst_machine():
    of = design(1e6)
    [engagement] = of.mechanism.engagements
    # on the slot's axis, where the slot has room for an arm too short by 0.02 + 0.03 sin(30 deg)
    roomy = design(1e6, size=Size(face_width_mm=18.0, slot_clearance_mm=0.046))
    contact = contact_of(engagement, 0.02 / 50.0, -0.03 / 100.0)
    check = row(roomy, "entry_shock_N")
    assert check.value == force_of(roomy.mechanism, contact.jump)
    assert check.at_deg == contact.at_deg
    assert check.passes
    # and on its mouth's far corner where it has but 0.02 - 0.02/2
    harder = mouth_contacts(
        RestingAxis.of(engagement), 0.02 / 50.0, -0.03 / 100.0, (0.05, 1e-4, 0.0)
    )
    check = row(of, "entry_shock_N")
    assert check.value == force_of(of.mechanism, harder.jump[0])
    assert check.at_deg == harder.at_deg[0]
    case = load_case(of.mechanism)
    drag = case.resists_Nm / case.inertia_Nm
    _, [start] = changes(engagement, np.array([[drag]]))
    x, y = (z.c[0] for z in engagement.path(start, 0))
    play = 2.0 * math.asin(0.03 / (100.0 * math.hypot(x, y)))
    [(_, _, speed)] = impacts_in(engagement, play, drag)
    assert row(of, "reversal_shock_N").value == pytest.approx(
        force_of(of.mechanism, speed), rel=1e-12
    )


@pytest.mark.long
def test_what_would_pass_passes():
    of = design(100.0)
    assert row(of, "entry_shock_N").passes is False
    check = row(of, "reversal_shock_N")
    assert check.passes is False
    drag = float(re.match(r"a drag of ([\d.]+) N m on", check.why)[1])
    assert row(of.with_("load.torque_Nm", 2.0 + drag), "reversal_shock_N") is None
    assert row(of.with_("load.torque_Nm", 2.0 + 0.97 * drag), "reversal_shock_N") is not None


# A dial of eight stations, driven by a cam; its process leaves 0.02 mm a side.
DIAL = Design(
    External(8),
    Cam(n_rpm=40.0),
    motion=Motion(ModifiedSine(), alpha0_deg=63.0),
    size=Size(
        center_distance_mm=160.0,
        roller_radius_mm=11.0,
        pin_mm=10.0,
        face_width_mm=12.0,
        process="mill",
    ),
    load=Load(inertia_kgm2=0.8, torque_Nm=12.0, friction=0.05),
)


def coasted():
    """The dial's change of sides, by its law and the triangle of slot, arm and centre line.

    In the modified sine's middle s = (2 + pi u - 9/4 sin(v))/(4 + pi), v = (pi + 4 pi u)/3. Returns
    the input angle of the impact in degrees, and the jump.
    """
    motion, step = math.radians(72.0), math.radians(45.0)
    drag = 12.0 / (0.8 * (40.0 * math.tau / 60.0) ** 2)

    def phase(x):
        return math.pi / 3.0 * (1.0 + 4.0 * (x / motion + 0.5))

    def torque(x):  # over I w²
        return 4.0 * math.pi**2 / (math.pi + 4.0) * math.sin(phase(x)) * step / motion**2 + drag

    start = brentq(torque, 0.0, math.radians(20.0), xtol=1e-15)
    u = start / motion + 0.5
    psi = (2.0 + math.pi * u - 2.25 * math.sin(phase(start))) / (4.0 + math.pi) * step - 0.5 * step
    lever = 160.0 * math.sin(start) / math.sin(start + psi)
    play = 2.0 * math.asin(0.02 / lever)

    def behind(x):
        return quad(lambda t: (x - t) * torque(t), start, x, epsabs=1e-15)[0] + play

    end = brentq(behind, start + 1e-3, math.radians(25.0), xtol=1e-14)
    return math.degrees(end), -quad(torque, start, end, epsabs=1e-15)[0]


def struck_N(jump, pin_mm, face_mm=12.0):
    """The force at which line contact and a cantilever of 12.4/2 mm store the impact's energy."""
    energy = 0.5 * 0.8 * (jump * 40.0 * math.tau / 60.0) ** 2 * 1000.0
    press = 3.84e-5 / face_mm**0.8
    k = 3.0 * 210e3 * math.pi / 64.0 * pin_mm**4 / (0.5 * face_mm + 0.2) ** 3
    return brentq(lambda F: 0.9 / 1.9 * press * F**1.9 + F * F / (2.0 * k) - energy, 1.0, 1e5)


def pin_MPa(force, pin_mm):
    """Bending of the cantilever under a force and its friction of 0.05."""
    return 32.0 * force * math.hypot(1.0, 0.05) * 6.2 / (math.pi * pin_mm**3)


@pytest.mark.long
def test_the_play_of_the_clearances_alone_counts():
    """Quadratures and the hand's formulas: 1434 N on a dial whose cycle needs 539.5 N."""
    at_deg, jump = coasted()
    force = struck_N(jump, 10.0)
    assert force == pytest.approx(1434.13, abs=5e-3)
    values = DIAL.loads_table.to_dict()
    told = {n.removeprefix("shock.reversal."): v for n, v in values.items() if ".reversal." in n}
    # two quadratures of some 1e-12, at a jump of 0.02
    near = functools.partial(pytest.approx, rel=1e-9)
    assert (told["at_deg"], told["jump"], told["force_N"]) == (
        near(at_deg),
        near(jump),
        near(force),
    )
    # Hertz on a flat wall: p0² = F E*/(pi b r)
    modulus = 0.5 * 210e3 / (1.0 - 0.3**2)
    pressed = math.sqrt(force * modulus / (math.pi * 12.0 * 11.0))
    assert told["contact_stress_MPa"] == near(pressed)
    assert values["life.pin_stress_MPa"] == near(pin_MPa(force, 10.0))
    for key, name, value in (
        ("pin_force_max_N", "reversal_shock_N", force),
        ("contact_stress_max_MPa", "reversal_stress_MPa", pressed),
    ):
        assert row(DIAL.with_(f"limits.{key}", 0.999 * value), name).passes is False
        assert row(DIAL.with_(f"limits.{key}", 1.001 * value), name).passes
    text = "\n".join(line.text for line in load_lines(DIAL))
    assert "1434 N at 9.532°, where the roller changes sides; contact stress 631.7 MPa" in text


def test_the_pin_that_an_impact_needs():
    """A stiffer pin is struck harder: its least diameter is a root, and the default is no less."""
    _, jump = coasted()
    least = brentq(lambda d: pin_MPa(struck_N(jump, d), d) - 165.0, 2.0, 20.0, xtol=1e-13)
    for pin_mm in (5.0, 10.0):
        of = DIAL.with_("size.pin_mm", pin_mm)
        assert of.strength["strength.pin.least_diameter_mm"] == pytest.approx(least, rel=1e-9)
        assert row(of, "pin_stress_MPa").passes is (pin_mm > least)
    heavy = DIAL.with_("size.pin_mm", None).with_("load.inertia_kgm2", 8.0)
    still = heavy.with_("size.slot_clearance_mm", 1e-9)
    assert built(heavy.mechanism).pin_mm > built(still.mechanism).pin_mm
    assert row(heavy, "pin_stress_MPa").passes


def test_the_wall_of_a_curved_slot_is_struck_as_it_presses():
    """Stress² over force is that of the cycle at the same place, where the same wall bears."""
    of = Design(
        External(5),
        motion=Motion(ModifiedSine(), ratio="matched"),
        size=Size(slot_clearance_mm=0.02, face_width_mm=10.0),
        load=Load(inertia_kgm2=0.05, torque_Nm=1.0),
    )
    told = of.strength.table("shock.reversal")
    names = ["contact_stress_MPa", "pin_force_N"]
    stress, force = of.cycle.states(np.array([told["at_deg"]]), names)[:, 0].tolist()
    ratio = stress * stress / abs(force)
    assert told["contact_stress_MPa"] ** 2 / told["force_N"] == pytest.approx(ratio, rel=1e-9)
    assert ratio != pytest.approx(float(of.cycle.case.hertz), rel=1e-3)  # the wall is curved
