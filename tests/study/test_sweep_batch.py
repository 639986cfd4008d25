"""Designs worked out together are the designs one by one; and the names of their quantities."""

import math

import numpy as np
import pytest
import repo

from geneva_cli import External, load
from geneva_cli.loads.load_peaks import REPORTED_PEAKS
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.parts.parts import parts_of
from geneva_cli.spec.tables import Load, Size
from geneva_cli.specfile.reader import read
from geneva_cli.study.batches import batch_machines, numbers
from geneva_cli.study.fields import pick
from geneva_cli.study.sweep.request import request
from geneva_cli.study.sweep.run import Sweep, plan, sweep
from geneva_cli.study.sweep.values import axis
from geneva_cli.table import Table
from geneva_cli.verdict.quantities.groups import GROUPS
from geneva_cli.verdict.quantities.quantity_names import WORDS

TIMING = ["timing.motion_deg", "timing.dwell_s", "timing.k"]
# the last bits of one sine by the C library, of many by NumPy
CLOSE = 1e-13
CHECKED = ("checks.passes", "checks.failed")


def rows(spec, vary, picks, random=None):
    found = sweep(
        read(str(repo.DESIGNS / spec)),
        plan([axis(v, random is not None) for v in vary], random, 5),
        picks=picks,
    )
    together = [*found.rows_of(found.plan.designs(0, len(found.plan)))]
    alone = [Sweep.row(found, some) for some in found.plan.designs(0, len(found.plan))]
    return together, alone, found


@pytest.mark.parametrize(
    ("spec", "vary"),
    [
        ("side-crank-z6.toml", ["drive.A=-0.9..1.1:0.1", "wheel.z=2..8"]),
        ("spherical-z6.toml", ["wheel.axes_deg=0..180:20", "wheel.z=3..5"]),
        ("modified-sine-matched.toml", ["motion.alpha0_deg=-100..100:25", "wheel.z=3..6"]),
        ("three-rollers-z4.toml", ["drive.rollers=1..3", "wheel.z=3..5"]),
    ],
)
def test_together_as_alone(spec, vary):
    together, alone, found = rows(spec, vary, TIMING)
    keys = [a.key for a in found.plan.axes]
    batches = found._batches(found.plan.designs(0, len(alone)))
    known = ~np.isnan(numbers(batches, found.pick.batched, len(alone))).any(axis=0)
    built = sum(row[-1] is None for row in alone)
    # where engagements differ, none of their timings is shared
    assert known.sum() == built
    for one, other in zip(together, alone, strict=True):
        assert one[: len(keys)] == other[: len(keys)]
        assert one[-1] == other[-1]
        for a, b in zip(one[len(keys) : -1], other[len(keys) : -1], strict=True):
            assert a == b or a == pytest.approx(b, rel=CLOSE)


@pytest.mark.parametrize(
    ("spec", "vary"),
    [
        ("turret.toml", "size.roller_radius_mm=4..28:6"),
        ("turret.toml", "size.center_distance_mm=150..350:50"),
        ("turret.toml", "size.lock_radius_mm=0,75,80"),
        ("turret.toml", "size.wheel_hub_mm=0..90:30"),
        ("turret.toml", "wheel.z=6..8"),
        ("offset-slots.toml", "size.center_distance_mm=80..120:20"),
        ("internal-z6.toml", "size.roller_radius_mm=3..6:1"),
        ("wandering-hours.toml", "load.torque_Nm=1..3"),
        # the greater speed's horn is most stressed nearer to the mouth: its samples come first
        ("press-345.toml", "drive.n_rpm=30,60"),
    ],
)
def test_strengths_of_a_batch_are_those_of_each(spec, vary):
    names = "strength.pin.stress_MPa", "strength.horn.stress_MPa", "strength.crank_shaft.margin"
    together, alone, _ = rows(spec, [vary], names)
    for one, other in zip(together, alone, strict=True):
        for a, b in zip(one, other, strict=True):
            assert a == b or a == pytest.approx(b, rel=1e-11)


def test_parts_are_kept_for_another_speed_and_not_for_another_drive():
    """Two rollers leave another locking disc, though no key of a size is another."""

    def machine(*settings):
        return load(str(repo.DESIGNS / "side-crank-z6.toml"), settings).mechanism

    first = parts_of(machine()).built
    faster, other = machine("drive.n_rpm=90"), machine("drive.rollers=2")
    same = first.following(faster)
    assert same.mechanism is faster and same.outlines.wheel is first.outlines.wheel
    following, alone = first.following(other), parts_of(other).outlines
    assert following.mechanism is other and following.outlines.crank == alone.crank
    assert alone.crank != first.outlines.crank


def test_a_design_that_cannot_be_built_spoils_no_batch():
    text = read(str(repo.DESIGNS / "turret.toml"))
    picks = ["checks.pin_stress_MPa", "checks.passes"]
    checked = sweep(text, plan([axis("load.efficiency=0.5,2,0.9")], None, 0), picks=picks)
    first, refused, last = checked.rows_of(checked.plan.designs(0, 3))
    assert refused[1:3] == [None, None] and "efficiency" in refused[3]
    assert first[2] is last[2] is True and first[1] == pytest.approx(last[1], rel=1e-14)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("name", "varied"),
    [
        ("modified-trapezoid-z5.toml", "drive.n_rpm=30,60,90"),
        ("modified-trapezoid-z5.toml", "motion.alpha0_deg=0,0,5"),
        ("press-straight.toml", "load.inertia_kgm2=1,100"),  # larger sizes under the larger load
    ],
)
def test_designs_with_equal_parts_have_one_turn(name, varied):
    """It is computed once for all designs whose parts are equal, and for no others."""
    text = read(str(repo.DESIGNS / name))
    checked = sweep(text, plan([axis(varied)], None, 0), picks=["checks.gap_mm", *CHECKED])
    together = [*checked.rows_of(checked.plan.designs(0, len(checked.plan)))]
    assert together == [checked.row(row[:1]) for row in together]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("text", "vary", "refused"),
    [
        ("steps_deg = [72, 48]", "wheel.offset_mm=0,0.003", "remove one of them"),
        ("[drive]\nrollers = 2\nroller_angles_deg = [0, 90]", "wheel.z=4,5", "jam"),
    ],
)
def test_one_of_a_batch_is_left(tmp_path, text, vary, refused):
    """The others are refused in their rows; of one a batch is a batch too."""
    z = 6 if "steps" in text else 4
    path = tmp_path / "spec.toml"
    path.write_text(
        f"[wheel]\nz = {z}\n{text}\n[size]\nface_width_mm = 10\n[load]\ntorque_Nm = 5\n"
    )
    pick = "life.horn_stress_MPa,strength.lock.force_N"
    [[left, other]] = request(str(path), [vary], pick=pick).blocks()
    [[single]] = request(str(path), [f"{vary.split(',')[0]}"], pick=pick).blocks()
    assert left[-1] is None
    assert left[1:-1] == pytest.approx(single[1:-1], rel=1e-14)
    assert other[1:-1] == [None, None]
    assert refused in other[-1]


def test_specs_of_one_kind_keep_their_own_loads_and_sizes():
    """A force goes with the inertia, and with 1/L: three times the one, a third of the other."""
    specs = [
        Spec(External(6), load=Load(inertia_kgm2=inertia), size=Size(center_distance_mm=L))
        for inertia, L in ((1.0, 100.0), (3.0, 100.0), (1.0, 300.0))
    ]
    ((one, heavy, wide),) = numbers(batch_machines(specs), ["loads.pin_force_N.max"], 3)
    assert heavy == pytest.approx(3.0 * one, rel=1e-12)
    assert wide == pytest.approx(one / 3.0, rel=1e-12)


def test_what_a_batch_lacks_takes_no_other_quantity_with_it():
    """Without the tolerance each design is worked out alone, from loads that the batch shares."""
    picks = ["velocity.max", "tolerance.motion_play.worst_deg"]
    together, alone, _ = rows("noncircular-gears.toml", ["shaft.bending_factor=1.5,1.56"], picks)
    assert together == alone and together[0][1:] == [pytest.approx(0.625, rel=1e-12), None, None]


LISTS = {  # of a report's names those of tables and lists, which are no quantities
    *("stations", "loads.reversals_deg", "vibration.speeds_to_avoid_rpm", "strength.needs"),
    *("tolerance.warnings", "wheels", "cranks"),
}


@pytest.mark.long
@pytest.mark.parametrize("name", ["tolerances", "press-curved", "unequal-steps", "spherical-z6"])
def test_every_group_has_the_names_that_are_listed(name):
    proof = load(str(repo.DESIGNS / f"{name}.toml")).parts
    for group in GROUPS:
        if group.table == "parts_list.":
            continue  # tables alone
        values = group.values(proof)
        assert {*values} - LISTS == {*group.names}
        assert not [n for n in group.names if isinstance(values[n], (tuple, Table))]
        assert {n for n, value in values.items() if isinstance(value, str)} <= WORDS


@pytest.mark.parametrize("name", ["turret", "linear"])
def test_what_loads_shows_is_a_quantity(name):
    """Issue: sweeps refused loads.power_W.max, which `geneva loads` shows.

    A batch computes them as a single design does. Where a report has the size, ``max`` is one.
    """
    design = load(str(repo.DESIGNS / f"{name}.toml"))
    shown = {
        f"loads.{of}.{end}": value
        for of, one in design.loads.items()
        for end, value in one._asdict().items()
        if not (of in REPORTED_PEAKS and end in ("max", "max_at_deg"))
    }
    assert "loads.power_W.max_at_deg" in shown
    alone = pick([*shown]).of(design.mechanism)
    # the cycle searches more functions together: places and sums may differ by rounding
    for value, (key, own) in zip(alone, shown.items(), strict=True):
        assert value == (own and pytest.approx(own, rel=1e-14, abs=1e-13)), key
    together = numbers(batch_machines([design.spec]), [*shown], 1)[:, 0].tolist()
    for value, (key, own) in zip(together, shown.items(), strict=True):
        if own is None:  # a wheel has no loads of a rack, nor a rack those of a wheel
            assert value == math.inf, key
            continue
        # sums to 1e-12 of a load's size, places to 1e-6 degrees, as a peak is flat
        size = max(abs(shown.get(f"{key.rpartition('.')[0]}.{end}", own)) for end in ("min", "max"))
        near = 1e-6 if key.endswith("deg") else 1e-12 * max(size, abs(own))
        assert value == pytest.approx(own, rel=0.0, abs=near), key
