"""How the shells of a sphere are built, drawn, turned and measured."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, ClassVar

from geneva_cli.drawings.model import PartsKind, PartsModel, before_links
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Dimension
from geneva_cli.parts.missing import Missing, or_missing

if TYPE_CHECKING:
    from geneva_cli.drawings.model import NamedBuilds
    from geneva_cli.kinds.spherical.parts import SphereParts
    from geneva_cli.kinds.spherical.shells import Shells
    from geneva_cli.parts.sizes.stressed import Stressed


class Ball(PartsKind):
    """Shells of a sphere, on shafts that meet at its centre; links and gears before it are flat."""

    HAS_FLAT_PARTS: ClassVar[bool] = True
    TURNED: ClassVar[str] = "shells"
    LAID_FLAT: ClassVar[tuple[str, ...]] = ("wheel", "crank", "arm")
    TABLES: ClassVar[Mapping[str, str]] = {"wheel": "kinds.spherical.meridians:meridians_table"}
    DRAWN: ClassVar[Mapping[str, str]] = {
        "wheel": "kinds.spherical.drawings:wheel",
        "crank": "kinds.spherical.drawings:crank",
        "arm": "kinds.spherical.arm_drawing:arm",
        "assembly": "kinds.spherical.drawings:assembly",
        "sheet": "kinds.spherical.sheet:sheet",
    }

    def built(self, model: PartsModel) -> SphereParts:
        """Return the parts."""
        from geneva_cli.kinds.spherical.parts import SphereParts

        return SphereParts(model.shells)

    def turned(self, model: PartsModel) -> Shells:
        """Return the shells."""
        return model.shells

    def all_built(self, model: PartsModel) -> NamedBuilds:
        """Return names and functions of the shells, and of links and gears."""
        return before_links(model)

    def dimensions(self, model: PartsModel) -> Iterator[Dimension | Missing]:
        """Yield the dimensions of the shells."""
        from geneva_cli.kinds.spherical.dimensions import dimensions

        return or_missing("dimensions of the shells", lambda: dimensions(self.built(model)))

    def stressed(self, mechanism: Mechanism) -> Stressed | None:
        """Return the sizes of stressed parts; None if the sizes leave no shells."""
        from geneva_cli.kinds.spherical.sizes import sized_ball
        from geneva_cli.kinds.spherical.stressed import sphere_stressed

        ball = sized_ball(mechanism)
        return sphere_stressed(mechanism.spec, ball) if ball else None
