"""The machines of the bench, their varied designs, and tasks for batches of them."""

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from bench import formulas
from bench.formulas import Proportions, rates, textbook
from bench.method import Method, Task
from geneva_cli.drives.crank import Crank
from geneva_cli.drives.epicyclic import Epicyclic
from geneva_cli.drives.gears import EllipticalGears
from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.kinds.linear.motion import Linear
from geneva_cli.kinds.linkages.four_bar import FourBar
from geneva_cli.kinds.series.geneva_pair import GenevaPair
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.laws.standard import ModifiedSine, SineGroup
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.external import External
from geneva_cli.motion.wheels.internal import Internal
from geneva_cli.motion.wheels.spherical import Spherical
from geneva_cli.spec.tables import Size

QUICK = 100  # designs of a quick run
CHECKED, QUICK_CHECKED = 20, 4  # designs whose error is measured


def peaks_on_grid(d, formula):
    """Greatest velocity and acceleration of a batch of cranks at 101 even angles."""

    def of_block(d):
        best = np.zeros((2, len(d.half)))
        for i in range(101):
            for most, rate in zip(best, formula(d, d.half * (i / 100)), strict=True):
                np.maximum(most, np.abs(rate), out=most)
        return best.T

    return d.blocks(of_block)


def plain_cranks(z):
    """Peaks of plain cranks at even angles, by NumPy."""
    designs = Proportions.of(1.0, z, 0.0, np)
    return peaks_on_grid(designs, lambda d, x: textbook(d.l, x, (1, 2)))


def side_cranks(sign, A):
    """Peaks of side-cranks of six slots at even angles, by NumPy."""
    return peaks_on_grid(Proportions.of(sign, 6, A, np), partial(rates, np))


def modified_sine_peaks(z, alpha0):
    """Greatest velocity and acceleration of curved slots for a modified sine, in closed form."""
    step, motion = 2.0 * np.pi / z, np.pi - 2.0 * np.pi / z - np.radians(alpha0)
    times = 4.0 * np.pi / (4.0 + np.pi) * step / motion
    return np.column_stack((times, times * np.pi / motion))


class VariedMachine(NamedTuple):
    """A machine, and a key that varies between two values."""

    name: str
    spec: Spec
    key: str
    low: float
    high: float
    designs: int = 50_000  # of a whole run
    # a handbook's formulas for the peaks of velocity and acceleration, from the varied values
    script: Callable[[Any], Any] | None = None
    # and for velocity and acceleration of one design at angles in radians
    formula: Callable[[Any, Any], Any] | None = None
    # what that takes in the value's place where the wheel is searched, from value and engagement
    place: Callable[[float, Any], tuple[float, ...]] | None = None

    def argument(self, value, engagement):
        """What the formula takes for a value of the key."""
        return self.place(value, engagement) if self.place else value


def four_bar_place(point_deg, engagement):
    """The coupler point's angle, the crank's at mid-motion, the wheel's axis, and its sense."""
    at = engagement.reactions
    return point_deg, at.middle, -at.L * at.x, -at.L * at.y, at.sense


_SIDE_CRANK, _Z = SideCrank(A=0.0), ("wheel.z", 3.0, 24.0)
_LINKS = FourBar(ground_mm=100.0, crank_mm=40.0, coupler_mm=90.0, rocker_mm=80.0, point_mm=60.0,
                 point_deg=-40.0)  # fmt: skip
_WHEEL = External(6)
KINDS = (
    VariedMachine("plain crank", Spec(_WHEEL, Crank()), *_Z, script=plain_cranks,
                  formula=lambda z, x: textbook(np.sin(np.pi / z), x, (1, 2))),
    VariedMachine("side-crank", Spec(_WHEEL, _SIDE_CRANK), "drive.A", -0.9, 0.9,
                  script=partial(side_cranks, 1.0),
                  formula=lambda A, x: rates(np, Proportions.of(1.0, 6, A), x)),
    VariedMachine("side-crank inside", Spec(Internal(6), _SIDE_CRANK), "drive.A", -0.9, 0.9,
                  script=partial(side_cranks, -1.0),
                  formula=lambda A, x: np.negative(rates(np, Proportions.of(-1.0, 6, A), x))),
    VariedMachine("offset slots", Spec(_WHEEL, size=Size(center_distance_mm=100.0)),
                  "wheel.offset_mm", -40.0, 40.0, formula=formulas.offset_slots),
    VariedMachine("spherical", Spec(Spherical(6)), "wheel.axes_deg", 20.0, 160.0,
                  formula=formulas.spherical),
    VariedMachine("linear", Spec(Linear(6)), *_Z, formula=formulas.linear),
    VariedMachine("elliptical gears", Spec(_WHEEL, EllipticalGears(eccentricity=0.1)),
                  "drive.eccentricity", 0.0, 0.6, formula=formulas.elliptical_gears),
    VariedMachine("epicyclic", Spec(External(4), Epicyclic(planet_ratio=0.01)),
                  "drive.planet_ratio", -0.05, 0.02, formula=formulas.epicyclic),
    VariedMachine("curved slots", Spec(_WHEEL, motion=Motion(ModifiedSine())),
                  "motion.alpha0_deg", -60.0, 60.0, script=partial(modified_sine_peaks, 6),
                  formula=formulas.modified_sine),
    VariedMachine("curved slots of a tilted law", Spec(_WHEEL, motion=Motion(SineGroup(0.01))),
                  "motion.lambda", -0.12, 0.12, formula=formulas.sine_group),
    VariedMachine("geneva pair", Spec(External(4), GenevaPair(first_z=4)), "wheel.z", 3.0, 5.0,
                  formula=formulas.geneva_pair),
    VariedMachine("four-bar", Spec(External(4), _LINKS), "drive.point_deg", -50.0, -35.0, 4_096,
                  formula=formulas.four_bar, place=four_bar_place),
)  # fmt: skip


def drawn(kind, spec, count):
    """Machine of a batch of designs, the number built, and the first of them one by one."""
    values = values_of(kind, count)
    batch = many(spec, {kind.key: values})
    assert batch.machine is not None, kind.name
    few = CHECKED if count > QUICK else QUICK_CHECKED
    some = values[batch.which[:few]].tolist()
    alone = [build(spec.with_(kind.key, value)) for value in some]
    return batch.machine, len(batch.which), alone


def values_of(kind, count):
    """Random values of the varied key, always equal."""
    values = np.random.default_rng(12).uniform(kind.low, kind.high, count)
    return np.floor(values).astype(int) if kind.key == "wheel.z" else values


def one_by_one(alone, count, one, most):
    """Method that computes at most ``most`` designs one by one, in place of all."""
    few = alone[:most]
    name = f"one by one (extrapolated from {len(few)})"
    return Method(name, None, lambda: [one(m) for m in few], True, False, count / len(few))


def task_of_many(name, count, error, methods):
    """A task for a batch of designs, with sine and cosine of as many numbers as baseline."""
    angles = np.linspace(0.0, 1.0, count)
    return Task(
        name,
        f"one np.sin + np.cos over {count} numbers",
        lambda: (np.sin(angles), np.cos(angles)),
        error,
        methods,
        count,
    )
