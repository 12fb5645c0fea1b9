"""`generate` and `optimize`: the same points as on the command line, to the bit, and objects that are pleasant to have."""

import copy
import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import evenly
import numpy as np
import pytest

OPTIMIZERS = ["procrustes", "push-pull", "well-spaced", "opt-beta", "lloyd", "cvt", "farthest-point", "distmesh", "capacity"]
STARTS = ["poisson-disk", "dart", "eliminate", "white", "jittered", "hexagonal"]
L_SHAPE = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]


def command(folder, *words):
    script = Path(sys.executable).with_name("evenly")
    done = subprocess.run([script, *words], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr


@pytest.mark.parametrize("method", OPTIMIZERS + STARTS)
def test_the_command_line_makes_the_same_bits(tmp_path, method):
    for kind in ("torus", "rect"):
        command(tmp_path, "generate", "-n", "300", "--method", method, "--seed", "5", "--space", kind, "--force", "-o", "points.npy")
        ours = evenly.generate(300, method=method, seed=5, space=kind, threads=1)
        np.testing.assert_array_equal(np.load(tmp_path / "points.npy"), ours.positions)
        assert ours.method == method and ours.seed == 5


@pytest.mark.parametrize("method", OPTIMIZERS)
def test_points_are_optimised_to_the_same_bits_and_not_changed(tmp_path, method):
    noise = np.random.default_rng(2).random((200, 2))
    before = noise.copy()
    np.save(tmp_path / "noise.npy", noise)
    command(tmp_path, "optimize", "noise.npy", "--method", method, "--iterations", "20", "-o", "better.npy")
    ours = evenly.optimize(noise, method=method, iterations=20)
    np.testing.assert_array_equal(np.load(tmp_path / "better.npy"), ours.positions)
    np.testing.assert_array_equal(noise, before)


@pytest.mark.parametrize("method", ["procrustes", "push-pull", "opt-beta", "lloyd"])
def test_polygons_densities_and_fixed_points_make_the_same_bits_too(tmp_path, method):
    (tmp_path / "area.txt").write_text("\n".join(f"{x} {y}" for x, y in L_SHAPE))
    np.save(tmp_path / "fixed.npy", np.array([[0.5, 0.5], [1.5, 0.25]]))
    command(tmp_path, "generate", "-n", "150", "--method", method, "--space", "area.txt", "--fixed", "fixed.npy", "-o", "points.npy")
    for space in (L_SHAPE, str(tmp_path / "area.txt"), evenly.Polygon(np.array(L_SHAPE))):
        ours = evenly.generate(150, method=method, space=space, fixed=[[0.5, 0.5], [1.5, 0.25]])
        np.testing.assert_array_equal(np.load(tmp_path / "points.npy"), ours.positions)


def test_densities_are_arrays_functions_and_pictures():
    by_function = evenly.generate(400, method="push-pull", density=lambda x, y: np.exp(3 * x))
    assert by_function.positions[:, 0].mean() > 0.6
    ramp = np.tile(np.linspace(0, 1, 32), (8, 1))
    by_array = evenly.generate(400, method="lloyd", density=ramp, density_rows="upper")
    assert by_array.positions[:, 0].mean() > 0.58
    assert evenly.measure(by_array, density=ramp, density_rows="lower").density_error < 0.1
    upper = np.zeros((2, 1))
    upper[0] = 1
    assert (evenly.generate(50, method="white", density=upper, density_rows="upper").positions[:, 1] >= 0.5).all()
    assert (evenly.generate(50, method="white", density=upper, density_rows="lower").positions[:, 1] <= 0.5).all()
    with pytest.raises(ValueError, match="density_rows='upper'.*density_rows='lower'"):
        evenly.generate(50, density=upper)
    with pytest.raises(ValueError, match="density_rows is 'top'"):
        evenly.generate(50, density=upper, density_rows="top")


def test_densities_are_grids_and_estimates_too():
    x, y = np.linspace(0, 1, 5), np.linspace(1, 0, 4)
    values = np.tile(x, (4, 1))
    by_grid = evenly.generate(300, density=(x, y, values))
    assert by_grid.positions[:, 0].mean() > 0.6
    below = evenly.generate(300, density=(x, y, np.where(y[:, None] < 0.5, 1.0, 0.01) + 0 * values))
    assert below.positions[:, 1].mean() < 0.4
    with pytest.raises(ValueError, match=r"it must be \(len\(y\), len\(x\)\)"):
        evenly.generate(300, density=(x, y, values.T))
    stats = pytest.importorskip("scipy.stats")
    around = np.random.default_rng(1).normal(0.3, 0.05, (2, 200))
    estimate = stats.gaussian_kde(around)
    assert np.abs(evenly.generate(200, density=estimate, space="rect").positions.mean(axis=0) - 0.3).max() < 0.05


def test_functions_are_sampled_as_finely_as_points_follow_them():
    shapes = []

    def density(x, y):
        shapes.append(x.shape)
        return 1 + x

    evenly.generate(500, method="white", density=density)
    evenly.generate(500, method="white", density=density, space="rect", size=(4, 1))
    evenly.generate(100_000, method="white", density=density)
    assert max(shapes[0]) <= 128 and shapes[1][0] * 4 == pytest.approx(shapes[1][1], abs=4) and max(shapes[2]) == 1024


def test_points_outside_of_an_assumed_domain_are_refused():
    points = [(0.1, 0.2), (3.0, 0.4), (0.5, 0.6)]
    for call in (evenly.optimize, evenly.measure, evenly.radial_power):
        with pytest.raises(ValueError, match="which was assumed"):
            call(points)
    assert len(evenly.optimize(points, size=(4, 1))) == 3


def test_lengths_may_be_in_input_units():
    points = evenly.generate(1000, size=(640, 480), min_distance="15u")
    measures = points.measure()
    assert measures.min_distance * measures.hex_spacing >= 15 - 1e-4
    with pytest.raises(ValueError, match="where spacings vary"):
        evenly.generate(100, min_distance="0.05u", density=lambda x, y: 1 + x)


def test_seeds_are_numbers_sequences_and_generators():
    def of(seed):
        return evenly.generate(20, method="white", seed=seed).positions.tobytes()

    assert of(7) == of(np.int64(7)) != of(8)
    assert of(np.random.SeedSequence(7)) == of(np.random.SeedSequence(7))
    generator = np.random.default_rng(7)
    assert of(generator) != of(generator)
    assert of(np.random.default_rng(7)) == of(np.random.default_rng(7))
    assert of(None) != of(None)
    for wrong in (-1, 2**64):
        with pytest.raises(ValueError, match="seed"):
            of(wrong)
    for wrong in (1.5, "1", True):
        with pytest.raises(TypeError, match="seed"):
            of(wrong)


def test_threads_change_no_bit():
    sets = {threads: evenly.generate(20_000, method="push-pull", seed=3, threads=threads).positions.tobytes() for threads in (1, 2, 5, None)}
    assert len(set(sets.values())) == 1


def test_two_threads_may_optimise_at_once():
    def run(seed):
        return evenly.generate(3000, method="push-pull", seed=seed).positions.tobytes()

    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(run, [1, 2, 1])) == [run(1), run(2), run(1)]


def test_results_are_frozen_and_can_be_copied():
    points = evenly.generate(50, method="push-pull", space="rect", size=(2, 1), seed=0)
    with pytest.raises(ValueError, match="read-only"):
        points.positions[0, 0] = 1
    with pytest.raises(AttributeError):
        points.seed = 1
    for other in (copy.copy(points), copy.deepcopy(points), pickle.loads(pickle.dumps(points))):
        np.testing.assert_array_equal(other.positions, points.positions)
        assert (other.space, other.seed, other.outcome) == (evenly.Rectangle((2, 1)), 0, "converged")
    assert np.asarray(points).shape == (50, 2) and len(points) == 50 and points[0].shape == (2,)
    assert np.asarray(points, dtype=np.float32).dtype == np.float32
    assert "50 points by push-pull in a rectangle" in repr(points)


def test_notebooks_show_pictures():
    assert evenly.generate(100)._repr_svg_().startswith("<svg")
    many = evenly.generate(6000, method="white")
    assert many._repr_svg_() is None and many._repr_png_().startswith(b"\x89PNG")


def test_callbacks_are_called_and_may_stop():
    seen = []
    points = evenly.generate(2000, method="push-pull", callback=lambda iteration, progress: seen.append((iteration, progress)))
    assert points.outcome == "converged" and seen[-1][0] == points.iterations and seen[-1][1].stable_share == 1.0
    stopped = evenly.generate(2000, method="lloyd", callback=lambda iteration, _: iteration < 5)
    assert (stopped.outcome, stopped.iterations) == ("cancelled", 5)
    with pytest.raises(ZeroDivisionError):
        evenly.generate(2000, method="lloyd", callback=lambda *_: 1 / 0)


def test_targets_that_are_missed_are_told():
    points = evenly.generate(500, method="push-pull", iterations=3)
    assert points.outcome == "iteration_limit" and points.unmet
    assert evenly.generate(500, method="push-pull", coverage_radius="off").unmet == ()


@pytest.mark.parametrize(
    ("message", "arguments"),
    [
        ('there is no method "nonsense"', {"n": 10, "method": "nonsense"}),
        ("beta is for method well-spaced or opt-beta", {"n": 10, "beta": 0.7}),
        ("beta is 0.2; it must be", {"n": 10, "method": "well-spaced", "beta": 0.2}),
        ("n is 0", {"n": 0}),
        ("n is missing", {"method": "lloyd"}),
        ("it must be 'torus', 'rect', a polygon or a polygon's file", {"n": 10, "space": "spere"}),
        ("size is 3; it must be two numbers", {"n": 10, "size": 3}),
        ("size and origin are for", {"n": 10, "space": evenly.Torus(), "size": (1, 2)}),
        ("fixed must be finite: row 1", {"n": 10, "fixed": [[0, 0], [np.inf, 0]]}),
        ("iterations is 0", {"n": 10, "method": "lloyd", "iterations": 0}),
        ("goes by no density", {"n": 10, "start": "jittered", "density": [[1.0, 2.0]], "density_rows": "upper"}),
        ("must be finite, and 0 or more: row 0", {"n": 10, "method": "lloyd", "density": [[-1.0, 2.0]], "density_rows": "upper"}),
    ],
)
def test_bad_wishes_are_value_errors(message, arguments):
    with pytest.raises(ValueError, match=message):
        evenly.generate(**arguments)


@pytest.mark.parametrize("method", ["dart", "jittered", "hexagonal", "opt-beta", "cvt", "farthest-point"])
def test_methods_that_know_no_density_refuse_it(method):
    with pytest.raises(ValueError, match="density is for method"):
        evenly.generate(100, method=method, density=[[1.0, 2.0]], density_rows="upper")


@pytest.mark.parametrize(
    ("kind", "arguments"),
    [
        (TypeError, {"n": 10.0}),
        (TypeError, {"n": 10, "method": None}),
        (TypeError, {"n": 10, "local": 1}),
        (TypeError, {"n": 10, "warp": "no"}),
        (TypeError, {"n": 10, "method": "well-spaced", "beta": "0.7"}),
        (TypeError, {"n": 10, "method": "well-spaced", "beta": True}),
        (TypeError, {"n": 10, "method": "lloyd", "iterations": True}),
        (ValueError, {"n": 2**70}),
        (ValueError, {"n": 10, "threads": -1}),
        (ValueError, {"n": 10, "threads": 0}),
        (ValueError, {"n": 10, "method": "well-spaced", "beta": float("nan")}),
    ],
)
def test_arguments_of_wrong_kinds_are_refused(kind, arguments):
    with pytest.raises(kind):
        evenly.generate(**arguments)


def test_copies_are_frozen_too():
    points = evenly.generate(50)
    for other in (copy.deepcopy(points), pickle.loads(pickle.dumps(points))):
        assert not other.positions.flags.writeable
    assert hash(points.measure()) == hash(points.measure())


def test_falsy_answers_of_callbacks_go_on():
    assert evenly.generate(300, method="lloyd", callback=lambda *_: 0).outcome == "iterations_done"
    assert evenly.generate(300, method="lloyd", callback=lambda *_: np.False_).outcome == "cancelled"


def test_points_bring_their_space_and_density_along():
    points = evenly.generate(300, method="push-pull", space="rect", size=(2, 1), density=lambda x, y: 0.2 + x)
    assert points.measure() == evenly.measure(points, density=points.density, density_rows="upper") and points.measure().beta < 1
    assert evenly.optimize(points, method="lloyd").positions[:, 0].mean() > 1.15
    assert evenly.generate(310, space=None, fixed=points).space == points.space


def test_modules_that_take_more_are_imported_when_asked_for():
    pytest.importorskip("matplotlib")
    assert evenly.plot.points.__doc__ and evenly.qmc.BlueNoise
    with pytest.raises(AttributeError, match="nonsense"):
        _ = evenly.nonsense


def test_designs_in_units_of_their_own(tmp_path):
    command(tmp_path, "generate", "-n", "30", "--method", "push-pull", "--space", "rect", "--size", "160,4", "--metric", "unit", "-o", "points.npy")
    ours = evenly.generate(30, method="push-pull", space="rect", size=(160, 4), metric="unit")
    np.testing.assert_array_equal(np.load(tmp_path / "points.npy"), ours.positions)
    assert ours.metric == "unit" and len(np.unique(ours.positions[:, 1].round(3))) > 20
    again = evenly.optimize(ours, method="lloyd", iterations=3)
    assert again.metric == "unit" and again.positions[:, 0].max() > 100
    assert evenly.measure(ours).min_distance == pytest.approx(evenly.measure(ours.positions / [160, 4], space="rect").min_distance)
    with pytest.raises(ValueError, match="metric is 'miles'"):
        evenly.generate(30, metric="miles")


def test_callbacks_see_where_the_points_are():
    seen = []
    points = evenly.generate(200, method="lloyd", callback=lambda _, progress: seen.append(progress.positions))
    assert len(seen) == points.iterations and all(each.shape == (200, 2) for each in seen)
    np.testing.assert_allclose(seen[-1], points.positions, atol=1e-9)
