"""What a motion leaves of a swing: against closed forms and integrals of 50 digits and more."""

import numpy as np
import pytest
import vibration_witness as witness
from swings import shares
from words import law

from geneva_cli import External
from geneva_cli.loads.vibration.swing import law_shape
from geneva_cli.loads.vibration.swing import motion_shapes as shape
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build

LAWS = [*witness.WAVES, *witness.POLYNOMIALS]
RATIOS = [1e-6, 1e-3, 0.1, 0.37, 0.5, 2 / 3, 1.0, 1.5, 2.0, 2.5, 3.14, 5.0, 7.3, 10.5, 20.1, 99.7]
NEAR = [x + side * 1e-12 for x in (0.5, 2 / 3, 1.0, 2.0, 4.0) for side in (-1, 0, 1)]
LARGE = [1e3, 1234.567, 9999.3, 1e4]


def of(name):
    if name.startswith("tilted"):
        return law_shape(law("sine-group", 0.1))
    return law_shape(law(name))


def amplitudes(form, ratios, damping=0.0):
    return shares(form, np.array(ratios, dtype=float), damping)


def close(found, exact):
    """Within 1e-13 of the value, or 1e-16 of the step: what is asked of residuals."""
    return abs(found - exact) <= max(1e-13 * exact, 1e-16)


@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("damping", [0.0, 0.02, 0.3, 0.95])
def test_residuals_of_laws(name, damping):
    ratios = RATIOS + NEAR + LARGE
    for ratio, found in zip(ratios, amplitudes(of(name), ratios, damping), strict=True):
        exact = witness.amplitude(name, ratio, damping)
        assert close(found, exact), (ratio, found, float(exact))


def test_half_a_natural_period_more_or_less_at_zeros():
    """The harmonic's half-integer zeros and the cycloidal's integer ones: 1e-16 of the step."""
    for name, offset in (("harmonic", 0.5), ("cycloidal", 0.0)):
        zeros = np.arange(2, 40) + offset
        assert amplitudes(of(name), zeros).max() <= 1e-16


# theory-loads.md, section 5: z = 3 external, amplitude over the step, derived with mpmath.
@pytest.mark.parametrize(
    ("ratio", "damping", "amplitude"),
    [
        (0.5, 0.0, 0.89884102659148325),
        (0.5, 0.02, 0.87128872570555313),
        (1.0, 0.0, 0.66081486966695231),
    ],
)
def test_published_values_of_three_slots(ratio, damping, amplitude):
    found = amplitudes(shape(build(Spec(External(3))).engagements[0].motion), [ratio], damping)[0]
    assert found == pytest.approx(amplitude, rel=4e-16)  # 17 digits are given


def test_half_integer_rule_of_six_slots():
    """theory-loads.md, section 5: 1.22e-3 of the step at 10, 6.1e-5 at 10.5."""
    ten, half = amplitudes(shape(build(Spec(External(6))).engagements[0].motion), [10.0, 10.5])
    assert (f"{ten:.2e}", f"{half:.1e}") == ("1.22e-03", "6.1e-05")
