"""Sizing by the form of index-drive makers, for any cam curve, and so for any Geneva.

The form assumes the greatest torque on the wheel during the whole motion, and the curve's factor Qm
for its transfer to the input. The exact cycle is in ``cycle``.
"""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.analysis.cam_factors import CamFactors
from geneva_cli.numerics.angles import radians


class ShaftLoad(NamedTuple):
    """Load of the wheel's shaft: kg m², N m, and the service factor fc on all of it."""

    inertia: float
    friction: float
    work: float
    service_factor: float
    frame: float = 0.0  # turns of the wheel's frame in one turn of the input


class MakersForm(NamedTuple):
    """The lines of the form: rad/s², N m at the wheel, and Tc at the input.

    Ti = J alpha, Tt = Ti + Tf + Tw, Te = fc Tt, Tc = step/motion Qm Te. A carrier that turns the
    wheel's frame also takes fc Ti, which need not be greatest where the rest is.
    """

    alpha: float
    Ti: float
    Tt: float
    Te: float
    Tc: float


def makers_form(
    factors: CamFactors, step_deg: float, motion_deg: float, n_rpm: float, load: ShaftLoad
) -> MakersForm:
    """The form for a wheel's step in an input angle at a speed: alpha = Am step / t2².

    A maker's example: six stops in 270 degrees at 80 rpm, modified trapezoid.

    >>> turret = ShaftLoad(inertia=0.319, friction=4.49, work=0.0, service_factor=2.0)
    >>> form = makers_form(CamFactors(4.89, 2.0, 1.655), 60.0, 270.0, 80.0, turret)
    >>> round(form.alpha, 3), round(form.Ti, 2), round(form.Tc, 2)
    (16.184, 5.16, 7.1)
    """
    t2 = motion_deg / (6.0 * n_rpm)
    alpha = factors.Am * radians(step_deg) / (t2 * t2)
    Ti = load.inertia * alpha
    Tt = Ti + load.friction + load.work
    Te = load.service_factor * Tt
    carried = abs(load.frame) * load.service_factor * Ti
    return MakersForm(alpha, Ti, Tt, Te, step_deg / motion_deg * factors.Qm * Te + carried)
