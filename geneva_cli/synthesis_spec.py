"""A machine found by synthesis as a spec to go on with: the wish, the machine and its costs."""

from __future__ import annotations

from typing import Any

from geneva_cli.cautions import SHOWN_UNDERCUT
from geneva_cli.errors import GenevaError, cut
from geneva_cli.keys import Limits, Spec
from geneva_cli.mechanism import build
from geneva_cli.spec import TABLES, fields, kind_keys
from geneva_cli.synthesis import Way
from geneva_cli.synthesis_wish import Wish

RADII = (5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)  # % of L
COSTS = ("velocity_max", "acceleration_max", "acceleration_entry", "jerk_max", "power_max")


def chosen(wish: Wish, ways: list[tuple[Spec, Way]], number: int) -> tuple[Spec, str]:
    """Row ``number`` of what ``synthesis(wish)`` found: the spec, and its text with comments.

    Raises GenevaError where there is no such row, or no roller is small enough for its slot.
    """
    if not 1 <= number <= len(ways):
        raise GenevaError(f"--write {cut(number)}: the table has rows 1 to {len(ways)}")
    spec, way = ways[number - 1]
    spec = _sized(spec)
    if wish.acceleration_max is not None:
        spec = spec._replace(limits=Limits(acceleration_max=wish.acceleration_max))
    return spec, "\n".join([*_heading(wish, number, way), *_tables(spec)]) + "\n"


def _sized(spec: Spec) -> Spec:
    """With the largest usual roller that does not undercut its slot."""
    if spec.motion.law is None:
        return spec
    from geneva_cli.undercut import undercut

    machine = build(spec)
    for percent in RADII:
        radius = 0.01 * percent * spec.size.center_distance_mm
        sized = spec._replace(size=spec.size._replace(roller_radius_mm=radius))
        found = undercut(machine._replace(spec=sized))
        if found is None or found.depth_mm <= SHOWN_UNDERCUT:
            return spec if percent == RADII[0] else sized
    raise GenevaError(
        f'law = "{spec.motion.law}" in so short a motion bends the slot so sharply that no roller '
        "fits; take another row"
    )


def _heading(wish: Wish, number: int, way: Way) -> list[str]:
    z = f"{way.z} slots, {way.gearing}"
    slots = f"curved slots ({way.law})" if way.law else way.drive
    lines = [
        f'title = "{wish.words}: {z}, {slots}"',
        "",
        f"# Row {number} of `geneva synth`. It moves for {way.motion_deg:.7g} deg of the input and",
        f"# rests for {way.dwell_deg:.7g}: tau = {way.tau:.7g}, k = {way.k:.7g}.",
        "# Invariants: " + ", ".join(f"{n} {getattr(way, n):.7g}" for n in COSTS[:3]) + ",",
        "# " + ", ".join(f"{n} {getattr(way, n):.7g}" for n in COSTS[3:]) + ".",
    ]
    if way.law:
        lines.append(
            "# The slots are solved for: `geneva check` and `report` say what they can do."
        )
    return lines


def _tables(spec: Spec) -> list[str]:
    """The tables, with the keys that are not at their defaults, and a few that one will change."""
    shown = {("wheel", "gearing"), ("drive", "kind"), ("drive", "n_rpm"), ("drive", "rollers")}
    lines = []
    for name, table in TABLES.items():
        values: dict[str, Any] = getattr(spec, name)._asdict()
        keys = fields(table)
        if name == "drive":
            keys += fields(kind_keys(spec.drive.kind))
            values |= spec.kind._asdict() if spec.kind else {}
        block = [
            (f"{field.key} = {_quoted(values[attribute])}", field.meaning)
            for field in keys
            for attribute in [field.key if field.key in values else f"{field.key}_"]
            if values[attribute] != field.default or (name, field.key) in shown
        ]
        if block:
            width = max(len(setting) for setting, _ in block)
            lines += ["", f"[{name}]", *[f"{s.ljust(width)}  # {note}" for s, note in block]]
    return lines


def _quoted(value: Any) -> str:
    return f'"{value}"' if isinstance(value, str) else repr(value)
