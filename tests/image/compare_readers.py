# SPDX-License-Identifier: Apache-2.0
"""Compares the reader of label images with nibabel: values and places. usage: compare_readers.py PRINT_LABELS"""
import itertools
import os
import subprocess
import sys
import tempfile

try:
    import nibabel
    import numpy
except ImportError:
    print("nibabel is not installed (python3-nibabel): skipped")
    sys.exit(77)

TYPES = ("u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", "f4", "f8")


def ours(program, path):
    words = subprocess.run([program, path], check=True, capture_output=True, text=True).stdout.split()
    shape = tuple(int(w) for w in words[:3])
    place = numpy.array([float(w) for w in words[3:15]]).reshape(4, 3)
    affine = numpy.eye(4)
    affine[:3, 3] = place[0]
    affine[:3, :3] = place[1:].T
    return numpy.array([int(w) for w in words[15:]]).reshape(shape, order="F"), affine


def affines(rng):
    yield numpy.diag([0.9, 0.8, 1.2, 1])
    turn, _ = numpy.linalg.qr(rng.normal(size=(3, 3)))
    for mirror in (1, -1):
        affine = numpy.eye(4)
        affine[:3, :3] = turn @ numpy.diag([mirror * 0.7, 1.1, 3.0])
        affine[:3, 3] = (-40.5, 12.25, 100)
        yield affine


def images(rng):
    """Images of all kinds: (file name, image)."""
    kinds = ((nibabel.Nifti1Image, ("a.nii", "a.nii.gz")), (nibabel.Nifti2Image, ("a.nii", "a.nii.gz")),
             (nibabel.Nifti1Pair, ("a.hdr",)), (nibabel.Nifti2Pair, ("a.img",)))
    for affine, order, kind in itertools.product(affines(rng), "<>", TYPES):
        data = rng.integers(0, 6, size=(7, 5, 4)).astype(order + kind)
        for make, names in kinds:
            header = make.header_class(endianness=order)
            header.set_data_dtype(numpy.dtype(order + kind))
            image = make(data, affine, header)
            for name in names:
                yield name, image
    data = rng.integers(0, 4, size=(6, 3, 2)).astype("i2")
    image = nibabel.Nifti1Image(data, numpy.diag([1, 1, 1, 1]))
    image.set_sform(None, code=0)
    image.set_qform(list(affines(rng))[1], code=1)
    yield "a.nii", image


def main(program):
    rng = numpy.random.default_rng(7)
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, image in images(rng):
            path = os.path.join(folder, name)
            nibabel.save(image, path)
            theirs = nibabel.load(path)
            values, affine = ours(program, path)
            assert numpy.array_equal(values, numpy.asarray(theirs.dataobj)), (name, image.header)
            assert numpy.allclose(affine, theirs.affine, rtol=1e-5, atol=1e-5), (name, affine, theirs.affine)
            count += 1
    print("%d images agree" % count)


if __name__ == "__main__":
    main(sys.argv[1])
