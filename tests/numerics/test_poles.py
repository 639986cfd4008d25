"""Which functions with a pole rise or fall all the way, and how good the cubics of cells are."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from geneva_cli.numerics.cubics import between
from geneva_cli.numerics.poles import goes_one_way
from geneva_cli.numerics.quintics import NEARLY, misses_of_cells, turns_as_told

SHARE = 3e-3


def rows(samples):
    """Places, values and slopes of functions, each an array."""
    return tuple(np.array(row) for row in zip(*samples, strict=True))


@pytest.mark.parametrize("middle", [0.5, 0.3])
def test_quintics(middle):
    """Of the quintic that three samples are of the cubics of both cells miss the middles by that,
    the one or the other: to rounding.
    """
    random = np.random.default_rng(1)
    curves = [Polynomial(random.normal(size=6)) for _ in range(500)]
    three = [rows([(x, p(x), p.deriv()(x)) for p in curves]) for x in (0.0, middle, 1.0)]
    expected = np.zeros(500)
    for one, two in zip(three, three[1:], strict=False):
        x = 0.5 * (one[0] + two[0])
        true = np.array([p(at) for p, at in zip(curves, x, strict=True)])
        expected = np.maximum(expected, np.abs(true - between(one, two, x)))
    assert misses_of_cells(*three) == pytest.approx(expected, rel=1e-9, abs=1e-13)


@pytest.mark.parametrize("middle", [0.5, 0.35])
def test_turns_within_cells(middle):
    """Of 6,000 quintics no cell turns otherwise than told; and of those that a cubic nearly
    predicts some half are told.
    """
    random = np.random.default_rng(3)
    rows_ = random.normal(size=(6000, 6)) * 0.5 ** np.arange(6)
    curves = [Polynomial(row) for row in rows_]
    three = [rows([(x, p(x), p.deriv()(x)) for p in curves]) for x in (0.0, middle, 1.0)]
    x = np.linspace(0.0, 1.0, 801)
    powers = np.vander(x, 6, increasing=True)
    every = rows_ @ powers.T
    room = SHARE * np.ptp(every, axis=1)
    told = turns_as_told(*three, room)
    slopes = (rows_[:, 1:] * np.arange(1, 6)) @ powers[:, :-1].T
    changes = np.sign(slopes[:, :-1]) != np.sign(slopes[:, 1:])
    cut = np.searchsorted(x, middle)
    for part, (one, two) in ((changes[:, :cut], three[:2]), (changes[:, cut:], three[1:])):
        as_ends = part.sum(axis=1) == (np.sign(one[2]) != np.sign(two[2]))
        assert as_ends[told].all()
    missed = np.abs(three[1][1] - between(three[0], three[2], three[1][0]))
    near = missed < NEARLY * room
    assert told[near].sum() > 0.4 * near.sum() > 1200
    assert not told[~near].any()


def test_a_turn_beside_a_flat_end_is_not_told():
    """x - 100 x² + ... falls soon after it rises: so flat an end has no sure sign."""
    p = Polynomial([0.0, 0.002, -0.2, 1.0, 0.3, 0.1])
    three = [rows([(x, p(x), p.deriv()(x))]) for x in (0.0, 0.5, 1.0)]
    assert p.deriv()(0.0) > 0.0 > p.deriv()(np.linspace(0.0, 0.5, 99)).min()
    assert not turns_as_told(*three, np.array([0.1])).any()


def quotients(count, pole):
    """Polynomials of the fifth degree over others that are 0 at most so far before 0."""
    random = np.random.default_rng(2)
    for _ in range(count):
        room = Polynomial([10.0 ** random.uniform(-3.0, pole), 1.0, *random.normal(size=2) * 0.3])
        yield Polynomial(random.normal(size=6)) * 0.3 + random.uniform(0.5, 3.0), room


def three_of(pairs, ends):
    """Samples of quotients and their rooms at the ends of a stretch and its middle."""
    of, room = [], []
    for x in np.linspace(*ends, 3):
        few = [(p(x), p.deriv()(x), r(x), r.deriv()(x)) for p, r in pairs]
        of.append(rows([(x, p / r, (q * r - p * s) / r**2) for p, q, r, s in few]))
        room.append(rows([(x, r, s) for _, _, r, s in few]))
    return of, room


@pytest.mark.parametrize("ends", [(0.0, 1.0), (0.0, 0.4), (0.3, 0.6)])
def test_quotients_with_a_pole(ends):
    """Of 1,500 none that turns is told to go one way, and of the others most are told to."""
    pairs = [pair for pair in quotients(1500, 1.0) if pair[1](np.linspace(*ends, 50)).min() > 0.0]
    told = goes_one_way(*three_of(pairs, ends), SHARE)
    x = np.linspace(*ends, 2001)
    way = np.array([np.sign((p.deriv() * r - p * r.deriv())(x)).sum() / 2001 for p, r in pairs])
    assert (np.abs(way[told]) == 1.0).all()
    assert told.sum() > 0.7 * (np.abs(way) == 1.0).sum() > 200


def test_beside_a_pole_no_cubic_tells():
    """1/(x + 0.01): a cubic misses the middle of [0, 1] by ten times what it is."""
    pair = (Polynomial([1.0, 0.0]), Polynomial([0.01, 1.0]))
    of, room = three_of([pair], (0.0, 1.0))
    left, middle, right = of
    assert abs(between(left, right, middle[0]) - middle[1])[0] > 10.0 * middle[1][0]
    assert goes_one_way(of, room, SHARE).all()
    # with a room that is 0 within, or that a cubic does not know, nothing is
    lost = [(x, np.array([r]), s) for (x, _, s), r in zip(room, (1.0, -0.1, 1.0), strict=True)]
    assert not goes_one_way(of, lost, SHARE).any()
    bent = [(x, np.array([r]), s) for (x, _, s), r in zip(room, (0.01, 0.1, 1.01), strict=True)]
    assert not goes_one_way(of, bent, SHARE).any()
