"""Options and refusals of parts as they are written; a sphere's slots."""

import math
import os
import re
from pathlib import Path

import pytest
import repo
from drawing_witness import dxf_shapes
from typer.testing import CliRunner
from words import load

import geneva_cli
from geneva_cli.cli.app import app
from geneva_cli.motion.mechanism import build
from geneva_cli.verdict.checks import checks

pytestmark = pytest.mark.usefixtures("made_once")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def profile(spec, part, output, *options):
    """A run of `geneva profile`; what is neither success nor a refusal raises."""
    arguments = ["profile", str(spec), "--part", part, "-o", output, *options]
    found = CliRunner().invoke(app, arguments)
    if found.exception is not None and not isinstance(found.exception, SystemExit):
        raise found.exception
    return found


def refused(found, status, *wants):
    """Exit status and one line that holds all of ``wants``, and nothing else."""
    assert found.exit_code == status, found.output
    assert found.stdout == ""
    (said,) = found.stderr.splitlines()
    for want in wants:
        assert want in said, said
    return said


def spec(text, name="spec.toml"):
    Path(name).write_text(text, encoding="utf-8")
    return name


def size(*lines, wheel="z = 6"):
    return "[wheel]\n" + wheel + "\n[size]\n" + "\n".join(lines) + "\n"


@pytest.mark.parametrize(("name", "axes"), [("spherical-z6", 90.0), ("spherical-60deg", 60.0)])
def test_the_slots_of_a_sphere_are_meridians_of_it(name, axes):
    """theory.md 1.3: sin th = sin S sin b, mouth at d = atan2(sin S cos b, cos S), bottom S - th.

    To 1e-9 of degrees: a few roundings of numbers of this size.
    """
    S, b = math.radians(axes), math.pi / 6
    design = geneva_cli.load(str(repo.DESIGNS / f"{name}.toml"))
    values = design.report.table.to_dict()
    assert values["sizes.sphere_radius_mm"] == design.mechanism.center_distance_mm
    mouth = math.degrees(math.atan2(math.sin(S) * math.cos(b), math.cos(S)))
    bottom = math.degrees(S - math.asin(math.sin(S) * math.sin(b)))
    assert values["sizes.slot_mouth_polar_deg"] == pytest.approx(mouth, abs=1e-9)
    assert values["sizes.slot_bottom_polar_deg"] == pytest.approx(bottom, abs=1e-9)


RIM = math.hypot(20.0 * math.cos(math.pi / 4.0), 2.0)  # where the roller enters: see above
JAMS = size(
    "center_distance_mm = 20",
    "roller_radius_mm = 2",
    f"wheel_radius_mm = {RIM + 0.2:.6f}",
    wheel="z = 4",
)
OLD = "the old file, whole\n"


@pytest.mark.long
def test_a_machine_that_jams():
    name = spec(JAMS)
    Path("old.dxf").write_text(OLD, encoding="utf-8")
    said = refused(profile(name, "wheel", "old.dxf"), 1, "spec.toml: not written: ", "--force")
    assert Path("old.dxf").read_text(encoding="utf-8") == OLD
    refused(profile(name, "crank", "new.svg"), 1, "not written")
    assert sorted(os.listdir()) == ["old.dxf", "spec.toml"]

    assert "roller and slot overlap" in said
    # Half a motion is 45 degrees: it collides just before it enters, or just after it has left.
    (at,) = re.findall(r"input angle (-?[\d.]+)°", said)
    assert 45.0 < abs(math.remainder(float(at), 360.0)) < 50.0
    value = float(re.search(r"wheel_radius_mm = ([\d.]+) would free it", said)[1])
    # It frees, and is no smaller than it need be: to a tenth of the change.
    wider = value + 0.1 * (RIM + 0.2 - value)
    rims = [load(name).spec.with_("size.wheel_radius_mm", rim) for rim in (value, wider)]
    rows = [row for rim in rims for row in checks(build(rim)) if row.name == "gap_mm"]
    assert RIM <= value < wider and [row.passes for row in rows] == [True, False]

    forced = profile(name, "wheel", "old.dxf", "--force")
    assert forced.exit_code == 0
    (warning,) = forced.stderr.splitlines()
    assert warning.startswith("spec.toml: warning: ")
    assert "overlap" in warning
    assert dxf_shapes(Path("old.dxf").read_text(encoding="utf-8"))["WHEEL"]
