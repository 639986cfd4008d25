"""Names of quantities: the list is what designs have, and one rule resolves a name for all."""

import math

import pytest
import repo

from geneva_cli import GenevaError, load
from geneva_cli.loads.load_peaks import REPORTED_PEAKS
from geneva_cli.study.batches import batch_machines, numbers
from geneva_cli.study.fields import pick
from geneva_cli.table import Table
from geneva_cli.verdict.quantities.groups import GROUPS
from geneva_cli.verdict.quantities.quantity_names import WORDS, whole_name

pytestmark = pytest.mark.usefixtures("made_once")
LISTS = {  # of a report's names those of tables and lists, which are no quantities
    *("stations", "cycle.reversals_deg", "vibration.speeds_to_avoid_rpm", "strength.needs"),
    *("tolerance.warnings", "wheels", "cranks"),
}


@pytest.mark.long
@pytest.mark.parametrize("name", ["tolerances", "press-curved", "unequal-steps", "spherical-z6"])
def test_every_group_has_the_names_that_are_listed(name):
    proof = load(str(repo.DESIGNS / f"{name}.toml")).parts
    for group in GROUPS:
        if group.table == "parts_list":
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


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("max", "it may be velocity.max or acceleration.max or jerk.max or power.max or"),
        ("horn_stress_MPa", "it may be strength.lock.horn_stress_MPa or life.horn_stress_MPa; say"),
        ("margin", "strength.crank_shaft.margin or 3 more; say which"),
        ("acceleration.mx", '(did you mean "acceleration.max"?)'),
    ],
)
def test_what_no_name_is(asked, said):
    with pytest.raises(GenevaError) as error:
        whole_name(asked, "--sort")
    assert str(error.value).startswith(f"--sort {asked}: ") and said in str(error.value)
    assert str(error.value).count(" or ") <= 5
