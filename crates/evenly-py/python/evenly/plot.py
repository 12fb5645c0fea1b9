"""Figures with matplotlib, which is needed for them; each function returns the axes that it has drawn on."""

from typing import TYPE_CHECKING, Any, cast

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from evenly import _evenly
from evenly._arrays import rows
from evenly._jobs import run
from evenly._measures import _sets, _space, power_spectrum, radial_power
from evenly._meshes import Mesh
from evenly._spaces import Pair, Polygon, frame, native

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["points", "radial", "report", "spectrum", "triangulation"]


def points(
    points: "ArrayLike | object",
    *,
    ax: Axes | None = None,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    **style: Any,
) -> Axes:
    """Draw points in their domain; `style` goes to ``Axes.scatter``."""
    axes, positions = _axes(ax), rows(points)
    where = _space(points, space, size, origin)
    corner, extent = frame(where)
    # As large as they may be without touching.
    style = {"s": min(20.0, 2e4 / len(positions)), "linewidths": 0, **_ink(style), **style}
    axes.scatter(positions[:, 0], positions[:, 1], **style)
    if isinstance(where, Polygon):
        rings = [np.asarray([*ring, ring[0]]) for ring in where.rings]
        axes.add_collection(LineCollection(rings, colors="0.5", linewidths=0.8))
    axes.set(xlim=(corner[0], corner[0] + extent[0]), ylim=(corner[1], corner[1] + extent[1]), aspect="equal")
    return axes


def triangulation(
    points: "Mesh | ArrayLike | object",
    *,
    ax: Axes | None = None,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    **style: Any,
) -> Axes:
    """Draw the Delaunay triangulation of points, or a mesh; `style` goes to ``LineCollection``."""
    axes = _axes(ax)
    if isinstance(points, Mesh):
        corners = points.vertices[points.triangles]
    else:
        where = _space(points, space, size, origin)
        corners = run(lambda: _evenly.triangles(rows(points), native(where), None), np.asarray).reshape(-1, 3, 2)
    closed = np.concatenate([corners, corners[:, :1]], axis=1)
    style = {"linewidths": 0.5, **({} if {"color", "colors"} & style.keys() else {"colors": "0.3"}), **style}
    axes.add_collection(LineCollection(list(closed), **style))
    axes.autoscale_view()
    axes.set_aspect("equal")
    return axes


def spectrum(
    points: "ArrayLike | object",
    *,
    ax: Axes | None = None,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    max_frequency: float = 4.0,
    **style: Any,
) -> Axes:
    """Draw the power spectrum, in log grey from a hundredth to ten times white noise; `style` goes to ``Axes.imshow``."""
    axes = _axes(ax)
    found = power_spectrum(points, space=space, size=size, origin=origin, max_frequency=max_frequency)
    half = [0.5 * step * n for step, n in zip(found.step, reversed(found.power.shape), strict=True)]
    style = {"cmap": "gray", "vmin": -2, "vmax": 1, **style}
    extent = (-half[0], half[0], -half[1], half[1])
    axes.imshow(np.log10(np.maximum(found.power, 1e-9)), origin="lower", extent=extent, **style)
    axes.set(xlabel="frequency / mean frequency")
    return axes


def radial(
    points: "ArrayLike | object",
    *,
    ax: Axes | None = None,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    **style: Any,
) -> Axes:
    """Draw the radial mean of the power spectrum; `style` goes to ``Axes.plot``."""
    axes = _axes(ax)
    found = radial_power(points, space=space, size=size, origin=origin)
    axes.plot(found.frequencies, found.power, **{**_ink(style), **style})
    axes.axhline(1, color="0.7", linewidth=0.8)
    axes.set(xlabel="frequency / mean frequency", ylabel="radial mean power", xlim=(0, None), ylim=(0, None))
    return axes


def report(
    points: "ArrayLike | object",
    *,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
) -> "np.ndarray[Any, np.dtype[np.object_]]":
    """Draw a page of points, triangulation, spectrum and radial mean; returns its four axes."""
    sets, where, _ = _sets(points, space, size, origin)
    if isinstance(where, Polygon):
        raise ValueError("a polygon has no spectrum, so there is no report")
    _, grid = plt.subplots(2, 2, figsize=(10, 10), layout="constrained")
    axes = cast("np.ndarray[Any, np.dtype[np.object_]]", grid)
    _points_of(sets[0], axes[0, 0], where)
    triangulation(sets[0], ax=axes[0, 1], space=where)
    spectrum(points, ax=axes[1, 0], space=where)
    radial(points, ax=axes[1, 1], space=where)
    return axes


def _points_of(positions: Any, ax: Axes, where: object) -> None:
    points(positions, ax=ax, space=where)


def _ink(style: dict[str, Any]) -> dict[str, Any]:
    return {} if {"c", "color"} & style.keys() else {"color": "black"}


def _axes(ax: Axes | None) -> Axes:
    return plt.subplots(figsize=(6, 6))[1] if ax is None else ax
