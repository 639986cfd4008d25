"""A batch of designs as one machine, whose numbers are arrays along a design axis.

    >>> import numpy as np
    >>> from geneva_cli import External, SideCrank
    >>> from geneva_cli.motion.many import many
    >>> batch = many(Spec(External(6), SideCrank(A=0.0)), {"drive.A": np.array([0.0, 0.6, 2.0])})
    >>> batch.spread(worst_peaks(batch.machine, ["velocity"])["velocity"].max)
    array([1.   , 0.625,   nan])

The numbers of ``batch.machine`` that vary are arrays (m, 1) of the designs that can be built, and
so are the results; at k input angles they are (m, k). Words, lists and the number of rollers have
one value in all designs. Build a refused design by itself to get the reason.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, marking
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.machine_spec import BEFORE, Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.peak_search import QUANTITIES, PeakArray, greater, motion_peaks
from geneva_cli.numerics.arrays import Array, Mask, Number, Whole, keep_memory, parameter
from geneva_cli.spec.rules import is_array

# tables whose numbers may vary
TABLES = (
    *("wheel", "drive", BEFORE, "motion", "size", "load", "support", "motor", "shaft", "tolerance"),
    *("material.wheel", "material.roller"),
)


class Many(NamedTuple):
    """A batch of n designs as ``many`` built it."""

    machine: Mechanism | None  # of the designs that can be built; None if there are none
    refused: Mask  # (n,)

    @property
    def which(self) -> Whole:
        """Numbers of the designs in ``machine``."""
        return np.flatnonzero(~self.refused)

    def spread(self, values: Number) -> Array:
        """Values (m, 1) of the designs in ``machine`` as (n,), with NaN for refused designs."""
        which = self.which
        out = np.full(len(self.refused), np.nan)
        out[which] = np.broadcast_to(np.reshape(values, -1), which.shape)
        return out


def many(spec: Spec, varied: Mapping[str, object]) -> Many:
    """Build the machine of a spec with some of its keys varied.

    ``varied`` has keys as in the file (``drive.A``, ``wheel.z``, ``motion.lambda``), with arrays
    (n,) of numbers or with one value for all designs.
    """
    arrays = {key: np.asarray(v) for key, v in varied.items() if is_array(v)}
    lengths = {len(values) for values in arrays.values()}
    if len(lengths) != 1 or any(values.ndim != 1 for values in arrays.values()):
        raise ValueError("keys must vary in arrays (n,) of one length")
    wrong = [key for key in arrays if not may_vary(spec, key)]
    if wrong:
        raise ValueError(f"{', '.join(wrong)}: cannot vary within a machine")
    (n,) = lengths
    keep_memory()
    columns = {**varied, **{key: values[:, None] for key, values in arrays.items()}}
    with np.errstate(all="ignore"), marking() as marks:
        try:
            numbers = np.arange(n)[:, None]
            machine = build(spec.with_keys(columns))._replace(design=numbers) if n else None
        except GenevaError:  # the error is the same for all designs
            machine = None
    refused = np.full(n, machine is None)
    for mark in marks:
        refused |= np.broadcast_to(mark, (n, 1))[:, 0]
    if machine is None or refused.all():
        return Many(None, np.full(n, True))
    return Many(taken(machine, ~refused) if refused.any() else machine, refused)


def may_vary(spec: Spec, key: str) -> bool:
    """True if a key of this spec may be an array: a number whose kind takes arrays."""
    table, _, name = key.rpartition(".")
    part = spec.part(table) if table in TABLES else None
    field = part._own_keys().get(name) if part else None
    if part is None or field is None:
        return False
    own = spec.motion.law if spec.motion and part is spec.motion else part
    return bool({int, float} & set(field.types)) and name not in own.SHARED


def worst_peaks(
    mechanism: Mechanism, quantities: Sequence[str] = QUANTITIES, among: Sequence[Engagement] = ()
) -> dict[str, PeakArray]:
    """The greatest peaks over all engagements, or some; angles are the machine's input angles."""
    best: dict[str, PeakArray] = {}
    for engagement in among or mechanism.engagements:
        for name, peak in motion_peaks(engagement.motion, quantities).items():
            at_deg = engagement.mid_deg + parameter(peak.at_deg[:, None])
            here = PeakArray(peak.max, np.ravel(mechanism.shown_deg(at_deg)))
            best[name] = greater(best[name], here) if name in best else here
    return best
