"""Names of a design's quantities, and the resolution of a typed name."""

from collections.abc import Iterable, Iterator

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.verdict.quantities.groups import GROUP_OF
from geneva_cli.verdict.quantities.quantity_rows import CHECKS, INPUTS

# Quantities whose values are words, which have no order.
WORDS = {
    *("wheel.gearing", "drive.kind", "drive.before.kind", "motion.law", "checks.failed"),
    *("inputs.wheel.held_by", "inputs.size.process", "inputs.size.pin_held"),
    *("inputs.load.friction_at", "sizes.clearances_from"),
    *("vibration.none", "parts.none", "parts.relief"),
}


def in_batch(names: Iterable[str]) -> bool:
    """Return True if all these quantities can be computed for a batch of designs.

    >>> in_batch(["timing.dwell_s", "jerk.max"]), in_batch(["sizes.ratio"])
    (True, False)
    """
    return all(name in GROUP_OF and name in GROUP_OF[name].batched for name in names)


def whole_name(name: str, option: str = "--pick") -> str:
    """The whole name of a quantity, from any name that means it; ``option`` is for messages.

    A whole name may be written with underscores, as a column of ``table`` and ``synth``, or
    shortened to its end. A key of the spec is named whole, and a check gives way to a quantity of
    its name. Raises GenevaError for a name that is none, with the nearest one, and for one that
    may be several, with these.

    >>> whole_name("acceleration_max"), whole_name("dwell_s")
    ('acceleration.max', 'timing.dwell_s')
    """
    if name in GROUP_OF:
        return name
    for meanings in _readings(name):
        if len(meanings) > 1:
            more = len(meanings) - 5  # a message has at most five candidates
            those = [*meanings[:5], *([f"{more} more"] if more > 0 else [])]
            raise GenevaError(f"{option} {cut(name)}: it may be {' or '.join(those)}; say which")
        if meanings:
            return meanings[0]
    text = f"{option} {cut(name)}: no quantity of a design{_nearest(name)}; `geneva compare` shows "
    text += "most of them, and a check is checks.NAME"
    raise GenevaError(text)


def _readings(typed: str) -> Iterator[list[str]]:
    """The possible meanings of a name that is not a whole name, the nearest first."""
    # columns and keys that no whole name or end spells, or the ends of two do
    synonyms = {
        "acceleration_max_deg": "acceleration.at_deg",
        "drive": "drive.kind",
        "kind": "drive.kind",
        "n_rpm": "inputs.drive.n_rpm",
    }
    yield [synonyms[typed]] if typed in synonyms else []
    others = [name for name in GROUP_OF if not name.startswith(INPUTS)]
    quantities = [name for name in others if not name.startswith(CHECKS)]
    yield [name for name in quantities if name.replace(".", "_") == typed]
    for names in (quantities, others):
        yield [name for name in names if name.endswith(f".{typed}")]
        yield [name for name in names if typed in (e.replace(".", "_") for e in _ends(name))]


def _ends(name: str) -> list[str]:
    """The name without its first parts, the longest first.

    >>> _ends("loads.pin_force_N.max")
    ['pin_force_N.max', 'max']
    """
    parts = name.split(".")
    return [".".join(parts[i:]) for i in range(1, len(parts))]


def _nearest(typed: str) -> str:
    """A question `` (did you mean "..."?)`` with the nearest whole name or end of one."""
    # a whole name behind an extra word, as peaks.velocity.max, or a key of the spec
    whole = [name for name in GROUP_OF if typed.endswith(f".{name}")]
    whole += [name for name in GROUP_OF if name.startswith(INPUTS) and name.endswith(f".{typed}")]
    own = [name for name in GROUP_OF if not name.startswith(INPUTS)]
    own.sort(key=lambda name: name.startswith(CHECKS))  # a check gives way to a quantity
    ends = [end for name in own for end in (name, *_ends(name))]
    begun = [end for end in ends if end.startswith(typed)] if len(typed) > 2 else []
    # the shortest name; of its values the first, which is the greatest
    begun.sort(key=lambda end: len(end.partition(".")[0]))
    best = [*sorted(whole, key=len, reverse=True), *begun][:1]
    return nearest(best[0], best) if best else nearest(typed, dict.fromkeys([*GROUP_OF, *ends]))
