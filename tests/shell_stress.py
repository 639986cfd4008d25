"""A horn of a spherical wheel in three dimensions, by finite elements: a witness of its beam.

The body between two neighbouring slots, in rays from the crank's axis: each begins at the recess
and ends at a slot's wall, or at the great circle between the slots' ends, where it is held.
Quadratic hexahedra on those rays and through the shell, by scikit-fem. Angles in radians, lengths
in millimetres, forces in newtons. Imports nothing of the program.
"""

import math

import numpy as np
import skfem
from skfem.helpers import ddot, eye, sym_grad, trace
from skfem.models.elasticity import lame_parameters


def horn(radius, thick, axes, half_step, w, recess, polar, beyond):
    """Polar angles along a slot's wall, and the von Mises stress there, for 1 N at the mouth.

    ``thick`` is the shell's thickness, ``w`` half the slot's width, ``recess`` the angle of the
    recess from the crank's axis, and ``polar`` are the polar angles of the mouth and of the slot's
    end. The horn goes past the mouth by ``beyond``. The stress is the greatest through the shell.
    """
    mouth, end = polar
    crank = np.array(
        [math.sin(axes) * math.cos(half_step), math.sin(axes) * math.sin(half_step), math.cos(axes)]
    )
    inwards = np.array([0.0, 0.0, 1.0]) - crank[2] * crank  # from the crank's axis to the wheel's
    inwards /= np.linalg.norm(inwards)
    beside = np.cross(inwards, crank)

    def seen(p):
        """Turns about the crank's axis from the wheel's, and angles from it."""
        return abs(np.arctan2(beside @ p, inwards @ p)), np.arccos(crank @ p)

    t = np.linspace(mouth + beyond, end, 8001)
    c, zero = math.cos(w), 0.0 * t
    wall = np.array([c * np.sin(t), math.sin(w) + zero, c * np.cos(t)])
    last = wall[:, -1]
    share = np.linspace(0.0, 0.5, 2001)
    mirrored = last - 2.0 * (beside @ last) * beside
    chord = last[:, None] * (1.0 - share) + mirrored[:, None] * share
    chord /= np.linalg.norm(chord, axis=0)
    edges = [seen(part) for part in (wall, chord)]
    assert np.all(np.diff(edges[0][0]) < 0.0)
    past, corner = edges[0][0][0], edges[0][0][-1]
    first = np.interp(-mouth, -t, edges[0][0])
    before = 2.0 * first - past
    half = np.concatenate(
        (
            np.linspace(past, before, 3)[:-1],
            np.linspace(before, corner, 23)[:-1],
            np.linspace(corner, 0.0, 5),
        )
    )
    turns = np.concatenate((half, -half[-2::-1]))
    far = np.interp(
        -abs(turns),
        -np.concatenate([turn for turn, _ in edges]),
        np.concatenate([angle for _, angle in edges]),
    )
    deep, layers = np.linspace(0.0, 1.0, 4), np.linspace(-0.5, 0.5, 3)
    r = (recess + (far - recess)[:, None] * deep)[..., None]
    side = 1.0 if beside @ last > 0.0 else -1.0
    away = np.cos(turns)[:, None] * inwards + np.sin(turns)[:, None] * side * beside
    p = np.cos(r) * crank + np.sin(r) * away[:, None]
    nodes = p[:, :, None] * (radius + thick * layers)[:, None]
    n, m, k, _ = nodes.shape
    number = np.arange(n * m * k).reshape(n, m, k)
    low, high = slice(None, -1), slice(1, None)
    # the corners of a hexahedron in scikit-fem's order
    order = ("000", "001", "010", "100", "011", "101", "110", "111")
    hexes = [number[tuple(high if i == "1" else low for i in at)].ravel() for at in order]
    mesh = skfem.MeshHex(np.ascontiguousarray(nodes.reshape(-1, 3).T), np.stack(hexes))
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementHex2()), intorder=4)
    lam, mu = lame_parameters(210e3, 0.3)

    def stress(e):
        return lam * eye(trace(e), 3) + 2.0 * mu * e

    @skfem.BilinearForm
    def stiffness(u, v, _):
        return ddot(stress(sym_grad(u)), sym_grad(v))

    def on_wall(x, low, high):
        at = np.arctan2(x[0], x[2])
        beside_it = np.arcsin(x[1] / np.sqrt((x**2).sum(axis=0)))
        return (abs(beside_it - w) < 1e-3 * w) & (at > low) & (at < high)

    pressed = mesh.facets_satisfying(
        lambda x: on_wall(x, mouth - beyond, mouth + beyond), boundaries_only=True
    )
    normal = np.cross(last, mirrored)
    normal /= np.linalg.norm(normal)
    held = mesh.facets_satisfying(
        lambda x: abs(normal @ x) < 1e-3 * radius * (1.0 - abs(math.cos(corner))) + 1e-6,
        boundaries_only=True,
    )
    face = skfem.FacetBasis(mesh, basis.elem, facets=pressed, intorder=4)
    area = float(face.dx.sum())
    across = np.array([-math.sin(w) * math.sin(mouth), math.cos(w), -math.sin(w) * math.cos(mouth)])

    @skfem.LinearForm
    def push(v, _):
        return sum(across[i] * v[i] for i in range(3)) / area

    K, f = stiffness.assemble(basis), push.assemble(face)
    u = skfem.solve(*skfem.condense(K, f, D=basis.get_dofs(held)))
    along = mesh.facets_satisfying(lambda x: on_wall(x, end, mouth + beyond), boundaries_only=True)
    grid = np.array([[a, b] for a in (0.0, 0.5, 1.0) for b in (0.0, 0.5, 1.0)]).T
    on = skfem.FacetBasis(mesh, basis.elem, facets=along, quadrature=(grid, np.ones(9)))
    s = stress(sym_grad(on.interpolate(u)))
    part = s - trace(s) / 3.0 * np.eye(3)[..., None, None]
    mises = np.sqrt(1.5 * (part**2).sum(axis=(0, 1)))
    x = on.default_parameters()["x"]
    at = np.arctan2(x[0], x[2]).mean(axis=1)
    return at, mises.max(axis=1)
