"""Spread points evenly, but not regularly: blue noise, fast, exact in count, seeded, on any domain.

>>> import evenly
>>> points = evenly.generate(1000, method="push-pull", seed=7)
>>> points.measure().beta < 0.79
True
"""

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
from evenly._points import Points, generate, optimize
from evenly._spaces import Polygon, Rectangle, Torus
from evenly._stipples import Layer, Stippling, stipple

__version__ = _evenly.__version__

__all__ = [
    "Comparison",
    "Interrupted",
    "Layer",
    "Measures",
    "Mesh",
    "MeshQuality",
    "PairCorrelation",
    "Points",
    "Polygon",
    "PowerSpectrum",
    "Progress",
    "RadialPower",
    "Rectangle",
    "Run",
    "Stippling",
    "Torus",
    "compare",
    "generate",
    "measure",
    "mesh",
    "optimize",
    "pair_correlation",
    "power_spectrum",
    "radial_power",
    "stipple",
]
