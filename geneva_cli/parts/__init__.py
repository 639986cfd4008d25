"""What is cut: sizes, walls, outlines, and the proof that they turn."""
