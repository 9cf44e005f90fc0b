#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How far linear tets lock: the tip of a cantilever under its weight, by small-strain elasticity in numpy and scipy.

A beam of 100 x 20 x 20 mm and 300 kPa, of boxes of six tets each, with its left end held. Three kinds of elements, each
its own code and none of Incise's: quadratic tets (4-point quadrature), linear tets, and linear tets whose resistance to
a change of volume beyond that of Poisson's ratio OWN is averaged at the vertices. Prints CSV: cells across, Poisson's
ratio, and the three sags in mm. Arguments: numbers of cells across (default 4).
"""
import itertools
import sys

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

SIZE, YOUNG, WEIGHT, OWN = (0.1, 0.02, 0.02), 300e3, 9810.0, 0.1


def lame(nu):
    """Lame's parameters of the beam's tissue at a Poisson's ratio, Pa."""
    return YOUNG * nu / ((1 + nu) * (1 - 2 * nu)), YOUNG / (2 * (1 + nu))


def box(across):
    """Points (n x 3) and tets (m x 4) of the beam; each box is cut into the six paths along its axes."""
    cells = (5 * across, across, across)
    grid = np.stack(np.meshgrid(*[np.linspace(0, s, c + 1) for s, c in zip(SIZE, cells)], indexing="ij"), -1)
    number = np.arange(grid[..., 0].size).reshape(grid.shape[:3])
    tets = []
    for order in itertools.permutations(range(3)):
        steps = np.zeros((4, 3), int)
        for i, axis in enumerate(order):
            steps[i + 1 :, axis] = 1
        corner = [number[tuple(slice(s, s + c) for s, c in zip(step, cells))].ravel() for step in steps]
        if np.linalg.det(steps[1:]) < 0:
            corner[2], corner[3] = corner[3], corner[2]
        tets.append(np.stack(corner, 1))
    return grid.reshape(-1, 3), np.concatenate(tets)


def gradients(points, tets):
    """Of the barycentric coordinates (m x 4 x 3), and volumes (m)."""
    p = points[tets]
    edges = np.swapaxes(p[:, 1:] - p[:, :1], 1, 2)
    rows = np.linalg.inv(edges)
    return np.concatenate([-rows.sum(1, keepdims=True), rows], 1), np.linalg.det(edges) / 6


def stiffness(grad, weight, tets, count, lam, mu):
    """lam (div u)^2 + 2 mu eps:eps with shape functions' gradients (m x k x 3) at one point of each tet."""
    m, k = tets.shape
    k_e = mu * (np.einsum("eaj,ebj->eab", grad, grad)[:, :, None, :, None] * np.eye(3)[:, None, :])
    k_e = k_e + mu * np.einsum("eaj,ebi->eaibj", grad, grad) + lam * np.einsum("eai,ebj->eaibj", grad, grad)
    k_e = (k_e * weight[:, None, None, None, None]).reshape(m, 3 * k, 3 * k)
    dof = (3 * tets[:, :, None] + np.arange(3)).reshape(m, 3 * k)
    rows, columns = np.repeat(dof, 3 * k, 1).ravel(), np.tile(dof, (1, 3 * k)).ravel()
    return sp.csc_matrix((k_e.ravel(), (rows, columns)), (3 * count, 3 * count))


def sag(points, k, load):
    """Of the tip, mm."""
    force = np.zeros((len(points), 3))
    force[:, 2] = load
    free = np.repeat(points[:, 0] > 1e-12, 3)
    u = np.zeros(points.size)
    u[free] = sla.spsolve(k[free][:, free].tocsc(), force.ravel()[free], permc_spec="MMD_AT_PLUS_A")
    tip = points[:, 0] > SIZE[0] - 1e-9
    return -1e3 * u.reshape(-1, 3)[tip, 2].mean()


def linear(points, tets, nu, averaged):
    lam, mu = lame(nu)
    own = min(lam, lame(OWN)[0]) if averaged else lam
    grad, volume = gradients(points, tets)
    k = stiffness(grad, volume, tets, len(points), own, mu)
    if lam > own:
        dof = (3 * tets[:, :, None] + np.arange(3)).reshape(len(tets), 12)
        div = sp.csr_matrix((grad.reshape(-1), (np.repeat(np.arange(len(tets)), 12), dof.ravel())), (len(tets), 3 * len(points)))
        share = sp.csr_matrix((np.repeat(volume / 4, 4), (tets.ravel(), np.repeat(np.arange(len(tets)), 4))))
        nodal = np.asarray(share.sum(1)).ravel()
        mean = sp.diags(1 / nodal) @ share @ div
        k = k + (lam - own) * (mean.T @ sp.diags(nodal) @ mean)
    load = -WEIGHT * np.bincount(tets.ravel(), np.repeat(volume / 4, 4))
    return sag(points, k, load)


def quadratic(points, tets, nu):
    pairs = list(itertools.combinations(range(4), 2))
    ends = np.sort(np.concatenate([tets[:, pair] for pair in pairs]), 1)
    edges, number = np.unique(ends, axis=0, return_inverse=True)
    all_points = np.concatenate([points, points[edges].mean(1)])
    ten = np.concatenate([tets, len(points) + number.reshape(6, -1).T], 1)
    grad, volume = gradients(points, tets)
    lam, mu = lame(nu)
    k = sp.csc_matrix((3 * len(all_points),) * 2)
    near, far = 0.58541019662496845, 0.13819660112501052
    for point in range(4):
        at = np.full(4, far)
        at[point] = near
        corner = [(4 * at[i] - 1) * grad[:, i] for i in range(4)]
        middle = [4 * (at[i] * grad[:, j] + at[j] * grad[:, i]) for i, j in pairs]
        k = k + stiffness(np.stack(corner + middle, 1), volume / 4, ten, len(all_points), lam, mu)
    shares = np.concatenate([np.full(4, -1 / 20), np.full(6, 1 / 5)])  # of a tet's weight, exactly
    load = -WEIGHT * np.bincount(ten.ravel(), (volume[:, None] * shares).ravel())
    return sag(all_points, k, load)


def main():
    print("cells,poisson,quadratic,linear,averaged")
    for across in [int(a) for a in sys.argv[1:]] or [4]:
        points, tets = box(across)
        for nu in (0.3, 0.45, 0.49):
            best = quadratic(points, tets, nu)
            one, two = linear(points, tets, nu, False), linear(points, tets, nu, True)
            print(f"{across},{nu},{best:.3f},{one:.3f},{two:.3f}", flush=True)


if __name__ == "__main__":
    main()
