"""Methods, and what they can be told: the registry of the library."""

import functools
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias, TypedDict

from evenly import _evenly
from evenly._jobs import Kind, value_of

Optimizer: TypeAlias = Literal[
    "procrustes", "push-pull", "well-spaced", "opt-beta", "lloyd", "cvt", "farthest-point", "distmesh", "capacity", "warp"
]
"""Methods that make points better."""
Start: TypeAlias = Literal["poisson-disk", "dart", "eliminate", "white", "jittered", "hexagonal"]
"""Methods that make points of nothing."""
OnMeshes: TypeAlias = Literal["push-pull", "well-spaced", "opt-beta", "lloyd", "distmesh", "capacity", "eliminate"]
"""Methods that move the vertices of meshes; those of 'eliminate' stay where they begin."""
OnSurfaces: TypeAlias = OnMeshes | Literal["poisson-disk", "white"]
"""Methods that spread points over surfaces."""
Target: TypeAlias = "float | str | None"
"""A number, 'off', a length in input units as '8u', or None for what the method has."""


class OptimizerOptions(TypedDict, total=False):
    """What methods can be told that move points; each takes those that `methods` lists."""

    iterations: int | None
    preset: Literal["fast", "balanced", "tough", "paper1", "paper2", "paper3"] | None
    min_distance: Target
    coverage_radius: Target
    capacity_tolerance: Target
    beta: float | None
    mode: Literal["paper", "fast"] | None
    side: float | None
    tolerance: float | None
    relaxation: float | None
    schedule: Literal["in-turn", "summed"] | None
    local: bool
    damping: float | None
    pressure: float | None
    step: float | None


class MethodOptions(OptimizerOptions, total=False):
    """What all methods can be told, those that make points too."""

    spacing: float | None
    coverage: float | None
    visible: bool
    tries: int | None


@dataclass(frozen=True)
class Parameter:
    """A parameter of a method."""

    name: str
    """Its name, here and on the command line."""
    kind: Kind
    """'number', 'target' (a number or 'off'), 'count', 'flag' or 'choice'."""
    unit: Literal["spacings", "input"] | None
    """What a length counts: spacings, of which ``"8u"`` is one in input units; or input units."""
    choices: tuple[str, ...]
    """Of a choice, its values."""
    default: str | None
    """Its value where none is given, in words."""
    doc: str
    """What it does."""


@dataclass(frozen=True)
class Method:
    """A method."""

    name: str
    """Its name."""
    title: str
    """What it does."""
    paper: str
    """Where it is from."""
    jobs: tuple[str, ...]
    """The functions that take it; 'density' if its points follow one."""
    parameters: dict[str, Parameter]
    """What it can be told, by name."""


@functools.cache
def _registry() -> dict[str, Method]:
    found = {}
    for entry in json.loads(_evenly.methods()):
        told = [Parameter(**{**each, "choices": tuple(each["choices"] or ())}) for each in entry.pop("parameters")]
        entry["jobs"] = tuple(entry["jobs"])
        found[entry["name"]] = Method(**entry, parameters={each.name: each for each in told})
    return found


def methods() -> dict[str, Method]:
    """List all methods, with what each can be told.

    Parameters
    ----------
    None

    Returns
    -------
    dict of str to Method
        By name.

    Raises
    ------
    Nothing

    Examples
    --------
    >>> import evenly
    >>> evenly.methods()["well-spaced"].parameters["beta"].default
    '0.75'
    """
    return dict(_registry())


@functools.cache
def _kinds() -> dict[str, Kind]:
    return {name: parameter.kind for method in _registry().values() for name, parameter in method.parameters.items()}


def parameters_of(options: Mapping[str, object]) -> dict[str, object]:
    """Return options of methods as requests have them; None and False are left out."""
    unknown = [name for name in options if name not in _kinds()]
    if unknown:
        raise TypeError(f"unexpected keyword argument {unknown[0]!r}; methods can be told: {', '.join(_kinds())}")
    values = {name: value_of(name, value, _kinds()[name]) for name, value in options.items()}
    return {name: value for name, value in values.items() if value is not None and value is not False}


def refuse_renamed(options: Mapping[str, object], names: Mapping[str, str]) -> None:
    """Refuse keywords that have another name now."""
    for old, new in names.items():
        if old in options:
            raise TypeError(f"{old!r} is called {new!r} now")


def options_of(method: str, options: Mapping[str, object]) -> dict[str, object]:
    """Return those options that a method takes."""
    taken = _registry()[method].parameters if method in _registry() else {}
    return {name: value for name, value in options.items() if name in taken}
