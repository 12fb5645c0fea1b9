"""Densities: how many points are wanted where."""

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from evenly._arrays import pixels
from evenly._spaces import Space, frame

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Density: TypeAlias = "ArrayLike | Callable[[Any, Any], Any] | str | os.PathLike[str] | None"

_LONGER_SIDE = 1024


def density_of(density: Any, space: Space) -> NDArray[np.float32] | str | None:
    """Return the density as the native half takes it: pixels, rows from the top, or a file."""
    if density is None:
        return None
    if isinstance(density, (str, os.PathLike)):
        return os.fspath(density)
    if callable(density):
        return pixels(_sampled(density, space), "what density returns")
    return pixels(density)


def _sampled(density: Callable[[Any, Any], Any], space: Space) -> NDArray[Any]:
    (x, y), (width, height) = frame(space)
    scale = _LONGER_SIDE / max(width, height)
    columns, rows = (max(1, round(side * scale)) for side in (width, height))
    at_x = x + width * (np.arange(columns) + 0.5) / columns
    at_y = y + height * (np.arange(rows)[::-1] + 0.5) / rows
    grid_x, grid_y = np.meshgrid(at_x, at_y)
    return np.broadcast_to(np.asarray(density(grid_x, grid_y)), grid_x.shape)
