"""From a wish to the machines that grant it, each with what it costs, the best first."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine import registry
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.machine.wheels.classic import rollers_max
from geneva_cli.numerics.keeps import keeps
from geneva_cli.study.fields import Pick, pick
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.sweep.columns import known
from geneva_cli.study.sweep.constraints import Constraint, is_number
from geneva_cli.study.synthesis import closed
from geneva_cli.study.synthesis.below import below
from geneva_cli.study.synthesis.best import best
from geneva_cli.study.synthesis.built import Built, built
from geneva_cli.study.synthesis.families import families, natural_deg
from geneva_cli.study.synthesis.parts import MAYBE, YES
from geneva_cli.study.synthesis.rows import Row, Way, rows
from geneva_cli.study.synthesis.target import Wish
from geneva_cli.study.synthesis.together import numbers
from geneva_cli.table import Table, rows_table

NAMES = ("no", *Way._fields)
USUAL = "acceleration.max"  # what rows are sorted by where nothing is said
TURNED = 20  # rows whose parts are turned where nothing is said


class Asked(NamedTuple):
    """The quantities that a wish names, whole, and its bounds on them by these names."""

    pick: Pick | None
    bounds: tuple[Constraint, ...]
    sort: str

    @property
    def names(self) -> tuple[str, ...]:
        """The columns beside those of every row."""
        return self.pick.names if self.pick else ()


def asked(wish: Wish, spec: Spec) -> Asked:
    """Which quantities a wish names; ``spec`` is a design that has them.

    Raises GenevaError, with the nearest name, for one that there is not.
    """
    sort = wish.sort.lstrip("-")
    wanted = [b.name for b in wish.bounds]
    if not (sort or wanted):
        return Asked(None, (), "")
    machine = build(spec)
    of_sort = pick([sort], machine, "--sort").names if sort else ()
    of_bounds = pick(wanted, machine, "--subject-to").asked if wanted else ()
    found = pick([*of_sort, *of_bounds], machine)
    bounds = tuple(b._replace(name=n) for b, n in zip(wish.bounds, of_bounds, strict=True))
    return Asked(found, bounds, of_sort[0] if of_sort else "")


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
    every = [*(below(wish, reached) if wish.only_acceleration else families(wish))]
    first = next((spec for f in every if (spec := _buildable(f.make, f.low))), None)
    wanted = asked(wish, first) if first else Asked(None, (), "")
    quick = [b for b in wanted.bounds if known([b.name])]
    specs = [_limited(wish, spec) for spec in dict.fromkeys(best(every, quick))]
    found = [row for row in rows(wish, specs, errors) if _kept(wish, row)]
    if not found:
        raise GenevaError(_out_of_reach(wish, reached, errors))
    if wanted.pick:
        found = _chosen(wanted, found)
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


def _chosen(wanted: Asked, found: Sequence[Row]) -> list[Row]:
    """The rows with the quantities that are asked for, of those that keep the bounds."""
    assert wanted.pick
    names = wanted.names
    values: Iterable[Sequence[float | int | str | bool | None] | None]
    if known(names):
        values = numbers([row.spec for row in found], names)
    else:
        work = partial(_values, wanted.pick)
        values = mapped(work, [row.spec for row in found], cores(), "machines")
    out = []
    nearest: dict[str, list[float]] = {b.name: [] for b in wanted.bounds}
    for row, cells in zip(found, values, strict=True):
        if cells is None:
            continue
        by_name = dict(zip(names, cells, strict=True))
        for name, seen in nearest.items():
            cell = by_name[name]
            seen += [float(cell)] if is_number(cell) else []
        if all(b.kept(by_name[b.name]) for b in wanted.bounds):
            out.append(row._replace(asked=tuple(cells)))
    if not out:
        raise GenevaError(f"--subject-to: {_how_near(wanted, nearest, len(found))}")
    return out


def _values(of: Pick, spec: Spec) -> list[float | int | str | bool | None] | None:
    try:
        return of.of(build(spec))
    except GenevaError:  # parts that cannot be drawn have none of their quantities
        return None


def _how_near(wanted: Asked, nearest: dict[str, list[float]], count: int) -> str:
    said = []
    for b in wanted.bounds:
        seen = nearest[b.name]
        near = (max if b.sign == ">=" else min)(seen) if seen else None
        said.append(f"{b}" + (f" (nearest {near:.6g})" if near is not None else " (known of none)"))
    return f"none of {count} machines that grant the rest keeps {' and '.join(said)}"


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


class Numbered(NamedTuple):
    """A row and its number, which it keeps where others are hidden."""

    no: int
    row: Row


def turned(
    wish: Wish, found: Found, count: int = TURNED, buildable: bool = False
) -> Iterator[Numbered]:
    """The rows, the first ``count`` of them turned; ``buildable``: the first so many that pass.

    A row that was turned says yes, with sizes that pass, or no; others maybe, or no where that is
    plain without.
    """
    every = [Numbered(i, row) for i, row in enumerate(found.rows, 1)]
    among = every if buildable else every[:count]
    some = [one.row for one in among if one.row.way.parts == MAYBE]
    work = partial(built, fixed=fixed(wish))
    shown = mapped(work, [row.spec for row in some], min(len(some), cores()), "machines")
    passed = 0
    for one in every:
        maybe = one.row.way.parts == MAYBE
        if buildable and (passed >= count or not maybe):
            continue
        row = told(one.row, next(shown)) if maybe and (buildable or one.no <= count) else one.row
        passed += row.way.parts == YES
        if not buildable or row.way.parts == YES:
            yield Numbered(one.no, row)


def fixed(wish: Wish) -> frozenset[str]:
    """The sizes that the wish's frame gives, and that stay as they are."""
    given = wish.frame.size.as_dict() if wish.frame else {}
    return frozenset(key for key, value in given.items() if value is not None)


def told(row: Row, result: Built) -> Row:
    """A row whose parts were turned."""
    said = f"no: {result.trouble}" if result.trouble else YES
    return row._replace(spec=result.spec, way=row.way._replace(parts=said))


def synthesis_table(
    wish: Wish, count: int = TURNED, buildable: bool = False, found: Found | None = None
) -> Table:
    """One row a machine, numbered from 1, as ``turned`` gives them."""
    found = found or search(wish)
    rows = [(one.no, *one.row.way, *one.row.asked) for one in turned(wish, found, count, buildable)]
    what = "1 machine" if len(rows) == 1 else f"{len(rows)} machines"
    by = wish.sort or "lowest peak acceleration"
    title = f"{what}, {by} first" if len(rows) > 1 else what
    if buildable:
        title = (
            f"{title}, of {len(found.rows)}"
            if len(rows) != 1
            else f"1 machine of {len(found.rows)}"
        )
    return rows_table((*NAMES, *found.names), rows, f"{wish.words}: {title}.")


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
