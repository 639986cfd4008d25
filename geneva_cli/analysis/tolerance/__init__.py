"""What deviations of the dimensions do to the wheel's place and entry: formulas, and many draws."""
