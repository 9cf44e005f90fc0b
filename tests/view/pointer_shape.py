# SPDX-License-Identifier: Apache-2.0
"""Prints what the pointer looks like on $DISPLAY now: its size, its hot spot and a checksum of its pixels.

Exit code 77 where the X server's extension for it, or its library, is not there.
"""
import ctypes
import ctypes.util
import sys
import zlib


class Image(ctypes.Structure):
    _fields_ = [("x", ctypes.c_short), ("y", ctypes.c_short), ("width", ctypes.c_ushort), ("height", ctypes.c_ushort),
                ("hot_x", ctypes.c_ushort), ("hot_y", ctypes.c_ushort), ("serial", ctypes.c_ulong),
                ("pixels", ctypes.POINTER(ctypes.c_ulong)), ("atom", ctypes.c_ulong), ("name", ctypes.c_char_p)]


def image_of():
    x11, fixes = (ctypes.CDLL(ctypes.util.find_library(name)) for name in ("X11", "Xfixes"))
    x11.XOpenDisplay.restype = ctypes.c_void_p
    fixes.XFixesGetCursorImage.restype = ctypes.POINTER(Image)
    fixes.XFixesGetCursorImage.argtypes = [ctypes.c_void_p]
    fixes.XFixesQueryExtension.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p]
    display = x11.XOpenDisplay(None)
    numbers = ctypes.c_int(), ctypes.c_int()
    if not display or not fixes.XFixesQueryExtension(display, *map(ctypes.byref, numbers)):
        sys.exit(77)
    return fixes.XFixesGetCursorImage(display).contents


try:
    shown = image_of()
except (OSError, TypeError):  # there is no such library
    sys.exit(77)
pixels = [shown.pixels[i] & 0xFFFFFFFF for i in range(shown.width * shown.height)]
print(shown.width, shown.height, shown.hot_x, shown.hot_y, zlib.crc32(repr(pixels).encode()))
