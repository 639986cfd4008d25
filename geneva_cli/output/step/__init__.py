"""STEP AP214 (ISO 10303-214): parts as closed solids with names and colours, and their assembly.

The output is equal on every run: its time stamp is empty, for a design has no date.
"""

import math
from collections.abc import Iterator

from geneva_cli.errors import clean
from geneva_cli.geometry.plates import Group, Part, Shell, Solid
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.geometry.sphere import POLE
from geneva_cli.output.inks import INKS
from geneva_cli.output.solid_part import solid_part
from geneva_cli.output.step.brep import plate_solid, shell_solid
from geneva_cli.output.step.entities import Entities, listed, real, words
from geneva_cli.output.templates import filled, template


def chunks(drawing: Drawing) -> Iterator[str]:
    """Yield the file's text. Raises GenevaError for a drawing without solids."""
    file = Entities()
    _Products(file, solid_part(drawing, "STEP"))
    yield filled("step_head.txt", {"TITLE": words(clean(drawing.title))})
    yield from file.lines
    yield "ENDSEC;\nEND-ISO-10303-21;\n"


# in what a colour is wrapped, to be that of a solid
STYLES = (
    *("FILL_AREA_STYLE_COLOUR('',{})", "FILL_AREA_STYLE('',({}))", "SURFACE_STYLE_FILL_AREA({})"),
    *("SURFACE_SIDE_STYLE('',({}))", "SURFACE_STYLE_USAGE(.BOTH.,{})"),
    "PRESENTATION_STYLE_ASSIGNMENT(({}))",
)


class _Products:
    """The products of one file; equal parts are one product in several places."""

    def __init__(self, file: Entities, whole: Part) -> None:
        self.file = file
        self.known: dict[Part, tuple[str, str]] = {}  # a part's definition and its shape
        self.styled: list[str] = []
        # behind the entities of the origin, #1 to #4
        _, _, self.context, self.design, *_, self.space = (
            file.add(text) for text in template("step_contexts.txt").splitlines()
        )
        self.product(whole)
        file.add(
            f"MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',{listed(self.styled)},"
            f"{self.space})"
        )

    def product(self, part: Part) -> tuple[str, str]:
        """The product of a part, written at its first use."""
        if part not in self.known:
            self.known[part] = self._group(part) if isinstance(part, Group) else self._solid(part)
        return self.known[part]

    def _solid(self, solid: Solid) -> tuple[str, str]:
        """The product of a solid, in its colour."""
        file, rgb = self.file, INKS[solid.layer].rgb
        body = shell_solid(file, solid) if isinstance(solid, Shell) else plate_solid(file, solid)
        parts = ",".join(real(value / 255.0, 6) for value in bytes.fromhex(rgb[1:]))
        style = file.shared(f"COLOUR_RGB('',{parts})")
        for outer in STYLES:
            style = file.shared(outer.format(style))
        self.styled.append(file.add(f"STYLED_ITEM('',({style}),{body})"))
        shape = f"ADVANCED_BREP_SHAPE_REPRESENTATION('',({file.origin},{body}),{self.space})"
        return self._defined(solid.name, shape)

    def _group(self, group: Group) -> tuple[str, str]:
        file = self.file
        parts = [self.product(member.part) for member in group.members]
        places = []
        for member in group.members:
            axis, ahead = POLE, (math.cos(member.turn), math.sin(member.turn), 0.0)
            if member.frame:
                ahead, _, axis = member.frame
            places.append(file.placement((*member.at, 0.0), axis, ahead))
        frames = listed(list(dict.fromkeys([file.origin, *places])))
        whole = self._defined(group.name, f"SHAPE_REPRESENTATION('',{frames},{self.space})")
        for i, (member, part, place) in enumerate(zip(group.members, parts, places, strict=True)):
            use = file.add(
                f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('{i + 1}',{words(member.part.name)},'',"
                f"{whole[0]},{part[0]},$)"
            )
            used = file.add(f"PRODUCT_DEFINITION_SHAPE('','',{use})")
            moved = file.add(f"ITEM_DEFINED_TRANSFORMATION('','',{file.origin},{place})")
            related = file.add(
                f"(REPRESENTATION_RELATIONSHIP('','',{part[1]},{whole[1]})"
                f"REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({moved})"
                "SHAPE_REPRESENTATION_RELATIONSHIP())"
            )
            file.add(f"CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({related},{used})")
        return whole

    def _defined(self, name: str, shape: str) -> tuple[str, str]:
        file, named = self.file, words(name)
        number = file.add(f"PRODUCT({named},{named},'',({self.context}))")
        file.add(f"PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({number}))")
        formation = file.add(f"PRODUCT_DEFINITION_FORMATION('','',{number})")
        definition = file.add(f"PRODUCT_DEFINITION('design','',{formation},{self.design})")
        shown = file.add(shape)
        whole = file.add(f"PRODUCT_DEFINITION_SHAPE('','',{definition})")
        file.add(f"SHAPE_DEFINITION_REPRESENTATION({whole},{shown})")
        return definition, shown
