"""Measures of sets of points: spacing, coverage, order, and spectra."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import numpy as np

from evenly import _evenly
from evenly._arrays import Floats, Frozen, converted, frozen, rows
from evenly._densities import Density, Raster, Rows, density_of
from evenly._jobs import run, threads_of
from evenly._spaces import Metric, Pair, Space, native, space_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@runtime_checkable
class _KnowsSpace(Protocol):
    @property
    def space(self) -> Space: ...
    @property
    def metric(self) -> Metric: ...
    @property
    def density(self) -> Any: ...


@dataclass(frozen=True)
class Measures:
    """What `measure` finds.

    Lengths are in hexagonal spacings, ``sqrt(2 A / (sqrt(3) n))``; capacities, the areas of Voronoi cells, in mean capacities ``A / n``; angles in
    degrees. What a set does not have is NaN, or None.
    """

    n_points: int
    """How many points there are."""
    hex_spacing: float
    """The hexagonal spacing, in input units."""
    coincident_points: int
    """Points that share their place with an earlier one."""
    min_distance: float
    """Smallest distance of two points; 1 at most."""
    mean_distance: float
    """Mean distance to the nearest other point."""
    coverage_radius: float
    """Radius of the largest empty disk; 0.577 for the hexagonal lattice."""
    beta: float
    """``coverage_radius / min_distance``; below 0.707 no triangle is obtuse."""
    bond_order: float
    """Mean over the points of abs(mean over neighbours of exp(6 i theta))."""
    bond_order_psa: float
    """The same as the tool psa defines it."""
    bond_order_global: float
    """The same of one mean over all: near 0 unless one lattice fills the domain."""
    capacity_sd: float
    """Standard deviation of the cells' areas."""
    capacity_max_deviation: float
    """Largest deviation of a cell's area from the mean."""
    cvt_energy: float
    """The energy of centroidal Voronoi tessellations, relative to the hexagonal lattice's."""
    angle_rms_deg: float
    """Root mean square deviation of the triangles' angles from 60 degrees."""
    triangle_quality: float
    """Mean of twice the inradius over the circumradius."""
    min_angle_deg: float
    """Smallest angle."""
    max_angle_deg: float
    """Largest angle."""
    obtuse_fraction: float
    """Share of triangles with an angle above 90 degrees."""
    valence: Mapping[int, int] = field(hash=False)
    """How many points have each number of neighbours."""
    density_error: float | None = None
    """Where a density is wanted, how far the number of points in cells of equal mass is from what it should be."""
    boundary_angle_rms_deg: float | None = None
    """``angle_rms_deg`` of triangles at the boundary, in bounded domains."""
    interior_angle_rms_deg: float | None = None
    """The same of all others."""
    uncovered_fraction: float | None = None
    """Share of a bounded domain that no triangle covers."""
    isolated_points: int | None = None
    """Points without a triangle."""
    inner_capacity_max_deviation: float | None = None
    """In a polygon, ``capacity_max_deviation`` of cells clear of the boundary."""


@dataclass(frozen=True, eq=False, repr=False)
class PowerSpectrum(Frozen):
    """What `power_spectrum` finds; 1 is the power of white noise."""

    power: Floats
    """The plane of power, of shape (rows, columns); the frequency 0, whose power is n, is in the middle."""
    step: Pair
    """Between columns and between rows, in inverse mean spacings ``sqrt(n / A)``."""
    ring_frequencies: Floats
    """Frequencies of rings, in inverse mean spacings."""
    ring_power: Floats
    """Mean power on each ring."""
    anisotropy_db: Floats
    """How much the power differs along each ring, in decibels."""

    def __repr__(self) -> str:
        return f"<power spectrum of {self.power.shape[1]} x {self.power.shape[0]} frequencies>"

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Floats:
        return converted(self.power, dtype, copy)


@dataclass(frozen=True, eq=False, repr=False)
class RadialPower(Frozen):
    """What `radial_power` finds."""

    frequencies: Floats
    """In inverse mean spacings."""
    power: Floats
    """Mean power at each; 1 for white noise."""
    effective_nyquist: float
    """Up to here there is next to no power (Heck, Schlömer and Deussen 2013)."""
    oscillation: float
    """How strongly the power swings beyond."""

    def __repr__(self) -> str:
        return f"<radial mean power at {len(self.power)} frequencies, effective Nyquist {self.effective_nyquist:.3f}, oscillation {self.oscillation:.3f}>"

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Floats:
        return converted(self.power, dtype, copy)


@dataclass(frozen=True, eq=False, repr=False)
class PairCorrelation(Frozen):
    """What `pair_correlation` finds."""

    distances: Floats
    """In mean spacings ``sqrt(A / n)``."""
    correlation: Floats
    """How many pairs there are at each distance, relative to white noise."""

    def __repr__(self) -> str:
        return f"<pair correlation at {len(self.distances)} distances>"

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Floats:
        return converted(self.correlation, dtype, copy)


def measure(
    points: "ArrayLike | object",
    *,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    metric: Metric | None = None,
    density: Density = None,
    density_rows: Rows | None = None,
    threads: int | None = None,
) -> Measures:
    """Measure a set of points.

    Parameters
    ----------
    points : array_like of shape (n, 2)
        Three points or more, not all on one line; a `Points` brings its space, its metric and its density along.
    space : {'torus', 'rect'}, polygon or file, optional
        The domain; 'torus' by default. See `generate`.
    size, origin : pair of float, optional
        Of a torus or rectangle; (1, 1) and (0, 0) by default.
    metric : {'input', 'unit'}, optional
        In which units distances are measured; see `generate`.
    density, density_rows : optional
        In which to measure; see `generate`.
    threads : int, optional
        All by default; the result does not depend on it.

    Returns
    -------
    Measures
        All of them.

    Raises
    ------
    ValueError
        For points that cannot be measured; the message names the row.
    Interrupted
        At Ctrl-C; ``partial`` waits for the measures.

    Examples
    --------
    >>> import evenly
    >>> points = evenly.generate(1000, method="well-spaced", beta=0.7)
    >>> measures = evenly.measure(points)
    >>> measures.beta <= 0.7, measures.obtuse_fraction
    (True, 0.0)
    """
    positions = rows(points)
    where = _space(points, space, size, origin, positions)
    own = points.density if density is None and isinstance(points, _KnowsSpace) else None
    wanted = density_of(Raster(own) if isinstance(own, np.ndarray) else density if own is None else own, where, density_rows, len(positions))
    return run(lambda: _evenly.measure(positions, native(where, metric or _metric(points)), wanted, threads_of(threads)), _measures)


def power_spectrum(
    points: "ArrayLike | object | Sequence[object]",
    *,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    max_frequency: float = 4.0,
    threads: int | None = None,
) -> PowerSpectrum:
    """Compute the power spectrum, the mean over sets if there are several.

    Parameters
    ----------
    points : array_like of shape (n, 2), or a list of such
        Sets with about as many points each.
    space, size, origin : optional
        As in `measure`; a polygon has no spectrum.
    max_frequency : float
        The largest frequency, in inverse mean spacings.
    threads : int, optional
        All by default.

    Returns
    -------
    PowerSpectrum
        The plane of power, and its means over rings.

    Raises
    ------
    ValueError
        For sets that have no frequencies in common.

    Notes
    -----
    Power is ``|sum exp(-2 pi i f x)|^2 / n`` (Lagae and Dutré 2008).

    Examples
    --------
    >>> import evenly
    >>> spectrum = evenly.power_spectrum(evenly.generate(1000, method="push-pull"))
    >>> bool(spectrum.ring_power[spectrum.ring_frequencies < 0.5].max() < 0.2)
    True
    """
    sets, where, metric = _sets(points, space, size, origin)

    def build(answer: tuple[Floats, tuple[int, int], Pair, Floats, Floats, Floats]) -> PowerSpectrum:
        power, (width, height), step, frequencies, means, anisotropy = answer
        return PowerSpectrum(frozen(power.reshape(height, width)), (step[0], step[1]), frozen(frequencies), frozen(means), frozen(anisotropy))

    return run(lambda: _evenly.power_spectrum(sets, native(where, metric), float(max_frequency), threads_of(threads)), build)


def radial_power(
    points: "ArrayLike | object | Sequence[object]",
    *,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    threads: int | None = None,
) -> RadialPower:
    """Compute the radial mean of the power spectrum from the pair correlation, and what Heck et al. (2013) derive from it.

    Parameters
    ----------
    points, space, size, origin, threads
        As in `power_spectrum`.

    Returns
    -------
    RadialPower
        Frequencies and power, the effective Nyquist frequency, and the oscillation.

    Raises
    ------
    ValueError
        For too few points, or sets that have nothing in common.

    Notes
    -----
    It comes of the pairs up to a largest distance, which blurs it: where there is little power, near the frequency 0, take ``power_spectrum(...).ring_power``.

    Examples
    --------
    >>> import evenly
    >>> evenly.radial_power(evenly.generate(1000, method="push-pull")).effective_nyquist > 0.6
    True
    """
    sets, where, metric = _sets(points, space, size, origin)

    def build(answer: tuple[Floats, Floats, Floats, Floats, float, float]) -> RadialPower:
        frequencies, power, _, _, effective_nyquist, oscillation = answer
        return RadialPower(frozen(frequencies), frozen(power), effective_nyquist, oscillation)

    return run(lambda: _evenly.radial_spectrum(sets, native(where, metric), threads_of(threads)), build)


def pair_correlation(
    points: "ArrayLike | object | Sequence[object]",
    *,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    threads: int | None = None,
) -> PairCorrelation:
    """Compute the pair correlation: how many pairs there are at a distance, relative to white noise.

    Parameters
    ----------
    points, space, size, origin, threads
        As in `power_spectrum`.

    Returns
    -------
    PairCorrelation
        Distances, in mean spacings, and the correlation at each.

    Raises
    ------
    ValueError
        As `radial_power`.

    Examples
    --------
    >>> import evenly
    >>> pairs = evenly.pair_correlation(evenly.generate(1000, method="push-pull"))
    >>> bool(pairs.correlation[pairs.distances < 0.8].max() == 0.0)
    True
    """
    sets, where, metric = _sets(points, space, size, origin)

    def build(answer: tuple[Floats, Floats, Floats, Floats, float, float]) -> PairCorrelation:
        return PairCorrelation(frozen(answer[2]), frozen(answer[3]))

    return run(lambda: _evenly.radial_spectrum(sets, native(where, metric), threads_of(threads)), build)


def _space(points: object, space: object, size: Pair | None, origin: Pair | None, positions: Floats | None = None) -> Space:
    own = points.space if isinstance(points, _KnowsSpace) else None
    return space_of(space, size, origin, own, rows(points) if own is None and positions is None else positions)


def _metric(points: object) -> Metric:
    return points.metric if isinstance(points, _KnowsSpace) else "input"


def _sets(points: Any, space: object, size: Pair | None, origin: Pair | None) -> tuple[list[Floats], Space, Metric]:
    is_several = isinstance(points, (list, tuple)) and len(points) > 0 and np.ndim(points[0]) == 2
    sets = list(points) if is_several else [points]
    spaces = {(each.space, each.metric) for each in sets if isinstance(each, _KnowsSpace)}
    if space is None and len(spaces) > 1:
        raise ValueError("the sets have different spaces")
    positions = [rows(each) for each in sets]
    return positions, _space(sets[0], space, size, origin, positions[0]), _metric(sets[0])


def _measures(text: str) -> Measures:
    found = json.loads(text)
    # JSON has neither infinity nor NaN.
    for name, value in found.items():
        if value is None:
            found[name] = math.inf if name in ("beta", "min_distance") else math.nan
    found["valence"] = {int(k): count for k, count in found["valence"].items()}
    known = {each.name for each in fields(Measures)}
    return Measures(**{name: value for name, value in found.items() if name in known})
