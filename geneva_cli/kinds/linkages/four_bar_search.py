"""The search of four-bars: proportions, the crank's angle at entry and, in a range, the motion.

With the crank's pin A and the coupler's unit vector e, the roller is at P = A + w e. Between entry
and exit of slots of a wheel of sense s, the tangent V has turned by pi - 2b relative to the wheel,
and the chord is half-way between both tangents:

    Im(V2 V1* exp(i s (pi - 2b))) = 0 ,    Im((P2 - P1) V1* exp(i s (pi - 2b)/2)) = 0 .

In the plane of w both are circles. At one intersection the roller rests at entry; the other one is
the solution.
"""

from __future__ import annotations

import math
from functools import partial
from typing import NamedTuple

import numpy as np

from geneva_cli.kinds.linkages.four_bar import CouplerPath
from geneva_cli.kinds.linkages.link_path import LinkPath
from geneva_cli.kinds.linkages.path_wheels import PathWheels, centre_of, top
from geneva_cli.kinds.linkages.tangent_pairs import Pairs, complex_of, turning_rate
from geneva_cli.motion.peak_search import ORDERS
from geneva_cli.motion.timing import Timing, timing
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import Array, Complex, Mask, Whole, parameter
from geneva_cli.numerics.jet import Jet, turning
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synth.family_search import Places, Zoom, sampled, zoom
from geneva_cli.study.target import AllowedSpan, Target
from geneva_cli.verdict.quantities.quantity_rows import RATES

SAMPLES = (256, 2048)  # least and most four-bars that are sampled for one wheel
SAMPLINGS = (14, 60)  # least and most closer samplings for one wheel
COARSE, FINE = 16, 96  # sampled places of a motion
OTHERS = 6  # further results if a bound or the goal is not computed here
# by a quantity in the unit of a time, the power of the speed that it has
SPEED_POWERS = {f"{at}_rad{end}": n for n, _, end in RATES.values() for at in ("max", "entry")}


class WheelGoal(NamedTuple):
    """A wheel, its allowed motions, and the least roller as a fraction of the centre distance."""

    wheel: Gearing
    motion: AllowedSpan
    roller: float


class Goal(NamedTuple):
    """The goal of the search: bounds, and a quantity to minimise (``sign`` -1: maximise)."""

    target: Target
    wheels: tuple[WheelGoal, ...]
    bounds: tuple[Constraint, ...]
    least: str
    sign: float = 1.0


class FourBars(NamedTuple):
    """Machines of the search; violations and costs are infinite without a machine."""

    path: CouplerPath  # of the roller, with numbers (n,)
    pair: Pairs
    distance: Array
    violation: Array
    cost: Array


def search_four_bars(goal: Goal) -> list[Places]:
    """For each wheel the places of four-bars that keep the bounds, the best first.

    A place is a point of the unit cube: two proportions, the crank, its angle, the motion in a
    range, and the wheel's sense.
    """
    wheels, slots = len(goal.wheels), len(goal.target.z)
    # all wheels of a requirement together have about 6000 samples, and 300 closer samplings
    count = min(max(6000 // slots, SAMPLES[0]), SAMPLES[1])
    samplings = min(max(300 // slots, SAMPLINGS[0]), SAMPLINGS[1])
    parents, children = 4, 12  # the best places of a wheel, and the closer samples near each

    def coarse(of: Whole, at: Array, samples: int = COARSE) -> tuple[Array, Array]:
        return four_bars_at(goal, of, at, samples)[-2:]

    def offsets(number: int) -> Array:
        return np.column_stack((_spread(children, number) - 0.5, np.zeros(children)))

    with np.errstate(all="ignore"):
        points = np.repeat(_spread(count), 2, axis=0)
        at = np.column_stack((points, np.resize([1.0, 0.0], 2 * count)))
        each = [sampled(coarse, np.full(2 * count, i), at).best(OTHERS) for i in range(wheels)]
        first = each[0].joined(*each[1:])
        first = first.take(np.isfinite(first.violation))
        closer = 3e-3 ** (1.0 / samplings)
        near = Zoom(offsets, 0.3, closer, samplings, around=(3,))
        several = zoom(coarse, first.best(parents), near, keep=parents).joined(first)
        # fine samples remove those that fail between the coarse ones
        kept = sampled(partial(coarse, samples=FINE), several.of, several.at)
        kept = kept.take(kept.violation == 0.0).best(parents + OTHERS)
    return [kept.take(kept.of == i) for i in range(wheels)]


def _spread(count: int, start: int = 0) -> Array:
    """Points spread evenly in the unit cube: Roberts' sequence, multiples of the powers of g."""
    g = 1.1347241384015194
    powers = g ** -np.arange(1.0, 6.0)
    numbers = np.arange(1 + start * count, 1 + (start + 1) * count)
    points: Array = (0.5 + numbers[:, None] * powers) % 1
    return points


def four_bars_at(goal: Goal, of: Whole, at: Array, places: int = FINE) -> FourBars:
    """The machines at places of the cube, for wheels by their numbers."""
    rows = [(w.wheel.step.b, *w.motion, w.roller, float(w.wheel.z)) for w in goal.wheels]
    (b, low, high, roller, slots), u = np.array(rows).T[:, of], at.T
    sense = np.where(u[5] > 0.5, 1.0, -1.0)
    # coupler and rocker are 1/4 to 4 times as long as the ground link
    sides = np.stack((np.ones(u[0].shape), *(4.0 ** (2.0 * x - 1.0) for x in u[:2])))
    longest = np.minimum(sides.min(axis=0), sides.sum(axis=0) - 2.0 * sides.max(axis=0))
    # the crank is 0.05 to 0.97 times as long as the longest that turns fully
    lengths = (longest * (0.05 + (0.97 - 0.05) * u[2]), *sides)
    path = CouplerPath(*map(parameter, lengths), reach_mm=0.0, angle_deg=0.0)
    # the gentlest is often at an end of a range: a sixth of all places is at either
    motion_deg = low + (high - low) * np.clip(1.5 * u[4] - 0.25, 0.0, 1.0)
    entry = math.tau * u[3]
    pair = Pairs(of, np.stack((entry, entry + np.radians(motion_deg))), sense)
    w = coupler_point(path, pair, b)
    path = path.having((*path.numbers[:4], parameter(w.real), parameter(w.imag)))
    # coarse samples miss the nearest places, which a larger roller makes up for
    roller = roller * (1.15 if places < FINE else 1.0)
    names = (goal.least, *(bound.name for bound in goal.bounds))
    order = max([2, *(ORDERS.get(name.partition(".")[0], 0) for name in names)])
    drives, rates, distance, reach = _driven(path, pair, b, roller, order, places)
    costs = Costs(goal.target, 360.0 / slots, rates, motion_deg)
    cost = goal.sign * costs.of(goal.least)
    drives &= (longest > 0.0) & (reach <= goal.target.space * distance) & np.isfinite(cost)
    violation, cost = np.where(drives, (costs.broken(goal.bounds), cost), np.inf)
    return FourBars(path, pair, distance, violation, cost)


def coupler_point(path: LinkPath, pair: Pairs, b: Array) -> Complex:
    """The roller's place w on the coupler that makes a motion, (n,).

    NaN if there is none, or if the chord does not run from entry to exit.
    """
    crank = np.exp(1j * pair.phi)
    (x, y), (px, py), (*_, rate, _) = path.turn(crank, 1)
    along, pin = x + 1j * y, px + 1j * py
    (p, p_end), (v, v_end) = pin, 1j * pin
    (e, e_end), (u, u_end) = along, 1j * rate * along
    turn = np.exp(1j * pair.sense * (0.5 * math.pi - b))
    circles = []
    for q, f, k in (v_end, u_end, turn * turn), (p_end - p, e_end - e, turn):
        # Im((q + w f)(v + w u)* k) = A |w|² + Im(d w) + C
        d = f * v.conj() * k - (q * u.conj() * k).conj()
        circles.append(((f * u.conj() * k).imag, d, (q * v.conj() * k).imag))
    (A, d, C), (A2, d2, C2) = circles
    # The line through both points: Im(D w) + E = 0
    D, E = A2 * d - A * d2, A2 * C - A * C2
    direction, foot = D.conj() / np.abs(D), -1j * E / D
    at_rest = ((-v / u - foot) * direction.conj()).real
    total = -(2.0 * A * (foot * direction.conj()).real + (d * direction).imag) / A
    w = foot + (total - at_rest) * direction
    chord, speed = p_end + w * e_end - (p + w * e), v + w * u
    ahead = (chord * (speed / np.abs(speed)).conj() * turn).real > 0.0
    return np.where(ahead, w, np.nan)


def _driven(
    path: LinkPath, pair: Pairs, b: Array, roller: Array, order: int, places: int
) -> tuple[Mask, list[Array], Array, Array]:
    """A mask of the wheels that are driven, at samples, and let the roller pass on its way back.

    Also their velocities with derivatives to an order, (n, places + 1) each; centre distances; and
    the greatest distances of joints and roller from the crank's axis. ``roller`` is its radius
    over L.
    """
    entry, exit_ = pair.phi
    crank = np.exp(1j * np.linspace(entry, exit_, places + 1))
    at = complex_of(*path.about(crank)(0.0, order))
    _, joint, at[0] = path.joints(crank)
    wheels = PathWheels(pair, *centre_of(at[:, [0, -1]]))
    rho, L = wheels.distance, np.abs(wheels.centre)
    near, turns = wheels.driven(*at[:2])
    drives = ((turns > 0.0) & (near < rho))[1:-1].all(axis=0)
    drives &= (pair.sense * turning_rate(at[:3, [0, -1]]) < 0.0).all(axis=0)  # at both ends, too
    half_wall = 1.0 / 400.0  # of the least wall between two slots, over the centre distance
    drives &= near.min(axis=0) * np.sin(b) >= (roller + half_wall) * L
    # the way back has twice the motion's samples
    back = np.linspace(exit_, entry + math.tau, 2 * places + 1)[1:-1]
    _, joint_back, returns = path.joints(np.exp(1j * back))
    # Lengths over the distance of the slots' mouths from the wheel's axis; a slot points along the
    # real axis. The wheel ends at hypot(1, r), where slots as wide as the roller leave corners.
    r, place = roller * L / rho, (returns - wheels.centre) / (at[0, 0] - wheels.centre)
    d, angle = np.abs(place), np.abs((np.angle(place) + b) % (2.0 * b) - b)
    ahead, across = d * np.cos(angle), d * np.sin(angle)
    corner = np.where(ahead >= 1.0, np.hypot(ahead - 1.0, r - across), r - across)
    # in front of a slot its mouth's corner is nearest, else the rim
    gap = np.where(across < r * ahead, corner, d - np.hypot(1.0, r)) - r
    touch = 1e-6  # a roller that leaves its slot is this near to it
    drives &= ((gap >= -touch) & (d > 1.0)).all(axis=0)
    moving = [np.abs(z).max(axis=0) for z in (joint, at[0], joint_back, returns)]
    at[0] -= wheels.centre
    rays = [one.T / math.factorial(k) for k, one in enumerate(at)]
    rates = turning(Jet([z.real for z in rays]), Jet([z.imag for z in rays])).derivatives()
    return drives, [*rates], L, np.maximum.reduce([path.numbers[1], *moving])


class Costs(NamedTuple):
    """Samples of n motions: velocities with derivatives (n, places), steps and motions, degrees."""

    target: Target
    index_deg: Array
    rates: list[Array]
    motion_deg: Array

    def of(self, name: str) -> Array:
        """A quantity for which ``is_known`` is true, (n,)."""
        group, _, quantity = name.partition(".")
        if group == "timing":
            dwell = 360.0 - self.motion_deg
            times = timing(self.motion_deg, dwell, self.index_deg, self._n_rpm())  # type: ignore[arg-type]
            return np.broadcast_to(times._asdict()[quantity], self.motion_deg.shape)
        value = self.rates[ORDERS[group] - 1]
        if group == "power":
            value = value * self.rates[0]
        end = _end(quantity)
        size = top(np.abs(value)) if end is None else np.abs(value[:, end])
        if quantity in SPEED_POWERS:
            size = size * (self._n_rpm() * (math.pi / 30.0)) ** SPEED_POWERS[quantity]
        return size

    def _n_rpm(self) -> Array:
        """The input's speed, (n,), which a quantity without a time does not need."""
        return np.array([self.target.n_rpm(1, float(x)) for x in self.motion_deg])

    def broken(self, bounds: tuple[Constraint, ...]) -> Array:
        """The sum of the relative violations of the bounds, (n,)."""
        total = np.zeros(len(self.motion_deg))
        for b in bounds:
            # a peak between samples may be 1e-4 higher; times follow from the motion angle
            needed = -1e-9 if b.name.startswith("timing.") else 1e-4
            total = total + np.maximum(needed - b.margin(self.of(b.name)), 0.0)
        return total


def is_known(name: str) -> bool:
    """Return True if the search can compute a quantity."""
    group, _, quantity = name.partition(".")
    if group == "timing":
        return quantity in Timing._fields[:-1]  # the last is a rack's step
    whole = quantity in ("max", "entry", "exit") or quantity in SPEED_POWERS
    at_rest = _end(quantity) is not None and group in ("velocity", "power")
    return group in ORDERS and whole and not at_rest


def _end(quantity: str) -> int | None:
    """The sample at which a quantity is taken; None for its greatest value."""
    return {"entry": 0, "exit": -1}.get(quantity.partition("_")[0])
