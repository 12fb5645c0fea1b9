"""Blue noise for those who sample with ``scipy.stats.qmc``; needs scipy."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from evenly._points import generate

__all__ = ["BlueNoise"]


class BlueNoise(qmc.QMCEngine):  # type: ignore[misc]
    """Blue noise as an engine of ``scipy.stats.qmc``: points in [0, 1)^2 that keep apart, across the seam as well.

    Parameters
    ----------
    d : int
        The dimension: 2.
    method : str
        Any method of `evenly.generate` that makes exactly as many points as asked for.
    seed, rng : int, SeedSequence, Generator, RandomState or None
        Where chance comes from; either name will do.

    Notes
    -----
    Each call of ``random`` makes a set of its own: one call with n points is a better set than two with half as many, and ``fast_forward(n)``
    goes on as after a call with n points.

    Examples
    --------
    >>> from evenly.qmc import BlueNoise
    >>> sample = BlueNoise(d=2, seed=7).random(256)
    >>> sample.shape, bool((sample >= 0).all() and (sample < 1).all())
    ((256, 2), True)
    """

    def __init__(self, d: int = 2, *, method: str = "push-pull", seed: Any = None, rng: Any = None) -> None:
        if d != 2:
            raise ValueError(f"d is {d}; blue noise is made in 2 dimensions")
        if seed is not None and rng is not None:
            raise ValueError("seed and rng are two names of one thing; give one")
        chance = rng if seed is None else seed
        if isinstance(chance, np.random.RandomState):
            chance = chance.randint(0, 2**63, dtype=np.int64)
        super().__init__(d=d, seed=np.random.default_rng(chance))
        self.method = method
        generate(3, method=method)  # type: ignore[arg-type]

    def _random(self, n: int = 1, *, workers: int = 1) -> NDArray[np.float64]:
        if n == 0:
            return np.empty((0, 2))
        points = generate(n, method=self.method, seed=self.rng, threads=None if workers == -1 else workers)  # type: ignore[arg-type]
        sample = np.array(points)
        # Exactly n: a maximal set has about as many.
        if len(sample) != n:
            raise ValueError(f"method {self.method!r} makes about as many points as asked for, not exactly; take another")
        return sample
