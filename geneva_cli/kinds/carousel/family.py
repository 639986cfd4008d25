"""Carousels for a requirement: wheels with radial slots on a carrier."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from geneva_cli.kinds.carousel.motion import Carousel
from geneva_cli.motion.wheels.classic import rollers_max
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.study.synth.families.family import (
    Family,
    allowed_motions,
    allows,
    is_compatible,
    machine,
    natural_deg,
    rollers,
)
from geneva_cli.study.target import Target


def carousels(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    """One wheel with any number of fingers, or several wheels with one finger."""
    for wheel in wheels:
        natural = natural_deg(wheel)
        for fingers in rollers(target, natural):
            if not allows(allowed_motions(target, fingers, natural), natural):
                continue
            for count in target.wheels:
                # each finger and each wheel has its own part of a turn
                if count > 1 and (fingers > 1 or count > rollers_max(natural)):
                    continue

                def drive(n: float, fingers: int = fingers, count: int = count) -> Carousel:
                    return Carousel(n_rpm=n, rollers=fingers, wheels=count)

                spec = machine(target, wheel, drive, fingers, natural)
                if is_compatible(spec):
                    yield Family(spec)
