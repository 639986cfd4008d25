"""DXF files of flat designs and of racks in a physics engine, Chipmunk: `tests/stress/jam.py`.

The engine is told nothing of where the wheel should be: its outline, read from the file, is a free
body on a pivot, or a rack's in a groove, moved by contact alone. Crank and rollers, from the other
file, are carried round as the design's own drive carries them, for two turns. The wheel must go
where the program says, off by no more than the play that the program says, and nothing may be
squeezed: that is a jam. A roller too large for its slot must be found to jam. `make jam` runs it,
ten minutes, and installs the engine (pymunk).
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

from geneva_cli.collisions.play import windows
from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.output import draw

TURNS = 2
STEPS = 7200  # a turn: a roller 50 mm from its axis goes 0.04 mm in one
CLEARANCE = 1e-3  # of the centre distance, in slot and lock, where the spec has none
# Of the centre distance: outlines are chains of round rods whose outer sides are the outline.
# Two of them are pushed apart the right way while their middles have not passed each other.
ROD = 1e-3
SAGITTA = 5e-5  # of the centre distance, between an arc and the rods' chords
SLOP = 1e-6  # of the centre distance, by which the engine lets bodies overlap in contact
LEFT = 0.5  # the share of an overlap that the engine leaves after a step
HEAVY = 1e15  # the wheel's mass to its inertia, 1: no push moves its axis, which is a pivot
# Parts that meet with some speed overlap by what they go in a step before the engine parts them:
# up to 1.8e-4 of the centre distance and 0.035 degrees in the designs.
SQUEEZED = 5e-4  # of the centre distance: no such overlap, but a jam
LOST = 0.05  # degrees beyond the play


def outlines(path, layer, flat):
    """The region inside of the closed curves on a layer, and its circles as (centre, radius)."""
    region, circles = shapely.Polygon(), []
    for entity in ezdxf.readfile(path).modelspace().query(f'*[layer=="{layer}"]'):
        if entity.dxftype() == "CIRCLE":
            circles.append(((entity.dxf.center.x, entity.dxf.center.y), entity.dxf.radius))
        points = [(p.x, p.y) for p in ezdxf.path.make_path(entity).flattening(flat)]
        region = region.symmetric_difference(shapely.Polygon(points))
    return region, circles


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


class Machine:
    """A design's two files as bodies of the engine."""

    def __init__(self, design, folder, larger=0.0):
        turns = design.spec.output.turns
        proof = design.drawn(0.001) if turns else design.parts_model
        self.play, self.found = proof.turn.play, proof.parts
        found = self.found
        self.assembly, self.L = found.assembly, found.assembly.L
        for part in ("wheel", "crank"):
            draw(design.drawing(part, of=proof), str(folder / f"{part}.dxf"))
        rod, flat = ROD * self.L, SAGITTA * self.L
        wheel, _ = outlines(folder / "wheel.dxf", "WHEEL", flat)
        crank, _ = outlines(folder / "crank.dxf", "CRANK", flat)
        _, circles = outlines(folder / "crank.dxf", "ROLLER", flat)
        radii = {}
        for centre, radius in circles:  # pins are on their layer too, within them
            radii[centre] = max(radius, radii.get(centre, 0.0))
        self.space = pymunk.Space()
        self.space.iterations = 20
        self.space.collision_slop = SLOP * self.L
        self.space.collision_bias = LEFT
        self.wheel = Turning() if turns else Sliding(self.L)
        self.space.add(self.wheel, *rods(self.wheel, wheel, rod), *self.wheel.joints(self.space))
        self.at = self.assembly.start_deg + self.assembly.turn_deg * np.arange(STEPS + 1) / STEPS
        self.true = self.assembly.wheel(self.at)
        self.each = sum(2.0 * engagement.half_step for engagement, _ in self.assembly.motions)
        rests = [w for w in windows(found) if w.rests and not found.crank]
        self.held = np.zeros(STEPS, dtype=bool)
        for dwell in rests:
            self.held |= (self.at[:-1] > dwell.start) & (self.at[1:] < dwell.end)
        meshed = self.assembly.geared(self.at)
        self.geared = meshed[:-1] | meshed[1:]
        self.wheel.put(float(self.true[0]), 0.0)
        self.carried = [self._carried(self.assembly.crank(self.at))]
        crank_body = self.carried[0][0]
        self.space.add(*rods(crank_body, crank, rod))
        assert len(radii) == len(self.assembly.rollers)
        for number, (centre, radius) in enumerate(radii.items()):
            way = self.assembly.pin(number, self.at) - (self.L, 0.0)
            if np.ptp(np.hypot(*way.T)) < 1e-9 * self.L:
                self.space.add(pymunk.Circle(crank_body, radius + larger, centre))
            else:  # what carries it is no part of the crank's file
                body, *_ = own = self._carried(np.zeros(len(way)), way)
                self.space.add(pymunk.Circle(body, radius + larger))
                self.carried.append(own)

    def _carried(self, angle, way=None):
        """A body that is carried: itself, its angles and its places at all steps of a turn."""
        body = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        self.space.add(body)
        places = np.zeros((len(angle), 2)) if way is None else way
        return body, np.unwrap(angle), places + np.array([self.L, 0.0])

    def _set(self, step):
        """Put what is carried at a step of a turn, on its way to the next."""
        for body, angle, place in self.carried:
            body.angle, body.position = angle[step], tuple(place[step])
            body.angular_velocity = angle[step + 1] - angle[step]
            body.velocity = tuple(place[step + 1] - place[step])

    def run(self, turns=TURNS):
        """The wheel's angles, radians, at all steps of some turns, and the deepest overlap, mm.

        What holds the wheel at rest where no locking disc does is in no file: it is held in place.
        Nor are a gear's teeth: it is turned where they turn it, and let go with its speed.
        """
        went, deepest = [], 0.0

        def deep(arbiter):
            nonlocal deepest
            found = min((p.distance for p in arbiter.contact_point_set.points), default=0.0)
            deepest = max(deepest, -found)

        for turn in range(turns):
            for step in range(STEPS):
                self._set(step)
                if self.held[step]:
                    self.wheel.put(self.place(turn, step), 0.0)
                if self.geared[step]:
                    speed = self.true[step + 1] - self.true[step]
                    self.wheel.put(self.place(turn, step), speed)
                self.space.step(1.0)
                went.append(self.wheel.place)
                self.wheel.each_arbiter(deep)
        return np.array(went), deepest

    def place(self, turn, step):
        """Where the program says that the wheel is, radians."""
        return self.true[step] + turn * self.each


def left_play(machine, play, went):
    """By how much the wheel left its play at most, degrees, and the input angle, degrees."""
    worst = (0.0, 0.0)
    for turn in range(len(went) // STEPS):
        true = machine.true[1:] + turn * machine.each
        off = np.degrees(went[turn * STEPS : (turn + 1) * STEPS] - true)
        # where the play was taken, the less of the two steps beside it: it may open all at once
        after = np.clip(np.searchsorted(machine.at[1:], play.input_deg), 1, STEPS - 1)
        for way, free in ((1.0, play.on), (-1.0, play.back)):
            out = np.minimum(way * off[after - 1], way * off[after]) - free
            i = int(np.argmax(out))
            worst = max(worst, (float(out[i]), float(play.input_deg[i])))
    return worst


def widened(path):
    """A design with clearances, and the settings that gave them."""
    size, L = load(str(path)).spec.size, load(str(path)).mechanism.center_distance_mm
    keys = ("slot_clearance_mm", "lock_clearance_mm")
    return load(
        str(path), [f"size.{key}={CLEARANCE * L:.9g}" for key in keys if not getattr(size, key)]
    )


def turned(path, folder):
    """What is wrong with a design's files, as a list of texts, and a line that says how it went."""
    design = widened(path)
    machine = Machine(design, folder)
    went, deepest = machine.run()
    out, at = left_play(machine, machine.play, went)
    limit = SQUEEZED * machine.L
    faults = []
    if deepest > limit:
        faults.append(f"squeezed by {deepest:.3g} mm")
    if out > LOST:
        faults.append(f"left its play by {out:.3g} deg at {at:.2f}")
    spare = machine.found.sizes.half_width - design.mechanism.roller_radius_mm
    if Machine(design, folder, spare + 2.0 * SQUEEZED * machine.L).run(1)[1] <= limit:
        faults.append("a roller that is too large for its slot was not found out")
    line = (
        f"{path.stem:24} {STEPS * TURNS} steps, {len(machine.space.shapes)} rods, "
        f"overlap {deepest / machine.L:.1e} L, play left by {out:.4f} deg at {at:.1f}"
    )
    return faults, line


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("designs", nargs="*", type=Path)
    given = parser.parse_args()
    bad = 0
    for path in given.designs or sorted(repo.DESIGNS.glob("*.toml")):
        try:
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
