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
    assert evenly.mesh(area, spacing=0.2).quality.area == pytest.approx(area.area)
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
        ([(0, 0), (2, 2), (2, 0), (0, 2)], "cross"),
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
