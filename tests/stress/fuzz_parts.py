"""Random machines with their parts: `python tests/stress/fuzz_parts.py --runs 20000 --jobs 2`.

Every gearing, drive and law, several rollers, offset slots, unequal steps, and all the keys of
``[size]``, ``[load]`` and ``[limits]``, mostly near values that a designer would write, sometimes
far from them. All results of the commands are computed for each: peaks, motion, report, checks with
the full turn, and every part as points and as a drawing, in arcs and in cubics. A machine is
refused with a place in its spec, or else every number is finite, without a warning, in time.
"""

import sys

from fuzz_machines import machine_text
from fuzz_spec import consistent, read, sound, sound_motion
from fuzzing import campaign, strictly

from geneva_cli.design import Design
from geneva_cli.drawings.catalogue import DRAWINGS, PARTS, is_table, part_drawing, part_table
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.pieces import pieces_table
from geneva_cli.parts.parts import parts_of
from geneva_cli.study.verdicts import Verdict, checks_table
from geneva_cli.table import flat
from geneva_cli.verdict.advice import judged

SECONDS = 30  # for all results of one machine
TOLERANCE = 0.01  # mm at L = 100, of the drawings
# The radius of a straight line; and loads that nothing bounds, where the report says so.
BOUNDLESS = {"curvature_radius_mm", "value"}


def tried(make, *args):
    """A checked table; None if it is refused with the spec's key or an option."""
    try:
        table = make(*args)
    except GenevaError as error:
        assert error.key or "--" in str(error), f"no place: {error}"
        return None
    sound(table, BOUNDLESS)
    return table


def one(text):
    """Compute all results of one spec; return how it ended, in a word."""
    with strictly(SECONDS):
        machine = read(text.encode())
        if isinstance(machine, str):
            return "refused"
        consistent(machine)
        sound_motion(machine, (97,))
        # loads that would be rounding are refused
        tried(lambda: flat(Design.of(machine.spec).report.table))
        tried(lambda: checks_table([Verdict("", checks=tuple(judged(machine)))]))
        tolerance = TOLERANCE * machine.center_distance_mm / 100.0
        for part in PARTS:
            try:
                listed = is_table(machine, part, False)
            except GenevaError:  # a part of other machines
                continue
            for samples in (None, 33, 50) if listed else ():
                tried(part_table, machine, part, tolerance, samples)
        drawn = parts_of(machine)
        try:
            drawn.turned  # noqa: B018 - made here, once for all parts
        except GenevaError as error:
            assert error.key, f"no place: {error}"
            return "parts refused"
        for part in DRAWINGS:
            for curves in ("arcs", "cubics"):
                tried(lambda *of: pieces_table(part_drawing(*of)), drawn, part, tolerance, curves)
        return "parts"


if __name__ == "__main__":
    sys.exit(campaign("machines with parts", machine_text, one, batch=20))
