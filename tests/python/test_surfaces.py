"""Meshes in space: remeshed, and points on them."""

import pickle

import evenly
import numpy as np
import pytest

OCTAHEDRON = (
    [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)],
    [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (1, 0, 5), (2, 1, 5), (3, 2, 5), (0, 3, 5)],
)


def torus(n=40, m=16):
    """Return vertices and triangles, with radii 1 and 0.4."""
    u, v = np.meshgrid(2 * np.pi * np.arange(n) / n, 2 * np.pi * np.arange(m) / m, indexing="ij")
    r = 1 + 0.4 * np.cos(v)
    vertices = np.stack([r * np.cos(u), r * np.sin(u), 0.4 * np.sin(v)], axis=-1).reshape(-1, 3)
    i, j = np.divmod(np.arange(n * m), m)
    a, b, c, d = (i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m)
    return vertices, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def test_a_surface_is_remeshed_exactly_and_not_obtuse(tmp_path):
    vertices, triangles = torus()
    mesh = evenly.remesh((vertices, triangles), 1000, seed=7)
    assert mesh.outcome == "converged" and len(mesh.vertices) == 1000 and len(mesh.uncertified) == 0
    assert mesh.quality.obtuse_triangles == 0 and mesh.quality.euler_characteristic == 0 and mesh.self_intersections == 0
    assert mesh.quality.min_angle_deg > 45.5 and mesh.distance.hausdorff < 0.02
    # Vertices lie where they say.
    corners = vertices[triangles[mesh.facets]]
    np.testing.assert_allclose((corners * mesh.barycentric[:, :, None]).sum(axis=1), mesh.vertices, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1)
    # The same bits, and the input is as it was.
    again = evenly.remesh((vertices, triangles), 1000, seed=7, threads=1)
    np.testing.assert_array_equal(again.vertices, mesh.vertices)
    np.testing.assert_array_equal(vertices, torus()[0])
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(mesh)).triangles, mesh.triangles)
    assert "1000 vertices" in repr(mesh) and mesh._repr_svg_().startswith("<svg")
    for name in ("mesh.ply", "mesh.obj", "mesh.off", "mesh.stl", "mesh.vtu", "mesh.msh", "mesh.npz", "mesh.png"):
        mesh.save(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 1000
    # A file is read again, with what its vertices carry.
    again = evenly.remesh(tmp_path / "mesh.ply", 300)
    assert len(again.vertices) == 300 and {"nx", "ny", "nz"} <= set(again.attributes)
    # What other packages have.
    assert len(evenly.remesh(mesh, 300).vertices) == 300


def test_sizes_features_and_methods():
    vertices, triangles = torus()
    by_axis = evenly.remesh((vertices, triangles), 800, density="linear:x,4")
    given = evenly.remesh((vertices, triangles), 800, density=np.where(vertices[:, 0] > 0, 2.0, 1.0))
    assert (by_axis.vertices[:, 0] < 0).sum() > 500 < (given.vertices[:, 0] < 0).sum()
    assert evenly.remesh((vertices, triangles), density="curvature:0.01").distance.max_from_reference < 0.05
    assert abs(evenly.remesh((vertices, triangles), edge_length=0.2).quality.spacing - 0.2) < 0.01
    kept = evenly.remesh(OCTAHEDRON, 500)
    assert {(0.0, 0.0, 1.0), (1.0, 0.0, 0.0)} <= set(map(tuple, kept.vertices.tolist()))
    assert evenly.remesh(OCTAHEDRON, 500, features="off", method="lloyd").quality.mean_quality > 0.85


def test_given_points_are_a_start():
    shape = torus()
    points = evenly.sample(shape, 400, method="white")
    mesh = evenly.remesh(shape, points=points, method="eliminate")
    order = lambda rows: rows[np.lexsort(rows.T)]  # noqa: E731
    np.testing.assert_allclose(order(mesh.vertices), order(points.positions), atol=1e-12)
    assert len(evenly.remesh(shape, 300, points=points.positions).vertices) == 300


def test_how_points_are_spread_is_told():
    shape = torus()
    even, white = (evenly.surface_spectrum(evenly.sample(shape, 1000, method=method), shape) for method in ("push-pull", "white"))
    assert even.effective_nyquist > 0.8 > 0.2 > white.effective_nyquist
    assert even.min_distance > 0.85 > 0.2 > white.min_distance and even.mean_distance > 0.9
    assert len(even.power) == len(even.frequencies) and len(even.correlation) == len(even.distances)
    mesh = evenly.remesh(shape, 1000, density="linear:x,3")
    assert evenly.surface_spectrum(mesh.vertices, mesh, local=True).effective_nyquist > 0.6
    with pytest.raises(ValueError, match="too few"):
        evenly.surface_spectrum(mesh.vertices[:50], shape)


def test_points_lie_on_the_surface():
    vertices, triangles = torus()
    for method in ("push-pull", "eliminate", "white"):
        points = evenly.sample((vertices, triangles), 500, method=method, seed=3)
        assert len(points) == 500 and np.asarray(points).shape == (500, 3)
        corners = vertices[triangles[points.facets]]
        np.testing.assert_allclose((corners * points.barycentric[:, :, None]).sum(axis=1), points.positions, atol=1e-12)
    disks = evenly.sample((vertices, triangles), spacing=0.15, method="poisson-disk").positions
    distances = np.linalg.norm(disks[:, None] - disks[None], axis=2) + np.eye(len(disks))
    assert distances.min() >= 0.15


@pytest.mark.parametrize(
    ("message", "shape", "arguments"),
    [
        ("missing", OCTAHEDRON, {}),
        ("either", OCTAHEDRON, {"n": 10, "edge_length": 0.1}),
        ("row 1", ([(0, 0, 0), (1, np.nan, 0), (0, 1, 0)], [(0, 1, 2)]), {"n": 10}),
        ("triangles", (OCTAHEDRON[0], [(0, 1)]), {"n": 10}),
        ("n is", OCTAHEDRON, {"n": 3}),
        ("features", OCTAHEDRON, {"n": 100, "features": 200}),
        ("density", OCTAHEDRON, {"n": 100, "density": [[1, 2]]}),
        ("each vertex", OCTAHEDRON, {"n": 100, "density": [1, 2]}),
        ("nowhere.obj", "nowhere.obj", {"n": 100}),
        ("repair", ([*OCTAHEDRON[0], (2, 2, 2)], [*OCTAHEDRON[1], (0, 1, 6)]), {"n": 100}),
    ],
)
def test_bad_surfaces_are_value_errors(message, shape, arguments):
    with pytest.raises(ValueError, match=message):
        evenly.remesh(shape, **arguments)


def test_what_is_no_mesh_is_a_type_error():
    with pytest.raises(TypeError, match="mesh"):
        evenly.sample(7, 100)


def test_meshes_go_to_other_packages():
    points = evenly.generate(10, method="white")
    square = evenly.mesh([(0, 0), (1, 0), (1, 1), (0, 1)], edge_length=0.3)
    vertices = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (1, 0, 5), (2, 1, 5), (3, 2, 5), (0, 3, 5)]
    surface = evenly.remesh((vertices, triangles), 100)
    for package, convert in [
        ("trimesh", lambda: surface.to_trimesh().faces),
        ("meshio", lambda: surface.to_meshio().cells_dict["triangle"]),
        ("meshio", lambda: square.to_meshio().cells_dict["triangle"]),
        ("geopandas", lambda: square.to_geodataframe()),
        ("geopandas", lambda: points.to_geodataframe()),
    ]:
        try:
            assert len(convert()) > 0
        except ModuleNotFoundError as missing:
            assert package in str(missing) or "shapely" in str(missing)
