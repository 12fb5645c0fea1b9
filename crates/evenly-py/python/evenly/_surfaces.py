"""`remesh` and `sample`, and what they return."""

import json
import math
import os
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from evenly import _evenly
from evenly._arrays import Floats, Frozen, converted, frozen, rows
from evenly._jobs import Callback, named, perform, run
from evenly._methods import OnMeshes, OnSurfaces, OptimizerOptions, parameters_of, refuse_renamed
from evenly._seeds import Seed, number
from evenly._shapes import native

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

_MANY = 20_000

_Places: TypeAlias = tuple[Floats, NDArray[np.int64], Floats, Floats]


@dataclass(frozen=True)
class SurfaceQuality:
    """What a mesh in space is worth, by chords; angles in degrees, lengths and areas in input units."""

    n_vertices: int
    """How many vertices there are."""
    n_triangles: int
    """How many triangles."""
    n_components: int
    """How many connected parts."""
    n_boundary_edges: int
    """How many edges with one triangle."""
    euler_characteristic: int
    """Vertices less edges plus triangles."""
    area: float
    """The area of all triangles."""
    min_quality: float
    """Least quality of a triangle, 6 S / (sqrt(3) p h): 1 for equilateral ones."""
    mean_quality: float
    """Mean of the same."""
    min_angle_deg: float
    """Smallest angle."""
    max_angle_deg: float
    """Largest angle."""
    mean_min_angle_deg: float
    """Mean of the triangles' smallest angles."""
    angle_rms_deg: float
    """Root mean square of the angles' differences from 60 degrees."""
    thin_fraction: float
    """Part of the triangles with an angle below 30 degrees."""
    obtuse_triangles: int
    """Triangles with an angle above 90 degrees."""
    obtuse_fraction: float
    """Part of all that they are."""
    valence_567_fraction: float
    """Part of the vertices inside with 5, 6 or 7 neighbours."""
    valence_6_fraction: float
    """Part with 6."""
    min_edge: float
    """Shortest edge."""
    max_edge: float
    """Longest edge."""
    max_circumradius: float
    """Largest circumradius."""
    beta: float
    """Largest circumradius over shortest edge."""
    spacing: float
    """Edge of equilateral triangles, as many, with the same area: 1 for the two that follow."""
    min_distance: float
    """Shortest edge, relative to the spacing."""
    coverage_radius: float
    """Largest circumradius, relative to the spacing."""
    size_ratio_mean: float
    """Mean of edges over the mean of the lengths wanted at their ends."""
    size_ratio_min: float
    """The smallest of these."""
    size_ratio_max: float
    """The largest."""


@dataclass(frozen=True)
class SurfaceDistance:
    """How far a mesh is from the one that was given, in input units, if nothing else is said."""

    rms_to_reference: float
    """Root mean square, from the mesh to the one given."""
    max_to_reference: float
    """Largest, from the mesh to the one given."""
    rms_from_reference: float
    """Root mean square, from the one given."""
    max_from_reference: float
    """Largest, from the one given."""
    flipped_triangles: int
    """Triangles that face the other way than the given mesh does there."""
    farthest_place: tuple[float, float, float]
    """The place on the given mesh from which it is so far."""
    rms: float
    """Larger root mean square, as a part of the given mesh's diagonal."""
    hausdorff: float
    """Larger largest, as a part of the given mesh's diagonal."""


@dataclass(frozen=True, eq=False, repr=False)
class SurfacePoints(Frozen):
    """Points on a surface."""

    positions: Floats
    """Of shape (n, 3)."""
    facets: NDArray[np.int64]
    """The triangle of the given mesh on which each lies."""
    barycentric: Floats
    """Of shape (n, 3): the weights of that triangle's corners."""
    normals: Floats
    """Of shape (n, 3): the surface's unit normals, rounded between creases."""
    seed: int
    """The same seed makes the same points."""
    outcome: str
    """See `Points.outcome`."""
    notes: tuple[str, ...] = ()
    """What is good to know."""

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return converted(self.positions, dtype, copy)

    def __len__(self) -> int:
        return len(self.positions)

    def __repr__(self) -> str:
        return f"<{len(self)} points on a surface>"


@dataclass(frozen=True, eq=False, repr=False)
class SurfaceMesh(Frozen):
    """Triangles in space, and where their vertices lie on the mesh that was given."""

    vertices: Floats
    """Of shape (n, 3)."""
    triangles: NDArray[np.int64]
    """Of shape (m, 3): the vertices of each, running as the given mesh's do."""
    facets: NDArray[np.int64]
    """The triangle of the given mesh on which each vertex lies."""
    barycentric: Floats
    """Of shape (n, 3): the weights of that triangle's corners."""
    normals: Floats
    """Of shape (n, 3): the surface's unit normals, rounded between creases."""
    quality: SurfaceQuality
    """What it is worth."""
    distance: SurfaceDistance
    """How far it is from the mesh that was given."""
    self_intersections: int
    """Pairs of triangles that cross each other."""
    seed: int
    """The same seed makes the same mesh."""
    outcome: str
    """'converged' where the targets are met everywhere; see `Points.outcome`."""
    uncertified: NDArray[np.int64]
    """The triangles whose angles are not what the targets imply; none for methods without targets."""
    attributes: dict[str, Floats] = field(default_factory=dict)
    """What a file's vertices carried, interpolated, by name."""
    notes: tuple[str, ...] = ()
    """What is good to know."""

    @property
    def faces(self) -> NDArray[np.int64]:
        """The triangles, as trimesh calls them."""
        return self.triangles

    def __repr__(self) -> str:
        q = self.quality
        angles = f"angles {q.min_angle_deg:.1f} to {q.max_angle_deg:.1f} degrees"
        return f"<surface mesh of {q.n_triangles} triangles and {q.n_vertices} vertices, {angles}>"

    def save(self, path: "str | os.PathLike[str]") -> None:
        """Write the mesh as .ply, .obj, .off, .stl, .vtu, .msh, .npz, .svg, .png or .pdf, as the path says."""
        places = (self.vertices, self.facets.tolist(), self.barycentric, self.normals)
        attributes = [(name, values.tolist()) for name, values in self.attributes.items()]
        _evenly.write_surface(os.fspath(path), places, self.triangles, attributes)

    def to_trimesh(self) -> Any:
        """Return the mesh as trimesh has it, which must be installed; vertices stay as they are."""
        import trimesh

        return trimesh.Trimesh(self.vertices, self.triangles, process=False)

    def to_meshio(self) -> Any:
        """Return the mesh as meshio has it, which must be installed, with the attributes of its vertices."""
        import meshio

        return meshio.Mesh(self.vertices, [("triangle", self.triangles)], point_data=dict(self.attributes))

    def svg(self) -> str:
        """Draw the mesh, shaded: obtuse triangles light red, thin ones red."""
        return _evenly.surface_figure(self.vertices, self.triangles)

    def _repr_svg_(self) -> str | None:
        return self.svg() if len(self.triangles) <= _MANY else None

    def _repr_png_(self) -> bytes | None:
        return run(lambda: _evenly.rendered(self.svg()), bytes) if len(self.triangles) > _MANY else None


def remesh(
    shape: object,
    n: int | None = None,
    *,
    edge_length: float | None = None,
    seed: Seed = 0,
    method: OnMeshes = "push-pull",
    density: "str | ArrayLike | None" = None,
    points: "ArrayLike | None" = None,
    features: float | Literal["off"] = 40.0,
    max_deviation: float | Literal["off"] | None = None,
    repair: bool = False,
    weld: float | None = None,
    threads: int | None = None,
    callback: Callback | None = None,
    **options: "Unpack[OptimizerOptions]",
) -> SurfaceMesh:
    """Give a triangle mesh in space a new one, by default without obtuse triangles (Ahmed et al. 2017, section 5.3).

    Parameters
    ----------
    shape : mesh, file, or pair of arrays
        What trimesh, pyvista and meshio have; a path to .obj, .ply, .stl, .off, .gltf or .glb; or vertices of shape (k, 3) and triangles of shape (l, 3).
    n : int, optional
        How many vertices, exactly. This, `edge_length`, a density with an error, or points.
    edge_length : float, optional
        The length of edges, in input units, instead.
    seed : int, SeedSequence, Generator or None
        As in `generate`.
    method : str
        By which rule vertices move; with 'eliminate' they stay where they begin.
    density : str or array_like of shape (k,), optional
        'curvature', 'curvature:0.01' (an error in input units), 'lfs', 'linear:z,4', of files 'attr:NAME'; or the wanted lengths of edges at the vertices, in proportion.
    points : array_like of shape (k, 3), optional
        Points at which vertices begin, as many as are wanted or more.
    features : float or 'off'
        Edges at which the surface turns by more than so many degrees are kept; boundaries are in any case.
    max_deviation : float or 'off', optional
        How far the given mesh may be from the new one, in edge lengths: where it is farther, a vertex is put and kept; 0.5 by default, 0.35 with a density.
    repair : bool
        Mend what can be without guessing.
    weld : float, optional
        Make one of corners that lie within this distance of each other, in input units.
    threads, callback
        As in `generate`.
    **options
        What the method can be told, see `methods`. Targets of 'push-pull' are {0.90, 0.63} by default, with a tolerance of 0.1; iterations are as many again after vertices are
        put or let go.

    Returns
    -------
    SurfaceMesh
        Vertices, triangles, and where the vertices lie on the given mesh. That targets were not reached is no error: see ``outcome`` and ``uncertified``.

    Raises
    ------
    ValueError
        For what cannot be; the message has the place.
    Interrupted
        Where Ctrl-C ends the run; ``partial`` has the mesh reached.

    Examples
    --------
    >>> import evenly
    >>> vertices = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    >>> triangles = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (1, 0, 5), (2, 1, 5), (3, 2, 5), (0, 3, 5)]
    >>> mesh = evenly.remesh((vertices, triangles), 500)
    >>> len(mesh.vertices), mesh.quality.min_angle_deg > 25
    (500, True)
    """
    has_sizes = density is not None and not isinstance(density, str)
    refuse_renamed(options, {"spacing": "edge_length"})
    begin = None if points is None else rows(points, "points", 3)
    sizes = None if not has_sizes else _sizes(density)
    chance = number(seed)
    def build(answer: tuple[_Places, NDArray[np.int64], list[tuple[str, Floats]], str]) -> SurfaceMesh:
        (vertices, facets, barycentric, normals), triangles, attributes, text = answer
        said: dict[str, Any] = json.loads(text)
        return SurfaceMesh(
            vertices=frozen(vertices),
            triangles=frozen(triangles),
            facets=frozen(facets),
            barycentric=frozen(barycentric),
            normals=frozen(normals),
            quality=_read(SurfaceQuality, said["quality"]),
            distance=_read(SurfaceDistance, {**said["distance"], "farthest_place": tuple(said["distance"]["farthest_place"])}),
            self_intersections=said["self_intersections"],
            seed=chance,
            outcome=said["run"]["outcome"],
            uncertified=frozen(np.array([each["triangle"] for each in said["breaches"]], dtype=np.int64)),
            attributes={name: frozen(values) for name, values in attributes},
            notes=tuple(said["notes"]),
        )

    return perform(
        "remesh",
        {
            "n_vertices": n,
            "edge_length": edge_length,
            "seed": chance,
            "method": method,
            "features": features,
            "max_deviation": max_deviation,
            "repair": repair,
            "weld": weld,
        },
        parameters_of(options),
        {
            "mesh": named("the mesh", native(shape)),
            "density": named("density", density if sizes is None else sizes),
            "points": named("points", begin),
        },
        build,
        threads,
        callback,
    )


def sample(
    shape: object,
    n: int | None = None,
    *,
    spacing: float | None = None,
    seed: Seed = 0,
    method: OnSurfaces = "push-pull",
    density: "str | ArrayLike | None" = None,
    repair: bool = False,
    weld: float | None = None,
    threads: int | None = None,
    callback: Callback | None = None,
    **options: "Unpack[OptimizerOptions]",
) -> SurfacePoints:
    """Spread points over a triangle mesh in space.

    Parameters
    ----------
    shape : mesh, file, or pair of arrays
        See `remesh`.
    n : int, optional
        How many points, exactly; of 'poisson-disk' about. This or `spacing`.
    spacing : float, optional
        The smallest distance of two points for 'poisson-disk', else their usual one, in input units.
    seed : int, SeedSequence, Generator or None
        As in `generate`.
    method : str
        'push-pull' and the other methods of `remesh`; 'eliminate', by the mesh's neighbourhoods; 'poisson-disk', which is maximal, and does not reach through thin parts; or 'white'.
    density : str or array_like of shape (k,), optional
        Points nearer to each other here and there, as in `remesh`.
    repair : bool
        Mend what can be without guessing.
    weld : float, optional
        Make one of corners that lie within this distance of each other, in input units.
    threads, callback
        As in `generate`.
    **options
        What the method can be told, as in `remesh`.

    Returns
    -------
    SurfacePoints
        Positions, facets, barycentric coordinates and normals.

    Raises
    ------
    ValueError
        For what cannot be; the message has the place.
    Interrupted
        Where Ctrl-C ends the run; ``partial`` has the points reached.

    Examples
    --------
    >>> import evenly
    >>> square = ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])
    >>> points = evenly.sample(square, 100, method="white")
    >>> points.positions.shape, bool((points.normals == (0, 0, 1)).all())
    ((100, 3), True)
    """
    chance = number(seed)
    has_sizes = density is not None and not isinstance(density, str)
    sizes = None if not has_sizes else _sizes(density)
    def build(answer: tuple[_Places, str]) -> SurfacePoints:
        (positions, facets, barycentric, normals), text = answer
        said: dict[str, Any] = json.loads(text)
        return SurfacePoints(
            positions=frozen(positions),
            facets=frozen(facets),
            barycentric=frozen(barycentric),
            normals=frozen(normals),
            seed=chance,
            outcome=said["run"]["outcome"],
            notes=tuple(said["notes"]),
        )

    return perform(
        "sample",
        {"n_points": n, "spacing": spacing, "seed": chance, "method": method, "repair": repair, "weld": weld},
        parameters_of(options),
        {"mesh": named("the mesh", native(shape)), "density": named("density", density if sizes is None else sizes)},
        build,
        threads,
        callback,
    )


def _read(kind: Any, said: dict[str, Any]) -> Any:
    """Return measures; what is no number in JSON is none."""
    return kind(**{each.name: math.nan if said[each.name] is None else said[each.name] for each in fields(kind)})


def _sizes(density: object) -> list[float]:
    array = np.asarray(density)
    if array.ndim != 1 or array.dtype.kind not in "fiu":
        raise ValueError(f"density must be a name, or one number for each vertex, not an array of shape {array.shape}")
    return [float(size) for size in array]
