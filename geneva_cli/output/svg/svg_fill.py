"""Plates of an SVG, filled with a light tint of their layer's colour, or hatched.

The lowest plates come first, so that the tints of the upper ones cover them; bores stay open.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from geneva_cli.geometry.measure import mapped
from geneva_cli.geometry.placed import in_place
from geneva_cli.geometry.plates import Member, Part
from geneva_cli.geometry.shapes import Contour, Layer, Shape, as_contour
from geneva_cli.output.inks import INKS, inks, mixed
from geneva_cli.output.plot.strokes import LIGHT, Paper
from geneva_cli.output.svg.svg_paths import number, path

Plates: TypeAlias = list[tuple[Layer, tuple[Contour, ...]]]  # layers, outlines with their holes


def filled(every: Plates, fill: str, mm: float) -> Iterator[str]:
    """The plates of ``rings``; ``mm`` is a millimetre of lines in the file's unit."""
    here = dict.fromkeys(layer for layer, _ in every)
    layers = tuple(sorted(here, key=[*INKS, *here].index))  # the wheel's hatch first
    turns_deg = (45, 135, 75, 105, 15, 165)  # the layers' hatches have these in turn
    if fill == "hatch":
        yield "<defs>\n"
        for turn, (layer, ink) in zip(turns_deg * len(layers), inks(layers).items(), strict=False):
            step = number(mm * 4.0)  # distance of hatch lines
            yield (
                f'<pattern id="hatch-{layer}" width="{step}" height="{step}"'
                f' patternUnits="userSpaceOnUse" patternTransform="rotate({turn})">'
                f'<path d="M 0,0 L {step},0" stroke="{ink.rgb}"'
                f' stroke-width="{number(mm * 0.25)}"/></pattern>\n'
            )
        yield "</defs>\n"
    tint = tints(layers, LIGHT)
    yield '<g id="FILL" stroke="none" fill-rule="evenodd">\n'
    for layer, contours in every:
        if fill == "hatch":
            how = f'fill="url(#hatch-{layer})"'
        else:
            how = f'class="{layer}" fill="{tint[layer]}"'
        yield f'<path {how} d="{" ".join(map(path, contours))}"/>\n'
    yield "</g>\n"


def tints(layers: tuple[Layer, ...], paper: Paper) -> dict[Layer, str]:
    """The tint of each layer on a page."""
    inked = inks(layers)
    return {layer: mixed(inked[layer].rgb, opacity(layer), paper.page) for layer in layers}


def opacity(layer: Layer) -> float:
    """Opacity of a layer's tint, from 0 to 1."""
    return 0.55 if layer == "ROLLER" else 0.16


def rings(solid: Part, unit: float = 1.0) -> Plates:
    """The outline and holes of each plate, with its layer; the lowest plate first.

    Of plates of one shape above each other only the highest is there, which covers the others.
    ``unit`` is the file's unit in mm.
    """
    placed = (plate for _, plate in in_place([Member(solid)]))
    every = sorted(placed, key=lambda plate: (plate.high, plate.low))

    def in_unit(shape: Shape) -> Contour:
        return as_contour(mapped(shape, lambda p: (p[0] / unit, p[1] / unit), lambda r: r / unit))

    drawn = [(one.layer, tuple(map(in_unit, (one.outline, *one.holes)))) for one in every]
    return list(dict.fromkeys(reversed(drawn)))[::-1]
