"""Whatever varies in a sweep, each row has its own design's answers."""

import pytest

from geneva_cli.study.sweep.request import request


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
