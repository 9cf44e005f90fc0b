# SPDX-License-Identifier: Apache-2.0
"""Draws the force on a blade that is pressed through the layers of scenes/sim_layers.json, for script/gallery.

usage: force_plot.py SCENE.json OUT.svg      with the package `incise` and its library to be found
"""
import json
import math
import sys

import incise

WIDTH, HEIGHT, LEFT, TOP, BOTTOM = 760, 330, 60, 20, 50
FILLS = {"skin": "#f3d6c8", "fat": "#f7e6b4", "muscle": "#eab8b0"}


def measure(path):
    """Depths of the edge below the top in mm, forces in N, the layers as (name, from, to, steady force)."""
    with open(path, encoding="utf-8") as file:
        scene = json.load(file)
    (first, last), = [stroke["blade"][0]["edges"] for stroke in scene["strokes"]]
    top, width = scene["model"]["box"]["size"][2], 1e-3 * scene["model"]["box"]["size"][1]
    speed = (first["points"][0][2] - last["points"][0][2]) / (last["t"] - first["t"])
    simulation = incise.Simulation.from_scene(path)
    depths, forces = [], []
    for i, frame in enumerate(simulation.run()):
        time = (i + 1) / 60
        if time > last["t"]:
            break
        depths.append(top - (first["points"][0][2] - speed * time))
        forces.append(math.hypot(*frame.blade_force))
    toughness = {each["region"]: each["toughness"] for each in scene["materials"]["regions"]}
    starts = [(each["name"], 0.0 if i == 0 else -each["below"][3]) for i, each in enumerate(scene["model"]["regions"])]
    ends = [low for _, low in starts[1:]] + [float(top)]
    layers = [(name, top - high, top - low, width * toughness[name]) for (name, low), high in zip(starts, ends)]
    return depths, forces, layers


def draw(depths, forces, layers):
    deepest, most = max(depths), 1.1 * max(forces)
    x = lambda depth: LEFT + (WIDTH - LEFT - 20) * depth / deepest
    y = lambda force: HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * force / most
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
             "  <title>Force on a blade that is pressed through skin, fat and muscle</title>",
             f'  <rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for name, low, high, steady in layers:
        high = min(high, deepest)
        lines.append(f'  <rect x="{x(low):.1f}" y="{TOP}" width="{x(high) - x(low):.1f}" height="{HEIGHT - TOP - BOTTOM}" fill="{FILLS[name]}"/>')
        lines.append(f'  <text x="{0.5 * (x(low) + x(high)):.1f}" y="{TOP + 16}" text-anchor="middle">{name}</text>')
        lines.append(f'  <path d="M{x(low):.1f} {y(steady):.1f} H{x(high):.1f}" stroke="#6b6b6b" stroke-dasharray="5 4" fill="none"/>')
    for force in range(math.ceil(most)):
        lines.append(f'  <text x="{LEFT - 8}" y="{y(force) + 4:.1f}" text-anchor="end">{force}</text>')
    for depth in range(0, int(deepest) + 1, 3):
        lines.append(f'  <text x="{x(depth):.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{depth}</text>')
    way = " L".join(f"{x(depth):.1f} {y(force):.1f}" for depth, force in zip(depths, forces) if depth >= 0)
    lines.append(f'  <path d="M{way}" fill="none" stroke="#0b5a8e" stroke-width="1.8"/>')
    lines.append(f'  <text x="{WIDTH / 2}" y="{HEIGHT - 12}" text-anchor="middle">depth of the edge, mm (dashed: toughness times width)</text>')
    lines.append(f'  <text x="16" y="{HEIGHT / 2}" text-anchor="middle" transform="rotate(-90 16 {HEIGHT / 2})">force, N</text>')
    return "\n".join([*lines, "</svg>", ""])


def main():
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(draw(*measure(sys.argv[1])))


main()
