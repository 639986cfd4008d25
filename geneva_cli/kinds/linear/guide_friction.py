"""Friction in the guide of a rack, as a part of the load case."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.kinds.linear.guide_place import guide_place
from geneva_cli.kinds.linear.motion import guided
from geneva_cli.loads.forces import Contact, LoadCase, lesser
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import choose
from geneva_cli.numerics.jet import Number, V
from geneva_cli.spec.default_sizes import value_or


class RackGuide(NamedTuple):
    """The guide of a rack, lengths over L; floats, or (m, 1) for m designs."""

    friction: float
    middle: float  # x of its middle from the deepest roller
    half: float  # half its length

    def lever(self, case: LoadCase, at: Contact[V], drives: Number, slides: Number) -> V:
        """Lever of the force on a rack about its guide's middle, over L, for a roller that drives.

        The formula is that of ``guide_forces``, over d. The crank turns against the rack,
        at the rate ``spin``, so that cos a is -velocity/spin, and sin a -along/spin.
        """
        lever = at.velocity / at.spin + (1.0 - self.middle)
        if not case.rubs:
            return lever
        height = drives * case.radius - at.along / at.spin
        return lever - height * (case.friction * slides * drives)

    def leaning(self, case: LoadCase, at: Contact[V], drives: Number, slides: Number) -> V:
        """A value above 0 where the rack bears on opposite sides of its guide's ends: smooth."""
        lever = self.lever(case, at, drives, slides)
        return lever * lever - (case.friction * self.half) ** 2

    def drag(self, case: LoadCase, at: Contact[V], drives: Number, slides: Number) -> V:
        """Friction in a rack's guide over the pin's force: nu (|N1| + |N2|)/F.

        The forces at both ends add up to mu F across the travel, and their moment about the guide's
        middle is that of the roller. So |N1| + |N2| is the greater of |M|/h and mu F.
        """
        turns = self.lever(case, at, drives, slides) * (1.0 / self.half)
        both = lesser(turns * -1.0, turns)  # less their size
        least = turns * 0.0 - case.friction
        return lesser(both, least) * (0.0 - self.friction)


def with_guide(mechanism: Mechanism, case: LoadCase) -> LoadCase:
    """Return a load case with the guide of a rack, if the machine has one.

    A rack whose slots leave no space for a guide has none.
    """
    spec, L = mechanism.spec, mechanism.center_distance_mm
    if not guided(spec):
        return case
    place = guide_place(mechanism)
    friction = value_or(spec.load.guide_friction, spec.load.friction)
    there = place.half > 0.0
    guide = RackGuide(
        choose(there, friction, 0.0), place.middle / L, choose(there, place.half / L, 1.0)
    )
    return case._replace(guide=guide)
