"""Checks and warnings: each must be able to fail. Their advice is in test_advice."""

import math
import re

import pytest
import repo
from strength_checks import standing_checks
from words import Drive, Keys, Motion, Spec, Wheel, law, load

from geneva_cli import Design, External, Internal
from geneva_cli.errors import GenevaError
from geneva_cli.motion import machine_spec as machine_spec
from geneva_cli.motion.mechanism import build
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.parts.parts import parts_of
from geneva_cli.spec.tables import Limits, Load, Size
from geneva_cli.verdict.checks import Check, checks
from geneva_cli.verdict.motion_warnings import motion_warnings
from geneva_cli.verdict.warnings import turn_warnings

DESIGNS = repo.DESIGNS

CURVED = Spec(Wheel(6), motion=Motion("cycloidal", ratio="matched"))
LOADED = Spec(Wheel(6), size=Size(200.0, 8.0, face_width_mm=10.0), load=Load(0.4, 15.0))


def failing(spec: Spec) -> list[str]:
    # of the motion and the limits; walls, shafts and the full turn have tests of their own
    return [c.name for c in checks(build(spec), parts=False) if not c.passes]


def test_a_sound_design_passes() -> None:
    assert not failing(LOADED.replace(limits=Limits(acceleration_max=1.4, pin_force_max_N=1e4)))
    assert not failing(CURVED)
    assert not [*motion_warnings(build(LOADED))]
    assert not [*motion_warnings(build(CURVED))]


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        (Spec(Wheel(25)), "z = 25"),
        (CURVED.replace(motion=Motion("cycloidal", ratio=0.45)), "mid condition"),
        (CURVED.replace(motion=Motion("sine-group", 0.13)), "turns back"),
        (CURVED.replace(motion=Motion("harmonic", ratio="matched")), "soft shock"),
        (CURVED.replace(motion=machine_spec.Motion(law("scca", 0.0, 1.0, 0.0))), "mid-motion"),
        (CURVED.replace(size=Size(100.0, 20.0)), "undercut"),
    ],
)
def test_warnings(spec: Spec, said: str) -> None:
    assert any(said in text for text in motion_warnings(build(spec)))


def test_the_side_crank_moves_the_mid_condition() -> None:
    """l/(1-l) = psi1 (1+A) at mid-motion: the crank there runs 1/(1+A) times as fast."""
    spec = Spec(Wheel(6), Drive("side-crank"), Keys("side-crank", 0.5), CURVED.motion)
    mechanism = build(spec)
    v = 2.0 * 60.0 / mechanism.engagements[0].motion_deg * 1.5
    assert mechanism.ratio == pytest.approx(v / (1.0 + v), rel=4e-16 * 4)
    assert not [*motion_warnings(mechanism)]


def rows(spec: Spec) -> dict[str, Check]:
    return {c.name: c for c in checks(build(spec))}


def test_something_must_hold_the_wheel_in_the_dwell() -> None:
    without = Spec(Wheel(6), size=Size(lock_radius_mm=0.0))
    assert rows(Spec(Wheel(6)))["dwell_hold"].passes
    assert rows(without)["dwell_hold"].passes is False
    assert rows(without.replace(wheel=Wheel(6, held_by="brake")))["dwell_hold"].passes
    assert any("nothing holds the wheel" in said for said in motion_warnings(build(without)))
    assert not [*motion_warnings(build(without.replace(wheel=Wheel(6, held_by="brake"))))]


@pytest.mark.parametrize(
    ("value", "must_be", "limit", "noise", "kept"),
    [
        (0.4999999999999787, "at least", 0.5, 0.0, True),
        (0.0, "above", 0.0, 0.0, False),
        (-2e-6, "at least", 0.0, 1e-5, True),  # a gap is known as nearly as its outlines
        (-2e-5, "at least", 0.0, 1e-5, False),
    ],
)
def test_rounding_breaks_no_limit(
    value: float, must_be: str, limit: float, noise: float, kept: bool
) -> None:
    assert keeps(value, must_be, limit, noise) is kept


@pytest.mark.parametrize(
    ("wheel", "size", "row", "value"),
    [
        # L - R - r - r/20 is 44.75 mm at L = 100, R = 50, r = 5
        (External(6), Size(wheel_bore_mm=89.4), "wheel_bore_wall_mm", 44.75 - 44.7),
        # The relief's arc: from the centre at L rk / R, radius L cos 30 deg rk / R
        (
            External(6),
            Size(crank_bore_mm=12.0, lock_radius_mm=40.0),
            "crank_bore_wall_mm",
            80.0 * (1.0 - math.sqrt(0.75)) - 6.0,
        ),
        # L + R + r + r/20 is 155.25 mm
        (Internal(6), Size(wheel_outer_radius_mm=155.5), "outer_wall_mm", 0.25),
    ],
)
def test_walls_beside_bores_and_outside(wheel, size: Size, row: str, value: float) -> None:
    rows = {c.name: c for c in standing_checks(Design(wheel, size=size).parts)}
    assert rows[row].value == pytest.approx(value, abs=1e-5)
    assert rows[row].limit == 0.5
    assert rows[row].passes == (value >= 0.5)


@pytest.mark.long
@pytest.mark.parametrize(
    ("radius", "most"),  # ISO 286: (2 IT11 + c) / 2 of H11/c11, in um, for the roller's diameter
    [(12.0, (260 + 110) / 2)],
)
def test_a_fit_looser_than_any_is_said(radius: float, most: float) -> None:
    def said(**keys: object) -> list[str]:
        design = Design(External(6), size=Size(200.0, radius, **keys))
        return [text for text in design.warnings if text.name == "loose-fit"]

    assert said(slot_clearance_mm=1e-3 * most) == []
    (text,) = said(slot_clearance_mm=1e-3 * most + 0.002)
    assert f"H11/c11, leaves at most {1e-3 * most:.4g} mm a side" in text
    assert said(slot_clearance_mm=5.0)
    # the process's own clearance is no warning; more than that is one
    assert said(process="print") == said(process="print", slot_clearance_mm=0.25) == []
    assert said(process="print", slot_clearance_mm=0.26)
    # a disc of Ø 120: (2 * 220 + 180) / 2
    assert said(lock_radius_mm=60.0, lock_clearance_mm=0.31) == []
    assert said(lock_radius_mm=60.0, lock_clearance_mm=0.32)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("process", "slot_mm", "lock_mm"),
    [
        ("print", 0.2, 0.2),  # roller and slot are each within 0.2 mm of their diameter
        ("mill", 0.006, 0.01425),  # ISO 286, um: (IT6 + IT7)/4 of Ø 10 and of Ø 100
        ("laser", 0.3, 0.3),  # ISO 9013, class 1: Ø 10 in a plate of 10 mm
        (None, 0.0, 0.0),
    ],
)
def test_a_clearance_that_the_process_cannot_hold_is_said(
    process: str | None, slot_mm: float, lock_mm: float
) -> None:
    def said(slot: float, lock: float) -> list[str]:
        size = Size(process=process, slot_clearance_mm=slot, lock_clearance_mm=lock)
        warnings = Design(External(6), size=size).warnings
        return [str(text) for text in warnings if text.name == "narrow-for-process"]

    assert said(slot_mm, lock_mm) == []
    if process:
        (text,) = said(0.99 * slot_mm, lock_mm)
        assert text.endswith(f"set slot_clearance_mm to {slot_mm:.4g}")
        (text,) = said(slot_mm, 0.5 * lock_mm)
        assert text.endswith(f"set lock_clearance_mm to {lock_mm:.4g}")


def test_a_turn_that_takes_too_long_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    """The check says so in place of those of the turn."""

    def endless(parts: object) -> None:
        raise GenevaError("it takes too long")

    monkeypatch.setattr("geneva_cli.parts.turn.full_turn.full_turn", endless)
    parts = parts_of(build(Spec(Wheel(6))))
    *_, last = checks(parts.mechanism, parts)
    assert (last.name, last.passes, last.why) == ("full_turn", False, "it takes too long")


def test_a_slot_that_drives_from_one_wall_leaves_the_wheel_free() -> None:
    """Just inside an offset slot's mouth there is no wall yet on the roller's other side."""
    (said,) = turn_warnings(parts_of(load(str(DESIGNS / "offset-slots.toml"))))
    assert re.match(r"in its slot the wheel is free ahead by 6\.49\d*° at -61\.\d+°", said)
    assert not list(turn_warnings(parts_of(load(str(DESIGNS / "limits.toml")))))
