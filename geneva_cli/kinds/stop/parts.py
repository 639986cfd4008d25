"""A Geneva stop: where the convex face in place of a recess blocks the locking disc.

The end of the disc, at rk from the crank's axis, meets the face, at ra from the wheel's, where

    cos gamma = (L² + rk² - ra²) / (2 L rk)

gamma being its angle at the crank's axis. The disc begins at the angle c from the roller: it meets
the face at a = c - gamma past mid-motion, and mirrored on the way back. So from stop to stop the
crank turns by 360° (z - 1) + 2 (c - gamma).
"""

import math
from collections.abc import Collection, Iterator
from contextlib import suppress
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.load_case import contact_modulus_GPa, hertz_MPa
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.spec.defaults import wheel_material
from geneva_cli.verdict.checks import Check, compared
from geneva_cli.verdict.quantities.groups import Values


class WheelStop(NamedTuple):
    """Both stops of a crank: input angles from the middle of its first engagement, degrees."""

    first_deg: float
    last_deg: float
    lever_mm: float  # of the force between disc and face about the crank's axis
    face_mm: float  # along the face, from the contact to the nearer mouth; negative in the mouth
    overlap_mm: float  # of the circles of disc and face, if nothing stopped them
    crank_deg: float  # of the crank at its last stop, from the middle of that engagement
    # under ``winding_torque_Nm``, between disc and face; None without a key that they need
    force_N: float | None
    contact_stress_MPa: float | None

    @property
    def turns(self) -> float:
        """Turns of the input from stop to stop."""
        return (self.last_deg - self.first_deg) / 360.0


def wheel_stop(outlines: Outlines) -> WheelStop | None:
    """Return the stops of a wheel with a convex face; None without one.

    The face is an arc about the wheel's axis. So the force between the end of the disc and the face
    passes through that axis, turns no wheel, and loads no roller. About the crank's axis its lever
    is h = L sin delta, where delta is the contact's direction from the line of centres, seen from
    the wheel's axis: F = T/h. A sharp end of the disc has no Hertz stress.
    """
    assembly, sizes, spec = outlines.assembly, outlines.sizes, outlines.assembly.full.spec
    z, size, torque = spec.wheel.z, spec.size, spec.load.winding_torque_Nm
    if not spec.wheel.stopped:
        return None
    L, rk, ra = assembly.L, sizes.lock, sizes.rim
    gamma = math.acos((L * L + rk * rk - ra * ra) / (2.0 * L * rk))
    ends = [piece.start for contour in outlines.crank for piece in contour.segments]
    on_disc = [p for p in ends if abs(math.hypot(*p) - rk) < SAME_LENGTH * L]
    crank = min(abs(math.atan2(y, x)) for x, y in on_disc) - gamma
    delta = math.asin(rk * math.sin(gamma) / ra)  # of the contact, from the line of centres
    from_middle = math.pi / z - delta - float(assembly.wheel(np.array([math.degrees(crank)]))[0])
    half_face = math.pi / z - math.asin(sizes.half_width / ra)
    last = assembly.to_input(math.degrees(crank))
    stops = assembly.to_input(-math.degrees(crank)), 360.0 * (z - 1) + last
    lever = L * math.sin(delta)
    lengths = lever, ra * (half_face - abs(from_middle)), rk + ra - L
    force = None if torque is None else 1e3 * torque / lever
    stress, width, edge = None, size.face_width_mm, size.lock_edge_mm
    if not (force is None or width is None or edge is None):
        material = wheel_material(spec)
        modulus = contact_modulus_GPa(material, material)
        stress = hertz_MPa(modulus, force / width, 1.0 / (1.0 / edge + 1.0 / ra))
    return WheelStop(*stops, *lengths, math.degrees(crank), force, stress)


def clearances_before(outlines: Outlines, stop: WheelStop, past_deg: float = 0.0) -> Array:
    """Return the gaps of disc and face, mm (2, n), up to either stop and a little past it."""
    assembly = outlines.assembly
    parts = Gaps(assembly, outlines.sizes, outlines.wheel, outlines.crank)
    z = assembly.full.spec.wheel.z
    turns = np.array([-(z // 2), z - 1 - z // 2])  # of the two engagements, in the drawings
    before_deg = np.linspace(stop.crank_deg - 180.0, stop.crank_deg + past_deg, 361)
    at = 360.0 * turns[:, None] + np.array([[-1.0], [1.0]]) * before_deg
    return parts.locking(parts.pose(at.ravel())).reshape(at.shape)


def stop(parts: Parts) -> Values:
    """Return the quantities of the stops of a crank, where the wheel has a convex face."""
    spec, stops = parts.mechanism.spec, None
    with suppress(GenevaError):  # ``parts.none`` gives the reason
        stops = wheel_stop(parts.outlines) if spec.is_flat else None
    names = "turns first_deg last_deg overlap_mm lever_mm force_N contact_stress_MPa"
    return {name: getattr(stops, name) for name in names.split()} if stops else {}


def standing(names: Collection[str], parts: FlatParts) -> Iterator[Check]:
    """The stop: its turns, the overlap of disc and face, and their Hertz stress if bounded.

    The turns are those from stop to stop: nothing touches before, and a degree beyond parts
    overlap. Disc and face overlap so far that wear does not free the crank.
    """
    stop = wheel_stop(parts.outlines) if parts.mechanism.spec.is_flat else None
    if stop is None:
        return
    outlines, z = parts.outlines, parts.mechanism.spec.wheel.z
    if "stop_turns" in names:
        before = float(clearances_before(outlines, stop).min())
        beyond = float(clearances_before(outlines, stop, past_deg=1.0)[:, -1].max())
        passes = stop.face_mm >= 0.0 and before >= -parts.contact >= beyond
        text = f"the face blocks the crank at {stop.first_deg:.4g} and {stop.last_deg:.6g}° from "
        text += f"the middle of its first engagement: {stop.turns:.4f} turns"
        if not passes:
            text = f"disc and wheel are {before:.4g} mm apart before the stop, and {beyond:.4g} mm "
            text += f"a degree beyond; the mouth of a slot is {stop.face_mm:.4g} mm away on the "
            text += "face"
        yield Check("stop_turns", stop.turns, "at most", float(z), passes, text)
    yield compared("stop_overlap_mm", stop.overlap_mm, "at least", outlines.sizes.wall_min)
    limit, stress = parts.mechanism.spec.limits.stop_stress_max_MPa, stop.contact_stress_MPa
    if limit is not None:
        why = "not known: it needs lock_edge_mm in [size], for a sharp end has no stress, and "
        why += "winding_torque_Nm"
        yield compared("stop_stress_max_MPa", stress, "at most", limit, why=why)
