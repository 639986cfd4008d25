"""How near is equal: the tolerances that files share, each with its unit and its reason.

Doubles carry 2e-16. What a formula makes of that is some 1e-15 of a size, a search 1e-13, a chain
of parts 1e-11. Drawings and tables show 1e-6 of a size. What is to be equal so lies between.
A tolerance of one file's own method (a step of Newton's, a scan) stands in that file.
"""

# Share of the centre distance, or of a sphere's radius: lengths and places nearer to each other are
# one. 1e-7 mm of 100 mm is the size of an atom, and a hundred times the rounding of a chain.
SAME_LENGTH = 1e-9

# Radians, or a cosine near 0: directions nearer to each other are one; SAME_LENGTH as an angle.
SAME_ANGLE = 1e-9

# Degrees: input angles nearer to each other are one position; angles are shown to 1e-6.
SAME_INPUT_DEG = 1e-9

# Share of a quantity's greatest size, or of a limit: what differs by less is rounding. Values are
# computed to 1e-12 or so, loads (by search) to 1e-10, and nobody can measure a billionth.
ROUNDED = 1e-9

# Share of a peak's size: two that differ by less are one that occurs twice. Jets run up to 31 units
# in the last place, 7e-15; of a power's two factors some ten times that is safe.
TIE = 1e-13

# Share of a limit by which a machine that is solved for stays on its good side: more than the
# rounding of the peaks that are compared, less than is shown.
MARGIN = 1e-12

# Times a distance or a limit: what is beyond it is so whatever the rounding, in searches that may
# leave the rest to a closer look.
CLEARLY = 1.0 + 1e-6

# mm or radians of what a drawing sheet shows: lines, radii, centres and directions nearer to each
# other are one; no plotter shows it.
SAME_ON_SHEET = 1e-6

# mm: a cutter as wide as a slot enters it, and a path so near to a part leaves it whole: a
# thousandth of what machines cut to.
SAME_CUT_MM = 1e-5
