# SPDX-License-Identifier: Apache-2.0
"""Reads the glTF files that the command writes with independent readers, where they are installed.

Khronos' validator (npm's gltf-validator, looked for where NODE_PATH says), Assimp's program (assimp-utils), and VTK
(python3-vtk9). usage: gltf_readers.py INCISE; exit 77: none of them is there
"""
import json
import os
import shutil
import struct
import subprocess
import sys
import tempfile

CELLS, FINE = 4, 12  # of the cube along each axis: of its mesh, of its surface

VALIDATOR = """
const validator = require('gltf-validator');
const bytes = new Uint8Array(require('fs').readFileSync(process.argv[1]));
validator.validateBytes(bytes).then((report) => console.log(JSON.stringify(report)));
"""


def write_box_surface(path):
    """The surface of the unit cube, each face by itself, with texture coordinates."""
    points, coordinates, faces = [], [], []
    for axis in range(3):
        for side in (0, 1):
            first = len(points) + 1
            for i in range(FINE + 1):
                for j in range(FINE + 1):
                    p = [0.0] * 3
                    p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side, i / FINE, j / FINE
                    points.append(p)
                    coordinates.append((i / FINE, j / FINE))
            for i in range(FINE):
                for j in range(FINE):
                    a = first + i * (FINE + 1) + j
                    b, c, d = a + FINE + 1, a + FINE + 2, a + 1
                    faces += [(a, b, c), (a, c, d)] if side else [(a, c, b), (a, d, c)]
    with open(path, "w", encoding="ascii") as out:
        out.writelines("v %r %r %r\n" % tuple(p) for p in points)
        out.writelines("vt %r %r\n" % t for t in coordinates)
        out.writelines("f %d/%d %d/%d %d/%d\n" % (a, a, b, b, c, c) for a, b, c in faces)


def write_scene(path):
    """A cube that is held on one side and falls apart while a blade goes through it."""
    scene = {
        "format": "incise-scene", "version": 1, "name": "halves",
        "model": {"box": {"cells": [CELLS] * 3, "size": [1, 1, 1]}, "surface": "fine.obj"},
        "length_unit": 0.1, "gravity": [0, 0, -9.81], "frames": 12, "frame_seconds": 0.02,
        "materials": {"default": {"young": 20000, "poisson": 0.4, "density": 1000}},
        "attachments": [{"below": [1, 0, 0, 0.001]}],
        "strokes": [{"blade": [{"name": "down", "edges": [
            {"t": 0.0, "points": [[0.53, -0.5, 1.2], [0.53, 1.5, 1.2]]},
            {"t": 0.2, "points": [[0.53, -0.5, 0.3], [0.53, 1.5, 0.3]]}]}]}],
    }
    with open(path, "w", encoding="utf-8") as out:
        json.dump(scene, out)


def contents_of(path):
    """The JSON of a binary glTF file, and its numbers."""
    with open(path, "rb") as file:
        data = file.read()
    magic, version, length = struct.unpack_from("<4sII", data)
    assert (magic, version, length) == (b"glTF", 2, len(data)), (magic, version, length)
    size, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON"
    return json.loads(data[20:20 + size]), data[28 + size:]


def check_contents(path, has_moments):
    root, numbers = contents_of(path)
    primitives = root["meshes"][0]["primitives"]
    assert len(primitives) == 2, "skin and walls"
    for primitive in primitives:
        for name in ("POSITION", "NORMAL", "TEXCOORD_0"):
            assert name in primitive["attributes"], name
        assert ("targets" in primitive) == has_moments
    assert "_REST" in primitives[1]["attributes"]
    assert ("animations" in root) == has_moments
    return sum(root["accessors"][p["indices"]]["count"] // 3 for p in primitives)


def check_validator(path):
    done = subprocess.run(["node", "-e", VALIDATOR, path], capture_output=True, text=True, check=False)
    if done.returncode != 0 and "Cannot find module" in done.stderr:
        return False
    issues = json.loads(done.stdout)["issues"]
    assert issues["numErrors"] == 0 and issues["numWarnings"] == 0, issues["messages"][:5]
    return True


def check_assimp(path, triangles):
    if shutil.which("assimp") is None:
        return False
    done = subprocess.run(["assimp", "info", path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    faces = [line.split()[-1] for line in done.stdout.splitlines() if line.startswith("Faces:")]
    assert faces == [str(triangles)], (faces, triangles)
    return True


def check_vtk(path, triangles):
    try:
        from vtkmodules.vtkIOGeometry import vtkGLTFReader
    except ImportError:
        return False
    reader = vtkGLTFReader()
    reader.SetFileName(path)
    reader.Update()
    found, blocks = 0, [reader.GetOutput()]
    while blocks:
        block = blocks.pop()
        if block is None:
            continue
        if hasattr(block, "GetNumberOfBlocks"):
            blocks += [block.GetBlock(i) for i in range(block.GetNumberOfBlocks())]
        else:
            found += block.GetNumberOfCells()
    assert found == triangles, (found, triangles)
    return True


def main():
    incise = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        write_box_surface("fine.obj")
        write_scene("scene.json")
        subprocess.run([incise, "simulate", "scene.json", "--drawn", "film.glb", "-o", "film.pvd", "-q"], check=True)
        last = sorted(os.listdir("film_frames"))[0]
        subprocess.run([incise, "cut", os.path.join("film_frames", last), "--plane", "1,0.2,0.1,0.61", "--surface",
                        "fine.obj", "--drawn", "cut.glb", "-q"], check=True)
        readers = set()
        for path, has_moments in (("cut.glb", False), ("film.glb", True)):
            triangles = check_contents(path, has_moments)
            for name, is_there in (("gltf-validator", check_validator(path)), ("assimp", check_assimp(path, triangles)),
                                   ("vtk", check_vtk(path, triangles))):
                readers |= {name} if is_there else set()
            print(path, triangles, "triangles")
    print("read by", ", ".join(sorted(readers)) or "nobody: none is installed")
    return 0 if readers else 77


if __name__ == "__main__":
    sys.exit(main())
