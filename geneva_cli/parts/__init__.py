"""The parts: sizes, walls, outlines, drawings, and the check that they turn."""
