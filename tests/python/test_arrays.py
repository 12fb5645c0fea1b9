"""Arrays of any kind come in; what is none is a `ValueError` that names the row."""

import evenly
import numpy as np
import pytest

BASE = np.random.default_rng(1).random((60, 2)).astype(np.float32)


@pytest.mark.parametrize(
    "data",
    [
        BASE,
        np.asfortranarray(BASE.astype(float)),
        np.repeat(BASE.astype(float), 2, axis=0)[::2],
        BASE.tolist(),
        tuple(map(tuple, BASE.tolist())),
        iter(BASE.tolist()),
        evenly.optimize(BASE, method="warp"),
    ],
    ids=["float32", "fortran", "strided", "lists", "tuples", "iterator", "points"],
)
def test_any_layout_is_taken(data):
    assert evenly.measure(data).n_points == 60


def test_read_only_arrays_are_taken_and_integers():
    data = BASE.astype(float)
    data.setflags(write=False)
    assert len(evenly.optimize(data, method="lloyd")) == 60
    grid = np.array([[x, y] for x in range(5) for y in range(5)])
    assert evenly.measure(grid, space="rect", size=(4, 4)).n_points == 25


def test_shapes_and_flat_models_are_taken():
    shapely = pytest.importorskip("shapely")
    area = shapely.Point(0, 0).buffer(2).difference(shapely.Point(0, 0).buffer(1))
    points = evenly.generate(100, method="push-pull", space=area)
    assert all(area.buffer(1e-9).contains(shapely.Point(*place)) for place in points)
    assert evenly.mesh(area, edge_length=0.2).quality.area == pytest.approx(area.area)
    assert evenly.Polygon(shapely.MultiPolygon([shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 1)])).area == pytest.approx(2)
    assert len(evenly.optimize(shapely.MultiPoint(BASE))) == 60

    class Flat:
        vertices = np.column_stack([BASE, np.full(60, 3.0)])

    class Solid:
        points = np.column_stack([BASE, BASE[:, 0]])

    assert len(evenly.optimize(Flat())) == 60
    with pytest.raises(ValueError, match="in a plane"):
        evenly.optimize(Solid())


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (np.empty((0, 2)), "must not be empty"),
        ([], "shape"),
        (np.zeros((5, 3)), r"shape \(n, 2\), not \(5, 3\)"),
        (np.zeros(4), "shape"),
        (np.array([[object(), 1]]), "not of type object"),
        ([["a", "b"]], "not of type"),
        ([[1, 2], [3]], "all as long"),
        ([[0.1, 0.2], [0.3, np.nan], [0.5, 0.6]], "row 1 is"),
        ([[0.1, 0.2], [0.3, 0.4], [0.5, np.inf]], "row 2 is"),
        (np.zeros((3, 2), dtype=complex), "not of type complex"),
        (None, "not of type object"),
    ],
)
def test_what_is_no_set_of_points_is_a_value_error(data, message):
    for call in (evenly.measure, evenly.optimize, evenly.power_spectrum, evenly.radial_power, evenly.pair_correlation):
        with pytest.raises(ValueError, match=message):
            call(data)


def test_points_outside_are_named():
    with pytest.raises(ValueError, match="point 1 is"):
        evenly.optimize([[0.1, 0.2], [3, 0.4], [0.5, 0.6]], space="rect")


@pytest.mark.parametrize(
    ("shape", "message"),
    [
        ([[(0, 0), (1, 0), (0, 1)], [(5, 5), (6, 5), (5, 6)]], "outside"),
        ([(0, 0), (1, 1), (2, 2)], "nothing|enclose"),
        ("nowhere.geojson", "nowhere"),
        ({"type": "Point", "coordinates": [0, 0]}, "a polygon is needed"),
        (3, "must be a shape"),
        ([], "must be a shape"),
        ([(0, 0), (1, np.nan), (2, 2)], "row 1"),
    ],
)
def test_what_is_no_polygon_is_a_value_error(shape, message):
    with pytest.raises(ValueError, match=message):
        evenly.Polygon(shape)


def test_what_only_looks_like_points_is_refused():
    masked = np.ma.masked_array(BASE, mask=BASE > 0.9)
    with pytest.raises(ValueError, match="masked"):
        evenly.measure(masked)
    with pytest.raises(ValueError, match="vertices"):
        evenly.measure(evenly.mesh([(0, 0), (1, 0), (1, 1)], edge_length=0.5))
    with pytest.raises(ValueError, match="different spaces"):
        evenly.power_spectrum([evenly.generate(50), evenly.generate(50, size=(2, 1))])


def test_empty_constraints_are_none():
    assert len(evenly.generate(20, fixed=[])) == 20
    assert len(evenly.mesh([(0, 0), (1, 0), (1, 1)], edge_length=0.5, fixed=np.empty((0, 2)), lines=[], sizes=[]).triangles) > 1


@pytest.mark.parametrize(
    "ring",
    [[(0, 0), (0, 3), (3, 3), (3, 0)], [(0.1, 0.2), (0.7, 3.3), (1.5, 1.75), (2.9, 3.1), (2.2, 0.3)], [(0, 0), (1, 0), (2, 0), (2, 1.1), (0, 1.3)]],
)
def test_polygons_are_those_of_the_command_line(tmp_path, ring):
    import json
    import subprocess
    import sys
    from pathlib import Path

    shape = {"type": "Polygon", "coordinates": [[*ring, ring[0]]]}
    (tmp_path / "area.geojson").write_text(json.dumps(shape))
    command = [Path(sys.executable).with_name("evenly"), "generate", "-n", "200", "--method", "push-pull", "--space", "area.geojson", "-o", "points.npy"]
    # 1: a target may be missed.
    assert subprocess.run(command, cwd=tmp_path, capture_output=True, check=False).returncode in (0, 1)
    assert evenly.Polygon(shape).rings == evenly.Polygon(tmp_path / "area.geojson").rings
    for space in (shape, np.array(ring), tmp_path / "area.geojson"):
        ours = evenly.generate(200, method="push-pull", space=space)
        np.testing.assert_array_equal(np.load(tmp_path / "points.npy"), ours.positions)


def test_spaces_are_values():
    polygon = evenly.Polygon([(0, 0), (1, 0), (1, 1)])
    assert hash(polygon) == hash(evenly.Polygon(polygon)) and polygon == evenly.Polygon(polygon)
    assert evenly.Torus([2, 1]) == evenly.Torus((2.0, 1.0)) and hash(evenly.Torus([2, 1])) == hash(evenly.Torus((2, 1)))
    assert repr(polygon) == "<polygon of 1 rings with 3 corners, area 0.5>"
    for wrong in (2, (0, 1), (np.nan, 1), (1, 2, 3)):
        with pytest.raises(ValueError, match="size is"):
            evenly.Torus(wrong)
