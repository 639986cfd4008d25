"""The parts of a machine: sizes, outlines, solids, and the check that they turn."""
