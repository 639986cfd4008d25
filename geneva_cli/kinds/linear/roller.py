"""The roller that suits a rack, for a search of machines."""

from __future__ import annotations

import math

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.linear.rack import rack_sizes
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.study.synth.suiting import SIZES


def rack_roller(mechanism: Mechanism) -> tuple[float, str]:
    """Return NaN for the roller of the spec, or the usual one, and the obstacle to the parts."""
    try:
        rack_sizes(mechanism)
    except GenevaError:
        return math.nan, SIZES
    return math.nan, ""
