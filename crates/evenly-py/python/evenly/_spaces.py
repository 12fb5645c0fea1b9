"""Domains: tori, rectangles and polygons."""

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from evenly import _evenly
from evenly._arrays import rows
from evenly._jobs import Named

Pair: TypeAlias = tuple[float, float]
Metric: TypeAlias = Literal["input", "unit"]
"""In which units distances are measured: those of the input, or parts of the domain's width and of its height."""


@dataclass(frozen=True)
class Torus:
    """A periodic rectangle: sets of points tile the plane."""

    size: Pair = (1.0, 1.0)
    """Width and height."""
    origin: Pair = (0.0, 0.0)
    """The lower left corner."""

    def __post_init__(self) -> None:
        _settle(self)


@dataclass(frozen=True)
class Rectangle:
    """A bounded rectangle."""

    size: Pair = (1.0, 1.0)
    """Width and height."""
    origin: Pair = (0.0, 0.0)
    """The lower left corner."""

    def __post_init__(self) -> None:
        _settle(self)


def _settle(box: "Torus | Rectangle") -> None:
    for name in ("size", "origin"):
        object.__setattr__(box, name, _pair(getattr(box, name), name, (0.0, 0.0)))


@dataclass(frozen=True, init=False, repr=False)
class Polygon:
    """A polygon with holes, in one part or several, cleaned and checked.

    Parameters
    ----------
    shape : object
        A shapely polygon or multipolygon, or anything else with ``__geo_interface__``; a file (GeoJSON, WKT, SVG, shapefile or text); a ring, as an array of
        shape (n, 2); or a list of rings, the first of which is the outer one and the others its holes.

    Raises
    ------
    ValueError
        Where nothing is enclosed, or a hole lies outside of its part: the message has the place.

    Examples
    --------
    >>> import evenly
    >>> l_shape = evenly.Polygon([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])
    >>> l_shape.area
    3.0
    >>> evenly.Polygon([[(0, 0), (3, 0), (3, 3), (0, 3)], [(1, 1), (2, 1), (2, 2), (1, 2)]]).area
    8.0
    """

    rings: tuple[tuple[Pair, ...], ...]
    """Outer rings counter-clockwise, holes clockwise; as they are after repairs."""
    area: float
    """What is enclosed, in input units squared."""
    repairs: tuple[str, ...]
    """What was repaired."""

    def __init__(self, shape: object) -> None:
        is_file = isinstance(shape, (str, os.PathLike))
        if isinstance(shape, Polygon):
            rings, area, repairs = [list(ring) for ring in shape.rings], shape.area, list(shape.repairs)
        else:
            rings, area, repairs = _evenly.read_polygon(os.fspath(cast("str", shape))) if is_file else _evenly.polygon(_parts(shape))
        object.__setattr__(self, "rings", tuple(tuple((x, y) for x, y in ring) for ring in rings))
        object.__setattr__(self, "area", area)
        object.__setattr__(self, "repairs", tuple(repairs))

    def __repr__(self) -> str:
        corners = sum(map(len, self.rings))
        return f"<polygon of {len(self.rings)} rings with {corners} corners, area {self.area:.6g}>"


Space: TypeAlias = Torus | Rectangle | Polygon


def space_of(
    space: object, size: Pair | None, origin: Pair | None, default: Space | None = None, points: "NDArray[Any] | None" = None
) -> Space:
    """Return the domain that the arguments stand for; where they say nothing, it must hold the points."""
    if points is not None and space is None and size is None and origin is None and default is None:
        _require_inside_unit(points)
    if space is None:
        space = default if default is not None and size is None and origin is None else "torus"
    if isinstance(space, (Torus, Rectangle, Polygon)):
        if size is not None or origin is not None:
            raise ValueError("size and origin are for space='torus' and 'rect'; this space has its own")
        return space
    if isinstance(space, str) and space in ("torus", "rect", "rectangle"):
        kind = Torus if space == "torus" else Rectangle
        return kind(_pair(size, "size", (1.0, 1.0)), _pair(origin, "origin", (0.0, 0.0)))
    if size is not None or origin is not None:
        raise ValueError("size and origin are for space='torus' and 'rect'; a polygon has its own")
    if isinstance(space, str) and not os.path.exists(space):
        raise ValueError(f"space is {space!r}; it must be 'torus', 'rect', a polygon or a polygon's file, and there is no file of that name")
    return Polygon(space)


def metric_of(metric: object) -> str:
    """Return a metric that there is."""
    if metric not in ("input", "unit"):
        raise ValueError(f"metric is {metric!r}; it must be 'input' or 'unit'")
    return str(metric)


def native(space: Space, metric: Metric = "input") -> Any:
    """Return what the native half takes."""
    is_unit = metric_of(metric) == "unit"
    if isinstance(space, Polygon):
        return ([list(ring) for ring in space.rings], is_unit)
    return ("torus" if isinstance(space, Torus) else "rectangle", space.origin, space.size, is_unit)


def _require_inside_unit(points: "NDArray[Any]") -> None:
    n_outside = int(((points < 0) | (points > 1)).any(axis=1).sum())
    if n_outside > 0:
        low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        raise ValueError(
            f"{n_outside} points lie outside the unit torus, which was assumed; they span {low} to {high}: give their space, or size and origin"
        )


def domain(space: Space) -> dict[str, object]:
    """Return the domain as requests have it, and its data."""
    if isinstance(space, Polygon):
        return {"space": Named("the polygon", [list(ring) for ring in space.rings], {"kind": "polygon", "polygon": "the polygon"})}
    return {"space": {"kind": "torus" if isinstance(space, Torus) else "rectangle", "origin": space.origin, "size": space.size}}


def frame(space: Space) -> tuple[Pair, Pair]:
    """Return the lower left corner and the size of what encloses a domain."""
    if isinstance(space, Polygon):
        corners = np.concatenate([np.asarray(ring) for ring in space.rings])
        low, high = corners.min(axis=0), corners.max(axis=0)
        return (float(low[0]), float(low[1])), (float(high[0] - low[0]), float(high[1] - low[1]))
    return space.origin, space.size


def _pair(value: object, name: str, default: Pair) -> Pair:
    if value is None:
        return default
    try:
        x, y = (float(number) for number in cast("Sequence[Any]", value))
    except (TypeError, ValueError):
        raise ValueError(f"{name} is {value!r}; it must be two numbers") from None
    if not (math.isfinite(x) and math.isfinite(y)) or (name == "size" and min(x, y) <= 0):
        raise ValueError(f"{name} is {value!r}; it must be finite" + (", and more than 0" if name == "size" else ""))
    return (x, y)


def _ring(ring: object) -> list[Pair]:
    return [(float(x), float(y)) for x, y in rows(ring, "a ring")]


def _parts(shape: object) -> list[list[list[Pair]]]:
    if hasattr(shape, "__geo_interface__") or isinstance(shape, dict):
        try:
            return _geo_parts(cast("dict[str, Any]", getattr(shape, "__geo_interface__", shape)))
        except (AttributeError, KeyError, TypeError):
            raise ValueError("a polygon must have a GeoJSON type and coordinates") from None
    if isinstance(shape, np.ndarray):
        return [[_ring(shape)]]
    try:
        first = cast("Sequence[Any]", shape)[0]
        is_ring = np.ndim(first[0]) == 0
    except (TypeError, IndexError, KeyError):
        raise ValueError("a polygon must be a shape, a file, a ring or a list of rings") from None
    return [[_ring(shape)]] if is_ring else [[_ring(ring) for ring in cast("Sequence[Any]", shape)]]


def _geo_parts(shape: dict[str, Any]) -> list[list[list[Pair]]]:
    kind = shape.get("type")
    if kind == "Feature":
        return _geo_parts(shape["geometry"])
    if kind in ("FeatureCollection", "GeometryCollection"):
        members = shape["features" if kind == "FeatureCollection" else "geometries"]
        return [part for member in members for part in _geo_parts(member)]
    if kind == "Polygon":
        return [[_flat(ring) for ring in shape["coordinates"]]]
    if kind == "MultiPolygon":
        return [[_flat(ring) for ring in part] for part in shape["coordinates"]]
    raise ValueError(f"a polygon is needed, not a {kind}")


def _flat(ring: Sequence[Sequence[float]]) -> list[Pair]:
    return _ring([corner[:2] for corner in ring])
