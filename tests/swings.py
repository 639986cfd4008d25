"""Residual swings of many oscillators after one motion, for tests."""

import numpy as np

from geneva_cli.loads.vibration.swing import Oscillator, greatest_accelerations, residual_swing


def swing(ratios, damping):
    ratios = np.array(ratios, dtype=float)
    return Oscillator(ratios, np.full(ratios.shape, damping))


def residuals(panels, ratios, damping):
    """Complex residual swings of the first motion among the panels."""
    return residual_swing(panels, np.zeros(len(ratios), dtype=np.intp), swing(ratios, damping))


def shares(panels, ratios, damping):
    """Residual amplitudes over the step."""
    return np.abs(residuals(panels, ratios, damping))


def greatest_acceleration(panels, ratio, damping):
    """The greatest acceleration of a load during the motion, over the step."""
    one = np.zeros(1, dtype=np.intp)
    return float(greatest_accelerations(panels, one, swing([ratio], damping))[0])
