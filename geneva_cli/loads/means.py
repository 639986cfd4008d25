"""Means of the loads of a batch: sums of them and of their squares over a period."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geneva_cli.loads.contact import NEAR_CUSP
from geneva_cli.loads.cycle_quantities import SQUARED, multiples, plain_values
from geneva_cli.loads.load_functions import ContactState, LoadFunctions, signed_instant
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Mask, Whole, array, matrix_product
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.pieces import gathered, spread
from geneva_cli.numerics.quadrature import Integrands, span_integrals
from geneva_cli.numerics.search import Stretches


def sources_of(
    mechanism: Mechanism, names: Sequence[str]
) -> tuple[dict[str, tuple[str, Array]], list[str]]:
    """Each quantity's source and its ratio to it, (m,) or (1,); and the names of all sources."""
    known = multiples(mechanism)
    every = {n: known.get(n, (n, 1.0, ""))[:2] for n in names}
    multiple_of = {
        n: (source, np.ravel(factor)) for n, (source, factor) in every.items() if factor is not None
    }
    return multiple_of, list(dict.fromkeys(source for source, _ in every.values()))


def means_from(
    mechanism: Mechanism, names: Sequence[str], each: Sequence[Array], plain: bool
) -> dict[str, tuple[Array | None, Array]]:
    """Mean and root mean square of quantities over a period.

    ``each`` are the integrals over each engagement, as ``sums`` returns them. The results are (m,)
    each, dwells included, and infinite if unbounded. Without ``plain`` the mean is None.
    """
    every, out = _in_period(mechanism, names, each), {}
    every /= np.ravel(mechanism.under_load.period_deg) * DEGREE
    for i, name in enumerate(names):
        square, mean = every[i], None
        if plain:
            mean = every[len(names) + i]
            # a mean whose square is so small a fraction of the mean square is rounding
            nought = np.isfinite(square) & (mean * mean <= 1e-30 * square)
            mean = np.where(nought, 0.0, mean)
        out[name] = mean, np.sqrt(square)
    return out


def _in_period(mechanism: Mechanism, names: Sequence[str], each: Sequence[Array]) -> Array:
    """The integrals over a period; of bearings the greatest crank's, of wheels one wheel's.

    The cranks work in turn. So do the wheels on a carrier, which are all alike.
    """
    drive = mechanism.spec.drive
    of_wheel = ("omega_rad_s", "alpha_rad_s2", "wheel_torque_Nm", "wheel_bearing_N")
    cranks, wheels = len(drive.cranks), max(1, drive.wheels_on_carrier)
    total: Array = np.sum(each, axis=0)
    for i in range(len(total)):
        if names[i % len(names)] in of_wheel:
            total[i] /= wheels
        if names[i % len(names)] == "crank_bearing_N" and cranks > 1:
            own = [sum(one[i] for one in each[k::cranks]) for k in range(min(cranks, len(each)))]
            total[i] = np.max(own, axis=0) * min(1.0, len(each) / cranks)
    return total


def sums(load: LoadFunctions, pieces: Stretches, bounded: Mask, n: int, plain: bool) -> Array:
    """The integrals by the angle in radians of the squares and, with ``plain``, of the quantities.

    The shape is (names, n) for each; integrals that are not ``bounded`` are infinite. Only
    quantities that are searched by their squares behave as a root at the ends of their stretches.
    """
    # pieces of one span together: a motion of several pieces is evaluated in one of them at a time
    order = np.argsort(pieces.span, kind="stable")
    design, (a, b) = pieces.design[order], pieces.x[:, order]
    signs = np.where(pieces.positive, 1.0, -1.0)[:, order]
    w = load.spread[design, 0]

    def rows(u: Array, which: Whole) -> Array:
        x, rate = gathered(u, w[which, None])
        state = load.at(np.clip(x, a[which, None], b[which, None]), design[which], 0)
        return powers(load, state, signs[:, which, None], plain) * rate

    rooted = plain and any(name in SQUARED for name in load.names)
    needed = np.tile(bounded, (2 if plain else 1, 1))
    with np.errstate(all="ignore"):
        spans = Integrands(rows, spread(a, w), spread(b, w), rooted)
        total = span_integrals(spans, design, needed)
        if load.engagement.slot.curved:
            total += _to_mid_motion(load, n, plain)
    total[~needed] = np.inf
    return total * DEGREE


def _to_mid_motion(load: LoadFunctions, n: int, plain: bool) -> Array:
    """The integrals of ``sums`` next to mid-motion of curved slots, by the angle in degrees.

    No stretch reaches there. The integral of a cubic from 0 to 1 follows from its values at 1, 2
    and 3 (Adams and Bashforth).
    """
    places, weights = np.array([1.0, 2.0, 3.0]), np.array([23.0, -16.0, 5.0]) / 12.0
    total = np.zeros(1)
    for end in (load.engagement.entry_deg, load.engagement.exit_deg):
        near = np.broadcast_to(np.reshape(NEAR_CUSP * end, (-1, 1)), (n, 1))
        values = powers(load, load.at(near * places, np.arange(n), 0), None, plain)
        total = total + matrix_product(values, weights) * np.abs(near[:, 0])
    return total


def powers(load: LoadFunctions, state: ContactState, signs: Array | None, plain: bool) -> Array:
    """The squares of the quantities and, with ``plain``, the quantities themselves after them."""
    case, at, shape, wanted = state
    here = signed_instant(load.kinds, case, at, signs).instant
    count = len(load.names)
    out = np.empty((2 * count if plain else count, *shape[::-1])).swapaxes(1, 2)
    for i, (name, quantity) in enumerate(zip(load.names, wanted, strict=True)):
        value = array(quantity(here).value.c[0])
        out[i] = value if name in SQUARED else value * value
        if plain:
            out[count + i] = plain_values(value, name)
    return out
