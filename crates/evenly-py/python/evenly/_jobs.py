"""Calls of the native half: requests, callbacks, and Ctrl-C."""

import json
import numbers
import threading
from collections.abc import Callable, Mapping
from typing import Any, Literal, NamedTuple, TypeAlias, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from evenly import _evenly

Answer = TypeVar("Answer")
Result = TypeVar("Result")

_MOST_THREADS = 1024
Kind: TypeAlias = Literal["number", "target", "count", "flag", "choice"]
"""What kind of value an option takes; a target is a number or 'off'."""

_KINDS: dict[str, Kind] = {
    "no_warp": "flag",
    "no_obtuse": "flag",
    "invert": "flag",
    "repair": "flag",
    "method": "choice",
    "layers": "choice",
    "sizes": "choice",
    "order": "choice",
    "start": "choice",
    "metric": "choice",
    "features": "target",
    "max_deviation": "target",
    "seed": "count",
    "n_triangles": "count",
    "n_points": "count",
    "n_vertices": "count",
}
_NEEDED = {"method", "layers", "sizes", "order"}


class Progress(NamedTuple):
    """What is known of a run after an iteration."""

    energy: float | None
    """What the method brings down, if it brings one number down."""
    stable_share: float | None
    """Of methods that sweep, the share of points at which the last pass found nothing to do."""
    fraction: float
    """How far the run has come, from 0 to 1, estimated."""
    positions: NDArray[np.float64] | None = None
    """Of shape (n, 2): where the points are, of `generate` and `optimize`; with ``metric="unit"`` in the unit square."""


Callback: TypeAlias = Callable[[int, Progress], bool | None]
"""Called with the iteration and a `Progress`; False stops the run, which then returns the state reached."""


class Interrupted(KeyboardInterrupt):
    """Raised where Ctrl-C ends a call; what had been reached by then is kept.

    An optimiser ends after the iteration at hand; what has no iterations, as some starts, goes on to its end.
    """

    def __init__(self, finish: Callable[[], object]) -> None:
        super().__init__("interrupted; what was reached is in .partial")
        self._finish: Callable[[], object] | None = finish
        self._partial: object = None
        self._error: Exception | None = None
        self._lock = threading.Lock()

    @property
    def partial(self) -> Any:
        """The state reached, as the call would have returned it; the first access waits for it."""
        with self._lock:
            if self._finish is not None:
                try:
                    self._partial = self._finish()
                except Exception as error:
                    self._error = error
                self._finish = None
        if self._error is not None:
            raise self._error
        return self._partial


def run(call: Callable[[], Answer], build: Callable[[Answer], Result]) -> Result:
    """Make a result of a native answer."""
    try:
        answer = call()
    except _evenly.Stopped as stopped:
        pending = cast(_evenly.Pending, stopped.args[0])
        raise Interrupted(lambda: build(cast(Answer, pending.result()))) from None
    return build(answer)


def told(callback: Callback | None) -> Callable[[int, float | None, float | None, float, Any], bool | None] | None:
    """Return the callback as the native half calls it."""
    if callback is None:
        return None
    return lambda iteration, energy, stable_share, fraction, positions: callback(
        iteration, Progress(energy, stable_share, fraction, positions)
    )


def threads_of(threads: object) -> int | None:
    """Return a number of threads; None for all."""
    if threads is None:
        return None
    if not _is_whole(threads) or not 1 <= int(cast(int, threads)) <= _MOST_THREADS:
        raise ValueError(f"threads is {threads!r}; it must be None or a whole number from 1 to {_MOST_THREADS}")
    return int(cast(int, threads))


def perform(
    job: str,
    options: Mapping[str, object],
    parameters: Mapping[str, object],
    data: Mapping[str, object],
    build: Callable[[Any], Result],
    threads: object = None,
    callback: Callback | None = None,
) -> Result:
    """Let the native half do a job.

    Data are numpy arrays, lists of them or files, by the names that the request has for them; options that are None, and data, are left out.
    """
    request: dict[str, object] = {"job": job, "parameters": dict(parameters)}
    request |= {name: value for name, value in checked(options).items() if value is not None}
    arrays = {}
    for name, given in data.items():
        if isinstance(given, Named):
            request[name], arrays[given.name] = given.name if given.place is None else given.place, given.data
        elif given is not None:
            request[name] = given
    text = json.dumps(request)
    return run(lambda: _evenly.perform(text, arrays, threads_of(threads), told(callback)), build)


class Named(NamedTuple):
    """Data, and what they are called where something is wrong with them."""

    name: str
    data: object
    place: object = None
    """What stands in the request, if that is more than the name."""


def named(name: str, data: object) -> object:
    """Return data with their name; a file's name, and None, as they are."""
    return data if data is None or isinstance(data, str) else Named(name, data)


def checked(options: Mapping[str, object]) -> dict[str, object]:
    """Return options that are of their kind."""
    return {name: value_of(name, value, _KINDS.get(name, "number")) for name, value in options.items()}


def value_of(name: str, value: object, kind: Kind) -> object:
    """Return the value of one option as requests have it; None where there is none."""
    if kind == "flag":
        if not isinstance(value, (bool, np.bool_)):
            raise TypeError(f"{name} must be True or False, not {value!r}")
        return bool(value)
    if value is None and name not in _NEEDED:
        return None
    if kind == "choice":
        if not isinstance(value, str):
            raise TypeError(f"{name} must be a name, not {value!r}")
        return value
    if kind == "target" and value == "off":
        return "off"
    if kind in ("number", "target") and isinstance(value, str) and value.endswith("u"):
        return value
    if kind == "count" and not _is_whole(value):
        raise TypeError(f"{name} must be a whole number, not {value!r}")
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} must be a number, not {value!r}")
    return int(cast(Any, value)) if kind == "count" else float(cast(Any, value))


def _is_whole(value: object) -> bool:
    return isinstance(value, numbers.Integral) and not isinstance(value, bool)
