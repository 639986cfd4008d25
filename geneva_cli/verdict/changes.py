"""Changes of one key of a spec: the values to try, from its present value on."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism

if TYPE_CHECKING:
    from geneva_cli.parts.sizes import Sizes

Value: TypeAlias = float | int | str | None  # None: the key is left out
# From the present value to the last one tried: values beyond a passing one may fail.
VALUE_STEPS = 24
SIZE_STEPS = 12  # steps of a size, whose trials take a whole turn

# The value of a key of [size], from the sizes that the machine's parts get.
_SIZES: dict[str, Callable[[Sizes], float]] = {
    "wheel_radius_mm": lambda s: s.rim,
    "lock_radius_mm": lambda s: s.lock,
    "relief_clearance_mm": lambda s: s.relief,
    "slot_bottom_clearance_mm": lambda s: s.slot_bottom,
    "wheel_outer_radius_mm": lambda s: s.outer,
    "roller_radius_mm": lambda s: s.roller,
    "wheel_bore_mm": lambda s: 2.0 * s.wheel_bore,
    "wheel_hub_mm": lambda s: 2.0 * s.wheel_hub,
    "crank_bore_mm": lambda s: 2.0 * s.crank_bore,
    "crank_hub_mm": lambda s: 2.0 * s.crank_hub,
    "pin_mm": lambda s: 2.0 * s.pin,
    "arm_bore_mm": lambda s: 2.0 * s.arm_bore,
    "wheel_thickness_mm": lambda s: s.wheel_thickness,
    "lock_thickness_mm": lambda s: s.lock_thickness,
    "arm_thickness_mm": lambda s: s.arm_thickness,
}


class Change(NamedTuple):
    """A key to change, and the values to try as a function of its present one, nearest first.

    If one number passes and the next does not, the adviser searches between the two.
    """

    table: str
    key: str
    values: Callable[[Any], list[Value]]


def value_now(mechanism: Mechanism, table: str, key: str) -> Value:
    """A key's present value; the default of a size that the spec leaves out; else None."""
    spec = mechanism.spec
    value: Value = spec.table(table).get(key)
    if value is not None or table != "size":
        # These keys take a word, and have no default.
        return value or ("" if key in ("ratio", "held_by") else value)
    allowed = spec.size.allowances._asdict()  # the process sets keys that are left out
    if key in allowed:
        return float(allowed[key])
    if key == "roller_radius_mm":
        return mechanism.roller_radius_mm
    if key == "center_distance_mm":
        return mechanism.center_distance_mm
    return size_now(mechanism, key)


def size_now(mechanism: Mechanism, key: str) -> float | None:
    """A size of the parts by its key; None for another key, and if no parts can be cut."""
    if key not in _SIZES:
        return None
    from geneva_cli.parts.assembly import assembly
    from geneva_cli.parts.machine_sizes import sizes

    try:
        return _SIZES[key](sizes(assembly(mechanism)))
    except GenevaError:
        return None


def scaled(table: str, key: str, factor: float) -> Change:
    """Steps from the present value to a multiple of it: in one ratio, or evenly to 0."""
    if factor > 0.0:
        factors = [factor ** (i / SIZE_STEPS) for i in range(1, SIZE_STEPS + 1)]
    else:
        factors = [1.0 - i / SIZE_STEPS for i in range(1, SIZE_STEPS + 1)]
    return Change(table, key, lambda now: [f * now for f in factors] if now else [])


def sized(table: str, key: str) -> tuple[Change, ...]:
    """Smaller values, larger values, and the default."""
    return scaled(table, key, 0.3), scaled(table, key, 3.0), left_out(table, key)


def fewer(table: str, key: str, least: int) -> Change:
    """Smaller values of a count, down to the least."""
    return Change(table, key, lambda now: list(range(now - 1, least - 1, -1)))


def replaced(table: str, key: str, *values: Value) -> Change:
    """Other values of a key whose value is not 0."""
    return Change(table, key, lambda now: list(values) if now else [])


def set_to(table: str, key: str, value: Value) -> Change:
    """One value, whatever the present one is."""
    return Change(table, key, lambda now: [value])


def left_out(table: str, key: str) -> Change:
    """The key's default."""
    return set_to(table, key, None)


def towards(table: str, key: str, end: float, steps: int = VALUE_STEPS) -> Change:
    """Even steps from a present number to an end."""

    def values(now: Any) -> list[Value]:
        if not isinstance(now, float):
            return []
        return [*(now + (end - now) * i / steps for i in range(1, steps)), end]

    return Change(table, key, values)


def increased(table: str, key: str, most: float) -> Change:
    """Even steps from the present number to one larger by ``most``, which may be negative."""
    return Change(
        table, key, lambda now: [now + most * i / VALUE_STEPS for i in range(1, VALUE_STEPS + 1)]
    )
