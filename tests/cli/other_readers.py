# SPDX-License-Identifier: Apache-2.0
"""Reads what the command writes with another reader, where that is installed.

usage: other_readers.py INCISE READER; READER: meshio, Gmsh or VTK; exit 77: it is not there
"""
import itertools
import os
import subprocess
import sys
import tempfile

CELLS = 4  # of the cube, along each axis


def write_cube(path, regions):
    """A cube of six tets per cell, with two regions that take turns in the file."""
    points = [(i, j, k) for k in range(CELLS + 1) for j in range(CELLS + 1) for i in range(CELLS + 1)]
    tets = []
    for corner in itertools.product(range(CELLS), repeat=3):
        for axes in itertools.permutations(range(3)):
            at, tet = list(corner), []
            for axis in (None,) + axes:
                if axis is not None:
                    at[axis] += 1
                tet.append(1 + at[0] + (CELLS + 1) * (at[1] + (CELLS + 1) * at[2]))
            tets.append(tet + [regions[sum(corner) % 2]])
    with open(path, "w", encoding="ascii") as out:
        out.write("MeshVersionFormatted 2\nDimension 3\nVertices\n%d\n" % len(points))
        out.writelines("%d %d %d 0\n" % point for point in points)
        out.write("Tetrahedra\n%d\n" % len(tets))
        out.writelines("%d %d %d %d %d\n" % tuple(tet) for tet in tets)
        out.write("End\n")


def read_meshio(path):
    import meshio
    mesh = meshio.read(path)
    found = {"points": len(mesh.points), "tets": 0, "triangles": 0, "regions": {}, "strokes": set(), "pieces": set()}
    for i, block in enumerate(mesh.cells):
        data = {name: values[i] for name, values in mesh.cell_data.items()}
        if block.type == "triangle":
            found["triangles"] += len(block.data)
            found["strokes"].update(int(x) for x in data["stroke"])
        if block.type == "tetra":
            found["tets"] += len(block.data)
            found["pieces"].update(int(x) for x in data["piece"])
            for region in data["gmsh:physical"] if "gmsh:physical" in data else data["region"]:
                found["regions"][int(region)] = found["regions"].get(int(region), 0) + 1
    return found


def read_gmsh(path):
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.open(path)
    elements = {dim: [len(tags) for tags in gmsh.model.mesh.getElements(dim)[1]] for dim in (2, 3)}
    found = {"points": len(gmsh.model.mesh.getNodes()[0]), "tets": sum(elements[3]), "triangles": sum(elements[2]),
             "regions": {}, "strokes": set()}
    for dim, group in gmsh.model.getPhysicalGroups():
        if dim == 2:
            found["strokes"].add(group)
            continue
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, group):
            count = sum(len(tags) for tags in gmsh.model.mesh.getElements(dim, entity)[1])
            found["regions"][group] = found["regions"].get(group, 0) + count
    gmsh.finalize()
    return found


def read_vtk(path):
    from vtkmodules.vtkIOLegacy import vtkUnstructuredGridReader
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    reader = vtkUnstructuredGridReader() if path.endswith(".vtk") else vtkXMLUnstructuredGridReader()
    if path.endswith(".vtk"):
        reader.ReadAllScalarsOn()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    data = grid.GetCellData()
    found = {"points": grid.GetNumberOfPoints(), "tets": 0, "triangles": 0, "regions": {}, "strokes": set()}
    for i in range(grid.GetNumberOfCells()):
        if grid.GetCellType(i) == 10:
            region = int(data.GetArray("region").GetTuple1(i))
            found["tets"] += 1
            found["regions"][region] = found["regions"].get(region, 0) + 1
        else:
            found["triangles"] += 1
            found["strokes"].add(int(data.GetArray("stroke").GetTuple1(i)))
    return found


READERS = {
    "meshio": ("meshio", read_meshio, ("msh41", "msh41-binary", "vtk", "vtu")),
    "Gmsh": ("gmsh", read_gmsh, ("msh41", "msh41-binary", "msh22")),
    "VTK": ("vtkmodules", read_vtk, ("vtk", "vtu")),
}


def expected_of(incise, path):
    """What meets every reader: from the .mesh file, by hand."""
    with open(path, encoding="ascii") as lines:
        words = lines.read().split()
    at = {name: words.index(name) for name in ("Vertices", "Triangles", "Tetrahedra")}
    n_tets, regions = int(words[at["Tetrahedra"] + 1]), {}
    for i in range(n_tets):
        region = int(words[at["Tetrahedra"] + 2 + 5 * i + 4])
        regions[region] = regions.get(region, 0) + 1
    return {"points": int(words[at["Vertices"] + 1]), "tets": n_tets, "triangles": int(words[at["Triangles"] + 1]),
            "regions": regions, "strokes": {1}, "pieces": {0, 1}}


def count_failures(incise, reader, regions):
    """How often the reader finds something else in a cut cube of these regions than what was written."""
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        cube, cut = os.path.join(folder, "cube.mesh"), os.path.join(folder, "cut.vtu")
        write_cube(cube, regions)
        subprocess.run([incise, "cut", cube, "--plane", "1,0.2,0,1.7", "-q", "-o", cut], check=True)
        by_hand = os.path.join(folder, "cut.mesh")
        subprocess.run([incise, "convert", cut, by_hand, "-q"], check=True)
        expected = expected_of(incise, by_hand)
        name, read, formats = reader
        for written in formats:
            path = os.path.join(folder, written + "." + written.split("4")[0].split("2")[0])
            subprocess.run([incise, "convert", cut, path, "--format", written, "-q"], check=True)
            found = read(path)
            if written == "msh22":  # where 0 stands for no group
                found["regions"].update({0: expected["regions"][0]} if 0 in expected["regions"] else {})
            wrong = {key: (value, expected[key]) for key, value in found.items() if value != expected[key]}
            failures += 1 if wrong else 0
            print("%s reads %s of the regions %s: %s" % (name, written, regions, wrong or "as it was written"))
    return failures


def main(incise, name):
    module, read, formats = READERS[name]
    try:
        __import__(module)
    except ImportError:
        print("%s is not installed" % name)
        return 77
    reader = (name, read, formats)
    return 1 if sum(count_failures(incise, reader, regions) for regions in ((0, 0), (0, 2), (3, 4))) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
