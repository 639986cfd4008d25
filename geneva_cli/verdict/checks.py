"""Does the design work? Each check with its value and its limit."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from geneva_cli.analysis.loads import loads
from geneva_cli.analysis.peaks import Peaks, worst
from geneva_cli.errors import GenevaError
from geneva_cli.machine.drives.drive import Gears
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.slot_and_motion import SolvedPath
from geneva_cli.numerics.keeps import keeps
from geneva_cli.spec.tables import Z_DRAWN
from geneva_cli.verdict.cautions import SHOWN_UNDERCUT, turns_back

if TYPE_CHECKING:
    from geneva_cli.parts.proof import Proof
    from geneva_cli.verdict.clearances import Clearance


# Steeper, a roller is wedged in its groove rather than led by it; as where it enters a slot.
GROOVE_MAX_DEG = 60.0


class Check(NamedTuple):
    """One check of one design.

    ``passes`` is None where it cannot be told; ``nearest`` then says why, and where a check fails
    it is the nearest change that would pass. ``at_deg`` is the input angle at which the value
    occurs, where it is of one place.
    """

    name: str
    value: float | None
    must_be: str
    limit: float | None
    passes: bool | None
    nearest: str = ""
    at_deg: float | None = None


def all_pass(rows: Iterable[Check]) -> bool:
    """Whether no check fails; what cannot be proved does not fail."""
    return all(check.passes is not False for check in rows)


Asked: TypeAlias = dict[str, Callable[[], Check]]


def checks(mechanism: Mechanism, proof: Proof | None = None, parts: bool = True) -> list[Check]:
    """Every check of one design: its motion, its parts unless left out, its own ``[limits]``."""
    motion = [ask() for ask in _motion(mechanism).values()]
    shown = list(_parts(mechanism, proof)) if parts else []
    return [*motion, *shown, *[ask() for ask in _limits(mechanism).values()]]


def each(mechanism: Mechanism, parts: bool = True) -> Iterator[Check]:
    """The same checks one by one as they are made, the dearest last."""
    for ask in (_motion(mechanism) | _limits(mechanism)).values():
        yield ask()
    if parts:
        yield from _parts(mechanism)


def one(mechanism: Mechanism, name: str) -> Check | None:
    """A single check, for no more work than it takes; None if the design has none of this name."""
    asked = _motion(mechanism) | _limits(mechanism)
    if name in asked:
        return asked[name]()
    return next((c for c in _parts(mechanism) if c.name == name), None)


def _held(
    name: str, value: float, must_be: str, limit: float, at_deg: float | None = None
) -> Check:
    return Check(name, value, must_be, limit, keeps(value, must_be, limit), at_deg=at_deg)


def _motion(mechanism: Mechanism) -> Asked:
    """The checks that every machine of its kind must pass, by name."""
    asked: Asked = {"dwell_deg": lambda: _held("dwell_deg", _dwell(mechanism), "at least", 0.0)}
    gears = mechanism.spec.drive.gears
    if gears:
        for gear in ("driver", "driven"):
            name = f"{gear}_gear_convexity"
            asked[name] = partial(_convexity, gears, name)
    engagement = mechanism.engagements[0]
    if mechanism.law is not None:
        asked["velocity_min"] = lambda: _forwards(mechanism)
    groove = engagement.groove
    if groove is not None:
        asked["groove_pressure_deg"] = lambda: _groove(mechanism, groove)
    if engagement.slot.curved:
        if mechanism.spec.limits.pressure_angle_max_deg is None:
            asked["pressure_angle_deg"] = partial(_pressure, mechanism, 90.0)
        asked["undercut_mm"] = lambda: _undercut(mechanism)
    return asked


def _dwell(mechanism: Mechanism) -> float:
    return min(mechanism.dwell_deg(i) for i in range(len(mechanism.engagements)))


def _convexity(gears: Gears, name: str) -> Check:
    from geneva_cli.parts.gear_curves import convexity

    least = convexity(gears)._asdict()[name.removesuffix("_gear_convexity")]
    return _held(name, least, "above", 0.0)


def _forwards(mechanism: Mechanism) -> Check:
    value, at_deg = turns_back(mechanism) or (0.0, None)
    return _held("velocity_min", value, "at least", 0.0, at_deg)


def _groove(mechanism: Mechanism, groove: SolvedPath) -> Check:
    """The roller must be able to follow its groove, in the dwell too."""
    from geneva_cli.parts.groove import greatest_pressure

    value, at_deg = greatest_pressure(groove)
    given = mechanism.spec.limits.pressure_angle_max_deg
    limit = GROOVE_MAX_DEG if given is None else given
    return _held("groove_pressure_deg", value, "at most", limit, mechanism.shown_deg(at_deg))


def _undercut(mechanism: Mechanism) -> Check:
    from geneva_cli.analysis.undercut import undercut

    found = undercut(mechanism)
    depth, at_deg = (found.depth_mm, found.at_deg) if found else (0.0, None)
    return _held("undercut_mm", depth, "at most", SHOWN_UNDERCUT, at_deg)


def _parts(mechanism: Mechanism, proof: Proof | None = None) -> Iterator[Check]:
    """Walls, shafts and the full turn, where the machine has flat parts."""
    if not mechanism.spec.is_flat:
        yield Check("parts", None, "proved", None, None, f"not proved: {_unturned(mechanism)}")
        return
    from geneva_cli.parts.proof import Proof
    from geneva_cli.parts.turn.gaps import NotProved
    from geneva_cli.verdict.clearances import clearances, turning

    proof = proof or Proof(mechanism)
    try:
        standing = list(clearances(proof.found))
    except GenevaError as error:
        yield Check("parts", 0.0, "at least", 1.0, False, str(error))
        return
    yield from map(_cleared, standing)
    try:
        turn = proof.turn
    except NotProved as error:
        yield Check("full_turn", 0.0, "at least", 1.0, False, str(error))
        return
    held = mechanism.spec.wheel.held_by is not None or turn.holds
    yield Check("dwell_hold", float(held), "at least", 1.0, held)
    yield from map(_cleared, turning(proof.found, turn))


def _cleared(c: Clearance) -> Check:
    return Check(c.name, c.value, c.must_be, c.limit, c.passes, at_deg=c.at_deg)


def _unturned(mechanism: Mechanism) -> str:
    """Why no full turn is made."""
    spec = mechanism.spec
    if not spec.wheel.FLAT:
        return "the parts of a spherical wheel are not drawn or turned against each other"
    if spec.wheel.z > Z_DRAWN:
        return f"wheels of more than {Z_DRAWN} slots are not drawn"
    return f'the parts of kind = "{spec.drive.NAME}" are not drawn or turned against each other'


def _limits(mechanism: Mechanism) -> Asked:
    """The spec's own limits, by the check's name."""
    limits = {k: v for k, v in mechanism.spec.limits.as_dict().items() if v is not None}
    asked: Asked = {}
    for key, limit in limits.items():
        if key in _INVARIANTS:
            asked[key] = partial(_invariant, mechanism, key, limit)
        elif key == "pressure_angle_max_deg":
            asked["pressure_angle_deg"] = partial(_pressure, mechanism, limit)
        else:
            asked[key] = partial(_load, mechanism, key, _LOADS[key], limit)
    return asked


_INVARIANTS: dict[str, Callable[[Peaks], float]] = {
    "velocity_max": lambda p: p.velocity.max,
    "acceleration_max": lambda p: p.acceleration.max,
    "acceleration_entry_max": lambda p: p.ends.acceleration_entry,
    "jerk_max": lambda p: p.jerk.max,
}
_LOADS = {
    "pin_force_max_N": "pin_force_N",
    "input_torque_max_Nm": "input_torque_Nm",
    "contact_stress_max_MPa": "contact_stress_MPa",
}


def _invariant(mechanism: Mechanism, key: str, limit: float) -> Check:
    return _held(key, _INVARIANTS[key](worst(mechanism)), "at most", limit)


def _pressure(mechanism: Mechanism, limit: float) -> Check:
    found = loads.greatest(mechanism, "pressure_deg")
    # At 90 degrees nothing turns the wheel, whatever the limit.
    passes = keeps(found.max, "at most", limit) and found.max < 90.0
    return Check("pressure_angle_deg", found.max, "at most", limit, passes, at_deg=found.at_deg)


def _load(mechanism: Mechanism, key: str, quantity: str, limit: float) -> Check:
    found = loads.greatest(mechanism, quantity)
    return _held(key, found.max, "at most", limit, found.at_deg)
