# SPDX-License-Identifier: Apache-2.0
"""Draws a slice of an INRIMAGE label image as a PNG, for script/gallery.

usage: label_slice.py IMAGE.inr[.gz] OUT.png WIDTH HEIGHT      across the second axis, where labels within the largest are seen best
"""
import gzip
import struct
import sys
import zlib

BACKGROUND = (255, 255, 255)
# Label images have few labels: the largest is the organ's own, others lie within.
COLORS = [(196, 120, 100), (90, 130, 190), (225, 180, 80), (120, 170, 120)]


def read_inr(path):
    """The sizes, spacings and bytes of an image of one byte per voxel."""
    opener = gzip.open if path.endswith(".gz") else open
    with opener(path, "rb") as file:
        header = file.read(256).decode("ascii")
        fields = dict(line.split("=", 1) for line in header.splitlines() if "=" in line)
        if fields["PIXSIZE"].split()[0] != "8":
            raise ValueError(path + ": voxels of one byte are needed")
        size = [int(fields[axis + "DIM"]) for axis in "XYZ"]
        return size, [float(fields["V" + axis]) for axis in "XYZ"], file.read(size[0] * size[1] * size[2])


def write_png(path, width, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)
    pixels = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b""))


def main():
    path, out, width, height = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    size, spacing, voxels = read_inr(path)
    labels = sorted((label for label in set(voxels) if label), key=voxels.count, reverse=True)
    colors = {0: BACKGROUND, **{label: COLORS[i % len(COLORS)] for i, label in enumerate(labels)}}

    def count(j, label):
        return sum(voxels.count(label, size[0] * (j + size[1] * k), size[0] * (j + 1 + size[1] * k))
                   for k in range(size[2]))
    middle = max(range(size[1]), key=lambda j: sum(count(j, label) for label in labels[1:] or labels))

    def at(i, k):
        return voxels[i + size[0] * (middle + size[1] * k)]
    there = [(i, k) for k in range(size[2]) for i in range(size[0]) if at(i, k)]
    low, high = [[edge(p[axis] for p in there) for axis in (0, 1)] for edge in (min, max)]
    extent = [(high[0] - low[0] + 1) * spacing[0], (high[1] - low[1] + 1) * spacing[2]]
    scale = 1.1 * max(extent[0] / width, extent[1] / height)  # mm per pixel
    rows = []
    for y in range(height):
        row = bytearray()
        k = int((low[1] + high[1] + 1) / 2 - (y + 0.5 - height / 2) * scale / spacing[2])
        for x in range(width):
            i = int((low[0] + high[0] + 1) / 2 + (x + 0.5 - width / 2) * scale / spacing[0])
            is_inside = 0 <= i < size[0] and 0 <= k < size[2]
            row += bytes(colors[at(i, k) if is_inside else 0])
        rows.append(row)
    write_png(out, width, rows)


if __name__ == "__main__":
    main()
