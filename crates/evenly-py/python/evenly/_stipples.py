"""`stipple`, and the dots that it returns."""

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from evenly._arrays import Floats, Frozen, converted, frozen
from evenly._jobs import Callback, named, perform
from evenly._methods import OptimizerOptions, parameters_of
from evenly._seeds import Seed, number

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack


@dataclass(frozen=True, eq=False, repr=False)
class Layer(Frozen):
    """The dots of one pen."""

    name: str
    """Its ink."""
    colour: str
    """The ink's colour, as ``#rrggbb``."""
    positions: Floats
    """Of shape (n, 2), in the order in which they are drawn: pixels, y upwards from the picture's lower left corner."""
    diameters: Floats
    """Of the dots, in pixels: as large as they may be without touching, or darkening the picture too much."""

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return converted(self.positions, dtype, copy)

    def __len__(self) -> int:
        return len(self.positions)

    def __repr__(self) -> str:
        return f"<{len(self)} {self.name} dots>"


@dataclass(frozen=True, eq=False, repr=False)
class Stippling:
    """A picture as dots; numpy takes all of them as an array of shape (n, 2)."""

    layers: tuple[Layer, ...]
    """A layer a pen."""
    size: tuple[int, int]
    """The picture's width and height, in pixels."""
    seed: int
    """The same seed makes the same dots."""

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        if copy is False:
            raise ValueError("the dots of all layers together take a copy")
        return converted(np.concatenate([layer.positions for layer in self.layers]), dtype, None)

    def __len__(self) -> int:
        return sum(map(len, self.layers))

    def __repr__(self) -> str:
        return f"<{len(self)} dots in {len(self.layers)} layers of a picture of {self.size[0]} x {self.size[1]} pixels>"

    def svg(self) -> str:
        """Draw the dots, a unit a pixel."""
        width, height = self.size
        groups = []
        for layer in self.layers:
            dots = [
                f'<circle cx="{x:.3f}" cy="{height - y:.3f}" r="{0.5 * d:.3f}"/>'
                for (x, y), d in zip(layer.positions.tolist(), layer.diameters.tolist(), strict=True)
            ]
            groups.append(f'<g id="{layer.name}" fill="{layer.colour}">{"".join(dots)}</g>')
        start = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" style="mix-blend-mode:multiply">'
        return start + "".join(groups) + "</svg>\n"

    def _repr_svg_(self) -> str:
        return self.svg()


def stipple(
    picture: "ArrayLike | str | os.PathLike[str]",
    n: int = 20_000,
    *,
    method: str = "push-pull",
    seed: Seed = 0,
    invert: bool = False,
    contrast: float = 1.0,
    gamma: float = 1.0,
    floor: float = 0.0,
    white: float = 1.0,
    layers: Literal["black", "cmyk"] = "black",
    sizes: Literal["constant", "tone"] = "constant",
    order: Literal["tour", "progressive", "input"] = "tour",
    threads: int | None = None,
    callback: Callback | None = None,
    **options: "Unpack[OptimizerOptions]",
) -> Stippling:
    """Draw a picture with dots.

    Parameters
    ----------
    picture : array_like of shape (height, width) or (height, width, 3 or 4), or path
        Whole numbers up to 255 (or up to 65535, of uint16), or fractions from 0 to 1; rows from the top. What is transparent gets no dots. Files are
        PNG, JPEG, TIFF, WebP, GIF or BMP.
    n : int
        How many dots, exactly, of all layers together.
    method : str
        How dots are spread: any method of `generate` that goes by a density.
    seed : int, SeedSequence, Generator or None
        As in `generate`.
    invert : bool
        Light counts instead of dark.
    contrast, gamma, floor : float
        Tones are spread from the middle grey by `contrast`, raised to `gamma`, and no darkness is below `floor`.
    white : float
        Where the picture is lighter than this, from 0 to 1, there are no dots.
    layers : {'black', 'cmyk'}
        One layer, or one a colour.
    sizes : {'constant', 'tone'}
        Dots of one size, or larger where it is darker.
    order : {'tour', 'progressive', 'input'}
        On a short way for a pen; so that any first dots show the whole; or as they come.
    threads, callback
        As in `generate`.
    **options
        What the method can be told, see `methods`; 60 ``iterations`` of 'push-pull', 'well-spaced' and 'capacity' by default.

    Returns
    -------
    Stippling
        The dots of each pen.

    Raises
    ------
    ValueError
        For what is no picture, or has no tone.
    Interrupted
        Where Ctrl-C ends the run; ``partial`` has the dots reached.

    Examples
    --------
    >>> import evenly, numpy
    >>> ramp = numpy.tile(numpy.linspace(0, 1, 64), (32, 1))
    >>> dots = evenly.stipple(ramp, 500)
    >>> len(dots), bool(numpy.asarray(dots)[:, 0].mean() < 28)
    (500, True)
    """
    chance = number(seed)
    if isinstance(n, bool) or not isinstance(n, (int, np.integer)) or n < 1:
        raise ValueError(f"n is {n!r}; it must be a whole number, 1 or more")
    source = os.fspath(picture) if isinstance(picture, (str, os.PathLike)) else _colours(picture)

    def build(answer: tuple[tuple[int, int], list[tuple[str, str, Floats, NDArray[np.float64], float]]]) -> Stippling:
        size, drawn = answer
        made = (
            Layer(name, colour, frozen(positions), frozen(widest * np.sqrt(areas)))
            for name, colour, positions, areas, widest in drawn
        )
        return Stippling(tuple(made), size, chance)

    return perform(
        "stipple",
        {
            "n_points": int(n),
            "method": method,
            "seed": chance,
            "invert": invert,
            "contrast": contrast,
            "gamma": gamma,
            "floor": floor,
            "white": white,
            "layers": layers,
            "sizes": sizes,
            "order": order,
        },
        parameters_of(options),
        {"picture": named("the picture", source)},
        build,
        threads,
        callback,
    )


def _colours(picture: "ArrayLike") -> NDArray[np.float32]:
    array = np.asarray(picture)
    if array.dtype == object or array.dtype.kind not in "fiub" or array.size == 0 or array.ndim not in (2, 3):
        raise ValueError(f"picture must be an array of shape (height, width) or (height, width, 3), not {array.shape} of {array.dtype}")
    if array.ndim == 3 and array.shape[2] not in (1, 3, 4):
        raise ValueError(f"picture must have 1, 3 or 4 channels, not {array.shape[2]}")
    whole = 65535 if array.dtype == np.uint16 else 255 if array.dtype.kind in "iu" else 1
    tones = np.asarray(array, dtype=np.float32) / np.float32(whole)
    if not np.isfinite(tones).all():
        row = int(np.argmax(~np.isfinite(tones).reshape(len(tones), -1).all(axis=1)))
        raise ValueError(f"picture must be finite: row {row} is not")
    if tones.min() < 0 or tones.max() > 1:
        raise ValueError(f"picture must have whole numbers up to {whole}, or fractions from 0 to 1; it has {array.min()} to {array.max()}")
    if tones.ndim == 2:
        tones = tones[:, :, None]
    opacity = tones[:, :, 3:] if tones.shape[2] == 4 else np.ones((*tones.shape[:2], 1), dtype=np.float32)
    colours = np.broadcast_to(tones[:, :, :3], (*tones.shape[:2], 3))
    return np.ascontiguousarray(np.concatenate([colours, opacity], axis=2))
