"""`surface_spectrum`: how points are spread over a mesh in space."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from evenly import _evenly
from evenly._arrays import Floats, Frozen, frozen, rows
from evenly._jobs import run, threads_of
from evenly._shapes import native

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True, eq=False, repr=False)
class SurfaceSpectrum(Frozen):
    """What `surface_spectrum` finds, by ways along the surface."""

    min_distance: float
    """Smallest distance of two points, relative to the spacing of a hexagonal lattice with as many."""
    mean_distance: float
    """Mean distance to the nearest point, relative to the same."""
    frequencies: Floats
    """In inverse mean spacings."""
    power: Floats
    """Mean power at each; 1 for white noise."""
    distances: Floats
    """In mean spacings ``sqrt(A / n)``."""
    correlation: Floats
    """How many pairs there are at each distance, relative to white noise on the same surface."""
    effective_nyquist: float
    """Up to here there is next to no power (Heck, Schlömer and Deussen 2013)."""
    oscillation: float
    """How strongly the power swings beyond."""

    def __repr__(self) -> str:
        return f"<spectrum on a surface, effective Nyquist {self.effective_nyquist:.3f}, oscillation {self.oscillation:.3f}>"


def surface_spectrum(
    points: "ArrayLike",
    shape: object,
    *,
    local: bool = False,
    repair: bool = False,
    threads: int | None = None,
) -> SurfaceSpectrum:
    """Tell how points are spread over a triangle mesh, by differential domain analysis (Wei and Wang 2011).

    Parameters
    ----------
    points : array_like of shape (n, 3)
        On the mesh, or near it; 100 or more.
    shape : mesh, file, or pair of arrays
        See `remesh`.
    local : bool
        Take each point's distances in its own spacing, where the density varies.
    repair : bool
        Mend the mesh, as in `remesh`.
    threads : int, optional
        All by default; the result does not depend on it.

    Returns
    -------
    SurfaceSpectrum
        The smallest and the mean distance, the pair correlation, and the power that belongs to it.

    Raises
    ------
    ValueError
        For too few points, and meshes that make no surface.

    Examples
    --------
    >>> import evenly
    >>> vertices = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    >>> triangles = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (1, 0, 5), (2, 1, 5), (3, 2, 5), (0, 3, 5)]
    >>> points = evenly.sample((vertices, triangles), 1000)
    >>> evenly.surface_spectrum(points, (vertices, triangles)).effective_nyquist > 0.8
    True
    """
    places, mesh = rows(points, "points", 3), native(shape)

    def build(answer: tuple[tuple[float, float], tuple[Floats, Floats, Floats, Floats, float, float]]) -> SurfaceSpectrum:
        (smallest, mean), (frequencies, power, distances, correlation, nyquist, oscillation) = answer
        return SurfaceSpectrum(
            min_distance=smallest,
            mean_distance=mean,
            frequencies=frozen(frequencies),
            power=frozen(power),
            distances=frozen(distances),
            correlation=frozen(correlation),
            effective_nyquist=nyquist,
            oscillation=oscillation,
        )

    return run(lambda: _evenly.surface_spectrum(mesh, places, bool(local), bool(repair), threads_of(threads)), build)
