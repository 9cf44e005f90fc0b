#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the paper's Figures 1, 2, 4, 5, 6, 8 and 9, which explain and show no run: from coordinates, by the rules that they explain.

usage: paper_diagrams.py FOLDER           writes figure01.svg to figure09.svg
       paper_diagrams.py --check FOLDER   exits with 1 where a file there is another
"""

import math
import sys
from pathlib import Path

INK, FAINT = "#1c2329", "#8a949e"
TET, TOOL, YELLOW, GREEN, RED = "#dbe9f7", "#a06cd5", "#f2c230", "#2e9e4f", "#c02020"
GROUPS = ["#dbe9f7", "#f7e7d0", "#d9efd7"]


class Sheet:
    """An SVG that is being drawn."""

    def __init__(self, title, width, height):
        self.lines = [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">',
            f"  <title>{title}</title>",
            f'  <rect width="{width}" height="{height}" fill="white"/>',
        ]

    def path(self, points, fill="none", stroke=INK, width=1.2, opacity=1.0, closed=True, dash=""):
        way = " L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.lines.append(
            f'  <path d="M{way}{" Z" if closed else ""}" fill="{fill}" fill-opacity="{opacity}" stroke="{stroke}" '
            f'stroke-width="{width}" stroke-linejoin="round"{dashes}/>'
        )

    def line(self, a, b, **style):
        self.path([a, b], closed=False, **style)

    def dot(self, at, color=GREEN, radius=5):
        self.lines.append(f'  <circle cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="{radius}" fill="{color}" stroke="{INK}"/>')

    def text(self, at, words, color=INK, anchor="middle", weight="normal"):
        self.lines.append(
            f'  <text x="{at[0]:.1f}" y="{at[1]:.1f}" fill="{color}" text-anchor="{anchor}" font-weight="{weight}">{words}</text>'
        )

    def arrow(self, a, b):
        self.line(a, b, width=1.6)
        along = math.atan2(b[1] - a[1], b[0] - a[0])
        barbs = [(b[0] - 9 * math.cos(along + s), b[1] - 9 * math.sin(along + s)) for s in (0.4, -0.4)]
        self.path([b, *barbs], fill=INK)

    def done(self):
        return "\n".join([*self.lines, "</svg>", ""])


def plus(a, b, t=1.0):
    return tuple(x + t * y for x, y in zip(a, b))


def minus(a, b):
    return plus(a, b, -1.0)


def between(a, b, t=0.5):
    return plus(a, minus(b, a), t)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return tuple(x / math.sqrt(dot(a, a)) for x in a)


def middle(points):
    return tuple(sum(column) / len(points) for column in zip(*points))


def volume(tet):
    a, b, c, d = tet
    return dot(cross(minus(b, a), minus(c, a)), minus(d, a)) / 6


class View:
    """Parallel projection: x to the right, z up, seen from the front and a little from above and the right."""

    def __init__(self, origin, scale, turn=0.5, tilt=0.35):
        self.origin, self.scale = origin, scale
        self.right = (math.cos(turn), math.sin(turn), 0)
        self.back = (-math.sin(turn) * math.cos(tilt), math.cos(turn) * math.cos(tilt), -math.sin(tilt))
        self.up = cross(self.right, self.back)

    def __call__(self, p):
        return (self.origin[0] + self.scale * dot(p, self.right), self.origin[1] - self.scale * dot(p, self.up))

    def depth(self, points):
        return dot(middle(points), self.back)


def faces_of(tet):
    return [tuple(tet[i] for i in range(4) if i != left) for left in range(4)]


def draw_faces(sheet, view, faces):
    """Faces with their style, what is far first."""
    for points, style in sorted(faces, key=lambda each: -view.depth(each[0])):
        sheet.path([view(p) for p in points], **style)


def draw_tets(sheet, view, tets, fills, opacity=0.75):
    draw_faces(
        sheet, view, [(face, {"fill": fill, "opacity": opacity}) for tet, fill in zip(tets, fills) for face in faces_of(tet)]
    )


def bisect(tets, edges):
    """The paper's subdivision: one collision point after the other, the longest edge first."""
    for a, b in sorted(edges, key=lambda edge: -dot(minus(*edge), minus(*edge))):
        point, made = between(a, b), []
        for tet in tets:
            if a in tet and b in tet:
                made += [tuple(point if p == old else p for p in tet) for old in (a, b)]
            else:
                made.append(tet)
        tets = made
    return tets


def figure_1():
    sheet = Sheet("The pipeline of a frame", 760, 200)

    def box(x, y, words, fill, width=130):
        sheet.path([(x, y), (x + width, y), (x + width, y + 46), (x, y + 46)], fill=fill)
        lines = words.split("|")
        for i, each in enumerate(lines):
            sheet.text((x + width / 2, y + 28 + 16 * (i - (len(lines) - 1) / 2)), each)

    cut = ["Collision|detection", "Incision|faces", "Subdivision|(Algorithm 1)", "Singleton vertices|(Algorithm 2)", "Edge|merging"]
    for i, words in enumerate(cut):
        box(9 + 153 * i, 30, words, GROUPS[0])
        if i:
            sheet.arrow((9 + 153 * i - 22, 53), (9 + 153 * i - 1, 53))
    sheet.text((380, 20), "in every frame", FAINT)
    keep = ["Boundary|Laplacian", "Smart|Laplacian", "Face|swapping"]
    for i, words in enumerate(reversed(keep)):
        box(315 + 153 * i, 120, words, GROUPS[1])
    sheet.arrow((686, 77), (686, 119))
    for i in range(2):
        sheet.arrow((620 - 153 * i, 143), (599 - 153 * i, 143))
    sheet.text((533, 188), "once an incision is complete: maintenance", FAINT)
    box(162, 120, "Relaxation", GROUPS[2])
    box(9, 120, "Rendering", GROUPS[2])
    for end in (293, 140):
        sheet.arrow((end + 21, 143), (end, 143))
    sheet.arrow((74, 119), (74, 77))
    return sheet.done()


CORNERS = [(0.0, 0.0, 0.0), (1.0, 0.05, 0.0), (0.42, 0.95, 0.0), (0.48, 0.3, 0.92)]


def figure_2():
    sheet = Sheet("A tet with three and with four collision points, and what it is divided into", 760, 300)
    a, b, c, d = CORNERS
    for row, (edges, count) in enumerate([([(d, a), (d, b), (d, c)], 4), ([(a, c), (a, d), (b, c), (b, d)], 6)]):
        x = 60 + 380 * row
        view = View((x, 220), 125, 0.35, 0.3)
        points = [between(*edge) for edge in edges]
        children = bisect([CORNERS], edges)
        assert len(children) == count, "the templates have four and six children"
        assert math.isclose(sum(abs(volume(tet)) for tet in children), abs(volume(CORNERS))), "they fill the tet"
        cut = [f for tet in children for f in faces_of(tet) if all(p in points for p in f)]
        draw_faces(
            sheet, view, [(f, {"fill": TET, "opacity": 0.35}) for f in faces_of(CORNERS)] + [(f, {"fill": YELLOW, "opacity": 0.9}) for f in cut]
        )
        for p in points:
            sheet.dot(view(p))
        apart = View((x + 170, 220), 125, 0.35, 0.3)
        centre = middle(CORNERS)
        moved = [tuple(plus(p, minus(middle(tet), centre), 0.55) for p in tet) for tet in children]
        draw_tets(sheet, apart, moved, [TET] * count, 0.85)
        sheet.text((x + 55, 262), f"{len(points)} collision points", GREEN)
        sheet.text((x + 235, 262), f"{count} tets")
    sheet.text((380, 288), "green: collision points; yellow: incision faces", FAINT)
    return sheet.done()


def figure_4():
    sheet = Sheet("Dividable vertices of type I and type II", 760, 290)
    side = math.sqrt(3) / 2

    def fan(x, is_open):
        place = lambda u, v: (x + 62 * u, 150 - 62 * v)
        p1, p2 = (0.0, 0.0), (1.0, 0.0)
        upper, lower = (0.0, 0.17 if is_open else 0.0), (0.0, -0.17 if is_open else 0.0)
        ring = [(1 + math.cos(math.pi / 3 * k), side / (side or 1) * math.sin(math.pi / 3 * k)) for k in range(6)]
        ring[3] = p1
        for k in range(6):
            first, second = ring[k], ring[(k + 1) % 6]
            if is_open and p1 in (first, second):
                lip = upper if k == 2 else lower
                first, second = [lip if p == p1 else p for p in (first, second)]
            sheet.path([place(*p2), place(*first), place(*second)], fill=YELLOW, opacity=0.55)
        for lip, end in ((upper, (0.0, 1.3)), (lower, (0.0, -1.3))):
            top = ring[2] if lip == upper and end[1] > 0 else ring[4]
            sheet.path([place(*lip), place(*end), place(*top)], fill=YELLOW, opacity=0.55)
            sheet.line(place(*lip), place(*end), width=3.5, stroke=RED)
        if is_open:
            for lip in (upper, lower):
                sheet.line(place(*lip), place(*p2), width=3.5, stroke=RED)
            sheet.text((place(*upper)[0] - 10, place(*upper)[1] + 2), "P1", anchor="end")
            sheet.text((place(*lower)[0] - 10, place(*lower)[1] + 10), "P1′", anchor="end")
            sheet.dot(place(*upper))
            sheet.dot(place(*lower))
        else:
            sheet.dot(place(*p1))
            sheet.text((place(*p1)[0] - 10, place(*p1)[1] + 5), "P1", anchor="end")
        sheet.dot(place(*p2))
        sheet.text((place(*p2)[0] + 16, place(*p2)[1] - 8), "P2")

    fan(120, False)
    fan(500, True)
    sheet.text((190, 262), "P2: a circle of incision faces (type I)")
    sheet.text((190, 279), "P1: a sector between two surface edges (type II)")
    sheet.text((570, 262), "P1 is divided: its edge to P2 has become two")
    sheet.text((570, 279), "surface edges, and P2 is of type II")
    sheet.text((380, 22), "yellow: incision faces; red: surface edges at P1 and P2", FAINT)
    return sheet.done()


def figure_5():
    sheet = Sheet("Singleton vertices", 760, 270)
    a, b = (0.0, 0.0, 0.0), (1.4, 0.0, 0.0)
    shared = [(0.7, -0.4, 0.75), (0.7, 0.4, 0.7), (0.7, 0.0, 0.3)]
    groups = [[(end, *[(x, y, sign * z) for x, y, z in shared]) for end in (a, b)] for sign in (1, -1)]
    for x, lift in ((90, 0.0), (470, 0.2)):
        view = View((x, 120), 110, 0.3, 0.2)
        for group, fill, sign in zip(groups, GROUPS, (1, -1)):
            moved = [tuple(plus(p, (0, 0, sign * lift)) for p in tet) for tet in group]
            draw_tets(sheet, view, moved, [fill] * 2, 0.8)
        for name, p in (("A", a), ("B", b)):
            for sign in (1, -1) if lift else (0,):
                sheet.dot(view(plus(p, (0, 0, sign * lift))))
                dash = "′" if sign < 0 else ""
                at = view(plus(p, (0, 0, sign * lift)))
                sheet.text((at[0] + (-14 if name == "A" else 14), at[1] + 5), name + dash)
    sheet.text((165, 262), "two groups that share A and B, and no face there")
    sheet.text((545, 262), "each group has vertices of its own")
    return sheet.done()


def figure_6():
    sheet = Sheet("The three shapes of a negligible tet", 760, 230)
    e = 0.24
    shapes = [
        ("a: one short edge", [(0, 0, 0), (0.9, 0.1, 0), (0.9 + 0.4 * e, 0.1, e), (0.45, 0.75, 0.1)], [(1, 2)]),
        ("b: two opposite short edges", [(0, 0, -e / 2), (0, 0, e / 2), (1, 0.2, 0.1), (1, 0.2 - e, 0.1 + 0.4 * e)], [(0, 1), (2, 3)]),
        ("c: a short face", [(0, 0, 0), (1, 0.1, 0), (1.02, 0.1 + 0.9 * e, 0.3 * e), (1.0, 0.12, 0.9 * e)], [(1, 2), (2, 3), (1, 3)]),
    ]
    for i, (words, tet, short) in enumerate(shapes):
        lengths = {pair: math.dist(tet[pair[0]], tet[pair[1]]) for pair in [(p, q) for p in range(4) for q in range(p + 1, 4)]}
        longest = max(lengths.values())
        assert {pair for pair, length in lengths.items() if longest > 3.5 * length} == set(short), "as find_thin_shape has it"
        view = View((60 + 245 * i, 140), 150, 0.2, 0.5)
        draw_tets(sheet, view, [tet], [TET], 0.5)
        for p, q in short:
            sheet.line(view(tet[p]), view(tet[q]), stroke=RED, width=3)
        if i == 0:
            for name, p, shift in zip("ABCD", (tet[0], tet[1], tet[2], tet[3]), ((-10, 5), (12, 12), (14, -2), (0, -8))):
                sheet.text(plus(view(p), shift), name)
        z = view(middle([between(tet[p], tet[q]) for p, q in short[-1:]]))
        sheet.text((z[0] + 16, z[1] + 4), "z", RED, weight="bold")
        sheet.text((60 + 245 * i + 80, 190), words)
    sheet.text((380, 218), "red edges, of less than the longest over 3.5, are eliminated", FAINT)
    return sheet.done()


def figure_8():
    sheet = Sheet("The two transformations of five vertices", 760, 400)
    top, bottom = (0.45, 0.3, 0.75), (0.5, 0.35, -0.6)
    ring = [(0.0, 0.0, 0.0), (1.0, 0.1, 0.0), (0.4, 0.95, 0.0)]
    two = [(top, *ring), (bottom, *ring)]
    three = [(top, bottom, ring[k], ring[(k + 1) % 3]) for k in range(3)]
    assert math.isclose(sum(abs(volume(t)) for t in two), sum(abs(volume(t)) for t in three)), "the same convex"

    def pair(y, left, right, words, marks):
        for x, tets in ((110, left), (470, right)):
            view = View((x, y), 120, 0.3, 0.3)
            draw_tets(sheet, view, tets, GROUPS, 0.6)
        for x, (p, q) in zip((110, 470), marks):
            view = View((x, y), 120, 0.3, 0.3)
            if p:
                sheet.line(view(p), view(q), stroke=RED, width=2.5)
        sheet.arrow((320, y - 30), (420, y - 30))
        sheet.arrow((420, y - 20), (320, y - 20))
        for x, label in zip((170, 530), words):
            sheet.text((x, y + 92), label)

    pair(110, two, three, ("two tets on a face", "three tets around an edge (red)"), ((None, None), (top, bottom)))
    square = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 0.9, 0.0), (0.0, 0.9, 0.0)]
    apex = (0.5, 0.4, 0.75)
    one = [(apex, square[0], square[1], square[2]), (apex, square[0], square[2], square[3])]
    other = [(apex, square[1], square[2], square[3]), (apex, square[1], square[3], square[0])]
    assert math.isclose(sum(abs(volume(t)) for t in one), sum(abs(volume(t)) for t in other)), "the same convex"
    pair(300, one, other, ("two tets whose lower faces lie in one plane", "the other diagonal (red)"),
         ((square[0], square[2]), (square[1], square[3])))
    return sheet.done()


def figure_9():
    sheet = Sheet("A contour vertex is moved to E and not to D", 760, 250)
    a, b, c = (150.0, 190.0, 0.0), (610.0, 170.0, 0.0), (250.0, 60.0, 0.0)
    ca, ab = minus(a, c), minus(b, a)
    nd = unit(cross(cross(ca, ab), ab))  # equation 2
    d = between(a, b)
    reach = dot(minus(c, d), nd)  # equation 3
    e = plus(d, nd, reach)  # equation 4
    off = lambda p: math.sqrt(dot(cross(minus(p, a), unit(ab)), cross(minus(p, a), unit(ab))))
    assert math.isclose(off(e), off(c)), "the distance from AB is kept"
    flat = lambda p: p[:2]
    before, after = (50.0, 120.0), (705.0, 95.0)
    sheet.path([before, flat(a), flat(c), flat(b), after, (705, 235), (50, 235)], fill=TET, stroke="none", opacity=0.6)
    sheet.path([before, flat(a), flat(c), flat(b), after], closed=False, width=2.2)
    sheet.path([flat(a), flat(e), flat(b)], closed=False, stroke=GREEN, width=2.2)
    sheet.line(flat(a), flat(b), stroke=FAINT, dash="5 4")
    for foot, p in ((plus(c, nd, -reach), c), (d, e)):
        sheet.line(flat(foot), flat(p), stroke=RED, dash="4 3")
    for name, p, shift in (("A", a, (-4, 22)), ("B", b, (6, 22)), ("C", c, (-4, -12)), ("D", d, (0, 22)), ("E", e, (0, -12))):
        sheet.dot(flat(p), GREEN if name == "E" else "white")
        sheet.text(plus(flat(p), shift), name)
    sheet.text((380, 240), "black: the contour before; green: after. Red: the distance that equations 2 to 4 keep", FAINT)
    return sheet.done()


FIGURES = {1: figure_1, 2: figure_2, 4: figure_4, 5: figure_5, 6: figure_6, 8: figure_8, 9: figure_9}


def main(arguments):
    checks = arguments[:1] == ["--check"]
    if len(arguments) != 1 + checks or arguments[-1] in ("-h", "--help"):
        print(__doc__)
        return 0 if arguments[-1:] in (["-h"], ["--help"]) else 2
    folder, status = Path(arguments[-1]), 0
    for number, draw in FIGURES.items():
        path = folder / f"figure{number:02d}.svg"
        if not checks:
            path.write_text(draw(), encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != draw():
            print(f"{path} is not what script/figures draws")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
