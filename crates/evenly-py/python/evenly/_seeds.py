"""Where chance comes from."""

import numbers
import secrets

import numpy as np

Seed = int | np.random.SeedSequence | np.random.Generator | None
"""A whole number from 0 to 2^64 - 1, numpy's ``SeedSequence`` or ``Generator`` (from which a number is drawn), or None for one that nobody knows."""


def number(seed: Seed) -> int:
    """Return the whole number that a seed stands for."""
    if seed is None:
        return secrets.randbits(64)
    if isinstance(seed, np.random.SeedSequence):
        return int(seed.generate_state(1, np.uint64)[0])
    if isinstance(seed, np.random.Generator):
        return int(seed.integers(0, 2**64, dtype=np.uint64))
    if isinstance(seed, numbers.Integral) and not isinstance(seed, bool):
        if 0 <= int(seed) < 2**64:
            return int(seed)
        raise ValueError(f"seed is {seed}; it must be from 0 to 2**64 - 1")
    raise TypeError(f"seed must be an int, a SeedSequence, a Generator or None, not {type(seed).__name__}")
