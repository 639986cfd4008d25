"""Links: positions, sizes, plates, pins, shafts and planes."""
