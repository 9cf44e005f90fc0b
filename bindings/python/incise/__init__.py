# SPDX-License-Identifier: Apache-2.0
"""Incise cuts tetrahedral models in real time and keeps the mesh fit to simulate.

>>> import incise
>>> engine = incise.box((4, 4, 4))
>>> engine.cut_plane((1, 0.1, 0), 0.5).stroke
1
>>> bool(engine.validate())
True

docs/python.md in the sources tells more.
"""
from . import batch
from ._library import version as _version
from .attributes import Attributes
from .engine import Engine, Report, Stroke, box, read
from .errors import (BadArgument, BadFile, Busy, InciseError, Internal, OutOfMemory, Unsupported, WriteFailed)
from .journal import Cursor, Step
from .mesh import NONE, Compact, Mesh, Pieces, Quality, Surface, Validity, Violation
from .simulation import Ball, Flat, Frame, Hook, Material, Plane, Rod, Simulation, State, Tool

__version__: str = _version()

__all__ = [
    "Attributes", "BadArgument", "BadFile", "Ball", "Busy", "Compact", "Cursor", "Engine", "Flat", "Frame", "Hook",
    "InciseError", "Internal", "Material", "Mesh", "NONE", "OutOfMemory", "Pieces", "Plane", "Quality", "Report", "Rod",
    "Simulation", "State", "Step", "Stroke", "Surface", "Tool", "Unsupported", "Validity", "Violation", "WriteFailed",
    "batch", "box", "read",
]
