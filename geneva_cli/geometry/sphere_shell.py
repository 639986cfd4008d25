"""A solid cut out of a sphere, in mm."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.geometry.shapes import Layer

if TYPE_CHECKING:
    from geneva_cli.geometry.sphere import Region, Vector
    from geneva_cli.geometry.sphere_arcs import RoundHole


class Shell(NamedTuple):
    """A solid between two spheres about the origin, over regions that touch along whole arcs.

    Round holes are all within the last of the regions, and separate from each other.
    """

    name: str
    layer: Layer
    regions: tuple[Region, ...]
    inner: float
    outer: float
    holes: tuple[RoundHole, ...] = ()

    @property
    def volume(self) -> float:
        """Solid angle times a third of the difference of the cubes, minus the holes, mm³."""
        covered = math.fsum(r.area for r in self.regions)
        bored = math.fsum(hole.volume(self.inner, self.outer) for hole in self.holes)
        return covered * (self.outer**3 - self.inner**3) / 3.0 - bored

    @property
    def centroid(self) -> Vector:
        """Centre of mass of a uniform shell, mm."""
        covered = np.sum([r.moments[0] for r in self.regions], axis=0)
        first = covered * (self.outer**4 - self.inner**4) / 4.0
        for hole in self.holes:
            first = first - hole.first(self.inner, self.outer) * np.array(hole.axis)
        x, y, z = (first / self.volume).tolist()
        return x, y, z

    def reach(self, direction: Vector) -> float:
        """Greatest coordinate of the shell along a direction, mm from the centre."""
        from geneva_cli.geometry.sphere_arcs import SphereArcs

        if any(SphereArcs(r.boundary).signed(np.array([direction]))[0] < 0.0 for r in self.regions):
            return self.outer
        most = max(arc.reach(direction) for region in self.regions for arc in region.boundary)
        return most * (self.outer if most > 0.0 else self.inner)

    def inertia(self, axis: Vector) -> float:
        """The volume's moment of inertia about an axis through the centre, mm⁵."""
        covered = math.fsum(r.area - float(r.moments[1] @ axis @ axis) for r in self.regions)
        bored = math.fsum(hole.inertia(self.inner, self.outer, axis) for hole in self.holes)
        return covered * (self.outer**5 - self.inner**5) / 5.0 - bored
