"""Densities: how many points are wanted where."""

import math
import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from evenly._arrays import pixels
from evenly._spaces import Space, frame

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Density: TypeAlias = "ArrayLike | Callable[[Any, Any], Any] | tuple[ArrayLike, ArrayLike, ArrayLike] | object | str | os.PathLike[str] | None"
Rows: TypeAlias = Literal["upper", "lower"]
"""Which row of an array comes first: the upper one, as pictures have it, or the lower one, as y grows."""

_PER_POINT = 5.6
_SIDES = (64, 1024)
_USUAL_SIDE = 512


class Raster:
    """Pixels of a density whose rows run from the top."""

    def __init__(self, values: NDArray[np.float32]) -> None:
        self.values = values


def density_of(density: Any, space: Space, rows: object = None, n: int | None = None) -> NDArray[np.float32] | str | None:
    """Return the density as the native half takes it: pixels, rows from the top, or a file.

    A function is sampled as finely as so many points can follow it.
    """
    if rows is not None and rows not in ("upper", "lower"):
        raise ValueError(f"density_rows is {rows!r}; it must be 'upper' or 'lower'")
    if density is None or isinstance(density, (str, os.PathLike)):
        return None if density is None else os.fspath(density)
    if isinstance(density, Raster):
        return density.values
    at = _function_of(density)
    if at is not None:
        return pixels(_sampled(at, space, _side(n)), "what density returns")
    values = pixels(density)
    if rows is None:
        raise ValueError(
            "density is an array: say which row comes first, "
            "density_rows='upper' (as pictures have it) or density_rows='lower' (as y grows, and matplotlib's origin='lower' has it)"
        )
    return values if rows == "upper" else np.ascontiguousarray(values[::-1])


def _side(n: int | None) -> int:
    return _USUAL_SIDE if n is None else min(max(_SIDES[0], round(_PER_POINT * math.sqrt(n))), _SIDES[1])


def _function_of(density: Any) -> Callable[[Any, Any], Any] | None:
    """Return what a density is at arrays of x and y; None of an array."""
    if hasattr(density, "evaluate") and hasattr(density, "dataset"):
        # Of scipy: coordinates by rows.
        return lambda x, y: density(np.vstack([np.ravel(x), np.ravel(y)])).reshape(np.shape(x))
    if hasattr(density, "score_samples"):
        # Of scikit-learn: points by rows, and the logarithm.
        return lambda x, y: np.exp(density.score_samples(np.column_stack([np.ravel(x), np.ravel(y)]))).reshape(np.shape(x))
    if isinstance(density, tuple) and len(density) == 3 and [np.ndim(part) for part in density] == [1, 1, 2]:
        return _between(*(np.asarray(part, dtype=float) for part in density))
    return density if callable(density) else None


def _between(x: NDArray[Any], y: NDArray[Any], values: NDArray[Any]) -> Callable[[Any, Any], Any]:
    """Return the linear interpolation of values of shape (len(y), len(x)), which go on beyond the last."""
    if values.shape != (len(y), len(x)) or min(len(x), len(y)) < 2:
        raise ValueError(f"density has values of shape {values.shape} for {len(x)} x and {len(y)} y; it must be (len(y), len(x)), 2 or more each")
    if not ((np.diff(x) > 0).all() or (np.diff(x) < 0).all()) or not ((np.diff(y) > 0).all() or (np.diff(y) < 0).all()):
        raise ValueError("density must have x and y that grow, or fall, all the way")
    along_x, along_y = np.argsort(x), np.argsort(y)
    x, y, values = x[along_x], y[along_y], values[np.ix_(along_y, along_x)]

    def place(at: Any, of: NDArray[Any]) -> tuple[Any, Any]:
        low = np.clip(np.searchsorted(of, at) - 1, 0, len(of) - 2)
        return low, np.clip((at - of[low]) / (of[low + 1] - of[low]), 0.0, 1.0)

    def at(at_x: Any, at_y: Any) -> Any:
        (i, s), (j, t) = place(np.asarray(at_x), x), place(np.asarray(at_y), y)
        low = values[j, i] * (1 - s) + values[j, i + 1] * s
        high = values[j + 1, i] * (1 - s) + values[j + 1, i + 1] * s
        return low * (1 - t) + high * t

    return at


def _sampled(density: Callable[[Any, Any], Any], space: Space, side: int) -> NDArray[Any]:
    (x, y), (width, height) = frame(space)
    scale = side / max(width, height)
    columns, rows = (max(1, round(length * scale)) for length in (width, height))
    at_x = x + width * (np.arange(columns) + 0.5) / columns
    at_y = y + height * (np.arange(rows)[::-1] + 0.5) / rows
    grid_x, grid_y = np.meshgrid(at_x, at_y)
    return np.broadcast_to(np.asarray(density(grid_x, grid_y)), grid_x.shape)
