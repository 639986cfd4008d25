"""What is computed and what is skipped: positions evaluated, derivatives carried, modules loaded.

| asked for                          | positions evaluated                              |
| ---------------------------------- | ------------------------------------------------ |
| n angles, symmetric machine and angles | (n + 1) // 2, and the ends' few              |
| n angles, else                     | n                                                |
| a peak of a symmetric machine      | of the first half only                           |
| a table's row, A = 0               | none: closed forms                               |
"""

import numpy as np
import pytest

from geneva_cli.analysis import peaks as peaks_module
from geneva_cli.analysis.motion import motion_table
from geneva_cli.analysis.peak_search import search_peaks
from geneva_cli.kinematics import registry
from geneva_cli.kinematics.engagement import WheelMotion
from geneva_cli.kinematics.path_and_slot import ClassicMotion

N = 2001


class Counter:
    """How many positions a method was asked for, and for which derivatives."""

    def __init__(self, monkeypatch, cls, name, orders):
        self.positions, self.orders, self.below_zero = 0, set(), True
        inner = getattr(cls, name)

        def counted(this, x, *rest, **more):
            self.positions += np.size(x)
            self.orders.add(orders(*rest, **more))
            self.below_zero &= bool(np.all(np.asarray(x) <= 0.0))
            return inner(this, x, *rest, **more)

        monkeypatch.setattr(cls, name, counted)


@pytest.fixture
def arrays(monkeypatch):
    """The closed forms of classic wheels over arrays."""
    return Counter(monkeypatch, ClassicMotion, "_requested", tuple)


def kinds(cls):
    yield cls
    for other in cls.__subclasses__():
        yield from kinds(other)


@pytest.fixture
def jets(monkeypatch):
    """Every class of motion that is worked out in a way of its own."""
    for name in registry.DRIVES:
        registry.drive(name)
    for name in registry.GEARINGS:
        registry.gearing(name)
    return [
        Counter(monkeypatch, cls, "__call__", lambda order=3: order)
        for cls in set(kinds(WheelMotion))
        if "__call__" in vars(cls) and not getattr(cls.__call__, "__isabstractmethod__", False)
    ]


def counted(jets):
    return sum(c.positions for c in jets)


def evenly(engagement):
    half = np.linspace(engagement.entry_deg, 0.0, N // 2 + 1)
    return np.concatenate([half[:-1], -half[::-1]])


def test_plain_crank_evaluates_half(engagement, arrays, jets):
    s = engagement(6)
    x = evenly(s)
    s.motion.derivatives(x)
    assert (arrays.positions, counted(jets)) == (N // 2 + 1, 0)


def test_plain_crank_at_unsymmetric_angles_evaluates_all(engagement, arrays, jets):
    s = engagement(6)
    x = evenly(s)[:-1]
    s.motion.derivatives(x)
    assert (arrays.positions, counted(jets)) == (N - 1, 0)


@pytest.mark.parametrize(
    ("keys", "halved"),
    [
        ({"A": 0.6}, True),
        ({"law": "cycloidal"}, True),
        ({"law": "sine-group"}, True),
        ({"law": "sine-group", "lambda_": 0.1}, False),
    ],
    ids=["side-crank", "cycloidal", "sine-group", "tilted-sine-group"],
)
def test_jets_evaluate_half_where_the_motion_is_symmetric(engagement, arrays, jets, keys, halved):
    s = engagement(6, **keys)
    s.motion.derivatives(evenly(s))
    assert counted(jets) == (N // 2 + 1 if halved else N)
    assert arrays.positions == 0


def test_motion_does_not_evaluate_the_dwell(machine, arrays, jets):
    m = machine(6)
    motion_table(m, 3601)
    inside = 1201  # 120 of 360 degrees, both ends
    assert arrays.positions in (inside, inside // 2 + 1)


def test_only_the_orders_that_are_asked_for(engagement, arrays, jets):
    s = engagement(6)
    out = s.motion.derivatives(evenly(s), (1, 2))
    assert len(out) == 2
    assert arrays.orders == {(1, 2)}
    assert {o for c in jets for o in c.orders} <= {2}


def test_a_jet_carries_no_more_than_it_must(engagement):
    for s in (engagement(6), engagement(6, A=0.6), engagement(6, law="cycloidal")):
        for order in range(4):
            assert len(s.motion(np.array([-1.0, 0.0]), order).c) == order + 1


def test_a_symmetric_peak_is_searched_in_one_half(engagement, jets):
    s = engagement(6, law="cycloidal")
    search_peaks(s.motion, peaks_module.QUANTITIES)
    assert 0 < counted(jets) < 1000
    assert all(c.below_zero for c in jets)


def test_the_classic_peaks_need_no_search(engagement, jets):
    """Every peak of a plain crank: closed forms, but for an internal wheel's jump at entry."""
    peaks_module.peaks_of(engagement(6).motion, peaks_module.QUANTITIES)
    assert counted(jets) == 0
    peaks_module.peaks_of(engagement(6, "internal").motion, peaks_module.QUANTITIES)
    assert counted(jets) == 1
