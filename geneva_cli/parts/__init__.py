"""The parts: sizes, walls, outlines, drawings, and the proof that they turn."""
