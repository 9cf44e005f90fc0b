# SPDX-License-Identifier: Apache-2.0
"""Makes the closed surfaces and grids behind script/models, with nothing but Python's standard library.

usage: surfaces.py cube OUT.mesh               the 5 x 5 x 5 Kuhn grid of 750 tets in the unit cube
       surfaces.py meat|vertebra|vessel|kidney OUT.off a closed triangulated surface, lengths in millimetres
       surfaces.py bunny INDEX.js OUT.off       the surface in npm's package `bunny`
       surfaces.py medit STEM OUT.mesh          TetGen's STEM.node and STEM.ele as one MEDIT file

Only + - * / and square roots decide a coordinate, so every machine makes the same files.
"""
import itertools
import json
import math
import re
import sys


def write_off(path, points, triangles):
    with open(path, "w", encoding="ascii") as out:
        out.write("OFF\n%d %d 0\n" % (len(points), len(triangles)))
        out.writelines("%r %r %r\n" % tuple(p) for p in points)
        out.writelines("3 %d %d %d\n" % tuple(t) for t in triangles)


def write_medit(path, points, tets):
    with open(path, "w", encoding="ascii") as out:
        out.write("MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n" % len(points))
        out.writelines("%s %s %s 0\n" % tuple(p) for p in points)
        out.write("Tetrahedra\n%d\n" % len(tets))
        out.writelines("%d %d %d %d 1\n" % tuple(i + 1 for i in t) for t in tets)
        out.write("End\n")


def kuhn_cube(n):
    """n^3 cells of six tets each in the unit cube; every tet positive."""
    def index(i, j, k):
        return (k * (n + 1) + j) * (n + 1) + i

    points = [(repr(i / n), repr(j / n), repr(k / n))
              for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)]
    tets = []
    for k, j, i in itertools.product(range(n), repeat=3):
        for order in itertools.permutations(range(3)):
            corner = [i, j, k]
            tet = [index(*corner)]
            for axis in order:
                corner[axis] += 1
                tet.append(index(*corner))
            odd = order in ((0, 2, 1), (1, 0, 2), (2, 1, 0))
            tets.append((tet[0], tet[1], tet[3], tet[2]) if odd else tuple(tet))
    return points, tets


# Signed distances, negative inside. All are plain closures over numbers: fast enough and easy to read.

def length(*v):
    return math.sqrt(sum(c * c for c in v))


def capsule(a, b, radius_a, radius_b=None):
    radius_b = radius_a if radius_b is None else radius_b
    d = [b[c] - a[c] for c in range(3)]
    dd = sum(c * c for c in d)

    def distance(x, y, z):
        p = (x - a[0], y - a[1], z - a[2])
        t = min(1.0, max(0.0, (p[0] * d[0] + p[1] * d[1] + p[2] * d[2]) / dd))
        return (length(p[0] - t * d[0], p[1] - t * d[1], p[2] - t * d[2])
                - (radius_a + t * (radius_b - radius_a)))
    return distance


def ellipsoid(centre, radii):
    """Not a distance far away, but of the right sign and slope near the surface."""
    def distance(x, y, z):
        q = [(p - c) / r for p, c, r in zip((x, y, z), centre, radii)]
        r = length(*q)
        g = length(*(c / k for c, k in zip(q, radii)))
        return r * (r - 1.0) / g if g > 0.0 else -min(radii)
    return distance


def smooth_union(parts, blend):
    def distance(x, y, z):
        best = parts[0](x, y, z)
        for part in parts[1:]:
            d = part(x, y, z)
            h = max(0.0, blend - abs(best - d)) / blend
            best = min(best, d) - 0.25 * blend * h * h
        return best
    return distance


def vertebra():
    """A body, an arch around the foramen, three processes and the articular facets."""
    def body(x, y, z):
        waist = 1.0 - 0.12 * max(0.0, 1.0 - (z / 13.0) * (z / 13.0))
        side = length(x / (23.0 * waist), (y + 4.0) / (16.0 * waist))
        radial = (side - 1.0) * 17.0
        axial = abs(z) - 13.0
        outside = length(max(radial + 3.0, 0.0), max(axial + 3.0, 0.0))
        return outside + min(max(radial + 3.0, axial + 3.0), 0.0) - 3.0

    parts = [body, capsule((0, 35, -1), (0, 58, -8), 5.2, 4.4), capsule((0, 36, 2), (0, 56, 1), 4.2, 4.0)]
    for s in (-1.0, 1.0):
        parts += [
            capsule((13 * s, 8, 5), (16 * s, 22, 3), 5.6, 5.2),
            capsule((16 * s, 22, 2), (0, 36, 0), 5.2),
            capsule((17 * s, 21, 3), (38 * s, 27, 4), 4.8, 4.0),
            capsule((15 * s, 24, 2), (17 * s, 27, 17), 5.0, 4.6),
            capsule((13 * s, 27, 0), (12 * s, 31, -17), 5.0, 4.6),
        ]
    return smooth_union(parts, 4.0), (-47.0, -25.0, -27.0), (47.0, 67.0, 27.0), 3.1


def vessel():
    """A hollow trunk that forks in two, walls of 3.4 mm, open at its three ends."""
    line = [(0.0, 0.0, -32.0), (1.5, 1.0, -12.0), (0.0, 0.0, 2.0)]
    left = [(0.0, 0.0, 2.0), (-8.0, 2.0, 16.0), (-12.0, 5.0, 36.0)]
    right = [(0.0, 0.0, 2.0), (8.0, -1.5, 17.0), (15.0, -6.0, 36.0)]

    def tube(extra):
        parts = [capsule(a, b, 5.6 + extra) for a, b in zip(line, line[1:])]
        for branch in (left, right):
            parts += [capsule(a, b, 4.4 + extra) for a, b in zip(branch, branch[1:])]
        return smooth_union(parts, 3.0)

    outer, inner = tube(3.4), tube(0.0)

    def distance(x, y, z):
        return max(outer(x, y, z), -inner(x, y, z), z - 30.0, -26.0 - z)
    return distance, (-28.0, -16.0, -33.0), (30.0, 19.0, 37.0), 1.8


def kidney():
    """A bean of 11 x 5 x 4 cm with a hilum and shallow furrows between its lobes, in millimetres; fine, to be drawn."""
    def hump(t):
        share = t - math.floor(t)
        return 16.0 * share * share * (1.0 - share) * (1.0 - share)

    def shape(x, y, z):
        bent = x + 12.0 * (z / 55.0) * (z / 55.0) - 5.0
        bean = 20.0 * (length(bent / 26.0, y / 20.0, z / 55.0) - 1.0)
        near = ((x - 30.0) * (x - 30.0) + y * y + 0.5 * z * z) / 400.0
        lobes = hump(z / 19.0 + 0.2) * hump(y / 17.0 + x / 60.0 + 0.4)
        return bean + 10.0 / ((1.0 + near) * (1.0 + near)) - 1.2 * lobes

    return shape, (-46.0, -26.0, -62.0), (38.0, 26.0, 62.0), 1.9


def gradient(f, p, h):
    return [(f(*(p[c] + h * (c == axis) for c in range(3))) - f(*(p[c] - h * (c == axis) for c in range(3)))) / (2 * h)
            for axis in range(3)]


def surface_net(f, low, high, h):
    """One vertex per cell that the surface crosses, one quad per grid edge that it crosses (naive surface nets)."""
    n = [int((high[a] - low[a]) / h) + 1 for a in range(3)]
    stride = (1, n[0] + 1, (n[0] + 1) * (n[1] + 1))
    value = [f(low[0] + i * h, low[1] + j * h, low[2] + k * h)
             for k in range(n[2] + 1) for j in range(n[1] + 1) for i in range(n[0] + 1)]
    corners = list(itertools.product((0, 1), repeat=3))
    edges = [(a, b) for a, b in itertools.combinations(corners, 2) if sum(map(abs, (a[i] - b[i] for i in range(3)))) == 1]

    points, vertex_of = [], {}
    for cell in itertools.product(*(range(n[a]) for a in range(3))):
        base = sum(cell[a] * stride[a] for a in range(3))
        v = {c: value[base + sum(c[a] * stride[a] for a in range(3))] for c in corners}
        crossings = []
        for a, b in edges:
            if (v[a] < 0.0) != (v[b] < 0.0):
                t = v[a] / (v[a] - v[b])
                crossings.append([a[i] + t * (b[i] - a[i]) for i in range(3)])
        if crossings:
            vertex_of[cell] = len(points)
            points.append([low[i] + h * (cell[i] + sum(c[i] for c in crossings) / len(crossings)) for i in range(3)])

    quads = []
    for node in itertools.product(*(range(n[a] + 1) for a in range(3))):
        base = sum(node[a] * stride[a] for a in range(3))
        for axis in range(3):
            u, w = (axis + 1) % 3, (axis + 2) % 3
            if node[axis] >= n[axis] or node[u] == 0 or node[w] == 0:
                continue
            inside, beyond = value[base] < 0.0, value[base + stride[axis]] < 0.0
            if inside == beyond:
                continue
            cells = []
            for du, dw in ((1, 1), (0, 1), (0, 0), (1, 0)):
                cell = list(node)
                cell[u] -= du
                cell[w] -= dw
                cells.append(vertex_of[tuple(cell)])
            quads.append(cells if inside else cells[::-1])
    return points, quads


def split_quads(points, quads):
    triangles = []
    for a, b, c, d in quads:
        if math.dist(points[a], points[c]) <= math.dist(points[b], points[d]):
            triangles += [(a, b, c), (a, c, d)]
        else:
            triangles += [(a, b, d), (b, c, d)]
    return triangles


def relax(f, points, quads, h, rounds):
    """Evens the triangles out: towards the mean of the neighbours, then back onto the surface."""
    around = [set() for _ in points]
    for quad in quads:
        for a, b in zip(quad, quad[1:] + quad[:1]):
            around[a].add(b)
            around[b].add(a)
    around = [sorted(s) for s in around]
    for _ in range(rounds):
        moved = []
        for p, near in zip(points, around):
            q = [0.5 * p[i] + 0.5 * sum(points[v][i] for v in near) / len(near) for i in range(3)]
            for _ in range(2):
                g = gradient(f, q, 1e-3 * h)
                gg = sum(c * c for c in g)
                if gg > 1e-6:
                    step = max(-0.5 * h, min(0.5 * h, f(*q) / gg))
                    q = [q[i] - step * g[i] for i in range(3)]
            moved.append(q)
        points = moved
    return points


def require_closed(triangles):
    """Stops where an edge lacks its partner or a vertex has more than one fan of triangles."""
    seen = set()
    spokes = {}
    for t in triangles:
        for a, b, c in (t, (t[1], t[2], t[0]), (t[2], t[0], t[1])):
            if (a, b) in seen:
                sys.exit("surface: edge %d-%d is used twice in one direction" % (a, b))
            seen.add((a, b))
            spokes.setdefault(a, {})[b] = c
    for v, turn in spokes.items():
        start = at = next(iter(turn))
        for steps in range(1, len(turn) + 1):
            at = turn.get(at)
            if at == start or at is None:
                break
        if at != start or steps != len(turn):
            sys.exit("surface: not a closed manifold at vertex %d" % v)


def implicit_surface(shape):
    f, low, high, h = shape
    points, quads = surface_net(f, low, high, h)
    points = relax(f, points, quads, h, 6)
    triangles = split_quads(points, quads)
    require_closed(triangles)
    return points, triangles


def meat():
    """A slab of 12 x 7.65 x 2.5 cm, in millimetres, gently domed on top."""
    counts, size = (10, 6, 2), (120.0, 76.5, 25.0)
    index, points = {}, []

    def vertex(node):
        if node not in index:
            u = [node[a] / counts[a] for a in range(3)]
            dome = 3.0 * u[2] * (4.0 * u[0] * (1.0 - u[0])) * (4.0 * u[1] * (1.0 - u[1]))
            index[node] = len(points)
            points.append([size[0] * u[0], size[1] * u[1], size[2] * u[2] + dome])
        return index[node]

    quads = []
    for axis in range(3):
        u, w = (axis + 1) % 3, (axis + 2) % 3
        for i, j in itertools.product(range(counts[u]), range(counts[w])):
            for level in (0, counts[axis]):
                corners = []
                for du, dw in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    node = [0, 0, 0]
                    node[axis], node[u], node[w] = level, i + du, j + dw
                    corners.append(vertex(tuple(node)))
                quads.append(corners if level else corners[::-1])
    # Alternate diagonals, as in a hand-made mesh: no direction is favoured.
    triangles = []
    for number, (a, b, c, d) in enumerate(quads):
        triangles += [(a, b, c), (a, c, d)] if number % 2 else [(a, b, d), (b, c, d)]
    require_closed(triangles)
    return points, triangles


def bunny(path):
    with open(path, encoding="utf-8") as source:
        text = source.read()
    found = [re.search(r"exports\.%s\s*=\s*(\[\[.*?\]\])" % name, text, re.S) for name in ("positions", "cells")]
    if not all(found):
        sys.exit("%s does not look like npm's package bunny" % path)
    points, triangles = (json.loads(match.group(1)) for match in found)
    return points, triangles


def read_tetgen(stem):
    def rows(suffix):
        with open(stem + suffix, encoding="ascii") as source:
            table = [line.split("#")[0].split() for line in source]
        table = [row for row in table if row]
        return table[1:1 + int(table[0][0])]
    nodes, elements = rows(".node"), rows(".ele")
    base = int(nodes[0][0])
    return [row[1:4] for row in nodes], [tuple(int(c) - base for c in row[1:5]) for row in elements]


def signed_volume(points, tet):
    a, b, c, d = ([float(x) for x in points[v]] for v in tet)
    u, v, w = ([q[i] - a[i] for i in range(3)] for q in (b, c, d))
    return (u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0])) / 6


def positive(points, tets):
    return [t if signed_volume(points, t) > 0.0 else (t[0], t[1], t[3], t[2]) for t in tets]


def main(arguments):
    kind, out = arguments[0], arguments[-1]
    if kind == "cube":
        write_medit(out, *kuhn_cube(5))
    elif kind == "meat":
        write_off(out, *meat())
    elif kind in ("vertebra", "vessel"):
        write_off(out, *implicit_surface({"vertebra": vertebra, "vessel": vessel}[kind]()))
    elif kind == "kidney":
        points, triangles = implicit_surface(kidney())
        write_off(out, [[round(c, 3) for c in p] for p in points], triangles)
    elif kind == "bunny":
        write_off(out, *bunny(arguments[1]))
    elif kind == "medit":
        points, tets = read_tetgen(arguments[1])
        write_medit(out, points, positive(points, tets))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:] if len(sys.argv) > 2 else ["", ""])
