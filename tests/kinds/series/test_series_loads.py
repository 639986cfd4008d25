"""Loads of drives in series, with friction, against bodies cut free in 50 digits."""

import pytest
import repo
from test_load_designs import LOAD, agree, planar
from words import load

from geneva_cli import (
    Cam,
    Cycloidal,
    EllipticalGears,
    External,
    Internal,
    Motion,
    NoncircularGears,
    Polynomial345,
    SideCrank,
)
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.tables import Support

SPECS = {
    "curved": Spec(External(6), motion=Motion(Cycloidal(), ratio="matched")),
    "cam": Spec(External(6), Cam(), Motion(Cycloidal())),
    "internal-cam": Spec(Internal(8), Cam(), Motion(Polynomial345())),
}
FRONTS = (
    EllipticalGears(eccentricity=0.2, gear_distance_mm=80.0),
    EllipticalGears(eccentricity=0.1, phase="quick"),
    NoncircularGears(A=0.3),
    SideCrank(A=-0.2, input_crank_mm=60.0),
)


@pytest.mark.sampled(36)
@pytest.mark.parametrize(
    "name", ["epicyclic-z4", "four-bar-z4", "slider-crank", "gear-sector", *SPECS]
)
@pytest.mark.parametrize("front", FRONTS, ids=lambda front: front.NAME)
def test_loads_of_drives_in_series(name, front):
    """Within 64 units of each quantity's peak: twice a single drive's, whose inputs round, too."""
    spec = SPECS.get(name) or load(str(repo.DESIGNS / f"{name}.toml")).spec
    spec = spec.replace(load=LOAD, mass=(), support=Support(), drive_before=front)
    agree(build(spec), 0, (-0.8, 0.1, 0.6), planar, 64.0)
