"""`mesh`, and the mesh that it returns."""

import json
import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from evenly import _evenly
from evenly._arrays import Floats, Frozen, frozen, rows
from evenly._densities import Density, Rows, density_of
from evenly._jobs import Callback, named, perform, run
from evenly._methods import OnMeshes, OptimizerOptions, parameters_of, refuse_renamed
from evenly._seeds import Seed, number
from evenly._spaces import Polygon

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

_MANY = 20_000


@dataclass(frozen=True)
class MeshQuality:
    """What a mesh is worth; angles in degrees, lengths and areas in input units."""

    n_vertices: int
    """How many vertices there are."""
    n_triangles: int
    """How many triangles."""
    n_boundary_edges: int
    """How many edges on the boundary."""
    min_angle_deg: float
    """Smallest angle."""
    max_angle_deg: float
    """Largest angle."""
    mean_min_angle_deg: float
    """Mean of the triangles' smallest angles."""
    obtuse_triangles: int
    """Triangles with an angle above 90 degrees."""
    radius_edge: float
    """Largest ratio of a triangle's circumradius to its shortest side."""
    beta: float
    """Largest circumradius over shortest edge, of all triangles."""
    triangle_quality: float
    """Mean of twice the inradius over the circumradius; 1 for equilateral triangles."""
    min_edge: float
    """Shortest edge."""
    max_edge: float
    """Longest edge."""
    area: float
    """The area of all triangles."""
    size_ratio_mean: float
    """Mean of edges over the mean of the lengths wanted at their ends."""
    size_ratio_min: float
    """The smallest of these."""
    size_ratio_max: float
    """The largest."""


@dataclass(frozen=True, eq=False, repr=False)
class Mesh(Frozen):
    """Triangles that cover a polygon."""

    vertices: Floats
    """Of shape (n, 2)."""
    triangles: NDArray[np.int64]
    """Of shape (m, 3): the vertices of each, counter-clockwise."""
    edges: NDArray[np.int64]
    """Of shape (k, 2): the edges on the boundary, with the inside on their left, and on lines."""
    tags: NDArray[np.int64]
    """Of each edge: the segment of the boundary, counted through all of the polygon's rings; or -1, -2, ... for the first line, the second, ...;
    or `Mesh.BETWEEN` where two regions meet."""
    edge_length: Floats
    """Of shape (n,): the length of edges that is wanted at each vertex, shorter than was asked for where the boundary is detailed."""
    quality: MeshQuality
    """What it is worth."""
    seed: int
    """The same seed makes the same mesh."""
    outcome: str
    """'converged' where all triangles are as good as they were to be; see `Points.outcome`."""
    notes: tuple[str, ...] = ()
    """What is good to know."""
    unmet: tuple[str, ...] = ()
    """Where a demand was not met, and why."""
    regions: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, dtype=np.int64))
    """Of shape (m,): the region in which each triangle lies, -1 for none; empty where there are no regions."""
    region_names: tuple[str, ...] = ()
    """The regions' names."""
    n_in_corners: int = 0
    """So many triangles, the last ones, lie in corners of the polygon that are sharper than 60 degrees."""

    BETWEEN: ClassVar[int] = -(2**63)
    """The tag of edges between two regions."""

    def __repr__(self) -> str:
        q = self.quality
        angles = f"angles {q.min_angle_deg:.1f} to {q.max_angle_deg:.1f} degrees"
        return f"<mesh of {q.n_triangles} triangles and {q.n_vertices} vertices, {angles}>"

    def save(self, path: "str | os.PathLike[str]") -> None:
        """Write the mesh as .msh (Gmsh 4.1), .vtu, .obj, .ply, .off, .stl, .geojson, .npz, .svg, .png or .pdf, as the path says."""
        _evenly.write_mesh(os.fspath(path), self._parts())

    def _parts(self) -> dict[str, object]:
        lists = {name: getattr(self, name).tolist() for name in ("tags", "edge_length", "regions")}
        names = ("vertices", "triangles", "edges", "region_names", "n_in_corners")
        return {name: getattr(self, name) for name in names} | lists

    def to_meshio(self) -> Any:
        """Return the mesh as meshio has it, which must be installed: triangles, and the edges that had to be with their tags."""
        import meshio

        cells = [("triangle", self.triangles), ("line", self.edges)]
        tags = [np.zeros(len(self.triangles), dtype=np.int64), self.tags]
        return meshio.Mesh(self.vertices, cells, cell_data={"tag": tags})

    def to_geodataframe(self, crs: Any = None) -> Any:
        """Return the triangles as a GeoDataFrame of geopandas, which must be installed."""
        import geopandas
        import shapely

        return geopandas.GeoDataFrame(geometry=shapely.polygons(self.vertices[self.triangles]), crs=crs)

    def svg(self) -> str:
        """Draw the mesh: obtuse triangles light red, thin ones red."""
        return _evenly.mesh_figure(self._parts())

    def _repr_svg_(self) -> str | None:
        return self.svg() if len(self.triangles) <= _MANY else None

    def _repr_png_(self) -> bytes | None:
        return run(lambda: _evenly.rendered(self.svg()), bytes) if len(self.triangles) > _MANY else None


def mesh(
    polygon: object = None,
    *,
    edge_length: float | None = None,
    n_triangles: int | None = None,
    simplify: float | None = None,
    seed: Seed = 0,
    method: OnMeshes = "push-pull",
    grade: float | None = None,
    max_edge_length: float | None = None,
    sizes: "ArrayLike | object | None" = None,
    density: Density = None,
    density_rows: Rows | None = None,
    min_angle: float | None = None,
    no_obtuse: bool = False,
    fixed: "ArrayLike | object | None" = None,
    lines: "Sequence[ArrayLike | object] | None" = None,
    regions: "Mapping[str, object] | Sequence[object] | str | os.PathLike[str] | None" = None,
    threads: int | None = None,
    callback: Callback | None = None,
    **options: "Unpack[OptimizerOptions]",
) -> Mesh:
    """Mesh a polygon with triangles that conform to its boundary (Ebeida et al. 2014, section 7).

    Parameters
    ----------
    polygon : Polygon, shapely polygon, file, ring or rings
        See `Polygon`. May be left out with `regions`: what these cover together.
    edge_length : float, optional
        The wanted length of edges, in input units; shorter where the boundary is detailed or the domain narrow. This or `n_triangles`.
    n_triangles : int, optional
        About how many triangles, instead.
    simplify : float, optional
        Fewer corners first: no place of the boundary goes farther than this, in input units. `Mesh.tags` then count the segments of the simpler polygon.
    seed : int, SeedSequence, Generator or None
        As in `generate`.
    method : str
        By which rule points move.
    grade : float, optional
        Let edges grow away from the boundary, by so much a length.
    max_edge_length : float, optional
        The longest edges wanted, where they grow.
    sizes : array_like of shape (k, 3), optional
        Wanted lengths of edges at points, as x, y and length, where they are to be shorter than `edge_length`; they grow from there by `grade`, or 0.25, per unit of distance.
    density, density_rows : optional
        How many vertices are wanted where, in the polygon's frame; see `generate`.
    min_angle : float, optional
        No angle shall be smaller, in degrees, but in sharper corners of the polygon; 25 by default.
    no_obtuse : bool
        No triangle shall be obtuse.
    fixed : array_like of shape (k, 2), optional
        Points that become vertices.
    lines : sequence of array_like of shape (k, 2), optional
        Lines that become edges, split where they cross and clipped at the boundary; they are no slits: triangles on both sides share their vertices.
    regions : mapping or sequence of polygons, or a file, optional
        Parts that are kept apart: no triangle lies in two, and `Mesh.regions` tells for each in which. Of a file: features of GeoJSON, polygons of WKT, shapes
        of SVG or of a shapefile, rings of text.
    threads, callback
        As in `generate`.
    **options
        What the method can be told, see `methods`. Targets, as ``beta=0.72``, are demands: they bound the angles, and where they are missed ``unmet`` says so.

    Returns
    -------
    Mesh
        Vertices, triangles and tagged edges. That a demand was not met is no error: see ``unmet``.

    Raises
    ------
    ValueError
        For what cannot be; the message has the place.
    Interrupted
        Where Ctrl-C ends the run; ``partial`` has the mesh reached.

    Examples
    --------
    >>> import evenly
    >>> l_shape = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    >>> mesh = evenly.mesh(l_shape, edge_length=0.1, no_obtuse=True)
    >>> mesh.quality.obtuse_triangles, mesh.quality.min_angle_deg > 40
    (0, True)
    """
    refuse_renamed(options, {"spacing": "edge_length", "max_spacing": "max_edge_length"})
    parts = _named(regions)
    shape = polygon if polygon is None or isinstance(polygon, Polygon) else Polygon(polygon)
    chance = number(seed)
    held = rows(() if fixed is None else fixed, "fixed", may_be_empty=True)
    ways = [rows(line, f"line {k}") for k, line in enumerate(lines or ())]
    lengths = None if sizes is None else rows(sizes, "sizes", 3, may_be_empty=True)
    if density is not None and shape is None:
        raise ValueError("density spans the polygon's frame; give the polygon too")
    wanted = None if shape is None else density_of(density, shape, density_rows)
    outer = None if shape is None else [list(ring) for ring in shape.rings]
    repairs = () if shape is None else shape.repairs

    def build(
        answer: tuple[Floats, NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], str, list[float], NDArray[np.int64]],
    ) -> Mesh:
        vertices, triangles, edges, tags, text, lengths, regions = answer
        said: dict[str, Any] = json.loads(text)
        quality: dict[str, Any] = {name: math.nan if value is None else value for name, value in said["quality"].items()}
        return Mesh(
            vertices=frozen(vertices),
            triangles=frozen(triangles),
            edges=frozen(edges),
            tags=frozen(tags),
            edge_length=frozen(np.asarray(lengths)),
            quality=MeshQuality(**{each.name: quality[each.name] for each in fields(MeshQuality)}),
            seed=chance,
            outcome=said["run"]["outcome"],
            notes=(*repairs, *said["notes"]),
            unmet=tuple(said["unmet"]),
            regions=frozen(regions),
            region_names=tuple(said["region_names"]),
            n_in_corners=said["n_in_corners"],
        )

    return perform(
        "mesh",
        {
            "edge_length": edge_length,
            "n_triangles": n_triangles,
            "simplify": simplify,
            "seed": chance,
            "method": method,
            "grade": grade,
            "max_edge_length": max_edge_length,
            "min_angle": min_angle,
            "no_obtuse": no_obtuse,
        },
        parameters_of(options),
        {
            "polygon": named("the polygon", outer),
            "regions": named("the regions", parts or None),
            "fixed": named("fixed", held),
            "lines": named("lines", ways),
            "sizes": named("sizes", lengths),
            "density": named("density", wanted),
        },
        build,
        threads,
        callback,
    )


def _named(regions: object) -> list[tuple[str, list[list[tuple[float, float]]]]]:
    """Return the rings of each region, by its name."""
    if regions is None:
        return []
    if isinstance(regions, (str, os.PathLike)):
        return [(name, [list(ring) for ring in rings]) for name, (rings, _, _) in _evenly.read_regions(os.fspath(regions))]
    if isinstance(regions, Mapping):
        named = [(str(name), shape) for name, shape in regions.items()]
    elif isinstance(regions, Sequence):
        named = [(f"region {k}", shape) for k, shape in enumerate(regions, 1)]
    else:
        raise ValueError(f"regions is {type(regions).__name__}; it must be a mapping or a sequence of polygons, or a file")
    if not named:
        raise ValueError("regions is empty; leave it out")
    polygons = [(name, shape if isinstance(shape, Polygon) else Polygon(shape)) for name, shape in named]
    return [(name, [list(ring) for ring in shape.rings]) for name, shape in polygons]
