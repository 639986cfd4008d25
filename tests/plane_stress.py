"""A horn of a Geneva wheel in plane stress, by finite elements: a witness of its beam formula.

The body between two neighbouring slots, seen from the centre of the recess between them: on every
ray it begins at the recess and ends at a slot's wall, or at the line between the slots' ends, where
it is held. Quadratic quadrilaterals on those rays, by scikit-fem. Lengths in millimetres, forces in
newtons on 1 mm of width. Imports nothing of the program.
"""

import math

import numpy as np
import skfem
from skfem.helpers import ddot, eye, sym_grad, trace
from skfem.models.elasticity import lame_parameters


def horn(wall, recess, depth, opening, beyond, fine=1):
    """Stress along a straight slot's wall, inwards of the mouth, for a force of 1 N at the mouth.

    ``wall`` is the distance of the slot's wall from the recess's centre, ``recess`` its radius,
    ``depth`` the slot's from the mouth, ``opening`` the angle at that centre between the feet of
    both slots, ``beyond`` how far the horn goes out past the mouth. Returns places, stresses along
    the wall there, and the deflection of the mouth.
    """
    s = np.linspace(-beyond, depth, 2001)
    return along(np.array([s, 0.0 * s + wall]), recess, opening, fine)


def along(wall, recess, opening, fine=1):
    """The result of ``horn`` for any wall: points (2, n) from past the mouth to the slot's end.

    The recess's centre is the origin, the mouth at (0, y), and the wall runs inwards along x there;
    the wall of the next slot is its image in the ray in the middle. From the recess's centre each
    ray meets it once.
    """
    turn, far = np.arctan2(*wall), np.hypot(*wall)
    assert np.all(np.diff(turn) > 0.0)
    first, corner = turn[0], turn[-1]
    half = np.concatenate(
        (
            np.linspace(first, -first, 8 * fine + 1)[:-1],
            np.linspace(-first, corner, 24 * fine + 1)[:-1],
            np.linspace(corner, opening / 2.0, 6 * fine + 1),
        )
    )
    ray = np.concatenate((half, opening - half[-2::-1]))
    # the outer boundary on each ray: wall, chord between the ends, other wall
    middle = opening / 2.0
    chord = far[-1] * math.cos(middle - corner)
    near = np.minimum(ray, opening - ray)
    out = np.where(near <= corner + 1e-12, np.interp(near, turn, far), chord / np.cos(ray - middle))
    deep = np.linspace(0.0, 1.0, 7)  # twenty elements change the stress by 2e-4
    r = recess + (out - recess)[:, None] * deep
    x, y = r * np.sin(ray)[:, None], r * np.cos(ray)[:, None]
    n, m = x.shape
    number = np.arange(n * m).reshape(n, m)
    quads = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]).reshape(
        4, -1
    )
    mesh = skfem.MeshQuad(np.stack([x.ravel(), y.ravel()]), quads)
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementQuad2()), intorder=5)
    lam, mu = lame_parameters(210e3, 0.3)
    lam = 2.0 * lam * mu / (lam + 2.0 * mu)  # plane stress

    def stress(e):
        return lam * eye(trace(e), 2) + 2.0 * mu * e

    @skfem.BilinearForm
    def stiffness(u, v, _):
        return ddot(stress(sym_grad(u)), sym_grad(v))

    K = stiffness.assemble(basis)
    low, high = ray[0], -ray[0]  # the roller presses evenly about the mouth

    def on_wall(x, a, b):
        at = np.arctan2(x[0], x[1])
        there = np.interp(at, turn, far)
        return (abs(np.hypot(x[0], x[1]) / there - 1.0) < 1e-4) & (at > a) & (at < b)

    pressed = mesh.facets_satisfying(lambda x: on_wall(x, low, high), boundaries_only=True)
    held = mesh.facets_satisfying(
        lambda x: abs(x[0] * math.sin(middle) + x[1] * math.cos(middle) - chord) < 1e-9 * chord,
        boundaries_only=True,
    )
    face = skfem.FacetBasis(mesh, basis.elem, facets=pressed, intorder=5)
    long = 2.0 * np.interp(0.0, turn, far) * math.tan(high)

    @skfem.LinearForm
    def push(v, _):
        return -v[1] / long

    f = push.assemble(face)
    u = skfem.solve(*skfem.condense(K, f, D=basis.get_dofs(held)))
    # the stress along the wall, in the middle of each of its facets
    side = mesh.facets_satisfying(lambda x: on_wall(x, low, corner), boundaries_only=True)
    on = skfem.FacetBasis(mesh, basis.elem, facets=side, quadrature=(np.array([[0.5]]), np.ones(1)))
    tensor = stress(sym_grad(on.interpolate(u)))[..., 0]
    s = on.default_parameters()["x"][0][:, 0]
    tx, ty = -on.normals[1][:, 0], on.normals[0][:, 0]
    along_wall = tensor[0, 0] * tx * tx + 2.0 * tensor[0, 1] * tx * ty + tensor[1, 1] * ty * ty
    order = np.argsort(s)
    return s[order], along_wall[order], abs(float(f @ u))
