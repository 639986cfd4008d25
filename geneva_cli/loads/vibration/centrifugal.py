"""Bodies off the axis of a wheel on a carrier, in the vibration of the load.

In the carrier's frame their centrifugal force puts the torque U sin x on the load, U = m e L w² and
x the body's direction from the carrier's axis: with X that of a rigid shaft, x = X + r, so that

    r'' + 2 zeta wn r' + (wn² - U/I cos X) r = -psi'' + U/I sin X

Both sides are linear in r, as r is small. The stiffness -U cos X varies with the motion. Its mean
over the motion counts, which has the phase of the swing: a body away from the carrier's axis
stiffens the shaft. What the mean leaves out is less than U/k of the residual. Damping per second
stays as it is.

With g = (U/k) sin X, which is constant while the wheel rests, q = r - g is free of force then:

    q'' + 2 zeta wn q' + wn² q = -(psi'' + g'' + 2 zeta wn g')

As g' is 0 at both ends of the motion, the integral of g' e^(p (1 - u)) is that of g'' over p. So g
adds to the residual what a motion g would leave, times 1 + 2 zeta wn/p = -p*/p.

In u, the fraction of the motion's time, g over the step is D(u)/Omega². D does not depend on speed,
as U grows with its square.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.loads.carried import MM, inertia_kgm2, unbalance_kgm
from geneva_cli.loads.vibration.oscillator import Oscillator
from geneva_cli.loads.vibration.panels import Panels, motion_shapes
from geneva_cli.loads.vibration.swing import residual_swing
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Complex, Number, Whole, matrix_product
from geneva_cli.numerics.jet import Jet, sin_cos
from geneva_cli.numerics.quadrature import rule

STIFFEST = 0.2  # U/k up to which the stiffness of the unbalance counts by its mean


class Pull(NamedTuple):
    """The centrifugal force in one motion of m designs: its shape, and stiffnesses (m,)."""

    shape: Panels  # D
    moving: Array  # the mean of U cos X over k, times Omega²
    resting: Array  # its value in the dwell that follows

    def softened(
        self, swing: Oscillator[Array], which: Whole, resting: bool = False
    ) -> Oscillator[Array]:
        """Return the oscillators with the stiffness of the unbalance."""
        own = self.resting if resting else self.moving
        less = (own if len(own) == 1 else own[which]) / (2.0 * np.pi) ** 2
        ratio = np.sqrt(swing.ratio**2 - less)
        return Oscillator(ratio, swing.damping * swing.ratio / ratio)

    def residual(self, motion: Whole, swing: Oscillator[Array]) -> Complex:
        """Return what g adds to the residuals of oscillators."""
        added = residual_swing(self.shape, motion, swing)
        out: Complex = -added * np.conj(swing.p) / (swing.p * abs(swing.p) ** 2)
        return out


def with_each_motion(mechanism: Mechanism) -> Mechanism:
    """Return the machine with one wheel's motions in all directions of its bodies.

    Each leaves its own vibration. Balanced wheels have equal motions, and are returned as they are.
    """
    if not mechanism.unbalanced:
        return mechanism
    loaded, wheels = mechanism.under_load, mechanism.spec.drive.wheels_on_carrier
    return loaded._replace(engagements=loaded.engagements[::wheels])


def pull(mechanism: Mechanism, engagement: Engagement) -> Pull | None:
    """Return the centrifugal force in a motion; None for balanced wheels, or on the ground."""
    if not mechanism.unbalanced:
        return None
    along, ahead = unbalance_kgm(mechanism.spec)
    factor, mid = _factor(mechanism, engagement), engagement.mid_angle or 0.0
    motion = engagement.motion

    def torque(angle: Jet, which: Whole) -> Jet:
        scale, middle = taken((factor, mid), which)
        sine, cosine = sin_cos(angle + middle)
        return (sine * along + cosine * ahead) * scale

    def stiffness(angle: Number) -> Array:
        x = np.atleast_2d(angle) + mid
        out: Array = (np.cos(x) * along - np.sin(x) * ahead) * factor  # U cos X, as D
        return out

    node, weight = rule(64)  # exact for a motion without knots
    span = motion.exit_deg - motion.entry_deg
    angles = motion(motion.entry_deg + span * (0.5 + 0.5 * node), 0).c[0]
    moving = matrix_product(stiffness(angles), 0.5 * weight)
    resting = np.ravel(stiffness(engagement.half_step))
    return Pull(motion_shapes(motion, mechanism.designs, torque), moving, resting)


def stiffness_ratio(mechanism: Mechanism, ratio: Array) -> Array:
    """Return U/k of m designs, the greatest stiffness of the unbalance over the shaft's: (m,).

    ``ratio`` are the period ratios of the first motion. It is 0 for balanced wheels.
    """
    if not mechanism.unbalanced:
        return np.zeros(1)
    size = np.hypot(*unbalance_kgm(mechanism.spec))
    factor = np.ravel(_factor(mechanism, mechanism.engagements[0]))
    ratios: Array = size * factor / (2.0 * np.pi * ratio) ** 2
    return ratios


def _factor(mechanism: Mechanism, engagement: Engagement) -> float:
    """L over the load's inertia, times the square of the motion's input angle."""
    arm_m = abs(mechanism.frame) * mechanism.center_distance_mm * MM
    turned = engagement.motion_deg * DEGREE
    return turned * turned * arm_m / inertia_kgm2(mechanism.spec)
