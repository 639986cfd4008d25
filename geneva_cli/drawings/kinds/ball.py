"""The parts of spherical wheels: shells of a sphere, on shafts that meet at its centre."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from geneva_cli.drawings.kinds.kind import PartsKind
from geneva_cli.layout.missing import or_missing

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from geneva_cli.drawings.kinds.kind import Known, SharedParts
    from geneva_cli.kinematics.layout import Dimension
    from geneva_cli.layout.assembly import Assembly
    from geneva_cli.layout.missing import Missing
    from geneva_cli.layout.stressed import Stressed
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.parts.sphere.shells import Shells
    from geneva_cli.parts.sphere.sphere_parts import SphereParts


class Ball(PartsKind):
    """Shells about a point. Links and gears in front of the crank are flat."""

    HAS_FLAT_PARTS: ClassVar[bool] = True
    LAID_FLAT: ClassVar[tuple[str, ...]] = ("wheel", "crank", "arm")
    TABLES: ClassVar[Mapping[str, str]] = {"wheel": "layout.meridians:meridians_table"}
    DRAWN: ClassVar[Mapping[str, str]] = {
        "wheel": "drawings.sphere.drawings:wheel",
        "crank": "drawings.sphere.drawings:crank",
        "arm": "drawings.sphere.arm_drawing:arm",
        "assembly": "drawings.sphere.drawings:assembly",
        "sheet": "drawings.sphere.sheet:sheet",
    }

    def built(self, model: SharedParts) -> SphereParts:
        """Return the parts."""
        from geneva_cli.parts.sphere.sphere_parts import SphereParts

        return SphereParts(model.shells)

    def turned(self, model: SharedParts) -> Shells:
        """Return the shells."""
        return model.shells

    def known(self, model: SharedParts, assembly: Assembly) -> Known:
        """Return the shells with an assembly."""
        return None, model.shells.over(assembly)

    def dimensions(self, model: SharedParts) -> Iterator[Dimension | Missing]:
        """Yield the dimensions of the shells."""
        from geneva_cli.drawings.sphere.dimensions import dimensions

        return or_missing("dimensions of the shells", lambda: dimensions(self.built(model)))

    def stressed(self, mechanism: Mechanism) -> Stressed | None:
        """Return the sizes of stressed parts; None if the sizes leave no shells."""
        from geneva_cli.layout.sphere_sizes import sized_ball
        from geneva_cli.layout.sphere_stressed import sphere_stressed

        ball = sized_ball(mechanism)
        return sphere_stressed(mechanism.spec, ball) if ball else None
