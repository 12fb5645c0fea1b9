"""Measures, spectra, meshes, dots, tables and figures."""

import json
import pickle
import subprocess
import sys
from pathlib import Path

import evenly
import numpy as np
import pytest

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def test_measures_are_those_of_the_command_line(tmp_path):
    points = evenly.generate(400, method="push-pull", space="rect", size=(3, 2))
    np.save(tmp_path / "points.npy", points.positions)
    words = ["analyze", "points.npy", "--space", "rect", "--size", "3,2", "--json"]
    done = subprocess.run([Path(sys.executable).with_name("evenly"), *words], cwd=tmp_path, capture_output=True, text=True, check=True)
    said = json.loads(done.stdout)
    measures = evenly.measure(points)
    for name, value in said.items():
        if isinstance(value, float) and hasattr(measures, name):
            assert getattr(measures, name) == value, name
    assert measures == points.measure()
    assert sum(measures.valence.values()) > 0 and measures.uncovered_fraction > 0


def test_spectra_are_of_one_set_or_several():
    sets = [evenly.generate(500, method="push-pull", seed=seed) for seed in range(3)]
    spectrum = evenly.power_spectrum(sets)
    rows, columns = spectrum.power.shape
    assert spectrum.power[rows // 2, columns // 2] == pytest.approx(500)
    np.testing.assert_allclose(spectrum.power, spectrum.power[::-1, ::-1])
    assert np.asarray(spectrum).shape == (rows, columns)
    one = evenly.radial_power(sets[0])
    assert one.effective_nyquist > 0.6 and one.frequencies.shape == one.power.shape
    pairs = evenly.pair_correlation(sets)
    assert pairs.correlation[pairs.distances < 0.8].max() == 0
    with pytest.raises(ValueError, match="polygon"):
        evenly.power_spectrum(evenly.generate(100, space=SQUARE))
    with pytest.raises(ValueError, match="frequency"):
        evenly.power_spectrum(sets[0], max_frequency=-1)


def test_meshes_conform_and_are_written(tmp_path):
    line, fixed = [(0.2, 0.2), (0.8, 0.4)], [(0.5, 0.8)]
    mesh = evenly.mesh(SQUARE, edge_length=0.1, lines=[line], fixed=fixed)
    assert mesh.quality.area == pytest.approx(1) and mesh.outcome == "converged"
    assert mesh.triangles.max() < len(mesh.vertices) and sorted(set(mesh.tags)) == [-1, 0, 1, 2, 3]
    assert (mesh.vertices == fixed[0]).all(axis=1).any()
    for name in ("mesh.msh", "mesh.vtu", "mesh.obj", "mesh.ply", "mesh.off", "mesh.stl", "mesh.geojson", "mesh.npz", "mesh.svg", "mesh.png"):
        mesh.save(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 1000
    with pytest.raises(ValueError, match="ending"):
        mesh.save(tmp_path / "mesh.nonsense")
    assert mesh._repr_svg_().startswith("<svg") and "triangles" in repr(mesh)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(mesh)).triangles, mesh.triangles)


def test_meshes_follow_sizes_densities_and_methods():
    even = len(evenly.mesh(SQUARE, edge_length=0.1).triangles)
    assert len(evenly.mesh(SQUARE, edge_length=0.1, sizes=[(0.5, 0.5, 0.01)]).triangles) > 1.8 * even
    by_density = evenly.mesh(SQUARE, n_triangles=1000, density=lambda x, y: np.exp(3 * x))
    assert by_density.vertices[:, 0].mean() > 0.6 and 800 < len(by_density.triangles) < 1300
    for method in ("opt-beta", "lloyd", "distmesh"):
        assert evenly.mesh(SQUARE, edge_length=0.1, method=method).quality.min_angle_deg > 30
    assert evenly.mesh(SQUARE, edge_length=0.05, no_obtuse=True).quality.obtuse_triangles == 0
    assert evenly.mesh([(0, 0), (1, 0), (0.5, 0.05)], edge_length=0.05, min_angle=30).quality.min_angle_deg < 30


@pytest.mark.parametrize(
    ("message", "arguments"),
    [
        ("either edge_length or n_triangles", {}),
        ("either edge_length or n_triangles", {"edge_length": 0.1, "n_triangles": 100}),
        ("edge_length is -1", {"edge_length": -1.0}),
        ("min_angle is 50", {"edge_length": 0.1, "min_angle": 50.0}),
        ("beta is for method well-spaced or opt-beta", {"edge_length": 0.1, "beta": 0.7}),
        ("length at", {"edge_length": 0.1, "sizes": [(0.5, 0.5, 0)]}),
        ("does not hold the fixed point", {"edge_length": 0.1, "fixed": [(3, 3)]}),
        (r"line 0 must have the shape", {"edge_length": 0.1, "lines": [(1, 2, 3)]}),
    ],
)
def test_bad_meshes_are_value_errors(message, arguments):
    with pytest.raises(ValueError, match=message):
        evenly.mesh(SQUARE, **arguments)


def test_old_names_are_answered_with_the_new_ones():
    with pytest.raises(TypeError, match="edge_length"):
        evenly.mesh(SQUARE, spacing=0.1)
    with pytest.raises(TypeError, match="edge_length"):
        evenly.remesh(([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]), spacing=0.1)


def test_dots_follow_the_picture():
    ramp = np.tile(np.linspace(0, 255, 100).astype(np.uint8), (50, 1))
    dots = evenly.stipple(ramp, 1000)
    assert len(dots) == 1000 and np.asarray(dots)[:, 0].mean() < 45
    assert np.asarray(evenly.stipple(ramp / 255, 1000, invert=True))[:, 0].mean() > 55
    colours = np.zeros((20, 30, 4), dtype=np.uint8)
    colours[:, :15] = (255, 0, 0, 255)
    inks = evenly.stipple(colours, 300, layers="cmyk", sizes="tone", order="progressive")
    assert [layer.name for layer in inks.layers] == ["magenta", "yellow"] and len(inks) == 300
    assert np.asarray(inks)[:, 0].max() < 16 and inks.layers[0].diameters.min() > 0
    assert inks._repr_svg_().count("<circle") == 300
    for wrong, message in [(np.zeros((2, 2, 2)), "channels"), (np.zeros(3), "shape"), (np.ones((4, 4)), "no place for points"), ("no.png", "no.png")]:
        with pytest.raises(ValueError, match=message):
            evenly.stipple(wrong, 10)
    for wrong in (ramp.astype(float), ramp.astype(int) * 200, ramp.astype(np.int16) - 300):
        with pytest.raises(ValueError, match="picture must have whole numbers"):
            evenly.stipple(wrong, 10)
    with pytest.raises(ValueError, match="iterations is for method"):
        evenly.stipple(ramp, 10, method="white", iterations=5)
    with pytest.raises(ValueError, match="n is 0"):
        evenly.stipple(ramp, 0)


def test_dots_are_those_of_the_command_line(tmp_path):
    image = pytest.importorskip("PIL.Image")
    ramp = np.tile(np.linspace(0, 255, 100).astype(np.uint8), (50, 1))
    image.fromarray(ramp).save(tmp_path / "ramp.png")
    command = [Path(sys.executable).with_name("evenly"), "stipple", "ramp.png", "-n", "500", "--seed", "3", "-o", "dots.npy"]
    subprocess.run(command, cwd=tmp_path, capture_output=True, check=True)
    for picture in (ramp, tmp_path / "ramp.png"):
        np.testing.assert_array_equal(np.load(tmp_path / "dots.npy"), np.asarray(evenly.stipple(picture, 500, seed=3)))


def test_methods_are_compared():
    table = evenly.compare(200, methods=["white", "push-pull"], runs=2)
    assert len(table.runs) == 4 and len(table.records()) == 4
    assert table.mean("push-pull", "min_distance") > 0.84 > table.mean("white", "min_distance")
    assert repr(table).splitlines()[2].startswith("push-pull") and "<table>" in table._repr_html_()
    given = evenly.compare(np.random.default_rng(1).random((100, 2)), methods=["lloyd"], runs=1)
    assert given.runs[0].measures.n_points == 100
    with pytest.raises(ValueError, match="runs is 0"):
        evenly.compare(100, runs=0)


def test_an_engine_of_scipy():
    qmc = pytest.importorskip("scipy.stats").qmc
    from evenly.qmc import BlueNoise

    engine = BlueNoise(d=2, seed=3)
    assert isinstance(engine, qmc.QMCEngine)
    for n in (0, 1, 2, 3, 500):
        sample = engine.random(n)
        assert sample.shape == (n, 2) and (sample >= 0).all() and (sample < 1).all()
    assert engine.num_generated == 506
    again = engine.reset().random(500)
    np.testing.assert_array_equal(again, BlueNoise(seed=3).random(500))
    assert qmc.scale(again, [1, 2], [3, 4]).min() >= 1
    np.testing.assert_array_equal(BlueNoise(rng=3).random(8), BlueNoise(seed=3).random(8))
    assert BlueNoise(seed=np.random.RandomState(3)).random(4).shape == (4, 2)
    assert BlueNoise(seed=3).fast_forward(5).random(4).shape == (4, 2)
    with pytest.raises(ValueError, match="there is no method"):
        BlueNoise(method="nonsense")
    with pytest.raises(ValueError, match="d is 3"):
        BlueNoise(d=3)


def test_figures_return_their_axes(tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from evenly import plot

    points = evenly.generate(300, method="push-pull")
    for figure in (plot.points, plot.triangulation, plot.spectrum, plot.radial):
        axes = figure(points)
        axes.figure.savefig(tmp_path / "figure.png")
        own = plt.subplots()[1]
        assert figure(points, ax=own) is own
    assert plot.triangulation(evenly.mesh(SQUARE, edge_length=0.2)).collections
    assert plot.points(evenly.generate(50, space=SQUARE)).collections
    assert plot.report(points).shape == (2, 2)
    plt.close("all")


def test_regions_are_kept_apart_and_survive_being_saved(tmp_path):
    left, right = [(0, 0), (1, 0), (1, 1), (0, 1)], [(1, 0), (2, 0), (2, 1), (1, 1)]
    mesh = evenly.mesh(regions={"left": left, "right": right}, edge_length=0.1)
    assert mesh.region_names == ("left", "right") and mesh.regions.shape == (len(mesh.triangles),)
    middles = mesh.vertices[mesh.triangles].mean(axis=1)
    assert np.array_equal(mesh.regions, (middles[:, 0] > 1).astype(int))
    between = mesh.edges[mesh.tags == evenly.Mesh.BETWEEN]
    assert len(between) >= 9 and np.all(mesh.vertices[between][:, :, 0] == 1)
    # As by the command line, which has the parts of a file.
    (tmp_path / "parts.wkt").write_text("MULTIPOLYGON(((0 0,1 0,1 1,0 1,0 0)),((1 0,2 0,2 1,1 1,1 0)))")
    of_file = evenly.mesh(regions=tmp_path / "parts.wkt", edge_length=0.1)
    assert np.array_equal(of_file.vertices, mesh.vertices) and of_file.region_names == ("region 1", "region 2")
    mesh.save(tmp_path / "mesh.msh")
    assert '"right"' in (tmp_path / "mesh.msh").read_text()
    assert len(evenly.mesh(left, edge_length=0.3).regions) == 0
    for bad in ({"regions": []}, {"regions": 3}, {"regions": {"left": left}, "simplify": 0.1}, {}):
        with pytest.raises(ValueError, match="region|polygon"):
            evenly.mesh(edge_length=0.1, **bad)


def test_a_mesh_with_sharp_corners_is_saved_whole(tmp_path):
    mesh = evenly.mesh([(0, 0), (4, 0), (4, 0.5)], edge_length=0.1)
    assert mesh.n_in_corners > 0
    mesh.save(tmp_path / "mesh.svg")
    assert mesh.svg() == mesh.svg() and (tmp_path / "mesh.svg").read_text().startswith("<svg")
