"""The loads as they are printed: the cycle row by row, and its summary."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.cycle import Cycle, Extremes
from geneva_cli.analysis.loads.instant import Instant
from geneva_cli.analysis.loads.means import Means, means_of, plain_of
from geneva_cli.analysis.loads.quantities import (
    PRESSED,
    PV,
    SIZES,
    SQUARED,
    STRESS,
    ends_of,
    known_quantities,
)
from geneva_cli.analysis.loads.sizing import WHEEL, sizing
from geneva_cli.analysis.motion import HELD, check_samples, derivatives, inputs, times_s
from geneva_cli.errors import Caution
from geneva_cli.table import Reading, Table, pieces, record_table, rows_table

if TYPE_CHECKING:
    from geneva_cli.machine.spec import Spec
    from geneva_cli.numerics.jet import Array, Number

# The columns of the summary from the most important one, for a narrow window.
FIRST = ("quantity", "max", "rms", "max_at_deg", "min", "mean")
PLACES = ("time_s", "input_deg", "wheel_deg")
UNLOADED = (
    "nothing resists the wheel, so no force is known: set inertia_kgm2 or torque_Nm in [load], or "
    "a [[mass]]"
)
PARALLEL = "parallel shafts; on a sphere the force moves along them, and pushes along them too"
ZERO = 1e-15  # share of a peak that is rounding
SHOWN = (
    "omega_rad_s",
    "alpha_rad_s2",
    "wheel_torque_Nm",
    "pin_force_N",
    STRESS,
    "sliding_m_s",
    "input_torque_Nm",
    "power_W",
    "wheel_bearing_N",
    "crank_bearing_N",
    PV,
    "guide_force_N",
    "wheel_near_bearing_N",
    "wheel_far_bearing_N",
    "crank_near_bearing_N",
    "crank_far_bearing_N",
)


def shares(cycle: Cycle) -> dict[str, tuple[str, float | None, str]]:
    """What is another quantity times a number: which, and what gives the number.

    A shaft carries its load outside two bearings, the overhang a from the nearer and s between
    them: the nearer bears (a + s)/s of it, the other a/s the other way.
    """
    shaft, flat = cycle.mechanism.spec.shaft, cycle.mechanism.spec.wheel.FLAT
    out: dict[str, tuple[str, float | None, str]] = {
        "power_W": ("input_torque_Nm", cycle.given.speed_rad_s, ""),
    }
    for name, a, s in (
        ("wheel", shaft.wheel_overhang_mm, shaft.wheel_span_mm),
        ("crank", shaft.crank_overhang_mm, shaft.crank_span_mm),
    ):
        needs = f"{name}_overhang_mm and {name}_span_mm in [shaft]" if flat else PARALLEL
        far = a / s if flat and a is not None and s is not None else None
        near = None if far is None else 1.0 + far
        out[f"{name}_near_bearing_N"] = (f"{name}_bearing_N", near, needs)
        out[f"{name}_far_bearing_N"] = (f"{name}_bearing_N", far, needs)
    return out


class Summary(NamedTuple):
    """Greatest and least over the motions, mean and root of the mean square over a period.

    None where nothing bounds the value, or what it needs is not known.
    """

    max: float | None = None
    max_at_deg: float | None = None
    min: float | None = None
    min_at_deg: float | None = None
    mean: float | None = None
    rms: float | None = None

    def times(self, share: float) -> Summary:
        """The summary of so many times the quantity, which is above 0."""
        every = self._asdict().items()
        sized = {k: v if v is None or k.endswith("_at_deg") else v * share for k, v in every}
        return Summary(**sized)


@lru_cache(maxsize=16)
def summaries(cycle: Cycle) -> Mapping[str, Summary]:
    """The summary of each quantity, by its name; None for each value that is not known."""
    names = known_quantities(cycle)
    found = ends_of(cycle, *names)

    means = means_of(cycle)
    out = {
        name: _summary(name, ends, means.get(name)) for name, ends in zip(names, found, strict=True)
    }
    for name, (source, share, _) in shares(cycle).items():
        if share is not None and source in out:
            out[name] = out[source].times(share)
    return {name: out.get(name, Summary()) for name in SHOWN}


def plain(cycle: Cycle, states: Instant[Array], name: str) -> Array:
    """A quantity of ``known``, or one that is its share, at states of the cycle."""
    source, share, _ = shares(cycle).get(name, (name, 1.0, ""))
    assert share is not None  # of what is known
    return plain_of(states, source) * share


def extremes(cycle: Cycle, names: Sequence[str]) -> list[Extremes]:
    """Greatest and least value of quantities that ``plain`` knows, infinite without a bound."""
    of = {name: shares(cycle).get(name, (name, 1.0, ""))[:2] for name in names}
    sources = list(dict.fromkeys(source for source, _ in of.values()))
    rooted = dict(zip(sources, ends_of(cycle, *sources), strict=True))
    for name, one in rooted.items():
        most, least = (float(x) for x in ends_told(name, one.max, one.min))
        rooted[name] = one._replace(max=most, min=least)
    return [
        rooted[source]._replace(max=rooted[source].max * share, min=rooted[source].min * share)
        for source, share in of.values()
        if share is not None
    ]


def _summary(name: str, ends: Extremes, means: Means | None) -> Summary:
    most, least = (float(x) for x in ends_told(name, ends.max, ends.min))
    mean, square = means or (None, None)
    return Summary(
        None if math.isinf(most) else most,
        ends.max_at_deg,
        None if math.isinf(least) else least,
        ends.min_at_deg,
        mean,
        None if square is None else math.sqrt(square),
    )


def ends_told(name: str, most: Number, least: Number) -> list[Array]:
    """Greatest and least of a quantity from those of what is looked for; of many designs too.

    Where the torque changes its sign, rounding may leave a size below 0. Of the two, 0 is told
    where one is rounding of the other.
    """
    found = [np.maximum(x, 0.0) if name in SIZES else np.asarray(x) for x in (most, least)]
    found = [np.sqrt(x) if name in SQUARED else x for x in found]
    level = ZERO * np.maximum(*[np.where(np.isfinite(x), np.abs(x), 0.0) for x in found])
    return [np.where(np.abs(x) > level, x, 0.0) for x in found]


def reversals_deg(cycle: Cycle) -> list[float]:
    """Input angles at which the wheel's torque changes sign: the roller changes walls."""
    out = []
    for (one, before), (two, after) in zip(cycle.stretches, cycle.stretches[1:], strict=False):
        if one is two and before.drives != after.drives:
            out.append(cycle.mechanism.shown_deg(one.mid_deg + before.end))
    return out


def loads_table(
    cycle: Cycle,
    life: Mapping[str, float | None],
    wheel_inertia_kgm2: float | None,
    warnings: Sequence[str],
    for_people: bool = False,
) -> Table:
    """The summary, with what must be bought, how long it lasts, and what else is to be said.

    ``life`` and the wheel's own inertia are known from its parts. For people the quantities that
    have a value are the rows of a table.
    """
    spec = cycle.mechanism.spec
    values: dict[str, object] = {"spec": spec.path, "title": spec.title}
    found = summaries(cycle)
    if for_people:
        rows = [(name, *one) for name, one in found.items() if one != Summary()]
        table = rows_table(("quantity", *Summary._fields), rows, mixed=True)
        values["loads"] = table.replaced(reading=Reading(FIRST))
    else:
        for name, one in found.items():
            values |= {f"{name}.{key}": value for key, value in one._asdict().items()}
    values["reversals_deg"] = tuple(reversals_deg(cycle)) if cycle.is_loaded else None
    bought, needed = sizing(cycle)
    bought[WHEEL] = wheel_inertia_kgm2
    if cycle.is_loaded and wheel_inertia_kgm2 is None:
        needed = [*needed, f"{WHEEL}: {_unweighed(spec)}"]
    for group, answers in (("sizing", bought), ("life", life)):
        values |= {f"{group}.{key}": value for key, value in answers.items()}
    values["warnings"] = (*warnings, *needed)
    return record_table(values)


def _unweighed(spec: Spec) -> str:
    """Why the wheel's own inertia is not known."""
    if not spec.is_flat:
        return "worked out of wheels that are drawn as flat outlines"
    if spec.size.face_width_mm is None and spec.size.wheel_thickness_mm is None:
        return "needs face_width_mm in [size]"
    return "no wheel can be cut, as `geneva profile` says"


def missing(cycle: Cycle) -> list[Caution]:
    """What keys would give the quantities that are None."""
    if not cycle.is_loaded:
        return [Caution("not-known", UNLOADED)]
    wide = cycle.given.hertz is not None
    out = [] if wide else [f"{name}: needs face_width_mm in [size]" for name in PRESSED]
    spec, guide = cycle.mechanism.spec, "guide_force_N"
    if spec.drive.LENGTH and spec.wheel.FLAT and guide not in known_quantities(cycle):
        needs = f"needs {spec.drive.LENGTH} in [drive]"
        out.append(f"{guide}, and the share of it in the crank's bearings: {needs}")
    unknown: dict[str, list[str]] = {}
    for name, (_, share, needs) in shares(cycle).items():
        if share is None:
            unknown.setdefault(needs, []).append(name)
    out += [f"{', '.join(names)}: needs {needs}" for needs, names in unknown.items()]
    return [Caution("not-known", text) for text in out]


def cycle_table(cycle: Cycle, samples: int) -> Table:
    """``samples`` rows, evenly in the input angle over one period from the first entry.

    A value without a bound, or not known, is None.
    """
    check_samples(samples)
    names = (*PLACES, *SHOWN)

    def rows(begin: int, end: int) -> list[Any]:
        return _rows(cycle, samples, begin, end)

    if samples > HELD:
        return Table(names, pieces(samples, len(names), rows, "object"))
    return Table(names, rows(0, samples))


def _rows(cycle: Cycle, samples: int, begin: int, end: int) -> list[Any]:
    input_deg = inputs(cycle.mechanism, samples, begin, end)
    states = cycle.states(input_deg)
    found = {name: plain_of(states, name) for name in known_quantities(cycle)}
    for name, (source, share, _) in shares(cycle).items():
        if share is not None and source in found:
            found[name] = found[source] * share
    none = [None] * len(input_deg)
    return [
        times_s(cycle.mechanism, input_deg),
        input_deg,
        np.degrees(derivatives(cycle.mechanism, input_deg, (0,))[0]),
        *[_cells(found[name]) if name in found else none for name in SHOWN],
    ]


def _cells(values: Array) -> Any:
    """A column of a table: None where there is no bound."""
    if np.isfinite(values).all():
        return values
    return [x if math.isfinite(x) else None for x in values.tolist()]
