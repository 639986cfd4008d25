"""Wheel and crank on shafts that meet: shells of a sphere, and their cones laid flat."""
