"""Calls of the native half: words for its options, callbacks, and Ctrl-C."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeAlias, TypeVar, cast

from evenly import _evenly

Answer = TypeVar("Answer")
Result = TypeVar("Result")


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
    """Raised where Ctrl-C ends a call; what had been reached by then is kept."""

    def __init__(self, pending: _evenly.Pending, build: Callable[[Any], object]) -> None:
        super().__init__("interrupted; what was reached is in .partial")
        self._pending: _evenly.Pending | None = pending
        self._build = build
        self._partial: object = None

    @property
    def partial(self) -> Any:
        """The state reached, as the call would have returned it; the first access waits for the iteration at hand."""
        if self._pending is not None:
            self._partial = self._build(self._pending.result())
            self._pending = None
        return self._partial


def run(call: Callable[[], Answer], build: Callable[[Answer], Result]) -> Result:
    """Make a result of a native answer."""
    try:
        answer = call()
    except _evenly.Stopped as stopped:
        raise Interrupted(cast(_evenly.Pending, stopped.args[0]), cast(Callable[[Any], object], build)) from None
    return build(answer)


def told(callback: Callback | None) -> Callable[[int, float | None, float | None, float], bool | None] | None:
    """Return the callback as the native half calls it."""
    if callback is None:
        return None
    return lambda iteration, energy, stable_share, fraction: callback(iteration, Progress(energy, stable_share, fraction))


def words(options: Mapping[str, object]) -> list[str]:
    """Return options as the command line has them; None and False are left out."""
    given = []
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if value is True:
            given.append(flag)
        elif value is not None and value is not False:
            text = repr(float(value)) if isinstance(value, float) else str(value)
            given.append(f"{flag}={text}")
    return given
