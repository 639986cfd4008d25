"""The dimensions of the parts of a spherical machine that their strength depends on.

Shafts reach outwards, past the parts that they carry. The bearings of plain ones are in the middle
of their ends there, which are as long as the arm is thick. An overhang counts from the sphere of
radius L.

The arm is bent over its sphere. A section at the angle x from the pin bears the force F across the
arm as a moment F L sin x in its plane, and a twist F (R - L cos x), R being the radius of the arm's
middle. The force along the arm bends it by F (L - R cos x). So a flat arm as long as the arc on the
sphere, with the offset at the crank's axis, bears at least as much.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.kinds.spherical.ball import Ball
from geneva_cli.loads.strength.arm_strength import ArmDimensions
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.parts.shafts.bores import reach_or_bore
from geneva_cli.parts.sizes import arm_hub, hole_radius
from geneva_cli.parts.stressed import ShaftEnd, Stressed, key_of, shaft_of
from geneva_cli.spec.default_sizes import half_or, value_or
from geneva_cli.spec.least_wall import eye_about, wall_min


def sphere_stressed(spec: Spec, ball: Ball) -> Stressed:
    """Return the dimensions of a spherical machine's parts."""
    size = spec.size
    inside, outside = ball.span_mm
    under, over = ball.arm_span_mm
    end = ShaftEnd(ball.shafts_end_mm(size) - ball.radius_mm, over - under, ball.radius_mm)
    return Stressed(
        value_or(size.face_width_mm, outside - inside),
        2.0 * ball.pin_mm,
        shaft_of(spec, "wheel", ball.bore_mm, end),
        shaft_of(spec, "crank", ball.arm_bore_mm, end),
        _arm(spec, ball),
        key_of(size.wheel_keyway, ball.bore_mm, ball.hub_length_mm(size)),
        key_of(size.crank_keyway, ball.arm_bore_mm, over - under),
    )


def _arm(spec: Spec, ball: Ball) -> ArmDimensions:
    """Return the dimensions of the flat arm that stands for the bent one; NaN without an arm."""
    size, L = spec.size, ball.radius_mm
    if not ball.arm_bore_mm:
        return ArmDimensions.none()
    middle, thick = 0.5 * sum(ball.arm_span_mm), ball.arm_span_mm[1] - ball.arm_span_mm[0]
    wall, hole = wall_min(size, L), hole_radius(size, ball.pin_mm)
    bored = reach_or_bore(size, "crank", ball.arm_bore_mm)
    hub = arm_hub(size, bored, ball.arm_bore_mm, wall)
    cap = ball.cap(hub, bored, wall)
    eye = half_or(size.arm_eye_mm, eye_about(hole, wall, ball.passing_mm(ball.opening_mm)))
    offset = middle - L * math.cos(ball.arm)
    rows = L * ball.arm, middle * cap, middle * eye / L, bored, hole, thick, offset
    return ArmDimensions(*map(np.asarray, rows))
