"""From a wish to the machines that grant it, each with what it costs, the best first."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine import registry
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.machine.wheels.classic import rollers_max
from geneva_cli.numerics.keeps import keeps
from geneva_cli.study.sweep.columns import known
from geneva_cli.study.sweep.constraints import Constraint, is_number
from geneva_cli.study.synthesis.best import best
from geneva_cli.study.synthesis.families import closed
from geneva_cli.study.synthesis.families.every import families
from geneva_cli.study.synthesis.families.family import natural_deg
from geneva_cli.study.synthesis.quantities import Asked, asked, bounded
from geneva_cli.study.synthesis.rows import Row, Way, rows
from geneva_cli.study.synthesis.wish import Wish

PEAK = "acceleration.max"


class Found(NamedTuple):
    """Rows in their order, and the names of the quantities beside those of every row."""

    rows: list[Row]
    names: tuple[str, ...] = ()


def search(wish: Wish) -> Found:
    """The machines that grant the wish in their order; no part has been turned yet.

    Raises GenevaError, saying what is within reach, where there is none.
    """
    reached: list[float] = []
    errors: list[str] = []
    every = [*families(wish, reached)]
    first = next((spec for f in every if (spec := _buildable(f.make, f.low))), None)
    wanted = asked(wish, first) if first else Asked(None, (), "")
    quick = [b for b in wanted.bounds if known([b.name])]
    if wish.acceleration_max is not None:
        quick.append(Constraint(PEAK, "<=", wish.acceleration_max))
    one_each = best(every, quick, nearest=wish.any_motion)
    specs = [_limited(wish, spec) for spec in dict.fromkeys(one_each)]
    found = [row for row in rows(wish, specs, errors) if _kept(wish, row)]
    if not found:
        raise GenevaError(_out_of_reach(wish, reached, errors))
    if wanted.pick:
        found = bounded(wanted, found)
    found.sort(key=lambda row: _rank(wish, wanted, row))
    return Found(found, wanted.names)


def _buildable(make: Callable[[float], Spec], x: float) -> Spec | None:
    try:
        spec = make(x)
        build(spec)
    except GenevaError:
        return None
    return spec


def _limited(wish: Wish, spec: Spec) -> Spec:
    """The spec with the limit that the wish is, beside its own."""
    if wish.acceleration_max is None:
        return spec
    return spec.but(limits=spec.limits.but(acceleration_max=wish.acceleration_max))


def _kept(wish: Wish, row: Row) -> bool:
    limit = wish.acceleration_max
    return limit is None or keeps(row.way.acceleration_max, "at most", limit)


def _rank(wish: Wish, wanted: Asked, row: Row) -> tuple[object, ...]:
    """The quantity asked for, then peaks; those that differ by rounding only are equal."""
    way = row.way
    first: list[object] = []
    if wanted.sort:
        value = row.asked[wanted.names.index(wanted.sort)]
        number = (
            float(value) * (-1.0 if wish.sort.startswith("-") else 1.0) if is_number(value) else 0.0
        )
        first = [
            not is_number(value),
            float(f"{number:.12g}"),
            "" if is_number(value) else str(value),
        ]
    peaks = (way.acceleration_max, way.jerk_max)
    return (
        *first,
        *[float(f"{x:.12g}") for x in peaks],
        way.rollers,
        way.z,
        way.gearing,
        way.drive,
    )


def synthesis(wish: Wish) -> list[tuple[Spec, Way]]:
    """The machines that grant the wish, the lowest peak acceleration first, no part turned.

    Raises GenevaError, saying what is within reach, where there is none.
    """
    return [(row.spec, row.way) for row in search(wish).rows]


def _out_of_reach(wish: Wish, reached: list[float], errors: list[str]) -> str:
    """What to say where no machine was found: what would be within reach."""
    m = wish.rollers or 1
    if wish.only_acceleration and reached:
        return (
            f"--acceleration-max {wish.acceleration_max:.7g}: out of reach; with these wheels it "
            f"must be above {min(reached):.6g}, and more slots come lower"
        )
    motion = wish.motion_for(m)
    if motion is None:
        most = max(
            rollers_max(natural_deg(registry.gearing(g)(z))) for z in wish.z for g in wish.gearings
        )
        return f"--rollers {m}: they jam on every wheel asked for; at most {most}"
    if motion.low * m >= 360.0:
        return (
            f"{wish.words}: {m} motions of {motion.low:.7g} deg leave no dwell in a turn of 360; "
            f"with {m} rollers a motion must be below {360.0 / m:.7g} deg (tau below 1)"
        )
    first = f"; the first says: {errors[0]}" if errors else ""
    return (
        f"{wish.words}: out of reach with {'one roller' if m == 1 else f'{m} rollers'}: curved "
        "slots turn an internal wheel at most half as fast as the crank"
        + (f", and no drive goes beyond A or eccentricity {closed.MOST}" if m == 1 else "")
        + f"; more slots or a longer motion would do{first}"
    )
