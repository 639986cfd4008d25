"""Of extremes that are equal the first is told, in the period from the first entry.

Motions are symmetric, and engagements alike: where an extreme is told, the same may be at its
mirror image and in every other engagement. Each of these earlier places is looked at.
"""

import numpy as np
import pytest
import repo
from load_states import state
from witness import mp

from geneva_cli import Crank, External, load
from geneva_cli.loads import load_tables
from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.load_peaks import load_peaks, load_summaries
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.slots.groove import greatest_pressure
from geneva_cli.spec.tables import Load, Size


def test_of_a_grooves_equal_pressures_the_first_is_told() -> None:
    """The cam's groove is as steep before the motion as after it."""
    (engagement,) = load(str(repo.DESIGNS / "cam-geneva.toml")).mechanism.engagements
    assert engagement.motion.symmetric and engagement.groove
    assert -180.0 < greatest_pressure(engagement.groove)[1] < 0.0


def test_of_two_zeros_the_first_is_told() -> None:
    """Least contact stress where I w² psi'' = -M, by mpmath: at 17.3 deg, and again at 52.2."""
    spec = Spec(
        External(8),
        Crank(n_rpm=90.0),
        size=Size(center_distance_mm=160.0, roller_radius_mm=8.0, face_width_mm=12.0),
        load=Load(inertia_kgm2=0.1, torque_Nm=5.0),
    )
    l, w = mp.sin(mp.pi / 8), 3 * mp.pi

    def torque(x: mp.mpf) -> mp.mpf:
        slope = mp.diff(lambda t: mp.atan2(l * mp.sin(t), 1 - l * mp.cos(t)), x, 2)
        return w * w * slope / 10 + 5

    first, second = (float(mp.degrees(mp.findroot(torque, mp.radians(x)))) for x in (17, 52))
    assert (round(first, 3), round(second, 3)) == (17.339, 52.165)
    least = load_tables.summaries(Cycle(build(spec)))["contact_stress_MPa"]
    assert least.min_at_deg == pytest.approx(first, abs=1e-9)
    batch = many(spec, {"drive.n_rpm": np.array([90.0, 91.0])}).machine
    for name in ("contact_stress_MPa", "wheel_bearing_N"):
        by_sweep = load_summaries(batch, [name])[name].min_at_deg[0]
        assert by_sweep == pytest.approx(first, abs=1e-9)


def test_a_stress_of_one_wall_is_not_that_of_the_other_half() -> None:
    """A torque alone presses on one wall, which past mid-motion bends towards the roller.

    Just past mid-motion it bends more sharply than the roller, and the stress has no bound.
    """
    spec = load(str(repo.DESIGNS / "internal-curved-z8.toml")).mechanism.spec
    size = spec.size.replace(face_width_mm=10.0)
    spec = spec.replace(load=Load(torque_Nm=5.0), size=size)
    (engagement,) = build(spec).engagements
    sharp = [state(build(spec), engagement, x).contact_stress_MPa for x in (-0.02, 0.02)]
    assert np.isinf(sharp).tolist() == [False, True]
    most = load_peaks(build(spec), ["contact_stress_MPa"])["contact_stress_MPa"]
    assert 0.0 < most.at_deg[0] < 0.02
