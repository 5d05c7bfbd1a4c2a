"""Results as tables, arrays, pictures."""

from __future__ import annotations

import difflib
import html
import json
import math
import os
import pathlib
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _asperity

if TYPE_CHECKING:
    import meshio
    import pandas as pd
    import pyvista

    PathLike = str | os.PathLike[str]

Array = npt.NDArray[Any]
FloatArray = npt.NDArray[np.float64]


def as_json(value: object) -> str:
    """Tables of Python as JSON: numbers and arrays of numpy are numbers and lists, ``None`` is left out.

    :raises InputError: a number that is not finite, with the path of its key.
    """

    def plain(value: object, path: str) -> object:
        if isinstance(value, Mapping):
            start = f"{path}." if path else ""
            return {
                str(key): plain(inner, f"{start}{key}") for key, inner in value.items() if inner is not None
            }
        if isinstance(value, list | tuple | np.ndarray):
            return [plain(inner, f"{path}[{i}]") for i, inner in enumerate(value)]
        if isinstance(value, np.generic):
            value = value.item()
        if isinstance(value, os.PathLike):
            return os.fspath(value)
        if isinstance(value, float) and not math.isfinite(value):
            raise _asperity.InputError(f"{path} is {value}: give a finite number, or leave the key out")
        return value

    return json.dumps(plain(value, ""), allow_nan=False)


def _page(page: str, path: PathLike | None) -> str:
    """The page, which is written too where there is a path."""
    if path is not None:
        pathlib.Path(path).write_text(page, encoding="utf-8")
    return page


class Numbers(dict[str, Any]):
    """The numbers of a result by name; of a name that is not there it tells those that are like it."""

    def __missing__(self, name: str) -> Any:
        near = difflib.get_close_matches(name, self, 3, 0.5)
        raise KeyError(f"{name}: there are {', '.join(near or self)}")


class Table(Mapping[str, Array]):
    """Rows of a result by the names of its columns, units included.

    ``table["force_N"]`` is an array, ``len(table)`` the number of rows, ``table.rows()`` the rows one by one.
    """

    def __init__(self, columns: Mapping[str, Any]) -> None:
        self._columns: dict[str, Array] = {name: np.asarray(values) for name, values in columns.items()}

    def __getitem__(self, column: str) -> Array:
        try:
            return self._columns[column]
        except KeyError:
            raise KeyError(f"{column}: there are {', '.join(self._columns)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(next(iter(self._columns.values()), ()))

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
        return list(self._columns)

    def rows(self) -> list[dict[str, Any]]:
        """The rows as dictionaries."""
        lists = [values.tolist() for values in self._columns.values()]
        return [dict(zip(self._columns, row, strict=True)) for row in zip(*lists, strict=True)]

    def to_dataframe(self) -> pd.DataFrame:
        """The same as a table of pandas."""
        import pandas as pd

        return pd.DataFrame(dict(self._columns))

    def to_parquet(self, path: PathLike) -> None:
        """Writes a Parquet file with pandas."""
        self.to_dataframe().to_parquet(path)

    def __repr__(self) -> str:
        return f"<Table of {len(self)} rows: {', '.join(self._columns)}>"

    def _repr_html_(self) -> str:
        shown = list(self._columns.items())[:12]
        head = "".join(f"<th>{name}</th>" for name, _ in shown)

        def cell(value: Any) -> str:
            return f"{value:.6g}" if isinstance(value, float | np.floating) else str(value)

        lines = [
            "<tr>" + "".join(f"<td>{cell(values[i])}</td>" for _, values in shown) + "</tr>"
            for i in range(min(len(self), 12))
        ]
        return f"<table><tr>{head}</tr>{''.join(lines)}</table><p>{len(self)} rows</p>"


class Fields:
    """Fields of one increment over its mesh; names carry units.

    ``fields["von_mises_MPa"]`` is an array over nodes, ``fields["plastic_zone"]`` over cells.
    """

    def __init__(self, frame: tuple[Any, ...]) -> None:
        increment, phase, points, cells, nodes, over_cells, surface = frame
        self.increment: int = increment
        """Increment of the curve."""
        self.phase: str = phase
        """``load`` or ``unload``."""
        self.points_um: FloatArray = points
        """Nodes (r, z) before the crush, one row each."""
        self.cells: npt.NDArray[np.int64] = np.asarray(cells, dtype=np.int64)
        """Nodes of each cell: four corners counterclockwise, then the middles of their sides where there are eight."""
        self.nodes: dict[str, FloatArray] = nodes
        """Arrays over nodes."""
        self.over_cells: dict[str, FloatArray] = over_cells
        """Arrays over cells."""
        self.surface = Table(surface)
        """The free surface from the axis outward."""

    def __getitem__(self, name: str) -> FloatArray:
        both = {**self.nodes, **self.over_cells}
        try:
            return both[name]
        except KeyError:
            raise KeyError(f"{name}: there are {', '.join(both)}") from None

    def to_meshio(self) -> meshio.Mesh:
        """The same as a mesh of meshio, coordinates in µm."""
        import meshio

        points = np.column_stack([self.points_um, np.zeros(len(self.points_um))])
        kind = {4: "quad", 8: "quad8"}[self.cells.shape[1]]
        over_cells = {name: [values] for name, values in self.over_cells.items()}
        return meshio.Mesh(points, [(kind, self.cells)], point_data=dict(self.nodes), cell_data=over_cells)

    def to_pyvista(self) -> pyvista.UnstructuredGrid:
        """The same as a mesh of pyvista, coordinates in µm."""
        import pyvista

        return pyvista.from_meshio(self.to_meshio())

    def __repr__(self) -> str:
        names = ", ".join([*self.nodes, *self.over_cells])
        return f"<Fields of increment {self.increment} ({self.phase}), {len(self.cells)} cells: {names}>"


class Crush:
    """The result of a crush.

    ``curve`` and ``summary`` hold its numbers, ``warnings`` the promises of the accuracy that it does not keep, ``fields(i)`` the
    fields of an increment; ``asperities``, ``gaps`` and ``cycles`` what several contacts and reloads have beside.
    """

    def __init__(self, inner: _asperity.Crush) -> None:
        self._inner = inner
        self.curve = Table(inner.curve())
        """Loading and unloading, a row an increment: ``curve["depth_um"]``."""
        self.summary = Numbers(inner.summary())
        """The numbers of ``summary.json``."""
        self.warnings: list[str] = inner.warnings()
        """Promises of the accuracy that the run does not keep."""

    @property
    def asperities(self) -> Table:
        """The share of each asperity in each increment; empty for a single one."""
        return Table(self._inner.asperities())

    @property
    def gaps(self) -> Table:
        """The gaps between contacts in each increment."""
        return Table(self._inner.gaps())

    @property
    def cycles(self) -> Table:
        """The loading and the reloads; empty without reloads."""
        return Table(self._inner.cycles())

    @property
    def frames(self) -> int:
        """Number of increments that have fields: ``output = {"every": 5}`` in the scene asks for them."""
        return self._inner.frames()

    def fields(self, i: int) -> Fields:
        """Fields ``i`` of ``frames``, in the order in which they came; -1 is the last."""
        if not -self.frames <= i < self.frames:
            kept = f"the run kept {self.frames}, counted from 0" if self.frames else "the run kept none"
            way = "output={'every': 1} in the scene keeps those of each increment"
            raise _asperity.InputError(f"there are no fields {i}: {kept}; {way}")
        return Fields(self._inner.frame(i if i >= 0 else self.frames + i))

    def write(self, folder: PathLike) -> None:
        """Writes the files of ``asperity crush``; files of the same name are replaced."""
        self._inner.write(os.fspath(folder))

    def svg(self) -> str:
        """The curve as SVG."""
        return self._inner.plot_svg()

    def section_svg(self) -> str | None:
        """The section at the peak as SVG, where the run has fields of it."""
        return self._inner.section_svg()

    def report(self, path: PathLike | None = None) -> str:
        """The page of ``--report``, which stands alone; written to ``path`` too if there is one."""
        return _page(self._inner.report(), path)

    def __repr__(self) -> str:
        return f"<Crush\n{self._inner.text()}>"

    def _repr_svg_(self) -> str:
        return self.svg()


class Rough:
    """The contact of a rough surface with a rigid plane, by one closure or several.

    ``table`` has a row a closure, in which ``contact_area_ratio`` counts whole pixels and ``contact_area_ratio_corrected``, whose
    error is ``area_error``, does without their corners; ``load_curve``, ``summary``, ``warnings``, and the maps ``pressure()``,
    ``contact()``, ``regime()`` and ``gap()``.
    """

    def __init__(self, inner: _asperity.Rough) -> None:
        self._inner = inner
        self.table = Table(inner.table())
        """A row a closure."""
        self.load_curve = Table(inner.load_curve())
        """From first touch to the load and back."""
        self.summary = Numbers(inner.summary())
        """The numbers of ``summary.json``."""
        self.warnings: list[str] = inner.warnings()
        """Remarks on the trust in the numbers."""

    def pressure(self, closure: str | None = None) -> FloatArray:
        """Force on a cell over its area, MPa, a row for each row of cells; of the first closure unless one is named."""
        return self._inner.layer(closure, "pressure")

    def contact(self, closure: str | None = None) -> FloatArray:
        """Share of each cell that is in contact."""
        return self._inner.layer(closure, "contact")

    def regime(self, closure: str | None = None) -> FloatArray:
        """Of each cell: 0 no contact, 1 elastic, 2 elastoplastic, 3 plastic."""
        return self._inner.layer(closure, "regime")

    def gap(self, closure: str | None = None) -> FloatArray:
        """Distance of the plane from the surface at the nodes, µm; 0 in contact.

        The surface is the deformed one with a half-space, the undeformed one with a closure of islands.
        """
        return self._inner.gap(closure)

    @property
    def heights_um(self) -> FloatArray:
        """The surface as pressed: levelled and filtered."""
        return self._inner.heights()

    def write(self, folder: PathLike) -> None:
        """Writes the files of ``asperity rough``; files of the same name are replaced."""
        self._inner.write(os.fspath(folder))

    def report(self, path: PathLike | None = None) -> str:
        """The page of ``--report``, which stands alone; written to ``path`` too if there is one."""
        return _page(self._inner.report(), path)

    def __repr__(self) -> str:
        return f"<Rough\n{self._inner.text()}>"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self._inner.text())}</pre>"


class Joint:
    """The law of a joint: pressure, gap, stiffness, conductance and leak from first touch to the largest load, and back."""

    def __init__(self, inner: _asperity.Joint) -> None:
        self._inner = inner
        self.table = Table(inner.table())
        """The rows of ``joint.csv``."""
        self.law = Table(inner.law())
        """Approach and pressure for straight lines between them."""
        self.summary = Numbers(inner.summary())
        """The numbers of ``joint.json``."""
        self.warnings: list[str] = self.summary["warnings"]
        """Remarks on the trust in the numbers."""

    def write(self, folder: PathLike) -> None:
        """Writes the files of ``asperity joint``; files of the same name are replaced."""
        self._inner.write(os.fspath(folder))

    def report(self, path: PathLike | None = None) -> str:
        """The page of ``--report``, which stands alone; written to ``path`` too if there is one."""
        return _page(self._inner.report(), path)

    def __repr__(self) -> str:
        return f"<Joint\n{self._inner.text()}>"

    def _repr_html_(self) -> str:
        return self.table._repr_html_()


class Scales:
    """A surface as ever finer waves are let in: slopes, contact, and of each answer whether it has stopped changing."""

    def __init__(self, inner: _asperity.Scales) -> None:
        self._inner = inner
        self.table = Table(inner.table())
        """The rows of ``scales.csv``."""
        self.slopes = Table(inner.slopes())
        """The rows of ``slopes.csv``."""
        self.summary = Numbers(inner.summary())
        """The numbers of ``summary.json``."""
        self.verdicts: dict[str, dict[str, Any]] = self.summary["verdicts"]
        """Of each quantity its class, the cut-off from which on it holds, its error and its exponent."""
        self.warnings: list[str] = self.summary["warnings"]
        """Remarks on the trust in the numbers."""

    def write(self, folder: PathLike) -> None:
        """Writes the files of ``asperity scales``; files of the same name are replaced."""
        self._inner.write(os.fspath(folder))

    def report(self, path: PathLike | None = None) -> str:
        """The page of ``--report``, which stands alone; written to ``path`` too if there is one."""
        return _page(self._inner.report(), path)

    def __repr__(self) -> str:
        return f"<Scales\n{self._inner.text()}>"

    def _repr_html_(self) -> str:
        return self.table._repr_html_()


class Extraction:
    """The asperities of a map, with profiles and scenes of the highest, and the closures beside finite elements."""

    def __init__(
        self,
        asperities: Mapping[str, Any],
        summary: dict[str, Any],
        compared: Mapping[str, Any] | None,
        text: str,
        folder: str,
    ) -> None:
        from . import _asperity

        self.asperities = Table(asperities)
        """A row an asperity, from the highest down."""
        self.summary = Numbers(summary)
        """The numbers of ``summary.json``."""
        self.compared = None if compared is None else Table(compared)
        """Force and area of each closure beside the finite elements; None where nothing was crushed."""
        self.scenes: dict[str, _asperity.Scene] = {}
        """The scenes by name, ``"001"`` that of the highest asperity, each with its profile in it."""
        for file in sorted((pathlib.Path(folder) / "scenes").glob("*.toml")):
            # with the points of the profile in the place of its file, which need not stay
            text_of = _asperity.Scene.from_toml(file).to_toml()
            self.scenes[file.stem] = _asperity.Scene.from_toml(text_of)
        self._text = text

    def __repr__(self) -> str:
        return f"<Extraction\n{self._text}>"

    def _repr_html_(self) -> str:
        return (self.asperities if self.compared is None else self.compared)._repr_html_()


class Calibration:
    """A sweep of cones and the representative strain that makes its curves one."""

    def __init__(
        self, cases: Mapping[str, Any], fit: dict[str, Any], coefficient: str | None, text: str, report: str
    ) -> None:
        self.cases = Table(cases)
        """A row a cone."""
        self.fit = fit
        """The numbers of ``fit.json``; ``fit["coefficient"]`` is None with ``fit["reason"]`` where nothing was fitted."""
        self.coefficient_toml = coefficient
        """The file that ``press`` reads as ``coefficient``."""
        self._text = text
        self._report = report

    def report(self, path: PathLike | None = None) -> str:
        """The page of ``--report``, which stands alone; written to ``path`` too if there is one."""
        return _page(self._report, path)

    def __repr__(self) -> str:
        return f"<Calibration\n{self._text}>"


class Trade:
    """Error against cost of many settings of a scene."""

    def __init__(self, rows: Mapping[str, Any], converged_to: float | None, text: str) -> None:
        self.rows = Table(rows)
        """A row a setting."""
        self.converged_to = converged_to
        """Relative uncertainty of the converged force; None where it is not known."""
        self._text = text

    def __repr__(self) -> str:
        return f"<Trade\n{self._text}>"


class Study:
    """Runs of a scene over its keys."""

    def __init__(
        self,
        keys: list[str],
        results: Mapping[str, Any],
        times: Mapping[str, Any],
        picture: str | None,
        text: str,
    ) -> None:
        self.keys = keys
        """The varied keys."""
        self.results = Table(results)
        """A row a run: the keys, every number of its summary, ``status``."""
        self.times = Table(times)
        """Seconds and memory of the runs."""
        self.picture = picture
        """One result over the keys, as SVG."""
        self._text = text

    def varied(self, key: str) -> FloatArray:
        """The values of a key as numbers, their unit left out."""
        values = self.results[key]
        if values.dtype.kind == "f":
            return values
        return np.array([float(str(value).split()[0]) for value in values])

    def to_dataframe(self) -> pd.DataFrame:
        """The results as a table of pandas."""
        return self.results.to_dataframe()

    def to_parquet(self, path: PathLike) -> None:
        """Writes the results as a Parquet file with pandas."""
        self.results.to_parquet(path)

    def __repr__(self) -> str:
        return f"<Study\n{self._text}>"

    def _repr_svg_(self) -> str | None:
        return self.picture


class Identification:
    """A metal found from measured curves, with intervals and a verdict whether the curves can tell.

    ``parameters`` holds what was sought, ``verdict`` a sentence on it, ``fit`` all numbers, ``fit["material"]`` the metal for a
    scene, ``samples`` the posterior.
    """

    def __init__(
        self,
        fit: dict[str, Any],
        samples: Mapping[str, Any],
        pictures: list[str | None],
        text: str,
        report: str,
    ) -> None:
        self.fit = fit
        """The numbers of ``fit.json``."""
        self.parameters: dict[str, dict[str, Any]] = fit["parameters"]
        """The unknowns that were sought: ``parameters["yield_stress"]`` has value, low, high, unit, identifiable."""
        self.verdict: str = fit["verdict"]
        """Sentences on what the measurements tell and what they do not."""
        self.samples = Table(samples)
        """Samples of the posterior, a row a sample."""
        self.curve_svg, self.stress_strain_svg, self.objective_svg = pictures
        self._text = text
        self._report = report

    def report(self, path: PathLike | None = None) -> str:
        """The page of ``--report``, which stands alone; written to ``path`` too if there is one."""
        return _page(self._report, path)

    def __repr__(self) -> str:
        # the files that the command speaks of are written with `out`
        lines = [line for line in self._text.split("\n") if not line.startswith("use it")]
        use = 'use it    asperity.Scene(material=found.fit["material"], ...) takes this metal'
        return "\n".join(["<Identification", *lines, use]) + ">"

    def _repr_svg_(self) -> str | None:
        return self.curve_svg
