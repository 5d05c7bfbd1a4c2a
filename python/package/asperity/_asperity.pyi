"""The extension module; its results are wrapped by the classes of the package."""

import os
from collections.abc import Callable
from typing import Any

from ._results import FloatArray

_Progress = Callable[[float, str], object] | None
_Columns = dict[str, Any]

__version__: str

class InputError(ValueError):
    """A scene or an argument is wrong; the message names the key, the allowed range and a way out."""

class UnfinishedError(RuntimeError):
    """The work could not be finished; the message says where and why."""

class Scene:
    """A scene of ``crush``: what is crushed, by what, how far."""

    def __init__(self, **tables: Any) -> None: ...
    @staticmethod
    def from_toml(path_or_text: str | os.PathLike[str]) -> Scene:
        """Reads a scene: a path, or the text of a TOML file."""
    def set(self, key: str, value: Any) -> Scene:
        """The scene with another value at ``key``; this one stays as it is."""
    def to_toml(self) -> str:
        """The scene as the text of a TOML file, in SI units."""
    @property
    def tables(self) -> dict[str, Any]:
        """The tables of the scene, in SI units."""
    @property
    def name(self) -> str:
        """Name of its file; "scene" where there is none."""
    def __eq__(self, other: object) -> bool: ...

class RoughScene:
    """A scene of ``press``: a surface, its material, its load."""

    def __init__(self, **tables: Any) -> None: ...
    @staticmethod
    def from_toml(path_or_text: str | os.PathLike[str]) -> RoughScene:
        """Reads a scene: a path, or the text of a TOML file."""
    def set(self, key: str, value: Any) -> RoughScene:
        """The scene with another value at ``key``; this one stays as it is."""
    def to_toml(self) -> str:
        """The scene as the text of a TOML file, in SI units; heights in memory are not in it."""

class Crush:
    def curve(self) -> _Columns: ...
    def asperities(self) -> _Columns: ...
    def gaps(self) -> _Columns: ...
    def cycles(self) -> _Columns: ...
    def summary(self) -> dict[str, Any]: ...
    def warnings(self) -> list[str]: ...
    def frames(self) -> int: ...
    def frame(self, i: int) -> tuple[Any, ...]: ...
    def plot_svg(self) -> str: ...
    def section_svg(self) -> str | None: ...
    def report(self) -> str: ...
    def text(self) -> str: ...
    def write(self, folder: str) -> None: ...

class Rough:
    def table(self) -> _Columns: ...
    def load_curve(self) -> _Columns: ...
    def summary(self) -> dict[str, Any]: ...
    def warnings(self) -> list[str]: ...
    def layer(self, closure: str | None, name: str) -> FloatArray: ...
    def gap(self, closure: str | None) -> FloatArray: ...
    def heights(self) -> FloatArray: ...
    def report(self) -> str: ...
    def text(self) -> str: ...
    def write(self, folder: str) -> None: ...

def crush(scene: Scene, accuracy: str | None, out: str | None, progress: _Progress) -> Crush: ...
def press(
    scene: RoughScene,
    heights: FloatArray | None,
    pixel_size_um: tuple[float, float] | None,
    out: str | None,
    progress: _Progress,
) -> Rough: ...
def calibrate(
    tables: dict[str, Any], threads: int, out: str | None, progress: _Progress
) -> tuple[_Columns, dict[str, Any], str | None, str, str]: ...
def trade(
    scene: Scene, combinations: int, out: str | None, progress: _Progress
) -> tuple[_Columns, float | None, str]: ...
def identify(
    fit: dict[str, Any] | str, set: dict[str, Any] | None, out: str | None, progress: _Progress
) -> tuple[dict[str, Any], _Columns, list[str | None], str, str]: ...
def study(
    scene: Scene | RoughScene | str,
    vary: dict[str, Any],
    sample: dict[str, Any],
    set: dict[str, Any] | None,
    heights: FloatArray | None,
    pixel_size_um: tuple[float, float] | None,
    curves: bool,
    show: str | None,
    shard: str | None,
    threads: int,
    out: str | None,
    progress: _Progress,
) -> tuple[_Columns, _Columns, str | None, str]: ...
def extract(
    scene: RoughScene,
    heights: FloatArray | None,
    pixel_size_um: tuple[float, float] | None,
    wanted: dict[str, Any],
    count: int,
    threads: int,
    folder: str,
    progress: _Progress,
) -> tuple[_Columns, dict[str, Any], _Columns | None, str]: ...
