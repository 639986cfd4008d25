"""The module behind a kind of drive, loaded when it is asked for."""

from __future__ import annotations

import importlib
from typing import Any

from geneva_cli.errors import GenevaError
from geneva_cli.machine.drives import KINDS
from geneva_cli.spec.tables import Spec

Z_DRAWN = 360  # slots of a wheel that is drawn: one a degree


def module(kind: str) -> Any:
    """The module of a kind of drive."""
    return importlib.import_module(f"geneva_cli.machine.drives.{KINDS[kind]}")


def own_path(kind: str) -> bool:
    """Whether the roller has a path of its own, and is not carried on the crank's circle."""
    return not hasattr(module(kind), "front")


def turns(spec: Spec) -> int:
    """Input turns in a turn of the crank."""
    of = getattr(module(spec.drive.kind), "turns", None)
    return int(of(spec.kind)) if of else 1


def refuse_reach(spec: Spec, farthest_deg: float) -> None:
    """Raise GenevaError where the crank cannot turn through the whole motion in one go."""
    of = getattr(module(spec.drive.kind), "reach_deg", None)
    reach = of(spec.kind) if of else 180.0
    if farthest_deg > reach * (1.0 + 1e-12):
        raise GenevaError(
            f"z = {spec.wheel.z}: the crank moves the wheel from up to {farthest_deg:.6g} deg "
            f'beside the line of centres, and kind = "{spec.drive.kind}" turns it by {reach:.6g} '
            "on either side; fewer slots here, or fewer on the first wheel",
            ("wheel", "z"),
        )


def is_flat(spec: Spec) -> bool:
    """Whether wheel and crank of a machine are flat outlines, of a wheel that can be cut."""
    toothed = spec.drive.kind == "gear-sector"
    return spec.wheel.gearing != "spherical" and not toothed and spec.wheel.z <= Z_DRAWN
