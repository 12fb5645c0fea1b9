"""Calls of the native half: words for its options, callbacks, and Ctrl-C."""

import numbers
import threading
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeAlias, TypeVar, cast

import numpy as np

from evenly import _evenly

Answer = TypeVar("Answer")
Result = TypeVar("Result")

_MOST_THREADS = 1024
_FLAGS = {"no_warp", "visible", "local", "no_obtuse", "invert", "repair"}
_NEEDED = {"method", "layers", "sizes", "order"}
_CHOICES = _NEEDED | {"start", "preset", "mode", "schedule", "density"}
_TARGETS = {"min_distance", "coverage_radius", "capacity_tolerance", "features", "tolerance"}
_COUNTS = {"seed", "iterations", "tries", "n_triangles", "n_points"}


class Progress(NamedTuple):
    """What is known of a run after an iteration."""

    energy: float | None
    """What the method brings down, if it brings one number down."""
    stable_share: float | None
    """Of methods that sweep, the share of points at which the last pass found nothing to do."""
    fraction: float
    """How far the run has come, from 0 to 1, estimated."""


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


def told(callback: Callback | None) -> Callable[[int, float | None, float | None, float], bool | None] | None:
    """Return the callback as the native half calls it."""
    if callback is None:
        return None
    return lambda iteration, energy, stable_share, fraction: callback(iteration, Progress(energy, stable_share, fraction))


def threads_of(threads: object) -> int | None:
    """Return a number of threads; None for all."""
    if threads is None:
        return None
    if not _is_whole(threads) or not 1 <= int(cast(int, threads)) <= _MOST_THREADS:
        raise ValueError(f"threads is {threads!r}; it must be None or a whole number from 1 to {_MOST_THREADS}")
    return int(cast(int, threads))


def words(options: Mapping[str, object]) -> list[str]:
    """Return options as the command line has them; None and False are left out."""
    given = []
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if name in _FLAGS:
            if not isinstance(value, (bool, np.bool_)):
                raise TypeError(f"{name} must be True or False, not {value!r}")
            given += [flag] if value else []
        elif name in _CHOICES:
            if value is None and name not in _NEEDED:
                continue
            if not isinstance(value, str):
                raise TypeError(f"{name} must be a name, not {value!r}")
            given.append(f"{flag}={value}")
        elif value is not None:
            is_off = name in _TARGETS and value == "off"
            if name in _COUNTS and not _is_whole(value):
                raise TypeError(f"{name} must be a whole number, not {value!r}")
            if not is_off and (isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Real)):
                raise TypeError(f"{name} must be a number, not {value!r}")
            given.append(f"{flag}={value if is_off else int(cast(int, value)) if name in _COUNTS else repr(float(cast(float, value)))}")
    return given


def _is_whole(value: object) -> bool:
    return isinstance(value, numbers.Integral) and not isinstance(value, bool)
