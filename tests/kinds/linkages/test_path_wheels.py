"""The wheels of a roller's path, against all pairs of a dense grid of places on it."""

import cmath
import math

import numpy as np
import pytest
from scipy.optimize import root

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.linkages.four_bar import FourBar
from geneva_cli.kinds.linkages.path_wheels import chosen, driven, passed
from geneva_cli.kinds.linkages.tangent_pairs import pairs, sampled

PLACES = 480  # of the grid
CHECKED = 4001  # places at which a wheel is checked between entry and exit, and on the way back
# A wheel that is driven within three steps of the grid has no place in it to speak of.
SHORTEST = 3.0 * math.tau / PLACES
FOUR_BAR = {
    "crank_mm": (20.0, 60.0),
    "ground_mm": (60.0, 120.0),
    "coupler_mm": (60.0, 140.0),
    "rocker_mm": (60.0, 140.0),
    "point_mm": (20.0, 250.0),
    "point_deg": (-180.0, 180.0),
}


def four_bars(n, seed):
    """Linkages whose crank turns all round, and numbers of slots."""
    random = np.random.default_rng(seed)
    found = []
    while len(found) < n:
        keys = {key: float(random.uniform(*ends)) for key, ends in FOUR_BAR.items()}
        z = int(random.choice([3, 4, 5, 6, 8, 12]))
        try:
            found.append((FourBar(**keys, branch=str(random.choice(["+", "-"]))), z))
        except GenevaError:
            continue
    return found


def pin(path, phi):
    """Place and velocity, as complex numbers."""
    crank = np.exp(1j * phi)
    return path.joints(crank)[2], path.about(crank).velocity


def conditions(path, b, sense, phi):
    """The chord's part across the tangents' sum, and the sine of the index angle's excess."""
    p, v = pin(path, np.asarray(phi))
    t = v / abs(v)
    excess = (-t[1] * t[0].conjugate() * cmath.exp(-2j * sense * b)).imag
    return [((p[1] - p[0]) * (t[0] + t[1]).conjugate()).imag, excess]


def drives(path, b, sense, entry, exit_):
    """Whether the roller turns the wheel by one index angle, one way, and keeps to its slot."""
    p, v = pin(path, np.array([entry, exit_]))
    t = v / abs(v)
    rho = ((p[1] - p[0]) / (t[0] + t[1])).real
    O = p[0] + rho * t[0]
    share = np.linspace(0.0, 1.0, CHECKED)[1:-1]
    p, v = pin(path, entry + (exit_ - entry) * share)
    back, _ = pin(path, exit_ + (entry + math.tau - exit_) * share)
    turned = np.unwrap(np.angle(p - O))
    index = sense * (turned[-1] - turned[0])
    return (
        rho > 0.0
        and (sense * ((p - O).conj() * v).imag > 0.0).all()
        and (abs(p - O) < rho).all()
        and (abs(back - O) > rho).all()
        and abs(index - 2.0 * b) < 0.1
    )


def brute(path, b):
    """Wheels (entry, exit, sense) from every cell of the grid in which both conditions change."""
    phi = np.arange(PLACES + 1) * (math.tau / PLACES)
    p, v = pin(path, phi)
    t = v / abs(v)
    chord, both = p[None, :] - p[:, None], t[:, None] + t[None, :]
    across = (chord * both.conj()).imag
    index = -t[None, :] * t[:, None].conj()
    found = []
    for sense in (1.0, -1.0):
        excess = (index * cmath.exp(-2j * sense * b)).imag
        ahead = (index * cmath.exp(-2j * sense * b)).real > 0.0
        cells = ahead[:-1, :-1]
        for part in (across, excess):
            corners = np.stack([part[:-1, :-1], part[1:, :-1], part[:-1, 1:], part[1:, 1:]])
            cells = cells & (corners.min(axis=0) <= 0.0) & (corners.max(axis=0) >= 0.0)
        for i, j in zip(*np.nonzero(cells), strict=True):
            if abs(i - j) < 2:
                continue
            start = [phi[i] + 0.5 * phi[1], phi[j] + 0.5 * phi[1]]
            end = root(lambda x, s=sense: conditions(path, b, s, x), start, tol=1e-13)
            entry, exit_ = (float(x) for x in end.x)
            entry, exit_ = entry % math.tau, exit_ % math.tau
            exit_ += math.tau * (exit_ < entry)
            settled = max(map(abs, conditions(path, b, sense, [entry, exit_]))) < 1e-9
            long_enough = SHORTEST < exit_ - entry < math.tau - SHORTEST
            new = settled and long_enough and not any(same(entry, f[0]) for f in found)
            if new and drives(path, b, sense, entry, exit_):
                found.append((entry, exit_, sense))
    return found


def same(a, b, by=1e-6):
    return abs(math.remainder(a - b, math.tau)) < by


def wheels(path, b):
    """Entries, exits and senses of all wheels of a path."""
    half = np.array([b])
    with np.errstate(all="ignore"):
        return passed(path, driven(path, pairs(path, sampled(path, 1), half))[0])


def listed(found):
    return [(e, x, s) for (e, x), s in zip(found.phi.T.tolist(), found.sense.tolist(), strict=True)]


def compared(keys, z):
    """How many wheels there are; each of the dense grid's is found, and what is found drives."""
    path, b = keys.roller_path, math.pi / z
    found = listed(wheels(path, b))
    expected = brute(path, b)
    for entry, exit_, sense in expected:
        assert [f for f in found if same(f[0], entry) and same(f[1], exit_) and f[2] == sense]
    for entry, exit_, sense in found:
        assert drives(path, b, sense, entry, exit_)
    return len(expected), len(found)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("seed", range(4))
def test_no_wheel_is_missed(seed):
    counts = [compared(keys, z) for keys, z in four_bars(3, seed)]
    assert sum(expected for expected, _ in counts) > 2


def peak(path, phi):
    """Greatest velocity at 20,001 even angles of the wheel with this entry and exit."""
    p, v = pin(path, phi)
    t = v / abs(v)
    centre = p[0] + ((p[1] - p[0]) / (t[0] + t[1])).real * t[0]
    p, v = pin(path, np.linspace(*phi, 20_001))
    return abs((v / (p - centre)).imag).max()


# the last has two wheels whose peaks differ by 1 %, and one of them has two nearly equal peaks
TWO_PEAKS = FourBar(
    crank_mm=44.4868,
    ground_mm=76.9857,
    coupler_mm=118.422,
    rocker_mm=86.0199,
    point_mm=25.0925,
    point_deg=104.568,
    branch="-",
)


@pytest.mark.parametrize(("keys", "z"), [*four_bars(6, 5), (TWO_PEAKS, 6)])
def test_the_chosen_wheel_has_the_least_peak(keys, z):
    path = keys.roller_path
    found = wheels(path, math.pi / z)
    peaks = [peak(path, found.phi[:, i]) for i in range(len(found.which))]
    with np.errstate(all="ignore"):
        best = chosen(path, np.array([math.pi / z]))[:2, 0]
    if peaks:
        assert peak(path, best) == pytest.approx(min(peaks), rel=1e-9)
    else:
        assert np.isnan(best).all()
