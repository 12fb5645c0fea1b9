"""Spread points evenly, but not regularly: blue noise, fast, exact in count, seeded, on any domain.

>>> import evenly
>>> points = evenly.generate(1000, method="push-pull", seed=7)
>>> points.measure().beta < 0.79
True
"""

import importlib as _importlib
from types import ModuleType as _ModuleType

from evenly import _evenly
from evenly._comparisons import Comparison, Run, compare
from evenly._jobs import Interrupted, Progress
from evenly._measures import (
    Measures,
    PairCorrelation,
    PowerSpectrum,
    RadialPower,
    measure,
    pair_correlation,
    power_spectrum,
    radial_power,
)
from evenly._meshes import Mesh, MeshQuality, mesh
from evenly._methods import Method, Parameter, methods
from evenly._points import Points, generate, optimize
from evenly._spaces import Polygon, Rectangle, Torus
from evenly._spectra import SurfaceSpectrum, surface_spectrum
from evenly._stipples import Layer, Stippling, stipple
from evenly._surfaces import SurfaceDistance, SurfaceMesh, SurfacePoints, SurfaceQuality, remesh, sample

__version__ = _evenly.__version__


def __getattr__(name: str) -> _ModuleType:
    # What takes more than numpy is imported when it is asked for.
    if name in ("plot", "qmc"):
        return _importlib.import_module(f"evenly.{name}")
    raise AttributeError(f"module 'evenly' has no attribute {name!r}")


__all__ = [
    "Comparison",
    "Interrupted",
    "Layer",
    "Measures",
    "Mesh",
    "MeshQuality",
    "Method",
    "PairCorrelation",
    "Parameter",
    "Points",
    "Polygon",
    "PowerSpectrum",
    "Progress",
    "RadialPower",
    "Rectangle",
    "Run",
    "Stippling",
    "SurfaceDistance",
    "SurfaceMesh",
    "SurfacePoints",
    "SurfaceQuality",
    "SurfaceSpectrum",
    "Torus",
    "compare",
    "generate",
    "measure",
    "mesh",
    "methods",
    "optimize",
    "pair_correlation",
    "power_spectrum",
    "radial_power",
    "remesh",
    "sample",
    "stipple",
    "surface_spectrum",
]
