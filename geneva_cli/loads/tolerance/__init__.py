"""Effects of tolerances on the wheel: formulas for its place and entry, and random machines."""
