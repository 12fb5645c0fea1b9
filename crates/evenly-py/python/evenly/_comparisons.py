"""`compare`: methods side by side."""

import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from html import escape
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from evenly._jobs import Interrupted
from evenly._measures import Measures, measure
from evenly._methods import OptimizerOptions, options_of, parameters_of
from evenly._points import Points, generate, optimize
from evenly._seeds import Seed, number
from evenly._spaces import Pair

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

_SHOWN = ("seconds", "min_distance", "coverage_radius", "beta", "angle_rms_deg", "obtuse_fraction", "capacity_sd", "bond_order")


@dataclass(frozen=True)
class Run:
    """One run of a method."""

    method: str
    seed: int
    seconds: float
    """Wall time, without the measuring."""
    measures: Measures
    """What has come of it."""


@dataclass(frozen=True, repr=False)
class Comparison:
    """Runs of several methods; printed, it is a table of means."""

    runs: tuple[Run, ...]
    """All of them."""

    def mean(self, method: str, name: str) -> float:
        """Return a measure's mean over a method's runs, or that of 'seconds'."""
        of_method = [run for run in self.runs if run.method == method]
        values = [run.seconds if name == "seconds" else getattr(run.measures, name) for run in of_method]
        return float(np.mean(values))

    def records(self) -> list[dict[str, Any]]:
        """Return a dictionary a run, as pandas and polars take it."""
        return [{"method": run.method, "seed": run.seed, "seconds": run.seconds, **asdict(run.measures)} for run in self.runs]

    def _table(self) -> list[list[str]]:
        methods = list(dict.fromkeys(run.method for run in self.runs))
        return [["", *_SHOWN], *([method, *(f"{self.mean(method, name):.4g}" for name in _SHOWN)] for method in methods)]

    def __repr__(self) -> str:
        table = self._table()
        widths = [max(map(len, column)) for column in zip(*table, strict=True)]
        lines = ["  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip() for line in table]
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        head, *lines = self._table()
        cells = "".join(f"<th>{escape(cell)}</th>" for cell in head)
        body = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in line) + "</tr>" for line in lines)
        return f"<table><tr>{cells}</tr>{body}</table>"


def compare(
    points: "int | ArrayLike | object",
    *,
    methods: Sequence[str] = ("procrustes", "push-pull", "well-spaced", "lloyd", "farthest-point"),
    runs: int = 3,
    seed: Seed = 0,
    space: object = None,
    size: Pair | None = None,
    origin: Pair | None = None,
    threads: int | None = None,
    **options: "Unpack[OptimizerOptions]",
) -> Comparison:
    """Run several methods on the same points, and lay their measures side by side.

    Parameters
    ----------
    points : int or array_like of shape (n, 2)
        How many points, or the points that all begin with.
    methods : sequence of str
        See `generate`; of points that are given, optimisers alone.
    runs : int
        How often, each time with the next seed.
    seed, space, size, origin, threads
        As in `generate`.
    **options
        What the methods can be told: each takes those that it has.

    Returns
    -------
    Comparison
        All runs; printed, a table of means.

    Raises
    ------
    ValueError
        As the methods.
    Interrupted
        Where Ctrl-C ends it; ``partial`` has the runs that were done.

    Examples
    --------
    >>> import evenly
    >>> table = evenly.compare(300, methods=["white", "push-pull"], runs=1)
    >>> table.mean("push-pull", "beta") < table.mean("white", "beta")
    True
    """
    if runs < 1:
        raise ValueError(f"runs is {runs}; it must be 1 or more")
    parameters_of(options)
    for name in options:
        if not any(options_of(method, {name: None}) for method in methods):
            raise ValueError(f"{name} is for none of these methods")
    first = number(seed)
    found: list[Run] = []
    where: dict[str, Any] = {"space": space, "size": size, "origin": origin, "threads": threads}
    try:
        for method in methods:
            for k in range(runs):
                chance = (first + k) % 2**64
                begin = time.perf_counter()
                made: Points
                if isinstance(points, (int, np.integer)):
                    made = generate(int(points), method=cast(Any, method), seed=chance, **where, **cast(Any, options_of(method, options)))
                else:
                    made = optimize(points, method=cast(Any, method), seed=chance, **where, **cast(Any, options_of(method, options)))
                seconds = time.perf_counter() - begin
                found.append(Run(method, chance, seconds, measure(made, threads=threads)))
    except KeyboardInterrupt:
        # Between two calls as well as in one.
        raise Interrupted(lambda: Comparison(tuple(found))) from None
    return Comparison(tuple(found))
