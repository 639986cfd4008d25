"""Random machines with their parts: `python tests/stress/fuzz_parts.py --runs 20000 --jobs 2`.

Every gearing, drive and law, several rollers, offset slots, unequal steps, and all the keys of
``[size]``, ``[load]`` and ``[limits]``, mostly near what a designer would write, now and then far
from it. All that the commands print is made of each: peaks, motion, report, checks with the full
turn, and every part as points and as a drawing, in arcs and in cubics. A machine is refused with a
place in its spec, or else every number of it is finite, without a warning, in its time.
"""

import sys

from fuzz_machines import machine_text
from fuzz_spec import consistent, read, sound, sound_motion
from fuzzing import campaign, strictly

from geneva_cli.curves.pieces import pieces_table
from geneva_cli.design import Design
from geneva_cli.drawings.catalogue import DRAWINGS, PARTS, is_table, part_drawing, part_table
from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import GenevaError
from geneva_cli.study.verdicts import Verdict, checks_table
from geneva_cli.table import flat
from geneva_cli.verdict.advice import judged

SECONDS = 30  # of one machine with all that is made of it
TOLERANCE = 0.01  # mm at L = 100, of the drawings
# The radius of a straight line; and loads that nothing bounds, where the report says so.
BOUNDLESS = {"curvature_radius_mm", "value"}


def tried(make, *args, jumps=False):
    """A table made and looked at; None where it is refused, and the spec's key or option named."""
    try:
        found = make(*args)
    except GenevaError as error:
        assert error.key or "--" in str(error), f"no place: {error}"
        return None
    sound(found, found.names if jumps else BOUNDLESS)
    return found


def one(text):
    """All that is made of one spec; how it ended, in a word."""
    with strictly(SECONDS):
        found = read(text.encode())
        if isinstance(found, str):
            return "refused"
        consistent(found)
        sound_motion(found, (97,))
        # loads that would be rounding are refused
        jumps = found.spec.wheel.JUMPS
        tried(lambda: flat(Design.of(found.spec).report.table), jumps=jumps)
        tried(lambda: checks_table([Verdict("", checks=tuple(judged(found)))]))
        tolerance = TOLERANCE * found.center_distance_mm / 100.0
        for part in PARTS:
            try:
                listed = is_table(found, part, False)
            except GenevaError:  # a part of other machines
                continue
            for samples in (None, 33, 50) if listed else ():
                tried(part_table, found, part, tolerance, samples)
        drawn = PartsModel(found)
        try:
            drawn.parts  # noqa: B018 - made here, once for all parts
        except GenevaError as error:
            assert error.key, f"no place: {error}"
            return "parts refused"
        for part in DRAWINGS:
            for curves in ("arcs", "cubics"):
                tried(lambda *of: pieces_table(part_drawing(*of)), drawn, part, tolerance, curves)
        return "parts"


if __name__ == "__main__":
    sys.exit(campaign("machines with parts", machine_text, one, batch=20))
