"""Checks and cautions: each must be able to fail, and its advice must pass."""

import pytest

from geneva_cli.cautions import cautions
from geneva_cli.checks import checks
from geneva_cli.drives.side_crank import Keys
from geneva_cli.keys import Drive, Limits, Load, Motion, Size, Spec, Wheel
from geneva_cli.mechanism import build

CURVED = Spec(Wheel(6), motion=Motion("cycloidal", ratio="matched"))
LOADED = Spec(Wheel(6), size=Size(200.0, 8.0, face_width_mm=10.0), load=Load(0.4, 15.0))


def failing(spec: Spec) -> dict[str, str]:
    # of the motion and the limits; walls, shafts and the full turn have tests of their own
    return {c.name: c.nearest for c in checks(build(spec), parts=False) if not c.passes}


def changed(spec: Spec, advice: str) -> Spec:
    """The spec with the advice taken."""
    key, _, value = advice.partition(" = ")
    number = value.split(" ")[0]
    if key == "center_distance_mm":  # "... and the roller with it"
        scale = float(number) / spec.size.center_distance_mm
        size = spec.size._replace(
            center_distance_mm=float(number), roller_radius_mm=spec.roller_radius_mm * scale
        )
        return spec._replace(size=size)
    tables = {
        "z": "wheel",
        "n_rpm": "drive",
        "alpha0_deg": "motion",
        "ratio": "motion",
        "lambda": "motion",
        "roller_radius_mm": "size",
    }
    table = getattr(spec, tables[key])
    new = "matched" if "matched" in value else int(number) if key == "z" else float(number)
    return spec._replace(
        **{tables[key]: table._replace(**{"lambda_" if key == "lambda" else key: new})}
    )


FAILURES = [
    (LOADED._replace(limits=Limits(acceleration_max=1.2)), "acceleration_max"),
    (LOADED._replace(limits=Limits(velocity_max=0.7)), "velocity_max"),
    (LOADED._replace(limits=Limits(acceleration_entry_max=0.3)), "acceleration_entry_max"),
    (LOADED._replace(limits=Limits(jerk_max=1.0)), "jerk_max"),
    (LOADED._replace(limits=Limits(pin_force_max_N=250.0)), "pin_force_max_N"),
    (LOADED._replace(limits=Limits(contact_stress_max_MPa=250.0)), "contact_stress_max_MPa"),
    (LOADED._replace(limits=Limits(input_torque_max_Nm=20.0)), "input_torque_max_Nm"),
    (CURVED._replace(limits=Limits(acceleration_max=1.2)), "acceleration_max"),
    (
        CURVED._replace(
            motion=Motion("cycloidal", alpha0_deg=-40.0, ratio="matched"),
            limits=Limits(pressure_angle_max_deg=10.0),
        ),
        "pressure_angle_deg",
    ),
    (CURVED._replace(motion=Motion("cycloidal", ratio=0.45)), "pressure_angle_deg"),
    (CURVED._replace(motion=Motion("sine-group", 0.2, ratio="matched")), "velocity_min"),
    (
        Spec(Wheel(8, "internal"), motion=CURVED.motion, size=Size(90.0, 5.0)),
        "undercut_mm",
    ),
]


@pytest.mark.parametrize(("spec", "name"), FAILURES)
def test_a_check_fails_and_its_advice_passes(spec: Spec, name: str) -> None:
    found = failing(spec)
    assert name in found
    assert found[name], "a failing check names the nearest change that passes"
    assert name not in failing(changed(spec, found[name]))


def test_a_sound_design_passes() -> None:
    assert not failing(LOADED)
    assert not failing(CURVED)
    assert not cautions(build(LOADED))
    assert not cautions(build(CURVED))


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        (Spec(Wheel(25)), "z = 25"),
        (CURVED._replace(motion=Motion("cycloidal", ratio=0.45)), "mid condition"),
        (CURVED._replace(motion=Motion("sine-group", 0.13)), "turns back"),
        (CURVED._replace(motion=Motion("sine-group", -0.13)), "turns back"),
        (CURVED._replace(motion=Motion("harmonic", ratio="matched")), "soft shock"),
        (CURVED._replace(size=Size(100.0, 20.0)), "undercut"),
    ],
)
def test_cautions(spec: Spec, said: str) -> None:
    assert any(said in text for text in cautions(build(spec)))


@pytest.mark.parametrize("shape", [-0.125, 0.0, 0.125])
def test_the_sine_group_does_not_turn_back_up_to_an_eighth(shape: float) -> None:
    spec = CURVED._replace(motion=Motion("sine-group", shape, ratio="matched"))
    assert not any("turns back" in text for text in cautions(build(spec)))


def test_the_side_crank_moves_the_mid_condition() -> None:
    """l/(1-l) = psi1 (1+A) at mid-motion: the crank there runs 1/(1+A) times as fast."""
    spec = CURVED._replace(drive=Drive("side-crank"), kind=Keys(0.5))
    mechanism = build(spec)
    v = 2.0 * 60.0 / mechanism.stations[0].motion_deg * 1.5
    assert mechanism.ratio == pytest.approx(v / (1.0 + v), rel=4e-16 * 4)
    assert not cautions(mechanism)
