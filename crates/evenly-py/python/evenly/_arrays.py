"""What people have, as the arrays that are worked with."""

from collections.abc import Iterator
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def rows(data: object, name: str = "points", n_columns: int = 2, *, may_be_empty: bool = False) -> Floats:
    """Return a contiguous array of finite float64 rows; the data are never changed.

    Arrays of any layout and real type, lists, and what has an array's protocol are taken; of shapely's points the coordinates, and of trimesh's
    and pyvista's flat ones the first two columns of ``points`` or ``vertices``.
    """
    array = _as_array(data, name)
    if may_be_empty and array.size == 0:
        return np.empty((0, n_columns))
    if array.dtype == object or array.dtype.kind not in "fiub":
        raise ValueError(f"{name} must be an array of numbers of shape (n, {n_columns}), not of type {array.dtype}")
    if array.ndim == 2 and array.shape[1] == n_columns + 1 and _is_flat_model(data):
        heights = array[:, -1]
        if heights.size and not (heights == heights[0]).all():
            raise ValueError(f"{name} must lie in a plane: their last coordinate varies")
        array = array[:, :-1]
    if array.ndim != 2 or array.shape[1] != n_columns:
        raise ValueError(f"{name} must have the shape (n, {n_columns}), not {array.shape}")
    if array.shape[0] == 0:
        raise ValueError(f"{name} must not be empty: the shape is {array.shape}")
    numbers = np.ascontiguousarray(array, dtype=np.float64)
    is_wrong = ~np.isfinite(numbers).all(axis=1)
    if is_wrong.any():
        row = int(np.argmax(is_wrong))
        raise ValueError(f"{name} must be finite: row {row} is {numbers[row].tolist()}")
    return numbers


def pixels(data: object, name: str = "density") -> NDArray[np.float32]:
    """Return a picture of densities, rows from the top."""
    array = np.asarray(data)
    if array.dtype == object or array.dtype.kind not in "fiub" or array.ndim != 2 or array.size == 0:
        raise ValueError(f"{name} must be an array of numbers of shape (height, width), not {array.shape} of {array.dtype}")
    numbers = np.ascontiguousarray(array, dtype=np.float32)
    is_wrong = ~(np.isfinite(numbers) & (numbers >= 0)).all(axis=1)
    if is_wrong.any():
        raise ValueError(f"{name} must be finite, and 0 or more: row {int(np.argmax(is_wrong))} is not")
    return numbers


def converted(array: NDArray[Any], dtype: Any, copy: bool | None) -> NDArray[Any]:
    """Return an array as ``__array__`` must: copied where it has to be, or always, or never."""
    as_wanted = np.asarray(array, dtype=dtype)
    if copy is False and as_wanted.dtype != array.dtype:
        raise ValueError(f"an array of {as_wanted.dtype} takes a copy")
    return as_wanted.copy() if copy else as_wanted


class Frozen:
    """What has arrays that nobody can write to, not in copies of it either."""

    def __setstate__(self, state: dict[str, Any]) -> None:
        for value in state.values():
            for array in value.values() if isinstance(value, dict) else [value]:
                if isinstance(array, np.ndarray):
                    frozen(array)
        self.__dict__.update(state)


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """Return the array, which nobody can write to any more."""
    array.setflags(write=False)
    return array


def _as_array(data: object, name: str) -> NDArray[Any]:
    if np.ma.isMaskedArray(data) and np.ma.is_masked(data):
        raise ValueError(f"{name} must have no masked values")
    if hasattr(data, "triangles") and hasattr(data, "tags"):
        raise ValueError(f"{name} must be points; a mesh has them as its vertices")
    if not hasattr(data, "__array__"):
        if hasattr(data, "__geo_interface__"):
            shape = cast("dict[str, Any]", data.__geo_interface__)
            if shape.get("type") not in ("MultiPoint", "LineString"):
                raise ValueError(f"{name} must be points, not a {shape.get('type')}")
            data = list(shape["coordinates"])
        for attribute in ("points", "vertices"):
            if hasattr(data, attribute):
                return np.asarray(getattr(data, attribute))
    try:
        return np.asarray(list(data) if isinstance(data, Iterator) else data)
    except ValueError:
        raise ValueError(f"{name} must be an array of rows that are all as long") from None


def _is_flat_model(data: object) -> bool:
    return hasattr(data, "vertices") or hasattr(data, "points")
