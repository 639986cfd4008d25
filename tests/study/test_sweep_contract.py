"""Whatever varies in a sweep, each row has its own design's answers."""

import pytest

from geneva_cli.design import load
from geneva_cli.motion.many import may_vary
from geneva_cli.study.sweep.request import request


def swept(tmp_path, text, *vary, pick):
    """The rows of a sweep without their last column, which says what is wrong: nothing."""
    path = tmp_path / "spec.toml"
    path.write_text(text, encoding="utf-8")
    rows = [row for block in request(str(path), vary, pick=pick).blocks() for row in block]
    assert [row[-1] for row in rows] == [None] * len(rows)
    return [row[:-1] for row in rows]


@pytest.mark.long
def test_slots_of_an_unbalanced_wheel_on_a_carrier_vary_alone(tmp_path):
    """A turn of the wheel has as many motions as slots: the sweep ended in a traceback."""
    text = '[wheel]\nz = 5\n[drive]\nkind = "carousel"\n[load]\ninertia_kgm2 = 0.1\n[[mass]]\n'
    text += 'shape = "point"\nmass_kg = 0.7\nradius_mm = 120\nangle_deg = 40\n'
    rows = swept(tmp_path, text, "wheel.z=5,6", pick="loads.input_torque_Nm.max")
    path = str(tmp_path / "spec.toml")
    assert not may_vary(load(path).spec, "wheel.z")
    single = [load(path, [f"wheel.z={z}"]).loads["input_torque_Nm"] for z in (5, 6)]
    # the cycle searches more functions together: its places may differ by rounding
    sizes = [max(one.max, -one.min) for one in single]
    assert [row[1] for row in rows] == pytest.approx(sizes, rel=1e-15)


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
