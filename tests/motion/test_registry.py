"""What every registered wheel, drive and law must be: named as registered, all its keys known,
and machines of it that can be kept, sent to another process and built again from their spec."""

import dataclasses
import pickle

import numpy as np
import pytest
import repo

from geneva_cli import design
from geneva_cli.errors import GenevaError
from geneva_cli.motion import registry
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.schema import checked, fields

KINDS = [
    *[(registry.gearing, name) for name in registry.GEARINGS],
    *[(registry.drive, name) for name in registry.DRIVES],
    *[(registry.law, name) for name in registry.LAWS],
]
DESIGNS = sorted(repo.DESIGNS.glob("*.toml"))

every = pytest.mark.parametrize("file", DESIGNS, ids=lambda file: file.stem)
kind = pytest.mark.parametrize(
    ("registered", "name"), KINDS, ids=lambda part: getattr(part, "__name__", part)
)


@kind
def test_every_field_of_a_kind_is_a_key(registered, name):
    cls = registered(name)
    found = fields(cls)
    assert {f.attribute for f in found} == {f.name for f in dataclasses.fields(cls)}
    assert len({f.key for f in found}) == len(found)
    assert all(f.meaning and f.types for f in found)
    # what is not given is checked like anything else, and so must pass
    for field in found:
        if field.default not in (dataclasses.MISSING, None):
            assert checked(cls.TABLE, field, field.default) == field.default


@pytest.mark.parametrize("registered", [registry.gearing, registry.drive, registry.law])
def test_an_unknown_kind_is_refused_with_those_that_are_known(registered):
    with pytest.raises(GenevaError, match="must be one of") as refused:
        registered("maltese")
    assert '"maltese"' in str(refused.value)
    assert refused.value.key


def numbers(engagement):
    """All that an engagement says of 31 input angles, as arrays and as numbers."""
    x = np.linspace(engagement.entry_deg, engagement.exit_deg, 31)
    out = [engagement.mid_deg, engagement.half_step, engagement.motion.symmetric]
    for at in (x, float(x[7])):
        jets = [engagement.motion(at), *engagement.path(at), *engagement.slot(at)]
        jets += [engagement.carrier(at, 1), *engagement.slot.axis(at, 1)]
        if engagement.groove:
            jets += engagement.groove.distances(at)
        out += [np.broadcast_to(c, np.shape(at)).tolist() for jet in jets for c in jet.c]
        out.append(np.broadcast_to(engagement.slot.touches(at), np.shape(at)).tolist())
    return [*out, [v.tolist() for v in engagement.motion.derivatives(x)]]


def all_numbers(mechanism):
    found = [numbers(e) for e in mechanism.engagements]
    whole = (mechanism.period_deg, mechanism.ratio, mechanism.center_distance_mm)
    return [whole, mechanism.rollers_max, found]


@pytest.mark.sampled(12)
@every
def test_a_machine_can_be_pickled(file):
    """And gives the same numbers, bit for bit: no formula in it is a closure."""
    made = design.load(str(file)).mechanism
    assert pickle.loads(pickle.dumps(made.spec)) == made.spec
    # both before it was asked for anything, and with what it keeps of its answers
    for _ in ("before", "after"):
        sent = pickle.loads(pickle.dumps(made))
        assert all_numbers(sent) == all_numbers(made)
        assert all_numbers(build(sent.spec)) == all_numbers(made)
