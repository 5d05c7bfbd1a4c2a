"""The functions: arguments of Python in, results out."""

from __future__ import annotations

import math
import operator
import os
import pathlib
import tempfile
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _asperity
from ._results import (
    Calibration,
    Crush,
    Extraction,
    FloatArray,
    Identification,
    Joint,
    Rough,
    Scales,
    Study,
    Trade,
    as_json,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._asperity import RoughScene, Scene
    from .keys import FitTable, RoughTable, SceneTable, SweepTable

    PathLike = str | os.PathLike[str]
    PixelSize = float | tuple[float, float]
    Progress = Callable[[float, str], object]


def _folder(path: PathLike | None) -> str | None:
    """The folder of ``out``, where one is asked for."""
    if path is not None and os.path.isfile(path):
        raise _asperity.InputError(f"out is the file {os.fspath(path)}: name a folder")
    return None if path is None else os.fspath(path)


def _scene(scene: Scene | SceneTable | PathLike) -> Scene:
    """A scene, or that of its tables or of a file."""
    if isinstance(scene, Mapping):
        tables: Any = scene
        return _asperity.Scene(**tables)
    if isinstance(scene, _asperity.Scene):
        return scene
    if isinstance(scene, str | os.PathLike):
        return _asperity.Scene.from_toml(os.fspath(scene))
    where = ": a RoughScene goes to press" if isinstance(scene, _asperity.RoughScene) else ""
    raise _asperity.InputError(
        f"a scene is a Scene, a dict of its tables or the path of its file, not {type(scene).__name__}{where}"
    )


def _whole(name: str, value: object) -> int:
    """A whole number that was given, from 0 on."""
    try:
        whole = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        whole = -1
    if not 0 <= whole < 2**63:
        raise _asperity.InputError(f"{name} is {value!r}: give a whole number from 0 on")
    return whole


def _level(accuracy: object) -> str | None:
    """An accuracy that was given, as the text that a scene holds."""
    if accuracy is None or isinstance(accuracy, str):
        return accuracy
    raise _asperity.InputError(
        f"accuracy is {accuracy!r}: give draft, standard, reference or a percentage as a text, '0.5%'"
    )


def _told(doubts: list[str]) -> None:
    """Tells doubts about a result as warnings, at the line that asked for it."""
    for doubt in doubts:
        warnings.warn(doubt, stacklevel=3)


def crush(
    scene: Scene | SceneTable | PathLike,
    *,
    accuracy: str | None = None,
    threads: int = 0,
    out: PathLike | None = None,
    progress: Progress | None = None,
) -> Crush:
    """Crushes a scene.

    :param scene: a scene, a dict of its tables, or the path of its file.
    :param accuracy: ``draft`` (5 %), ``standard`` (1 %), ``reference`` (0.2 %) or a percentage in place of the scene's.
    :param threads: 0 for all cores; results do not depend on it.
    :param out: folder for the files of ``asperity crush``; files of the same name are replaced.
    :param progress: called with the share that is done and a text.
    :raises InputError: the run cannot begin; what stops it later is in ``summary["stopped"]``.

    An exception that ends the run, that of ``progress`` or KeyboardInterrupt, has what was reached, a :class:`Crush`, as
    ``partial``.
    """
    try:
        result = Crush(
            _asperity.crush(
                _scene(scene), _level(accuracy), _whole("threads", threads), _folder(out), progress
            )
        )
    except BaseException as error:
        reached = getattr(error, "partial", None)
        if isinstance(reached, _asperity.Crush):
            error.__dict__["partial"] = Crush(reached)
        raise
    _told(result.warnings)
    return result


def _pixel(pixel_size_um: PixelSize) -> tuple[float, float]:
    """Distance of the points along x and y in µm."""
    try:
        dx, dy = np.broadcast_to(np.asarray(pixel_size_um, dtype=np.float64), 2).tolist()
    except (TypeError, ValueError):
        dx = dy = math.nan
    if not (0.0 < dx < math.inf and 0.0 < dy < math.inf):
        raise _asperity.InputError(
            f"pixel_size_um is {pixel_size_um!r}: give a positive number in µm, or two of them along x and y"
        )
    return dx, dy


def _heights(surface: Any, pixel_size_um: PixelSize | None) -> tuple[FloatArray, tuple[float, float]]:
    """Heights in µm and their pixel, of an array or of a topography of the package SurfaceTopography."""
    if callable(getattr(surface, "heights", None)) and hasattr(surface, "pixel_size"):
        metres = {
            "m": 1.0,
            "mm": 1e-3,
            "µm": 1e-6,
            "um": 1e-6,
            "μm": 1e-6,
            "nm": 1e-9,
            "pm": 1e-12,
            "Å": 1e-10,
        }
        unit = getattr(surface, "unit", None)
        if unit not in metres:
            raise _asperity.InputError(
                f"a topography in unit {unit!r} is not known: use one of {', '.join(metres)}"
            )
        to_um = metres[unit] / 1e-6
        if pixel_size_um is None:
            dx, dy = surface.pixel_size
            pixel_size_um = (float(dx) * to_um, float(dy) * to_um)
        # its first index runs along x, ours along y
        surface = np.ma.filled(np.ma.asarray(surface.heights(), dtype=float), np.nan).T * to_um
    given = np.ma.asarray(surface)
    if given.dtype.kind not in "fiu":
        raise _asperity.InputError(f"heights are of the type {given.dtype}: give real numbers, in µm")
    heights = np.ma.filled(given.astype(np.float64), np.nan)
    if heights.ndim != 2:
        raise _asperity.InputError(
            f"heights are an array of dimension {heights.ndim}: give one of dimension 2, y first"
        )
    if infinite := int(np.isinf(heights).sum()):
        raise _asperity.InputError(
            f"heights are infinite at {infinite} points: give nan where nothing was measured"
        )
    if pixel_size_um is None:
        raise _asperity.InputError("pixel_size_um is missing: the distance of the heights along x and y")
    return np.ascontiguousarray(heights), _pixel(pixel_size_um)


def _surface(
    surface: Any, pixel_size_um: PixelSize | None, tables: Mapping[str, object]
) -> tuple[RoughScene, FloatArray | None, tuple[float, float] | None]:
    """The scene of a surface however it is given, with heights in µm and their pixel where they are no file."""
    if isinstance(surface, _asperity.Scene):
        raise _asperity.InputError("a Scene goes to crush: give heights, the path of a map, or a RoughScene")
    scene: dict[str, Any] = dict(tables)
    table: dict[str, Any] = dict(scene.get("surface") or {})
    whole = surface if isinstance(surface, _asperity.RoughScene) else None
    if isinstance(surface, str | os.PathLike):
        path = os.fspath(surface)
        if path.endswith(".toml"):
            whole = _asperity.RoughScene.from_toml(path)
        else:
            if table.setdefault("file", path) != path:
                raise _asperity.InputError(f"the surface is given twice: as {path} and as surface.file")
            surface = None
    if whole is not None:
        if scene or pixel_size_um is not None:
            raise _asperity.InputError("a RoughScene has its own tables: change it with its set")
        return whole, None, None
    if surface is None and pixel_size_um is not None:
        sizes = [f"{size:.17g} um" for size in _pixel(pixel_size_um)]
        if "pixel_size" in table:
            raise _asperity.InputError("pixel_size_um and surface.pixel_size say the same: leave one out")
        table["pixel_size"] = sizes
    if surface is None:
        return _asperity.RoughScene(**{**scene, "surface": table}), None, None
    for key in ("file", "generate", "height_unit", "pixel_size"):
        if key in table:
            way = "pixel_size_um says it" if key == "pixel_size" else "heights are an array in µm"
            raise _asperity.InputError(f"surface.{key} goes with no array: {way}; leave it out")
    given = None if pixel_size_um is None else _heights(surface, pixel_size_um)
    # a misspelt pixel_size_um is told as a key
    known = _asperity.RoughScene(**{**scene, "surface": table})
    return known, *(given or _heights(surface, pixel_size_um))


def _is_whole(surface: Any) -> bool:
    """Tells whether a surface has all tables of its scene."""
    is_file = isinstance(surface, str | os.PathLike) and os.fspath(surface).endswith(".toml")
    return is_file or isinstance(surface, _asperity.RoughScene)


def _are_several(surfaces: Any) -> bool:
    """Tells a list of surfaces from one whose heights are lists."""
    if not isinstance(surfaces, list | tuple) or not surfaces:
        return False
    first = surfaces[0]
    named = isinstance(first, str | os.PathLike | _asperity.RoughScene)
    return named or callable(getattr(first, "heights", None)) or np.ndim(first) == 2


def press(
    heights: Any = None,
    *,
    pixel_size_um: PixelSize | None = None,
    threads: int = 0,
    out: PathLike | None = None,
    progress: Progress | None = None,
    **scene: Unpack[RoughTable],
) -> Rough:
    """Presses a rigid plane on a rough surface.

    :param heights: in µm, the first index along y, NaN or masked where nothing was measured; or a topography of the package
        SurfaceTopography; or a :class:`RoughScene`; or the path of a map or of a scene (``.toml``); absent where the tables name
        or generate a surface.
    :param pixel_size_um: distance of the heights along x and y, or one for both; of the points of a file that does not say it.
    :param threads: 0 for all cores; results do not depend on it.
    :param out: folder for the files of ``asperity rough``; files of the same name are replaced.
    :param progress: called with the share that is done and a text.
    :param scene: the tables of the scene: ``closure="all"``, ``material={...}``, ``load={...}``; with heights,
        ``surface={"level": "none", "periodic": True}`` says what is done to them.
    :raises InputError: a scene that makes no sense, a load that the surface cannot carry.
    """
    result = Rough(
        _asperity.press(
            *_surface(heights, pixel_size_um, scene), _whole("threads", threads), _folder(out), progress
        )
    )
    _told(result.warnings)
    return result


def joint(
    heights: Any = None,
    *,
    pixel_size_um: PixelSize | None = None,
    threads: int = 0,
    out: PathLike | None = None,
    progress: Progress | None = None,
    **scene: Unpack[RoughTable],
) -> Joint:
    """Presses a surface from first touch to its largest load and back: pressure, gap, stiffness, conductance and leak for other programs.

    :param heights: of the map, its path, a topography, or a :class:`RoughScene` or its path, as for :func:`press`; or a list of
        them, which are maps of one surface and give their mean and how far they differ.
    :param pixel_size_um: distance of the heights along x and y, or one for both; of the points of a file that does not say it.
    :param threads: 0 for all cores; results do not depend on it.
    :param out: folder for the files of ``asperity joint``; files of the same name are replaced.
    :param progress: called with the share that is done and a text.
    :param scene: the tables of the scene: ``material={...}``, ``load={...}`` (without it to the end of the metal or of the gap),
        ``thermal={"conductivity": ["50 W/(m K)", "50 W/(m K)"]}``, ``joint={"loads": 25}``.
    :raises InputError: a scene that makes no sense, maps of different sizes, a load that touches nothing or cannot be carried.
    """
    maps = list(heights) if _are_several(heights) else [heights]
    # where nothing is said, the metal decides whether it flows
    tables: list[dict[str, object]] = [
        {**scene} if _is_whole(one) else {"closure": "all", **scene} for one in maps
    ]
    taken = [_surface(one, pixel_size_um, own) for one, own in zip(maps, tables, strict=True)]
    result = Joint(_asperity.joint(taken, _whole("threads", threads), _folder(out), progress))
    _told(result.warnings)
    return result


def scales(
    heights: Any = None,
    *,
    pixel_size_um: PixelSize | None = None,
    threads: int = 0,
    out: PathLike | None = None,
    progress: Progress | None = None,
    **scene: Unpack[RoughTable],
) -> Scales:
    """Presses a surface with ever finer waves let in: slopes, area, pressure, gap and leak by scale, each with a verdict.

    :param heights: of the map, its path, a topography, or a :class:`RoughScene` or its path, as for :func:`press`; of a list of
        them the first is looked at, and the others are repeated measurements of it, which tell its noise.
    :param pixel_size_um: distance of the heights along x and y, or one for both; of the points of a file that does not say it.
    :param threads: 0 for all cores; results do not depend on it.
    :param out: folder for the files of ``asperity scales``; files of the same name are replaced.
    :param progress: called with the share that is done and a text.
    :param scene: the tables of the scene: ``material={...}``, ``load={...}``, ``scales={"tip_radius": "2 um"}``.
    :raises InputError: a scene that makes no sense, a flat map, repetitions of another size, a load that touches nothing.
    """
    maps = list(heights) if _are_several(heights) else [heights]
    tables: list[dict[str, object]] = [
        {**scene} if _is_whole(one) else {"closure": "all", **scene} for one in maps
    ]
    taken = [_surface(one, pixel_size_um, own) for one, own in zip(maps, tables, strict=True)]
    result = Scales(_asperity.scales(taken, _whole("threads", threads), _folder(out), progress))
    _told(result.warnings)
    return result


def extract(
    heights: Any = None,
    *,
    pixel_size_um: PixelSize | None = None,
    separation: str | None = None,
    share: float | None = None,
    hills: float | None = None,
    plane_of: str | None = None,
    depth: str | None = None,
    profiles: int = 20,
    lines: Sequence[str] = (),
    accuracy: str = "standard",
    crush: int = 0,
    threads: int = 0,
    out: PathLike | None = None,
    progress: Progress | None = None,
    **scene: Unpack[RoughTable],
) -> Extraction:
    """Finds the asperities of a map, the bodies that stand for the highest of them, and holds the closures against crushing them.

    :param heights: of the map, its path, a topography, or a :class:`RoughScene` or its path, as for :func:`press`.
    :param pixel_size_um: distance of the heights along x and y, or one for both; of the points of a file that does not say it.
    :param separation: islands above this separation from the mean plane, such as ``"1 um"``.
    :param share: islands above the plane that this share of the points is above; 0.1 where nothing is said.
    :param hills: hills of ISO 25178-2 that rise by at least this share of the height.
    :param plane_of: islands above the plane at which this closure carries the pressure of the scene, such as ``"sneddon"``.
    :param depth: how deep the scenes crush; down to the plane where nothing is said.
    :param profiles: how many asperities get a profile and a scene.
    :param lines: lines of the map as scenes in plane strain, ``"y=0.2 mm"``.
    :param accuracy: of the scenes.
    :param crush: how many asperities are crushed and compared with the closures.
    :param threads: 0 for all cores; results do not depend on it.
    :param out: folder for the files of ``asperity extract``; with ``crush`` a run that was stopped goes on from there.
    :param progress: called with the share that is done and a text.
    :param scene: the tables of the scene, as for :func:`press`.
    :raises InputError: a scene that makes no sense, no asperity, more to crush than have a profile.
    """
    wanted = {
        "separation": separation,
        "share": share,
        "hills": hills,
        "plane_of": plane_of,
        "depth": depth,
        "profiles": max(profiles, crush),
        "lines": list(lines),
        "accuracy": _level(accuracy),
    }
    with tempfile.TemporaryDirectory() as beside:
        folder = _folder(out) or beside
        taken = _surface(heights, pixel_size_um, scene)
        found = _asperity.extract(*taken, wanted, crush, _whole("threads", threads), folder, progress)
        return Extraction(*found, folder)


def calibrate(
    *,
    threads: int = 0,
    out: PathLike | None = None,
    progress: Progress | None = None,
    **sweep: Unpack[SweepTable],
) -> Calibration:
    """Crushes cones of many slopes and metals and finds the representative strain.

    :param threads: 0 for all cores; results do not depend on it.
    :param out: folder for the files of ``asperity calibrate``.
    :param progress: called with the share that is done and a text.
    :param sweep: keys of a sweep, ``slopes_deg=[2, 4]``, ``yield_stress=["200 MPa"]``; what is absent is the paper's.
    :raises InputError: values that make no sense.
    """
    return Calibration(*_asperity.calibrate(dict(sweep), _whole("threads", threads), _folder(out), progress))


def trade(
    scene: Scene | SceneTable | PathLike,
    *,
    combinations: int = 30,
    threads: int = 0,
    out: PathLike | None = None,
    progress: Progress | None = None,
) -> Trade:
    """Measures what accuracy costs on a scene, knob by knob.

    :param scene: a scene, a dict of its tables, or the path of its file.
    :param combinations: how many settings differ in everything at once.
    :param threads: 0 for all cores; the errors do not depend on it.
    :param out: folder for the files of ``asperity trade``.
    :param progress: called with the share that is done and a text.
    """
    return Trade(
        *_asperity.trade(_scene(scene), combinations, _whole("threads", threads), _folder(out), progress)
    )


def _with_files(curves: Any, folder: str) -> Any:
    """Curves with files in ``folder`` in the place of arrays; a curve alone is a list of one."""
    if isinstance(curves, Mapping):
        curves = [curves]
    if not isinstance(curves, list | tuple):
        return curves

    def with_file(i: int, curve: Any) -> Any:
        given = [name for name in ("depth_um", "force_N") if isinstance(curve, Mapping) and name in curve]
        named = curve.items() if isinstance(curve, Mapping) else ()
        arrays = [name for name, value in named if isinstance(value, np.ndarray)]
        if unknown := [name for name in arrays if name not in given]:
            raise _asperity.InputError(
                f"curve[{i}]: no array is called {unknown[0]}: give depth_um in µm and force_N in N"
            )
        if not given:
            return curve
        if len(given) == 1 or np.shape(curve["depth_um"]) != np.shape(curve["force_N"]):
            raise _asperity.InputError(
                f"curve[{i}]: depth_um and force_N go together: give an array of each, as long as the other"
            )
        file = pathlib.Path(folder) / f"curve-{i + 1}.csv"
        rows = np.column_stack([np.asarray(curve[name], dtype=np.float64) for name in given])
        np.savetxt(file, rows, fmt="%.17g", delimiter=",", header=",".join(given), comments="")
        return {**{name: value for name, value in curve.items() if name not in given}, "file": str(file)}

    return [with_file(i, curve) for i, curve in enumerate(curves)]


def identify(
    fit: FitTable | Mapping[str, Any] | PathLike,
    *,
    set: Mapping[str, Any] | None = None,  # noqa: A002
    threads: int = 0,
    out: PathLike | None = None,
    progress: Progress | None = None,
) -> Identification:
    """Finds the metal from measured force-depth curves, or from features of them.

    >>> import asperity
    >>> metal = {"youngs_modulus": "200 GPa", "poissons_ratio": 0.3, "yield_stress": ["50 MPa", "2 GPa"], "hardening_exponent": 0.1}
    >>> curve = {"depth_um": depth, "force_N": force, "tool": {"shape": "berkovich"}, "noise": "2 %"}  # doctest: +SKIP
    >>> found = asperity.identify({"material": metal, "curve": [curve]})  # doctest: +SKIP
    >>> found.parameters["yield_stress"]["low"]  # doctest: +SKIP

    :param fit: the path of a fit file, or its tables: what is known is a value, what is sought a list of two. A curve has a
        ``file``, or arrays ``depth_um`` and ``force_N`` in its place.
    :param set: keys of the file and the value that they have instead.
    :param threads: 0 for all cores; results do not depend on it.
    :param out: folder for the files of ``asperity identify``; files of the same name are replaced.
    :param progress: called with the share that is done and a text.
    :raises InputError: a fit or a table of readings that makes no sense.
    """
    if isinstance(fit, Mapping):
        tables: dict[str, Any] | str = dict(fit)
        if set is not None:
            raise TypeError("set changes a file: change the tables themselves")
    else:
        tables = os.fspath(fit)
    with tempfile.TemporaryDirectory() as folder:
        if isinstance(tables, dict) and "curve" in tables:
            tables["curve"] = _with_files(tables["curve"], folder)
        changes = None if set is None else dict(set)
        return Identification(
            *_asperity.identify(tables, changes, _whole("threads", threads), _folder(out), progress)
        )


def _any_scene(scene: Any) -> Any:
    """A scene of any kind, or that of its tables, or the path of a file."""
    if not isinstance(scene, Mapping):
        return scene if isinstance(scene, _asperity.Scene | _asperity.RoughScene) else os.fspath(scene)
    tables: Any = scene
    return _asperity.RoughScene(**tables) if "surface" in tables or "closure" in tables else _scene(tables)


def study(
    scene: Scene | RoughScene | SceneTable | RoughTable | PathLike,
    vary: Mapping[str, Any],
    *,
    sample: str | tuple[str, int] = "grid",
    seed: int = 0,
    set: Mapping[str, Any] | None = None,  # noqa: A002
    heights: Any = None,
    pixel_size_um: PixelSize | None = None,
    curves: bool = False,
    show: str | None = None,
    shard: str | None = None,
    accuracy: str | None = None,
    threads: int = 0,
    out: PathLike | None = None,
    progress: Progress | None = None,
) -> Study:
    """Runs a scene of any kind over any of its keys.

    >>> import asperity
    >>> scene = asperity.Scene.from_toml("meshes/single-asperity.toml")  # doctest: +SKIP
    >>> study = asperity.study(scene, {"material.hardening_exponent": [0, 0.1], "loading.depth": "1 um..5 um/5"})  # doctest: +SKIP

    :param scene: a scene, a dict of its tables, or the path of its file.
    :param vary: keys and their values: a list, or a text such as ``"1 um..5 um/5"``, ``"5..500/3 log"``.
    :param sample: ``grid`` (every combination), ``list`` (values in step), ``("lhs", 100)`` or ``("sobol", 128)``, drawn from
        ranges such as ``"1 um..5 um"``.
    :param seed: of the Latin hypercube.
    :param set: keys and the value that they have in all runs.
    :param heights: surface of a rough scene, as for :func:`press`.
    :param curves: keep the curve of every run, in ``out``.
    :param show: column that the picture shows.
    :param shard: a part such as ``"2/8"`` alone; ``asperity study merge`` joins their folders.
    :param accuracy: of all runs, in place of the scene's.
    :param threads: 0 for all cores; results do not depend on it.
    :param out: folder for the results; a study that was stopped goes on from there.
    :param progress: called with the share that is done and a text.
    :raises InputError: a key or a value that makes no sense; a run that fails is a row with its reason.
    """
    given: Sequence[Any] = (sample,) if isinstance(sample, str) else sample
    table: dict[str, Any] = {"kind": given[0], "seed": seed, "points": given[1] if len(given) > 1 else None}
    seed = _whole("seed", seed)
    surface, pixel = (None, None) if heights is None else _heights(heights, pixel_size_um)
    if heights is not None and isinstance(scene, Mapping):
        bare: Any = {"surface": {}, **scene}
        scene = bare
    changes = None if set is None else dict(set)
    if accuracy is not None:
        changes = {**(changes or {}), "accuracy": _level(accuracy)}
    # refuses numbers that are not finite by the path of their key
    as_json(vary)
    results = _asperity.study(
        _any_scene(scene),
        dict(vary),
        table,
        changes,
        surface,
        pixel,
        curves,
        show,
        shard,
        _whole("threads", threads),
        _folder(out),
        progress,
    )
    return Study(list(vary), *results)
