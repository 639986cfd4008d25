"""A report on a design for people: words, timing, peaks, loads, sizes, warnings."""

from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.errors import Notice
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.timing import timings
from geneva_cli.parts.chosen import ByLoad
from geneva_cli.parts.parts import Parts
from geneva_cli.table import Table, record_table
from geneva_cli.verdict.checks import Check, all_pass
from geneva_cli.verdict.failures import sentence
from geneva_cli.verdict.quantities.groups import REPORT, Values


class Report(NamedTuple):
    """A report on a design; ``passes`` is the result of ``check``."""

    table: Table
    passes: bool


def report(
    parts: Parts, rows: Sequence[Check], warnings: Sequence[Notice], by_load: ByLoad
) -> Report:
    """Everything about one design, as a tree of named values under a paragraph of words."""
    mechanism = parts.mechanism
    passes = all_pass(rows)
    title = mechanism.spec.title
    values: Values = {
        "spec": mechanism.spec.path,
        "title": title,
        "passes": passes,
        "checks_failed": tuple(sentence(c) for c in rows if c.passes is False),
        "not_proved": tuple(f"{c.name}: {c.why}" for c in rows if c.passes is None),
    }
    for group in REPORT:
        values |= group.values(parts)
    ends = {"chosen": by_load.record, "warnings": tuple(warnings)}
    return Report(record_table({**values, **ends}, title, words(mechanism)), passes)


def words(mechanism: Mechanism) -> str:
    """The design in words."""
    spec = mechanism.spec
    wheel, drive = spec.wheel, spec.drive
    slot = mechanism.engagements[0].slot
    each_step = len(mechanism.engagements[0].passages)  # rollers, each with its slot
    slots = "curved" if slot.curved else "straight offset" if slot.offset else "straight radial"
    count = len(wheel.steps or drive.roller_angles_deg or ()) or drive.rollers
    count *= each_step
    slots = f"pairs of {slots}" if each_step > 1 else slots
    rollers = "one roller" if count == 1 else f"{count} rollers"
    named = wheel.WORDS.format(wheel, slots)
    behind = f", behind {spec.drive_before.IN_FRONT}," if spec.drive_before else ""
    article = "An" if named[0] in "aeiou" else "A"
    driven = f"{drive.WORDS}{behind} with {rollers} at {drive.n_rpm:g} rpm"
    if len(drive.cranks) > 1:
        driven = f"{count} cranks with one roller each, in turn, at {drive.n_rpm:g} rpm"
    text = f"{article} {named}, driven by {driven}."
    if spec.motion:
        text += f' The wheel follows the law "{spec.motion.law.NAME}"'
        if spec.motion.alpha0_deg:
            text += f", with {spec.motion.alpha0_deg:g}° of extra dwell"
        text += "; its slots are cut to suit." if slot.curved else "; the groove is cut to suit."
    if wheel.stopped:
        text += f" A convex face in place of a recess blocks the crank after {wheel.z - 1} turns."
    each, output = timings(mechanism), mechanism.output
    verb, steps = "turns" if output.turns else "moves", sorted({t.step for t in each})
    turn = f"{verb} by {' or '.join(f'{step:.6g}' for step in steps)} {output.unit}"
    if len(each) == 1:
        own = each[0]
        text += f" It {turn} in {own.motion_s:.4g} s and then rests for {own.dwell_s:.4g} s."
    else:
        lasting = sorted({f"{t.motion_s:.4g}" for t in each}, key=float)
        text += f" It {turn} {len(each)} times in a turn of the crank, in {' or '.join(lasting)} s."
    return text
