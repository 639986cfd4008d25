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


def horn(wall, recess, depth, opening, beyond, E=210e3, nu=0.3, fine=1):
    """Stress along the slot's wall, inwards of the mouth, for a force of 1 N at the mouth.

    ``wall`` is the distance of the slot's wall from the recess's centre, ``recess`` its radius,
    ``depth`` the slot's from the mouth, ``opening`` the angle at that centre between the feet of
    both slots, ``beyond`` how far the horn goes out past the mouth. Returns places, stresses along
    the wall there, and the deflection of the mouth.
    """
    corner = math.atan2(depth, wall)
    first = -math.atan2(beyond, wall)
    half = np.concatenate(
        (
            np.linspace(first, -first, 8 * fine + 1)[:-1],
            np.linspace(-first, corner, 24 * fine + 1)[:-1],
            np.linspace(corner, opening / 2.0, 6 * fine + 1),
        )
    )
    ray = np.concatenate((half, opening - half[-2::-1]))
    # the outer boundary on each ray: the nearest of wall, chord between the ends, other wall
    middle = opening / 2.0
    chord = math.hypot(depth, wall) * math.cos(middle - corner)
    out = np.empty_like(ray)
    for i, a in enumerate(ray):
        near = min(a, opening - a)
        out[i] = wall / math.cos(near) if near <= corner + 1e-12 else chord / math.cos(a - middle)
    deep = np.linspace(0.0, 1.0, 10 * fine + 1)
    r = recess + (out - recess)[:, None] * deep
    x, y = r * np.sin(ray)[:, None], r * np.cos(ray)[:, None]
    n, m = x.shape
    number = np.arange(n * m).reshape(n, m)
    quads = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]).reshape(
        4, -1
    )
    mesh = skfem.MeshQuad(np.stack([x.ravel(), y.ravel()]), quads)
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementQuad2()), intorder=5)
    lam, mu = lame_parameters(E, nu)
    lam = 2.0 * lam * mu / (lam + 2.0 * mu)  # plane stress

    def stress(e):
        return lam * eye(trace(e), 2) + 2.0 * mu * e

    @skfem.BilinearForm
    def stiffness(u, v, _):
        return ddot(stress(sym_grad(u)), sym_grad(v))

    K = stiffness.assemble(basis)
    low, high = ray[0], -ray[0]  # the roller presses evenly about the mouth

    def near(x, a, b):
        at = np.arctan2(x[0], x[1])
        return (abs(x[1] - wall) < 1e-9 * wall) & (at > a) & (at < b)

    pressed = mesh.facets_satisfying(lambda x: near(x, low, high), boundaries_only=True)
    held = mesh.facets_satisfying(
        lambda x: abs(x[0] * math.sin(middle) + x[1] * math.cos(middle) - chord) < 1e-9 * chord,
        boundaries_only=True,
    )
    face = skfem.FacetBasis(mesh, basis.elem, facets=pressed, intorder=5)
    long = 2.0 * wall * math.tan(high)

    @skfem.LinearForm
    def push(v, _):
        return -v[1] / long

    f = push.assemble(face)
    u = skfem.solve(*skfem.condense(K, f, D=basis.get_dofs(held)))
    # the stress along the wall, averaged on the nodes of the wall's facets
    side = mesh.facets_satisfying(lambda x: near(x, low, corner), boundaries_only=True)
    on = skfem.FacetBasis(mesh, basis.elem, facets=side, quadrature=(np.array([[0.5]]), np.ones(1)))
    found = stress(sym_grad(on.interpolate(u)))
    s = on.default_parameters()["x"][0][:, 0]
    order = np.argsort(s)
    moved = -float(f @ u)
    return s[order], found[0, 0][:, 0][order], abs(moved)
