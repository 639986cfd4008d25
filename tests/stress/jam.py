"""DXF files of flat designs and racks in a physics engine, Chipmunk: `make jam`.

The engine does not know the wheel's motion. The wheel's outline, read from the file, is a free body
on a pivot, or a rack's in a groove, which contact alone moves. Crank and rollers, from the other
file, move as the design's drive moves them, for two turns; each of several cranks from its own
place. The wheel's angle must be that of the program, within the program's play, and no parts may be
squeezed, which is a jam. A roller too large for its slot must jam. `make jam` installs the engine
(pymunk); ten minutes.
"""

import argparse
import math
import sys
import tempfile
from pathlib import Path

import ezdxf
import ezdxf.path
import numpy as np
import pymunk
import repo
import shapely

from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.output import draw
from geneva_cli.parts.turn.turned_parts import play_of, windows

TURNS = 2
STEPS = 7200  # a turn: a roller 50 mm from its axis moves 0.04 mm in one
CLEARANCE = 1e-3  # of the centre distance, in slot and lock, where the spec has none
# Of the centre distance: outlines are chains of round rods whose outer sides are the outline.
# Two of them are pushed apart the right way while their middles have not passed each other.
ROD = 1e-3
SAGITTA = 5e-5  # of the centre distance, between an arc and the rods' chords
SLOP = 1e-6  # of the centre distance, by which the engine lets bodies overlap in contact
LEFT = 0.5  # the fraction of an overlap that the engine leaves after a step
HEAVY = 1e15  # the wheel's mass to its inertia, 1: no push moves its axis, which is a pivot
# Parts that meet at some speed overlap by their travel in a step before the engine parts them:
# up to 1.8e-4 of the centre distance and 0.035 degrees in the designs.
SQUEEZED = 5e-4  # of the centre distance: a larger overlap is a jam
LOST = 0.05  # degrees beyond the play


def outlines(path, layer, flat):
    """The region inside the closed curves on a layer, and its circles as (centre, radius)."""
    region = shapely.Polygon()
    for inside in contours(path, layer, flat):
        region = region.symmetric_difference(inside)
    circles = ezdxf.readfile(path).modelspace().query(f'CIRCLE[layer=="{layer}"]')
    return region, [((c.dxf.center.x, c.dxf.center.y), c.dxf.radius) for c in circles]


def contours(path, layer, flat):
    """The inside of each closed curve on a layer."""
    for entity in ezdxf.readfile(path).modelspace().query(f'*[layer=="{layer}"]'):
        yield shapely.Polygon([(p.x, p.y) for p in ezdxf.path.make_path(entity).flattening(flat)])


def rods(body, region, rod):
    """The edge of a region as rods, which lie within it."""
    inside = region.buffer(-rod, join_style="mitre")
    for polygon in getattr(inside, "geoms", [inside]):
        for ring in (polygon.exterior, *polygon.interiors):
            points = list(ring.coords)
            for a, b in zip(points, points[1:], strict=False):
                yield pymunk.Segment(body, a, b, rod)


class Turning(pymunk.Body):
    """A wheel: a heavy body of inertia 1, whose axis no push moves, with its angle in radians."""

    def __init__(self):
        super().__init__(HEAVY, 1.0)

    def joints(self, space):
        """None: the mass holds the axis."""
        return ()

    @property
    def place(self):
        return self.angle

    def put(self, place, speed):
        self.angle, self.angular_velocity = place, speed


class Sliding(pymunk.Body):
    """A rack of mass 1 that slides along y, with its travel over the crank's radius."""

    def __init__(self, radius):
        super().__init__(1.0, math.inf)
        self.radius = radius

    def joints(self, space):
        """The groove along y."""
        far = 100.0 * self.radius  # beyond some turns' travel
        yield pymunk.GrooveJoint(space.static_body, self, (0.0, -far), (0.0, far), (0.0, 0.0))

    @property
    def place(self):
        return self.position.y / self.radius

    def put(self, place, speed):
        self.position, self.velocity = (0.0, place * self.radius), (0.0, speed * self.radius)


class Simulation:
    """Bodies of the engine: a free wheel, and bodies with given motions."""

    def __init__(self, L, wheel, at, true):
        """``at`` are the input angles of a turn's steps, ``true`` the wheel's, radians."""
        self.L, self.wheel, self.at, self.true = L, wheel, at, true
        self.held = self.geared = np.zeros(STEPS, dtype=bool)
        self.carried = []
        self.space = pymunk.Space()
        self.space.iterations = 20
        self.space.collision_slop = SLOP * L
        self.space.collision_bias = LEFT
        self.space.add(wheel, *wheel.joints(self.space))

    def carry(self, angle, place):
        """Add a body with its angles and its places, mm, at all steps of a turn, and return it."""
        body = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self.space.add(body)
        self.carried.append((body, np.unwrap(angle), np.zeros((len(angle), 2)) + place))
        return body

    def outline(self, body, region):
        """Add the outline of a part."""
        self.space.add(*rods(body, region, ROD * self.L))

    def _set(self, step):
        """Place the carried bodies at a step of a turn, with their speeds to the next."""
        for body, angle, place in self.carried:
            body.angle, body.position = angle[step], tuple(place[step])
            body.angular_velocity = angle[step + 1] - angle[step]
            body.velocity = tuple(place[step + 1] - place[step])

    def run(self, turns=TURNS):
        """The wheel's angles, radians, at all steps of some turns, and the deepest overlap, mm.

        Without a locking disc no file has the part that holds the wheel at rest: it is held in
        place. No file has the teeth of gears: the wheel is turned where they turn it, and released
        with its speed.
        """
        self.wheel.put(float(self.true[0]), 0.0)
        angles, deepest = [], 0.0

        def deep(arbiter):
            nonlocal deepest
            gap = min((p.distance for p in arbiter.contact_point_set.points), default=0.0)
            deepest = max(deepest, -gap)

        for turn in range(turns):
            for step in range(STEPS):
                self._set(step)
                if self.held[step]:
                    self.wheel.put(self.place(turn, step), 0.0)
                if self.geared[step]:
                    speed = self.true[step + 1] - self.true[step]
                    self.wheel.put(self.place(turn, step), speed)
                self.space.step(1.0)
                angles.append(self.wheel.place)
                self.wheel.each_arbiter(deep)
        return np.array(angles), deepest

    def place(self, turn, step):
        """The wheel's angle by the program, radians."""
        return self.true[step] + turn * self.each

    @property
    def each(self):
        """The wheel's angle in each turn, radians."""
        return self.true[-1] - self.true[0]


def cranked(design, folder, larger=0.0):
    """A simulation of the files of a wheel or rack and its cranks, with larger rollers.

    Returns its play as well.
    """
    turns = design.spec.output.turns
    proof = design.parts
    assembly, L = proof.assembly, proof.assembly.L
    for part in ("wheel", "crank"):
        draw(design.drawing(part), str(folder / f"{part}.dxf"))
    wheel, _ = outlines(folder / "wheel.dxf", "WHEEL", SAGITTA * L)
    crank, _ = outlines(folder / "crank.dxf", "CRANK", SAGITTA * L)
    _, circles = outlines(folder / "crank.dxf", "ROLLER", SAGITTA * L)
    radii = {}
    for centre, radius in circles:  # pins are on their layer too, within them
        radii[centre] = max(radius, radii.get(centre, 0.0))
    at = assembly.start_deg + assembly.turn_deg * np.arange(STEPS + 1) / STEPS
    out = Simulation(L, Turning() if turns else Sliding(L), at, assembly.wheel(at))
    out.outline(out.wheel, wheel)
    for window in windows(proof):
        if window.rests and not proof.locked:
            out.held |= (at[:-1] > window.start) & (at[1:] < window.end)
    meshed = assembly.geared(at)
    out.geared = meshed[:-1] | meshed[1:]
    cranks = [
        out.carry(place.turn + assembly.crank(at - place.behind_deg), place.at)
        for place in design.mechanism.crank_places
    ]
    for body in cranks:
        out.outline(body, crank)
    assert len(radii) * len(cranks) == len(assembly.rollers)
    for number, (centre, radius) in enumerate(radii.items()):
        path = assembly.pin(number, at)
        if np.ptp(np.hypot(*(path - (L, 0.0)).T)) < 1e-9 * L:
            out.space.add(*(pymunk.Circle(body, radius + larger, centre) for body in cranks))
        else:  # the crank's file lacks the part that carries it
            body = out.carry(np.zeros(len(path)), path)
            out.space.add(pymunk.Circle(body, radius + larger))
    return out, play_of(proof, proof.turn.smallest.mm >= -proof.close)[0]


def beyond_play(machine, play, angles):
    """The wheel's greatest error beyond its play, and the input angle, degrees."""
    worst = (0.0, 0.0)
    for turn in range(len(angles) // STEPS):
        true = machine.true[1:] + turn * machine.each
        off = np.degrees(angles[turn * STEPS : (turn + 1) * STEPS] - true)
        # the lesser of the two steps beside a sampled play, as it may open suddenly
        after = np.clip(np.searchsorted(machine.at[1:], play.input_deg), 1, STEPS - 1)
        for way, free in zip((-1.0, 1.0), play.ways, strict=True):
            out = np.minimum(way * off[after - 1], way * off[after]) - free
            i = int(np.argmax(out))
            worst = max(worst, (float(out[i]), float(play.input_deg[i])))
    return worst


def widened(path):
    """A design with clearances, from the spec or else of ``CLEARANCE``."""
    size, L = load(str(path)).spec.size, load(str(path)).mechanism.center_distance_mm
    keys = ("slot_clearance_mm", "lock_clearance_mm")
    return load(
        str(path), [f"size.{key}={CLEARANCE * L:.9g}" for key in keys if not getattr(size, key)]
    )


def turned(path, folder):
    """Return the faults of a design's files as a list of texts, and a line with the results."""
    design = widened(path)
    spare = design.parts.sizes.half_width - design.mechanism.roller_radius_mm
    machine, play = cranked(design, folder)
    angles, deepest = machine.run()
    out, at = beyond_play(machine, play, angles)
    limit = SQUEEZED * machine.L
    faults = []
    if deepest > limit:
        faults.append(f"squeezed by {deepest:.3g} mm")
    if out > LOST:
        faults.append(f"left its play by {out:.3g} deg at {at:.2f}")
    if cranked(design, folder, spare + 2.0 * limit)[0].run(1)[1] <= limit:
        faults.append("a roller that is too large did not jam")
    line = (
        f"{path.stem:24} {STEPS * TURNS} steps, {len(machine.space.shapes)} rods, "
        f"overlap {deepest / machine.L:.1e} L, play left by {out:.4f} deg at {at:.1f}"
    )
    return faults, line


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("designs", nargs="*", type=Path)
    options = parser.parse_args()
    bad = 0
    for path in options.designs or sorted(repo.DESIGNS.glob("*.toml")):
        try:
            if load(str(path)).spec.wheel.NAME == "spherical":  # which no engine of the plane has
                raise GenevaError("its parts turn on a sphere")
            with tempfile.TemporaryDirectory() as folder:
                faults, line = turned(path, Path(folder))
        except GenevaError as error:
            print(f"{path.stem:24} not drawn: {error}")
            continue
        bad += bool(faults)
        print(line, *faults, sep="; ", flush=True)
    print(f"{bad} jam")
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
