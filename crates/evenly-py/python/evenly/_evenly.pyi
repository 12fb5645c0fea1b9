from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

_Rows: TypeAlias = NDArray[np.float64]
_Box: TypeAlias = tuple[str, tuple[float, float], tuple[float, float], bool]
_Parts: TypeAlias = Sequence[Sequence[Sequence[tuple[float, float]]]]
_Rings: TypeAlias = Sequence[Sequence[tuple[float, float]]]
_Space: TypeAlias = _Box | tuple[_Rings, bool]
_Density: TypeAlias = NDArray[np.float32] | str | None
_Callback: TypeAlias = Callable[[int, float | None, float | None, float, Any], bool | None] | None
_Clean: TypeAlias = tuple[list[list[tuple[float, float]]], float, list[str]]
_Shape: TypeAlias = tuple[_Rows, NDArray[np.int64]] | str
_Places: TypeAlias = tuple[_Rows, NDArray[np.int64], _Rows, _Rows]

__all__ = [
    "Pending",
    "Stopped",
    "__version__",
    "command",
    "figure",
    "measure",
    "mesh_figure",
    "methods",
    "perform",
    "polygon",
    "power_spectrum",
    "radial_spectrum",
    "read_polygon",
    "read_regions",
    "rendered",
    "surface_figure",
    "surface_spectrum",
    "triangles",
    "write_mesh",
    "write_surface",
]
__version__: str

class Stopped(KeyboardInterrupt): ...

@final
class Pending:
    def result(self) -> object: ...

def perform(
    request: str, data: Mapping[str, object], threads: int | None, callback: _Callback
) -> Any: ...
def measure(points: _Rows, space: _Space, density: _Density, threads: int | None) -> str: ...
def power_spectrum(
    sets: list[_Rows], space: _Space, max_frequency: float, threads: int | None
) -> tuple[_Rows, tuple[int, int], tuple[float, float], _Rows, _Rows, _Rows]: ...
def radial_spectrum(
    sets: list[_Rows], space: _Space, threads: int | None
) -> tuple[_Rows, _Rows, _Rows, _Rows, float, float]: ...
def triangles(points: _Rows, space: _Space, threads: int | None) -> _Rows: ...
def figure(points: _Rows, space: _Space, density: _Density, draw: list[str]) -> str: ...
def rendered(svg: str) -> bytes: ...
def polygon(parts: _Parts) -> _Clean: ...
def read_polygon(path: str) -> _Clean: ...
def read_regions(path: str) -> list[tuple[str, _Clean]]: ...
def write_mesh(path: str, parts: dict[str, object]) -> None: ...
def mesh_figure(parts: dict[str, object]) -> str: ...
def surface_spectrum(
    shape: _Shape, points: _Rows, is_local: bool, is_repaired: bool, threads: int | None
) -> tuple[tuple[float, float], tuple[_Rows, _Rows, _Rows, _Rows, float, float]]: ...
def write_surface(
    path: str,
    places: tuple[_Rows, list[int], _Rows, _Rows],
    triangles: NDArray[np.int64],
    attributes: list[tuple[str, list[float]]],
) -> None: ...
def surface_figure(vertices: _Rows, triangles: NDArray[np.int64]) -> str: ...
def methods() -> str: ...
def command(words: list[str]) -> int: ...
