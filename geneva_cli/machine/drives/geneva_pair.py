"""Two Geneva wheels in series: the first wheel carries the crank of the second.

The second wheel moves while the first makes one of its steps, once in a turn of the first wheel. It
starts from a crank that is itself just starting or running, so its jump is the first one's speed
squared times tan b: none where both motions begin together (as with four slots on four).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated, NamedTuple

from geneva_cli.machine.drives import Front
from geneva_cli.machine.wheels import poses as gearing
from geneva_cli.numerics.angles import sin_cos_pi
from geneva_cli.numerics.jet import Coefficient, Jet, atan2, sine_versine, sine_versine_of
from geneva_cli.spec.rules import Z_MAX, Range
from geneva_cli.spec.tables import Spec


class Keys(NamedTuple):
    """The keys that ``kind = "geneva-pair"`` adds."""

    first_z: Annotated[int, Range(3, Z_MAX), "slots of the first wheel, external"]


def turns(keys: Keys) -> int:
    """Input turns in a turn of the second crank."""
    return keys.first_z


def reach_deg(keys: Keys) -> float:
    """Farthest the second crank may be from mid-step while it moves its wheel."""
    return 180.0 / keys.first_z


def front(spec: Spec) -> Callable[[float], Front]:
    """Front about an angle of the second crank within the first wheel's step, degrees."""
    keys = spec.kind
    assert isinstance(keys, Keys)
    step = gearing.Step(1, keys.first_z)
    ends = {180.0 / keys.first_z * side: side for side in (-1.0, 1.0)}

    def about(crank_deg: float) -> Front:
        poses = gearing.radial("external", step)
        if crank_deg in ends:
            pose = poses[0] if ends[crank_deg] < 0.0 else poses[2]
        else:
            pose = _running(poses[1], _crank_at(step, crank_deg))

        def advance(tau: Coefficient, order: int) -> tuple[Jet, Jet]:
            along, across = pose.displacement(*sine_versine(Jet.variable(tau, max(order, 1))))
            along = along + pose.along
            rate = atan2(across, along).derivative()
            return sine_versine_of(rate, across.c[0], along.c[0], order)

        return Front(pose.crank_deg, advance)

    return about


def _crank_at(step: gearing.Step, wheel_deg: float) -> float:
    """The first crank's angle a, radians, where its wheel is at psi: sin(a + psi) = sin psi / l.

    With k = l cos(a + psi) = sqrt(sin(b - psi) sin(b + psi)) nothing cancels in
    l sin a = sin psi cos² b / (cos psi + k) and l cos a = k cos psi + sin² psi.
    """
    n, d = wheel_deg.as_integer_ratio()
    whole = 180 * d * step.q
    here, less = 180 * d * step.p, n * step.q  # b and psi, in parts of pi
    s, c = sin_cos_pi(less, whole)
    k = math.sqrt(sin_cos_pi(here - less, whole)[0] * sin_cos_pi(here + less, whole)[0])
    return math.atan2(s * step.sin_cos[1] ** 2 / (c + k), k * c + s * s)


def _running(middle: gearing.Pose, a: float) -> gearing.Pose:
    """The first crank's pin at an angle a (radians) from mid-motion, in its own ray's frame."""
    l, s, c = middle.bend[0], math.sin(a), math.cos(a)
    x, y = middle.along + 2.0 * l * math.sin(0.5 * a) ** 2, l * s
    rho = math.hypot(x, y)
    u, v = x / rho, y / rho
    slope = (l * (s * u + c * v), l * (c * u - s * v))
    bend = (l * (c * u - s * v), -l * (s * u + c * v))
    return gearing.Pose(math.degrees(a), math.atan2(y, x), rho, slope, bend)
