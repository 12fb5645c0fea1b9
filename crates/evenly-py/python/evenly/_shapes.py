"""Meshes in space, whoever made them, as what the native module takes."""

import os
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from evenly._arrays import Floats, rows

Shape: TypeAlias = "str | tuple[Floats, NDArray[np.int64]]"


def native(shape: Any) -> Shape:
    """Return a path, or vertices and triangles."""
    if isinstance(shape, (str, os.PathLike)):
        return os.fspath(shape)
    if isinstance(shape, (tuple, list)) and len(shape) == 2:
        vertices, triangles = shape
    elif hasattr(shape, "cells_dict"):
        vertices, triangles = shape.points, shape.cells_dict.get("triangle", ())
    elif hasattr(shape, "regular_faces"):
        vertices, triangles = shape.points, shape.regular_faces
    elif hasattr(shape, "vertices") and (hasattr(shape, "faces") or hasattr(shape, "triangles")):
        vertices, triangles = shape.vertices, shape.faces if hasattr(shape, "faces") else shape.triangles
    else:
        raise TypeError(f"a mesh is needed: a path, vertices and triangles, or what has them, not {type(shape).__name__}")
    return rows(vertices, "vertices", 3), _indices(triangles)


def _indices(triangles: object) -> NDArray[np.int64]:
    array = np.asarray(triangles)
    if array.ndim != 2 or array.shape[1] != 3 or array.shape[0] == 0 or array.dtype.kind not in "iu":
        raise ValueError(f"triangles must be whole numbers of shape (m, 3), not {array.dtype} of shape {array.shape}")
    return np.ascontiguousarray(array, dtype=np.int64)
