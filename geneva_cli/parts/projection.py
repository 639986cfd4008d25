"""Lists of parts: which are alike, which cannot be built, and what a drawing shows of them."""

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple, TypeVar

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Member, Part, Shell, Solid, in_place, solids
from geneva_cli.geometry.shapes import Circle, Shape
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.motion.mechanism import Mechanism


def alike(parts: Iterable[Part]) -> list[list[Solid]]:
    """Return the solids of some parts: a list for each kind, also at different heights."""
    kinds: dict[tuple[object, object], list[Solid]] = {}
    for solid in (one for part in parts for one in solids(part)):
        if isinstance(solid, Shell):
            # shells of one kind lie at different places, and may differ by rounding
            kind: tuple[object, object] = solid.name, f"{solid.volume:.9g}"
        else:
            # thicknesses are differences of heights: to a nanometre
            kind = solid._replace(low=0.0, high=0.0), round(solid.thickness, 6)
        kinds.setdefault(kind, []).append(solid)
    return list(kinds.values())


T = TypeVar("T")


class Missing(NamedTuple):
    """An omitted entry of a list: its name and the reason."""

    name: str
    why: str


def or_missing(name: str, listed: Callable[[], Iterable[T]]) -> Iterator[T | Missing]:
    """Yield the listed rows; if they cannot be built, the name and the reason instead."""
    missing = list[Missing]()
    yield from built_of([(name, listed)], missing)
    yield from missing


def built_of(
    named: Iterable[tuple[str, Callable[[], Iterable[T]]]], missing: list[Missing]
) -> Iterator[T]:
    """Yield what can be built; add the others to ``missing``, once for each reason."""
    failed: dict[str, list[str]] = {}
    for name, build in named:
        try:
            some = list(build())
        except GenevaError as error:
            failed.setdefault(str(error), []).append(name)
            continue
        yield from some
    missing += [Missing(", ".join(names), why) for why, names in failed.items()]


# in the order of a drawing
LAYERS = (
    *("WHEEL", "CRANK", "ARM", "LINK", "FRAME", "GROOVE"),
    *("PITCH", "ROLLER", "BORE", "HUB", "SHAFT"),
)


def titled(mechanism: Mechanism, part: str = "") -> str:
    """Return the title of a machine's drawings, or of one part's."""
    spec = mechanism.spec
    title = spec.title or spec.wheel.title
    return f"{title}: {part}" if part else title


def outlines_of(part: Part) -> tuple[Shape, ...]:
    """Return the outlines and holes of a part in its own frame, each once, layer by layer."""
    # layer by layer, and contours before circles
    own = once(shapes([Member(part)]))
    return tuple(sorted(own, key=lambda one: (LAYERS.index(one.layer), isinstance(one, Circle))))


def drawing_of(mechanism: Mechanism, part: str, solid: Part) -> Drawing:
    """Return the drawing of a part in its own frame, under its name."""
    return Drawing(titled(mechanism, part), outlines_of(solid), solid=solid)


def shapes(members: Iterable[Member]) -> Iterator[Shape]:
    """Yield the outlines and holes of plates at their positions."""
    for _, plate in in_place(members):
        yield from (plate.outline, *plate.holes)


def with_frame(moving: Iterable[Shape], standing: Iterable[Member]) -> tuple[Shape, ...]:
    """Return shapes of moving parts, and of the frame what they do not cover, each once.

    A hole of the frame is left out where a circle is drawn already.
    """
    drawn = list(moving)
    seen = {_key(shape) for shape in drawn if isinstance(shape, Circle)}
    for shape in shapes(standing):
        if _key(shape) not in seen:
            drawn.append(shape._replace(layer="FRAME") if isinstance(shape, Circle) else shape)
    return tuple(once(drawn))


def once(shapes: Iterable[Shape]) -> Iterator[Shape]:
    """Yield shapes without those of one layer that coincide; circles coincide to 1e-6 mm."""
    seen = set()
    for shape in shapes:
        key = shape.layer, _key(shape)
        if key not in seen:
            seen.add(key)
            yield shape


def _key(shape: Shape) -> Shape | tuple[float, ...]:
    """Return what equal shapes share: of circles centre and radius, rounded to 1e-6 mm."""
    if not isinstance(shape, Circle):
        return shape
    return tuple(round(value, 6) for value in (*shape.centre, shape.radius))
