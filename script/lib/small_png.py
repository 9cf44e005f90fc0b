# SPDX-License-Identifier: Apache-2.0
"""Makes PNG pictures of 8 bits per channel small: at most 256 colours, found by median cut. The same picture gives the
same bytes. usage: small_png.py PICTURE..."""
import struct
import sys
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"
MOST_COLOURS = 256


def chunks_of(data):
    at = len(SIGNATURE)
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        yield kind, data[at + 8 : at + 8 + size]
        at += 12 + size


def paeth(a, b, c):
    p = a + b - c
    da, db, dc = abs(p - a), abs(p - b), abs(p - c)
    return a if da <= db and da <= dc else b if db <= dc else c


def unfiltered(kind, line, above, step):
    for i in range(len(line)):
        left = line[i - step] if i >= step else 0
        if kind == 1:
            line[i] = (line[i] + left) & 255
        elif kind == 2:
            line[i] = (line[i] + above[i]) & 255
        elif kind == 3:
            line[i] = (line[i] + (left + above[i]) // 2) & 255
        elif kind == 4:
            line[i] = (line[i] + paeth(left, above[i], above[i - step] if i >= step else 0)) & 255
    return line


def read_pixels(data):
    """The width, the height and a list of (red, green, blue); None for other kinds of PNG."""
    parts = list(chunks_of(data))
    width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", parts[0][1])
    if (depth, colour, interlace) != (8, 2, 0):
        return None
    raw = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
    row, above, pixels = 3 * width, bytearray(3 * width), []
    for y in range(height):
        start = y * (row + 1)
        above = unfiltered(raw[start], bytearray(raw[start + 1 : start + 1 + row]), above, 3)
        pixels += zip(above[0::3], above[1::3], above[2::3])
    return width, height, pixels


def widest(box):
    """How much the colours of a box differ at most, and in which channel."""
    return max((max(c[i] for c, _ in box) - min(c[i] for c, _ in box), -i) for i in range(3))


def pixels_of(box):
    return sum(n for _, n in box)


def halves(box, channel):
    box.sort(key=lambda entry: (entry[0][channel], entry[0]))
    total, sum_, at = pixels_of(box), 0, 0
    while at < len(box) - 1 and (at == 0 or 2 * sum_ < total):
        sum_ += box[at][1]
        at += 1
    return box[:at], box[at:]


def mean_of(box):
    total = pixels_of(box)
    return tuple((2 * sum(c[i] * n for c, n in box) + total) // (2 * total) for i in range(3))


def palette_of(pixels):
    """The colours, and for each colour of the picture the number of its nearest kin."""
    counts = {}
    for pixel in pixels:
        counts[pixel] = counts.get(pixel, 0) + 1
    boxes = [(widest(list(counts.items())), sorted(counts.items()))]
    while len(boxes) < MOST_COLOURS:
        # What differs much and what covers much are both worth a colour.
        at = max(range(len(boxes)), key=lambda i: (boxes[i][0][0] ** 2 * pixels_of(boxes[i][1]), -i))
        if boxes[at][0][0] == 0:
            break
        spread, box = boxes.pop(at)
        boxes += [(widest(half), half) for half in halves(box, -spread[1])]
    colours = [mean_of(box) for _, box in boxes]
    return colours, {colour: i for i, (_, box) in enumerate(boxes) for colour, _ in box}


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def indexed(width, height, pixels):
    colours, number = palette_of(pixels)
    numbers = bytes(number[pixel] for pixel in pixels)
    raw = b"".join(b"\0" + numbers[y * width : (y + 1) * width] for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)
    return SIGNATURE + b"".join(
        [
            chunk(b"IHDR", header),
            chunk(b"PLTE", bytes(value for colour in colours for value in colour)),
            chunk(b"IDAT", zlib.compress(raw, 9)),
            chunk(b"IEND", b""),
        ]
    )


def main():
    for name in sys.argv[1:]:
        with open(name, "rb") as file:
            data = file.read()
        picture = read_pixels(data)
        small = indexed(*picture) if picture else data
        if len(small) < len(data):
            with open(name, "wb") as file:
                file.write(small)


if __name__ == "__main__":
    main()
