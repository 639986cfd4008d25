"""The sizes of the parts, in millimetres: as the spec gives them, or defaults.

The rim is where the roller enters: on a smaller wheel the roller would lose its slot, on a larger
one it would touch the rim. The locking disc reaches past the rim and leaves a horn beside the slot.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.keyways import reach
from geneva_cli.parts.reliefs import arc_room, has_arcs
from geneva_cli.parts.roller_paths import RollerPaths, mouth, roller_paths
from geneva_cli.spec.tables import Size

PLAIN = 0.4  # of a hub's diameter: the radius of a bore in it
KEYED = 0.5 / 1.6  # the same of a bore with a keyway, which is up to 0.39 of the radius deep
BESIDE_HUB = 0.6  # of the room: the widest bore whose default hub, of 1.5 bores, has room

# what stands on the axis of a wheel, and has nothing to stand on where that is a ring
ON_AXIS = (
    "wheel_bore_mm",
    "wheel_hub_mm",
    "wheel_hub_length_mm",
    "wheel_shaft_low_mm",
    "wheel_shaft_high_mm",
)


class Sizes(NamedTuple):
    """Lengths and radii, mm; bores and hubs are radii too. 0 where there is none."""

    roller: float
    half_width: float  # of the slot: roller and clearance
    rim: float  # of the wheel, inside: of its opening
    outer: float  # of an internal wheel; 0 outside
    slot_bottom: float  # clearance between the deepest roller and a straight slot's end
    slot_end: float  # distance of the slot's bottom from the wheel's axis
    arm: float  # least distance of a roller's path from the crank's axis
    lock: float  # locking disc
    recess: float  # in the wheel: lock and clearance
    relief: float  # clearance between wheel and relief
    wall_min: float
    wheel_bore: float
    wheel_reach: float  # of the bore with its keyway, from the axis
    wheel_hub: float
    crank_bore: float
    crank_reach: float
    crank_hub: float
    pin: float
    wheel_thickness: float  # along the axis, of the rollers too
    lock_thickness: float
    arm_thickness: float

    @property
    def horn(self) -> float:
        """Thickness of the horn between slot and recess, thinnest at the mouth."""
        return self.arm - self.half_width - self.recess


def sized(mechanism: Mechanism) -> tuple[Assembly, Sizes] | None:
    """A machine's assembly and its parts' sizes; None where no flat parts can be cut."""
    if not mechanism.spec.is_flat:
        return None
    try:
        where = assembly(mechanism)
        return where, sizes(where)
    except GenevaError:
        return None  # as the check of the parts says


def sizes(assembly: Assembly, known: RollerPaths | None = None) -> Sizes:
    """The sizes of a machine's parts; ``known`` are its roller paths, if they are at hand.

    Raises GenevaError, naming the key, where a size leaves no wheel or no lock.
    """
    spec, L = assembly.mechanism.spec, assembly.L
    path, kinds = known or roller_paths(assembly), assembly.kinds
    given, r = spec.size, assembly.mechanism.roller_radius_mm
    allowed = given.allowances
    w = r + allowed.slot_clearance_mm
    outside = assembly.sign > 0.0
    rim = _or(given.wheel_radius_mm, max(mouth(assembly, s, r) for s in kinds))
    bottom = _or(given.slot_bottom_clearance_mm, max(allowed.slot_clearance_mm, r / 20.0))
    gaps = [0.0 if s.slot.curved else bottom for s in kinds]
    ends = (
        assembly.sign * _bottom(deepest, L * s.through.slot.offset, assembly.sign * gap)
        for s, deepest, gap in zip(kinds, path.ends, gaps, strict=True)
    )
    end = (min(ends) - w) * assembly.sign
    arm = path.arm
    lock = _lock(assembly, arm, w, rim)
    depth = abs(L - rim)
    relief = _or(given.relief_clearance_mm, min(L / 200.0, depth / 4.0))
    room = (lock or rim) / arm * (L - math.sqrt(max(rim * rim - r * r, 0.0))) if outside else 0.0
    if any(s.apart for s in kinds):  # gears widen the relief
        room = min(room, arc_room(assembly, lock)) if has_arcs(assembly, lock) else math.inf
    bore = (
        0.0
        if not spec.drive.LOCKS
        else _crank_bore(assembly.given.spec, min(room, depth - relief), L)
    )
    wall = wall_min(given, L)
    wheel_bore = _or(_half(given.wheel_bore_mm), _bore(given, end, wall, L))
    wheel_bore = wheel_bore if outside or given.wheel_bore_mm else 0.0
    wheel_reach = _reach(given.wheel_keyway, wheel_bore)
    crank_reach = _reach(given.crank_keyway, bore)
    wheel_hub = _around(wheel_reach, wheel_bore, wall, min(1.6 * wheel_bore, 0.75 * end))
    thick = thicknesses(given, L)
    out = Sizes(
        roller=r,
        half_width=w,
        rim=rim,
        outer=0.0 if outside else _or(given.wheel_outer_radius_mm, end + max(r, L / 20.0)),
        slot_bottom=bottom,
        slot_end=end,
        arm=arm,
        lock=lock,
        recess=lock + allowed.lock_clearance_mm if lock else 0.0,
        relief=relief,
        wall_min=wall,
        wheel_bore=wheel_bore,
        wheel_reach=wheel_reach,
        wheel_hub=_or(_half(given.wheel_hub_mm), wheel_hub),
        crank_bore=bore,
        crank_reach=crank_reach,
        crank_hub=_or(_half(given.crank_hub_mm), _around(crank_reach, bore, wall, 1.5 * bore)),
        pin=pin_radius(given, r),
        wheel_thickness=thick.wheel,
        lock_thickness=thick.lock,
        arm_thickness=thick.arm,
    )
    _refuse(assembly, out)
    _refuse_hubs(given, out)
    return out


class Thicknesses(NamedTuple):
    """The parts' thicknesses along the axis, mm."""

    wheel: float
    lock: float
    arm: float
    link: float


def thicknesses(size: Size, L: float) -> Thicknesses:
    """The thicknesses of a spec; by default the wheel's for all."""
    wheel = _or(size.wheel_thickness_mm, _or(size.face_width_mm, L / 10.0))
    arm = _or(size.arm_thickness_mm, wheel)
    lock = _or(size.lock_thickness_mm, wheel + size.pin_gap_mm)
    return Thicknesses(wheel, lock, arm, _or(size.link_thickness_mm, arm))


def pin_radius(size: Size, r: float) -> float:
    """The radius of a roller's pin, 0 for none."""
    return _or(_half(size.pin_mm), r / 2.0)


def wall_min(size: Size, L: float) -> float:
    """The least wall that ``check`` lets pass, mm."""
    return _or(size.wall_min_mm, L / 200.0)


def _or(given: float | None, default: float) -> float:
    return default if given is None else given


def _half(diameter: float | None) -> float | None:
    return None if diameter is None else 0.5 * diameter


def _bore(given: Size, end: float, wall: float, L: float) -> float:
    """The wheel's default bore: it leaves a wall to the slots' ends, within a given hub."""
    room = _within(given.wheel_hub_mm, given.wheel_keyway)
    return even(min(L / 12.0, 0.4 * end, end - wall, room))


def _crank_bore(spec: Spec, room: float, L: float) -> float:
    """The crank's bore: the arm's, which has the same shaft, or by default half the room.

    It is 0 where the room inside the relief is too small; then the shaft ends in the arm.
    """
    given = spec.size
    if given.crank_bore_mm is not None:
        return 0.5 * given.crank_bore_mm
    own = given.arm_bore_mm if spec.drive.ONE_ARM else None
    if own is None:
        own = spec.shaft.crank_diameter_mm
    if own is not None:
        return 0.5 * own if 0.5 * own <= BESIDE_HUB * room else 0.0
    within = _within(given.crank_hub_mm, given.crank_keyway)
    return even(min(0.45 * room, within)) if 0.45 * room >= L / 40.0 else 0.0


def _within(hub_mm: float | None, keyway: str | None) -> float:
    """The largest default bore within a hub of a given diameter, if there is one."""
    return (KEYED if keyway else PLAIN) * hub_mm if hub_mm else math.inf


def _reach(standard: str | None, bore: float) -> float:
    """How far a bore goes with its keyway; without it where the standard has none so large."""
    try:
        return reach(standard, bore)
    except GenevaError:  # which the part that is cut says
        return bore


def _around(bored: float, bore: float, wall: float, usual: float) -> float:
    """The default hub round a bore: as wide as usual, or with a wall round its keyway."""
    return max(even(usual), bored + wall) if bored > bore else even(usual)


def even(radius: float) -> float:
    """A radius rounded down to a diameter of two digits; 0 for no radius."""
    if radius <= 0.0:
        return 0.0
    step = 10.0 ** (math.floor(math.log10(2.0 * radius)) - 1)
    return 0.5 * step * math.floor(2.0 * radius / step * (1.0 + 1e-12))


def _lock(assembly: Assembly, arm: float, w: float, rim: float) -> float:
    """The locking disc's radius: a horn as thick as the roller's radius, or a fifth of the room.

    0 for no disc; linkages have none.
    """
    spec, size = assembly.mechanism.spec, assembly.mechanism.spec.size
    if size.lock_radius_mm == 0.0 or not spec.drive.LOCKS:
        return 0.0
    room = arm - w - size.allowances.lock_clearance_mm
    least, r = max(assembly.L - rim, 0.0), assembly.mechanism.roller_radius_mm
    if room <= least:
        raise GenevaError(
            f"no room for a locking disc: it would have to reach {least:.4g} mm, to the rim, and "
            f"arm less roller and clearances is {room:.4g} mm; "
            + (f"a roller below {r + room - least:.4g} mm, or " if r + room > least else "")
            + "lock_radius_mm = 0, where the wheel is held in another way",
            ("size", "lock_radius_mm"),
        )
    if size.lock_radius_mm is None:
        return lock_between(least, room, r)
    require_lock_between(size.lock_radius_mm, least, room)
    return size.lock_radius_mm


def lock_between(least: float, room: float, roller: float) -> float:
    """The reach of a lock that is not given: into the rim, and a horn's breadth off the slot."""
    return max(room - min(roller, room / 5.0), 0.5 * (room + least))


def require_lock_between(lock_radius_mm: float, least: float, room: float) -> None:
    """Raise GenevaError where a lock that is given does not reach the rim, or leaves no horn."""
    if not least < lock_radius_mm < room:
        raise GenevaError(
            f"lock_radius_mm = {lock_radius_mm:g}: it must be above {least:.6g}, to reach "
            f"into the rim, and below {room:.6g}, to leave a horn beside the slot; or 0 for none",
            ("size", "lock_radius_mm"),
        )


def _bottom(deepest: float, offset: float, gap: float) -> float:
    """Distance from the wheel's axis of the centre of a slot's round end, mm.

    The gap between it and the deepest roller is along the slot, which may miss the wheel's axis;
    below 0 where it is beyond that.
    """
    along = math.sqrt(max(deepest * deepest - offset * offset, 0.0)) - gap
    return math.copysign(math.hypot(along, offset), along)


def _refuse(assembly: Assembly, found: Sizes) -> None:
    outside = assembly.sign > 0.0
    if found.lock and not abs(assembly.L - found.rim) < found.recess:
        raise GenevaError(
            f"wheel_radius_mm = {found.rim:g}: the rim lies beyond the locking disc, which opens "
            f"it only where it is below {assembly.L + found.recess:.6g}",
            ("size", "wheel_radius_mm"),
        )
    if outside and found.slot_end <= 0.0:
        raise GenevaError(
            "the slots meet in the wheel's centre: roller_radius_mm, slot_clearance_mm and "
            f"slot_bottom_clearance_mm must together be less by more than {-found.slot_end:.4g} mm",
            ("size", "roller_radius_mm"),
        )
    if outside and found.wheel_bore >= found.slot_end:
        raise GenevaError(
            f"wheel_bore_mm = {2.0 * found.wheel_bore:g}: the slots reach down to "
            f"{found.slot_end:.6g} mm; it must be below {2.0 * found.slot_end:.6g}",
            ("size", "wheel_bore_mm"),
        )
    own = assembly.mechanism.spec.size.arm_bore_mm
    one_arm = assembly.given.spec.drive.ONE_ARM
    if (
        one_arm
        and own
        and found.crank_bore
        and abs(0.5 * own - found.crank_bore) > SAME_LENGTH * assembly.L
    ):
        raise GenevaError(
            f"arm_bore_mm = {own:g}: the same shaft goes through the locking disc, whose "
            f"crank_bore_mm is {2.0 * found.crank_bore:g}; they must be equal, or crank_bore_mm 0, "
            "where the shaft ends in the arm",
            ("size", "arm_bore_mm"),
        )
    if found.lock and found.crank_bore >= found.lock:
        raise GenevaError(
            f"crank_bore_mm = {2.0 * found.crank_bore:g}: it must be below the locking disc's "
            f"{2.0 * found.lock:.6g}",
            ("size", "crank_bore_mm"),
        )
    if found.pin >= found.roller:
        raise GenevaError(
            f"pin_mm = {2.0 * found.pin:g}: it must be below the roller's {2.0 * found.roller:g}",
            ("size", "pin_mm"),
        )
    if not outside and found.outer <= max(found.slot_end, assembly.L + found.recess):
        raise GenevaError(
            f"wheel_outer_radius_mm = {found.outer:g}: the slots reach {found.slot_end:.6g} mm; it "
            "must be larger",
            ("size", "wheel_outer_radius_mm"),
        )
    if outside and assembly.mechanism.spec.size.wheel_outer_radius_mm is not None:
        raise GenevaError(
            "wheel_outer_radius_mm is for internal wheels; here wheel_radius_mm is the outside",
            ("size", "wheel_outer_radius_mm"),
        )


def _refuse_hubs(given: Size, found: Sizes) -> None:
    """Raise GenevaError, naming the key, for what stands on no wheel, and for a hub cut through."""
    on_axis = [key for key in ON_AXIS if vars(given)[key]]
    if found.outer and on_axis:
        raise GenevaError(
            f"{on_axis[0]}: an internal wheel is open in the middle; remove it",
            ("size", on_axis[0]),
        )
    hubs = {"wheel": (found.wheel_hub, found.wheel_reach, found.wheel_bore)}
    hubs["crank"] = found.crank_hub, found.crank_reach, found.crank_bore
    for part, (hub, bored, bore) in hubs.items():
        if bore < hub <= bored:
            raise GenevaError(
                f"{part}_hub_mm = {2.0 * hub:g}: the hub must be above {2.0 * bored:.6g}, its bore "
                f"and keyway; a smaller {part}_bore_mm leaves more of it",
                ("size", f"{part}_hub_mm"),
            )
