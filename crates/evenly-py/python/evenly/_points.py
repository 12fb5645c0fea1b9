"""`generate` and `optimize`, and the points that they return."""

import json
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from evenly import _evenly
from evenly._arrays import Floats, Frozen, converted, frozen, rows
from evenly._densities import Density, Raster, Rows, density_of
from evenly._jobs import Callback, named, perform, run
from evenly._measures import Measures, measure
from evenly._methods import MethodOptions, Optimizer, OptimizerOptions, Start, parameters_of
from evenly._seeds import Seed, number
from evenly._spaces import Metric, Pair, Polygon, Space, domain, metric_of, native, space_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

_MANY = 5000
_MOST = 40_000_000
_SPECTRAL = 16


@dataclass(frozen=True, eq=False, repr=False)
class Points(Frozen):
    """A set of points, as `generate` and `optimize` return it; numpy takes it as an array of shape (n, 2)."""

    positions: Floats
    """The points, which cannot be written to."""
    space: Space
    """Their domain."""
    method: str
    """How they were made."""
    seed: int
    """The same seed makes the same points."""
    outcome: str
    """How the run ended: 'converged', 'iterations_done', 'iteration_limit', 'forced', 'lost_to_rounding', 'cancelled', 'nothing_to_do', or 'made' where there was none."""
    iterations: int
    """Iterations or passes that were made."""
    notes: tuple[str, ...] = ()
    """What is good to know."""
    unmet: tuple[str, ...] = ()
    """For each target that was missed, in a sentence."""
    density: NDArray[np.float32] | str | None = None
    """The density that they follow: pixels, rows from the top, or a picture's file."""
    metric: Metric = "input"
    """In which units distances were measured."""
    run: dict[str, Any] = field(default_factory=dict)
    """All that the run has counted."""

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return converted(self.positions, dtype, copy)

    def __len__(self) -> int:
        return len(self.positions)

    def __getitem__(self, index: Any) -> Any:
        return self.positions[index]

    def __repr__(self) -> str:
        missed = f", {len(self.unmet)} of its targets missed" if self.unmet else ""
        kind = type(self.space).__name__.lower()
        return f"<{len(self)} points by {self.method} in a {kind}, seed {self.seed}, {self.outcome.replace('_', ' ')}{missed}>"

    def measure(self) -> Measures:
        """Measure the points, in the density that they follow; see `evenly.measure`."""
        return measure(self)

    def to_geodataframe(self, crs: Any = None) -> Any:
        """Return the points as a GeoDataFrame of geopandas, which must be installed."""
        import geopandas

        return geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(self.positions[:, 0], self.positions[:, 1]), crs=crs)

    def svg(self, *draw: str) -> str:
        """Draw the points, or what else the command line's ``--draw`` knows, as SVG."""
        shown = list(draw) or ["points"]
        return run(lambda: _evenly.figure(rows(self.positions), native(self.space, self.metric), self.density, shown), str)

    def _repr_svg_(self) -> str | None:
        return self.svg(*self._shown()) if len(self) <= _MANY else None

    def _repr_png_(self) -> bytes | None:
        return run(lambda: _evenly.rendered(self.svg(*self._shown())), bytes) if len(self) > _MANY else None

    def _shown(self) -> list[str]:
        has_spectrum = len(self) >= _SPECTRAL and not isinstance(self.space, Polygon)
        return ["points", "spectrum"] if has_spectrum else ["points"]


def generate(
    n: int | None = None,
    *,
    method: Optimizer | Start = "push-pull",
    start: Start | None = None,
    seed: Seed = 0,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    metric: Metric | None = None,
    density: Density = None,
    density_rows: Rows | None = None,
    fixed: "ArrayLike | object | None" = None,
    warp: bool = True,
    threads: int | None = None,
    callback: Callback | None = None,
    **options: "Unpack[MethodOptions]",
) -> Points:
    """Make points, evenly but not regularly: blue noise.

    Parameters
    ----------
    n : int, optional
        How many points, exactly; of 'poisson-disk' about. May only be missing with `spacing`.
    method : str
        How they are made, by an optimiser or as one of its starts: 'push-pull' (Ahmed et al. 2016), 'procrustes' (Papazov and Hege 2017),
        'well-spaced' and 'opt-beta' (Ebeida et al. 2014), 'lloyd', 'cvt' (Liu et al. 2009), 'farthest-point' (Schlömer et al. 2011), 'distmesh'
        (Persson and Strang 2004), 'capacity' (Balzer et al. 2009), 'warp', which takes long density waves out and nothing else; 'poisson-disk', 'dart', 'eliminate' (Yuksel 2015), 'white', 'jittered', 'hexagonal'.
    start : str, optional
        What an optimiser starts from; by default white noise, of 'opt-beta' 'poisson-disk', in a polygon 'jittered'.
    seed : int, SeedSequence, Generator or None
        The same seed makes the same points, on any number of threads, here and on the command line. None for other points each time.
    space : {'torus', 'rect'}, Torus, Rectangle, Polygon, shapely polygon or file, optional
        The domain; a torus, which is periodic, by default.
    size, origin : pair of float, optional
        Width and height of a torus or rectangle, and its lower left corner; (1, 1) and (0, 0) by default.
    metric : {'input', 'unit'}, optional
        In which units distances are measured: those of the input, or, with 'unit', parts of the domain's width and of its height. The latter is
        for axes of different kinds, as the factors of an experiment; points come back in their own units, and measures are those of the unit square.
    density : array_like of shape (height, width), callable, (x, y, values), kernel density estimate or path, optional
        How many points are wanted where, in proportion: pixels that span the domain, see `density_rows`; a function of arrays x and y; values of shape
        (len(y), len(x)) on a grid; a ``gaussian_kde`` of scipy or a ``KernelDensity`` of scikit-learn; or a picture, ``photo.png`` or ``photo.png:invert,gamma=2``.
    density_rows : {'upper', 'lower'}
        Which row of a density that is an array comes first: the upper one, as pictures have it, or the lower one, as y grows. There is no default.
    fixed : array_like of shape (k, 2), optional
        Points that stay where they are; they are among the n, and come first.
    warp : bool
        Whether long density waves are taken out first, where that suits the method.
    threads : int, optional
        All cores by default; the result does not depend on it.
    callback : callable, optional
        Called with the iteration and a `Progress` after each of an optimiser's; False stops the run.
    **options
        What the method can be told: ``iterations``; of 'push-pull' its targets, by a ``preset`` or one by one, as ``min_distance=0.85``; of 'well-spaced' and 'opt-beta'
        ``beta``; and others. `methods` lists them all.

    Returns
    -------
    Points
        The points, and how the run ended. That targets were missed is no error: see ``unmet``.

    Raises
    ------
    ValueError
        For what cannot be.
    Interrupted
        Where Ctrl-C ends the run; ``partial`` has the points reached.

    Examples
    --------
    >>> import evenly, numpy
    >>> points = evenly.generate(500, method="push-pull", seed=7)
    >>> numpy.asarray(points).shape
    (500, 2)
    >>> bool(evenly.generate(300, method="lloyd", density=lambda x, y: x).positions[:, 0].mean() > 0.6)
    True
    """
    where = space_of(space, size, origin, fixed.space if isinstance(fixed, Points) else None)
    units = metric or (fixed.metric if isinstance(fixed, Points) else "input")
    chance = number(seed)
    held = rows(() if fixed is None else fixed, "fixed", may_be_empty=True)
    wanted = density_of(density, where, density_rows, n)
    return perform(
        "generate",
        {
            "n_points": None if n is None else _count(n),
            "method": method,
            "start": start,
            "seed": chance,
            "no_warp": _is_unwarped(warp),
            "metric": metric_of(units),
        },
        parameters_of(options),
        {**domain(where), "fixed": named("fixed", held), "density": named("density", wanted)},
        lambda answer: _points(answer, where, units, method, chance, wanted),
        threads,
        callback,
    )


def optimize(
    points: "ArrayLike | object",
    *,
    method: Optimizer = "push-pull",
    seed: Seed = 0,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    metric: Metric | None = None,
    density: Density = None,
    density_rows: Rows | None = None,
    fixed: "ArrayLike | object | None" = None,
    warp: bool = True,
    threads: int | None = None,
    callback: Callback | None = None,
    **options: "Unpack[OptimizerOptions]",
) -> Points:
    """Make better points of points; those that come in are not changed.

    Parameters
    ----------
    points : array_like of shape (n, 2)
        A `Points` brings its space, its metric and its density along.
    method : str
        An optimiser, see `generate`.
    fixed : array_like of shape (k, 2), optional
        Points that stay where they are. They come first in the result; points at their places are left out.
    seed, space, size, origin, metric, density, density_rows, warp, threads, callback, **options
        As in `generate`.

    Returns
    -------
    Points
        As many points, in the same order; with `fixed` those first that stay, whether they came in or not.

    Raises
    ------
    ValueError
        For points that are not finite or lie outside the domain; the message names the row.
    Interrupted
        Where Ctrl-C ends the run; ``partial`` has the points reached.

    Examples
    --------
    >>> import evenly, numpy
    >>> noise = numpy.random.default_rng(1).random((500, 2))
    >>> better = evenly.optimize(noise, method="push-pull")
    >>> better.measure().min_distance > 0.84
    True
    """
    positions = rows(points)
    where = space_of(space, size, origin, points.space if isinstance(points, Points) else None, positions)
    units = metric or (points.metric if isinstance(points, Points) else "input")
    chance = number(seed)
    held = rows(() if fixed is None else fixed, "fixed", may_be_empty=True)
    wanted = density_of(_own_density(points) if density is None else density, where, density_rows, len(positions))
    return perform(
        "optimize",
        {"method": method, "seed": chance, "no_warp": _is_unwarped(warp), "metric": metric_of(units)},
        parameters_of(options),
        {**domain(where), "points": named("points", positions), "fixed": named("fixed", held), "density": named("density", wanted)},
        lambda answer: _points(answer, where, units, method, chance, wanted),
        threads,
        callback,
    )


def _own_density(points: object) -> object:
    own = points.density if isinstance(points, Points) else None
    return Raster(own) if isinstance(own, np.ndarray) else own


def _is_unwarped(warp: object) -> bool:
    if not isinstance(warp, (bool, np.bool_)):
        raise TypeError(f"warp must be True or False, not {warp!r}")
    return not warp


def _count(n: object) -> int:
    if isinstance(n, bool) or not isinstance(n, (int, np.integer)):
        raise TypeError(f"n must be a whole number, not {n!r}")
    if not 1 <= n <= _MOST:
        raise ValueError(f"n is {n}; it must be from 1 to {_MOST}")
    return int(n)


def _points(
    answer: tuple[Floats, str], space: Space, metric: Metric, method: str, seed: int, density: NDArray[np.float32] | str | None
) -> Points:
    positions, text = answer
    said = json.loads(text)
    counted = said["run"] or {}
    return Points(
        positions=frozen(positions),
        space=space,
        method=method,
        seed=seed,
        outcome=counted.get("outcome", "made"),
        iterations=counted.get("iterations", 0),
        notes=(*(space.repairs if isinstance(space, Polygon) else ()), *said["notes"]),
        unmet=tuple(said["unmet"]),
        metric=metric,
        density=density if density is None or isinstance(density, str) else frozen(density.copy()),
        run=counted,
    )
