"""The package against the command: the same bits, errors that name their key, and manners of Python.

``ASPERITY`` is the command that numbers are compared with; without it those tests are skipped.
"""

import csv
import json
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time
from typing import TYPE_CHECKING, Any

import asperity
import numpy as np
import pytest

if TYPE_CHECKING:
    from asperity.keys import CurveTable, FitTable, RoughMaterialTable

SCENE: dict[str, Any] = {
    "symmetry": "axisymmetric",
    "accuracy": "draft",
    "material": {
        "youngs_modulus": "210 GPa",
        "poissons_ratio": 0.3,
        "yield_stress": "300 MPa",
        "hardening_exponent": 0.3,
    },
    "asperity": [{"height": "20 um", "slope_deg": 10, "tip_radius": "10 um"}],
    "tool": {"shape": "plane"},
    "loading": {"depth": "2 um", "unload": True},
    "output": {"every": 0},
}
STEEL: "RoughMaterialTable" = {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "hardness": "1280 MPa"}


def waves() -> asperity._results.FloatArray:
    """An egg box that is not square, so that the axes cannot be mixed up."""
    x, y = np.arange(96), np.arange(64)
    return 0.2 * np.cos(2 * np.pi * y / 32)[:, None] * np.cos(2 * np.pi * x / 48)[None, :]


def command(folder: pathlib.Path, *args: str) -> None:
    """Runs the command in a folder."""
    binary = os.environ.get("ASPERITY")
    if binary is None:
        pytest.skip("ASPERITY names no command")
    done = subprocess.run([binary, *args, "--quiet"], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def column(file: pathlib.Path, name: str) -> list[float]:
    with file.open() as lines:
        return [float(row[name]) for row in csv.DictReader(lines)]


def test_a_crush_has_the_bits_of_the_command(tmp_path: pathlib.Path) -> None:
    scene = asperity.Scene(**SCENE)
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    result = asperity.crush(scene)
    command(tmp_path, "crush", "scene.toml", "--out", "out")
    for name in ("depth_um", "force_N", "plastic_work_uJ"):
        assert result.curve[name].tolist() == column(tmp_path / "out/curve.csv", name), name
    summary = json.loads((tmp_path / "out/summary.json").read_text())
    for name in ("peak_force_N", "residual_depth_um", "errors", "dofs"):
        assert result.summary[name] == summary[name], name
    assert result.curve["depth_um"].dtype == np.float64
    assert result.curve["increment"].dtype == np.int64
    result.write(tmp_path / "again")
    assert (tmp_path / "again/curve.csv").read_bytes() == (tmp_path / "out/curve.csv").read_bytes()


def test_a_numpy_surface_is_pressed_like_its_file(tmp_path: pathlib.Path) -> None:
    heights = waves()
    np.save(tmp_path / "surface.npy", heights)
    tables: dict[str, Any] = {"material": STEEL, "load": {"pressure": "50 MPa"}}
    rough = asperity.press(
        heights, pixel_size_um=(1.0, 2.0), closure="all", surface={"level": "none"}, **tables
    )
    scene = asperity.RoughScene(
        closure="all",
        surface={"file": "surface.npy", "pixel_size": ["1 um", "2 um"], "height_unit": "um", "level": "none"},
        **tables,
    )
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    command(tmp_path, "rough", "scene.toml", "--out", "out")
    ratios = column(tmp_path / "out/table.csv", "contact_area_ratio")
    assert rough.table["contact_area_ratio"].tolist() == ratios
    assert len(rough.table) == len(ratios) >= 3
    # cells lie between the nodes
    assert rough.pressure("sneddon").shape == (63, 95) and rough.gap("sneddon").shape == (64, 96)
    assert np.array_equal(rough.heights_um, heights) or np.allclose(rough.heights_um, heights, rtol=1e-15)
    # pressure over the cells carries the load
    assert rough.pressure("sneddon").mean() == pytest.approx(50.0, rel=1e-5)
    assert rough.gap("sneddon").min() == 0.0 and rough.gap("sneddon").max() > 0.1


def test_a_topography_is_taken_with_its_units() -> None:
    class Topography:
        """As in the package SurfaceTopography: the first index runs along x."""

        unit = "nm"
        pixel_size = (1000.0, 2000.0)

        def heights(self) -> Any:
            return np.ma.masked_array(1000.0 * waves().T)

    tables: dict[str, Any] = {"closure": "sneddon", "material": STEEL, "load": {"pressure": "50 MPa"}}
    one = asperity.press(Topography(), **tables)
    other = asperity.press(waves(), pixel_size_um=(1.0, 2.0), **tables)
    ratio = one.table["contact_area_ratio"][0]
    assert ratio == pytest.approx(other.table["contact_area_ratio"][0], rel=1e-9)


def test_tables_stand_for_a_scene_and_one_pixel_size_for_both() -> None:
    scene: Any = SCENE
    by_tables, by_scene = asperity.crush(scene), asperity.crush(asperity.Scene(**SCENE))
    assert by_tables.summary["peak_force_N"] == by_scene.summary["peak_force_N"]
    tables: dict[str, Any] = {"closure": "sneddon", "material": STEEL, "load": {"pressure": "50 MPa"}}
    one, both = (asperity.press(waves(), pixel_size_um=size, **tables) for size in (1, (1.0, 1.0)))
    assert one.table["contact_area_ratio"][0] == both.table["contact_area_ratio"][0]


def test_wrong_input_names_its_key() -> None:
    with pytest.raises(asperity.InputError, match="axisymmetric"):
        asperity.Scene.from_toml("symmetry = 'axisymetric'")
    with pytest.raises(asperity.InputError, match=r"poissons_ratio"):
        asperity.Scene(**{**SCENE, "material": {**SCENE["material"], "poissons_ratio": 0.7}})
    with pytest.raises(asperity.InputError, match=r"did you mean `depth`"):
        asperity.Scene(**SCENE).set("loading.dept", "1 um")
    with pytest.raises(asperity.InputError, match=r"loading.depth"):
        asperity.study(asperity.Scene(**SCENE), {"loading.depth": []})
    with pytest.raises(asperity.InputError, match=r"there is no file"):
        asperity.Scene.from_toml("no such file.toml")
    with pytest.raises(asperity.InputError, match="pixel_size_um"):
        asperity.press(waves(), closure="sneddon", material=STEEL, load={"pressure": "50 MPa"})
    with pytest.raises(asperity.InputError, match=r"material\.hardening_exponent is nan"):
        asperity.Scene(**{**SCENE, "material": {**SCENE["material"], "hardening_exponent": float("nan")}})
    with pytest.raises(asperity.InputError, match="tool.friction"):
        asperity.study(asperity.Scene(**SCENE), {"tool.friction": [0.0, float("inf")]})
    for size in ("1 um", -1.0, (1.0, 0.0), (1.0, 1.0, 1.0)):
        with pytest.raises(asperity.InputError, match="pixel_size_um"):
            asperity.press(waves(), pixel_size_um=size, closure="sneddon")  # type: ignore[arg-type]
    for heights in (waves() > 0, 1j * waves(), np.where(waves() > 0, waves(), np.inf)):
        with pytest.raises(asperity.InputError, match="heights are"):
            asperity.press(heights, pixel_size_um=1.0, closure="sneddon")
    with pytest.raises(asperity.InputError, match="dimension"):
        asperity.press(np.zeros(4), pixel_size_um=(1.0, 1.0), closure="sneddon")
    with pytest.raises(asperity.InputError, match="material"):
        asperity.press(waves(), pixel_size_um=(1.0, 1.0), closure="sneddon", load={"pressure": "1 MPa"})
    assert issubclass(asperity.InputError, ValueError)


def test_a_surface_is_given_once_and_its_pixel_too(tmp_path: pathlib.Path) -> None:
    contact: Any = {"closure": "sneddon", "material": STEEL, "load": {"pressure": "50 MPa"}}
    file = tmp_path / "waves.npy"
    np.save(file, waves())
    by_file = asperity.press(file, pixel_size_um=(1, 2), surface={"height_unit": "um"}, **contact)
    by_array = asperity.press(waves(), pixel_size_um=(1, 2), **contact)
    assert by_file.table["contact_area_ratio"][0] == pytest.approx(by_array.table["contact_area_ratio"][0])
    twice: list[tuple[Any, Any, str]] = [
        ({"pixel_size": "1 um"}, file, "leave one out"),
        ({"file": "other.npy"}, file, "given twice"),
        ({"file": "other.npy"}, waves(), "surface.file"),
        ({"height_unit": "um"}, waves(), "surface.height_unit"),
        ({"pixel_size": "1 um"}, waves(), "surface.pixel_size"),
    ]
    for surface, heights, words in twice:
        with pytest.raises(asperity.InputError, match=words):
            asperity.press(heights, pixel_size_um=1.0, surface=surface, **contact)
    with pytest.raises(asperity.InputError, match="pixel_size"):
        asperity.press(waves(), pixel_size=1.0, **contact)  # type: ignore[call-arg]


def test_arguments_of_another_kind_are_named(tmp_path: pathlib.Path) -> None:
    scene: Any = SCENE
    with pytest.raises(asperity.InputError, match="accuracy is 0.05"):
        asperity.crush(scene, accuracy=0.05)  # type: ignore[arg-type]
    asperity.study(scene, {"loading.depth": ["1 um"]}, seed=np.int64(3))  # type: ignore[arg-type]
    for threads in (-1, 1.5):
        with pytest.raises(asperity.InputError, match="threads is"):
            asperity.crush(scene, threads=threads)  # type: ignore[arg-type]
    with pytest.raises(asperity.InputError, match="seed is -1"):
        asperity.study(scene, {"loading.depth": "1 um..2 um"}, sample=("lhs", 2), seed=-1)
    (tmp_path / "file").write_text("")
    with pytest.raises(asperity.InputError, match="name a folder"):
        asperity.crush(scene, out=tmp_path / "file")
    curve = {"depth_um": np.arange(3.0), "force_mN": np.arange(3.0)}
    with pytest.raises(asperity.InputError, match="force_mN"):
        asperity.identify({"material": SCENE["material"], "curve": curve})


def test_threads_change_no_result() -> None:
    scene: Any = SCENE
    one, two = (asperity.crush(scene, accuracy="draft", threads=threads) for threads in (1, 2))
    assert one.summary["peak_force_N"] == two.summary["peak_force_N"]


def test_scenes_go_to_toml_and_back() -> None:
    scene = asperity.Scene(**SCENE)
    again = asperity.Scene.from_toml(scene.to_toml())
    assert again == scene and eval(repr(scene), {"Scene": asperity.Scene}) == scene
    deeper = scene.set("loading.depth", "3 um")
    assert deeper != scene and deeper.tables["loading"]["depth"] == "3 um"
    assert scene.set("asperity[0].slope_deg", np.float64(8.0)).tables["asperity"][0]["slope_deg"] == 8.0


def test_fields_are_arrays_over_a_mesh() -> None:
    fields = {"every": 100, "fields": ["displacement", "von_mises", "plastic_zone"]}
    result = asperity.crush(asperity.Scene(**{**SCENE, "output": fields}))
    assert result.frames >= 1
    frame = result.fields(-1)
    nodes, cells = len(frame.points_um), len(frame.cells)
    assert frame["von_mises_MPa"].shape == (nodes,) and frame["displacement_um"].shape == (nodes, 2)
    assert frame["plastic_zone"].shape == (cells,) and frame.cells.max() == nodes - 1
    assert frame["von_mises_MPa"].max() > 200.0
    for beyond in (result.frames, -99):
        with pytest.raises(asperity.InputError, match=f"kept {result.frames}"):
            result.fields(beyond)
    with pytest.raises(KeyError, match="von_mises_MPa"):
        frame["mises"]
    meshio = pytest.importorskip("meshio")
    assert isinstance(frame.to_meshio(), meshio.Mesh)
    section = result.section_svg()
    assert section is not None and "<svg" in section


def test_a_study_is_a_table(tmp_path: pathlib.Path) -> None:
    vary = {"material.hardening_exponent": np.array([0.1, 0.3]), "loading.depth": "1 um..2 um/2"}
    study = asperity.study(asperity.Scene(**SCENE), vary, out=tmp_path / "study", curves=True)
    assert len(study.results) == 4 and set(study.results["status"]) == {"ok"}
    assert study.varied("loading.depth").tolist() == [1.0, 2.0, 1.0, 2.0]
    alone = asperity.crush(asperity.Scene(**SCENE).set("material.hardening_exponent", 0.3))
    assert study.results["peak_force_N"][3] == alone.summary["peak_force_N"]
    assert (tmp_path / "study" / str(study.results["curve"][3])).is_file()
    assert study.picture is not None and "<svg" in study.picture
    # found in the folder, not run again
    told: list[str] = []
    asperity.study(
        asperity.Scene(**SCENE),
        vary,
        out=tmp_path / "study",
        curves=True,
        progress=lambda _, text: told.append(text),
    )
    drawn = asperity.study(
        asperity.Scene(**SCENE), {"loading.depth": "0.5 um..1 um"}, sample=("sobol", 2), threads=1
    )
    assert drawn.varied("loading.depth").tolist() == [0.5, 0.75]
    pandas = pytest.importorskip("pandas")
    assert isinstance(study.to_dataframe(), pandas.DataFrame)


def test_a_surface_is_varied_too() -> None:
    scene = asperity.RoughScene(
        closure="sneddon", surface={"level": "none"}, material=STEEL, load={"pressure": "20 MPa"}
    )
    vary = {"load.pressure": ["20 MPa", "50 MPa"]}
    study = asperity.study(scene, vary, heights=waves(), pixel_size_um=(1.0, 2.0))
    ratio = study.results["contact_area_ratio"]
    assert ratio[1] > ratio[0] > 0.0
    assert study.results["load_error"].max() < 1e-6


def test_a_sweep_is_fitted_or_says_why() -> None:
    swept = asperity.calibrate(
        slopes_deg=[8.0], youngs_modulus=["210 GPa"], yield_stress=["200 MPa", "800 MPa"],
        hardening_exponent=[0.1], accuracy="draft",
    )  # fmt: skip
    assert len(swept.cases) == 2 and (swept.cases["K_over_E"] > 0).all()
    assert swept.fit["coefficient"] is None and swept.fit["reason"]
    with pytest.raises(asperity.InputError, match="slopes_deg"):
        asperity.calibrate(slopes_deg=[60.0])


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
def test_ctrl_c_ends_a_run() -> None:
    # a shell makes its background jobs ignore the signal, and Python then leaves it ignored
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    # a run that is long enough on a machine that has much else to do
    scene = asperity.Scene(**SCENE).set("numerics.elements_in_contact", 150).set("loading.depth", "15 um")
    begun, shares = threading.Event(), [0.0]

    def follow(share: float, _: str) -> None:
        shares.append(share)
        begun.set()

    def press_ctrl_c() -> None:
        # by progress, not by the clock: a run of a fast machine is over before a second is
        if begun.wait(60.0):
            os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=press_ctrl_c).start()
    try:
        with pytest.raises(KeyboardInterrupt):
            asperity.crush(scene, progress=follow)
    finally:
        signal.signal(signal.SIGINT, before)
    assert shares[-1] < 0.9


def test_an_exception_carries_what_was_reached(tmp_path: pathlib.Path) -> None:
    def enough(share: float, _: str) -> None:
        if share > 0.3:
            raise RuntimeError("enough")

    scene = asperity.Scene(**SCENE).set("accuracy", "standard")
    with pytest.raises(RuntimeError, match="enough") as ended:
        asperity.crush(scene, progress=enough, out=tmp_path / "out")
    partial = ended.value.__dict__["partial"]
    assert isinstance(partial, asperity.Crush)
    assert 2 < len(partial.curve) and 0.0 < partial.curve["depth_um"][-1] < 2.0
    assert "stopped" in partial.summary
    assert column(tmp_path / "out/curve.csv", "force_N") == partial.curve["force_N"].tolist()
    # an exception before the run began carries nothing
    with pytest.raises(asperity.InputError) as refused:
        asperity.crush(scene, accuracy="perfect")
    assert not hasattr(refused.value, "partial")


def test_reports_are_those_of_the_command(tmp_path: pathlib.Path) -> None:
    scene = asperity.Scene(**SCENE)
    (tmp_path / "scene.toml").write_text(scene.to_toml())
    result = asperity.crush(scene)
    assert (
        asperity.crush(tmp_path / "scene.toml").curve["force_N"].tolist() == result.curve["force_N"].tolist()
    )
    page = result.report(tmp_path / "report.html")
    assert page == (tmp_path / "report.html").read_text(encoding="utf-8")
    peak = f'value="{result.summary["peak_force_N"]!r}" data-place="/peak_force_N"'
    assert peak in page and page == result.report()
    # the light form of a notebook is not the page
    assert len(result._repr_svg_()) < len(page) / 2
    command(tmp_path, "crush", "scene.toml", "--out", "out", "--report")
    assert peak in (tmp_path / "out/report.html").read_text(encoding="utf-8")
    rough = asperity.press(
        waves(), pixel_size_um=(1.0, 2.0), closure="sneddon", material=STEEL, load={"pressure": "50 MPa"}
    )
    assert 'data-place="/closures/0/contact_area_ratio"' in rough.report()
    assert "<svg" not in rough._repr_html_()


def test_asperities_are_taken_and_crushed(tmp_path: pathlib.Path) -> None:
    tables: dict[str, Any] = {"material": STEEL, "load": {"pressure": "50 MPa"}, "closure": "all"}
    # hills of the egg box that no edge cuts
    found = asperity.extract(
        np.roll(waves(), (16, 24), axis=(0, 1)), pixel_size_um=(1.0, 1.0), share=0.2, accuracy="draft", profiles=2,
        **tables,
    )  # fmt: skip
    assert len(found.asperities) >= 2 and found.compared is None
    assert found.summary["profiles"] == len(found.scenes) == 2
    scene = next(iter(found.scenes.values()))
    # its profile stands in it: nothing on disk is needed any more
    assert asperity.crush(scene.set("accuracy", "draft")).summary["peak_force_N"] > 0.0
    kept = asperity.extract(
        np.roll(waves(), (16, 24), axis=(0, 1)), pixel_size_um=(1.0, 1.0), share=0.2, accuracy="draft", crush=1,
        out=tmp_path / "taken", **tables,
    )  # fmt: skip
    assert kept.compared is not None and (tmp_path / "taken/compared.csv").exists()
    ratio = kept.compared["force_over_finite_elements"][kept.compared["closure"] == "finite-elements"]
    assert np.allclose(ratio, 1.0)
    assert "published" in kept.compared["closure"]
    np.save(tmp_path / "box.npy", np.roll(waves(), (16, 24), axis=(0, 1)))
    of_file = asperity.extract(
        tmp_path / "box.npy", share=0.2, accuracy="draft", profiles=2, material=STEEL,
        load={"pressure": "50 MPa"}, closure="all", surface={"pixel_size": ["1 um", "1 um"], "height_unit": "um"},
    )  # fmt: skip
    assert len(of_file.scenes) == 2 and len(of_file.asperities) == len(found.asperities)
    at_load = asperity.extract(
        waves(), pixel_size_um=(1.0, 1.0), plane_of="sneddon", accuracy="draft", profiles=1, **tables
    )
    assert len(at_load.scenes) == 1
    with pytest.raises(asperity.InputError, match="exclude"):
        asperity.extract(waves(), pixel_size_um=(1.0, 1.0), share=0.2, hills=0.1, **tables)
    with pytest.raises(asperity.InputError, match="depth"):
        asperity.extract(waves(), pixel_size_um=(1.0, 1.0), depth="deep", **tables)


def test_progress_is_told_and_python_runs_on() -> None:
    shares: list[float] = []
    counted, ended = [0], threading.Event()

    def count() -> None:
        while not ended.is_set():
            counted[0] += 1
            time.sleep(0.001)

    beside = threading.Thread(target=count)
    beside.start()
    # one run: another round would begin anew
    scene = asperity.Scene(**SCENE).set("accuracy", "standard").set("numerics.refine", False)
    before = counted[0]
    asperity.crush(scene, progress=lambda share, _: shares.append(share))
    after = counted[0]
    ended.set()
    beside.join()
    assert shares and all(0.0 <= share <= 1.0 for share in shares) and shares == sorted(shares)
    assert after - before > 10

    def refuse(_share: float, _text: str) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        asperity.crush(scene, progress=refuse)


def test_a_metal_is_identified_from_two_cones(tmp_path: pathlib.Path) -> None:
    cone: CurveTable = {
        "features": {"loading_curvature": "13.602 GPa"},
        "noise": "2 %",
        "tool": {"shape": "cone", "half_apex_deg": 60},
    }
    fit: FitTable = {
        "accuracy": "draft",
        "samples": 50,
        "material": {
            "youngs_modulus": "50 GPa",
            "poissons_ratio": 0.3,
            "yield_stress": ["20 MPa", "2 GPa"],
            "hardening_exponent": [0.0, 0.5],
            "hardening_law": "swift",
        },
        "curve": [cone],
    }
    found = asperity.identify(fit, out=tmp_path)
    stress = found.parameters["yield_stress"]
    assert stress["low"] <= stress["value"] <= stress["high"] and not stress["identifiable"]
    assert "not identifiable" in found.verdict and len(found.samples) == 50
    assert json.loads((tmp_path / "fit.json").read_text())["parameters"] == found.parameters
    with pytest.raises(asperity.InputError, match="yield_stress"):
        asperity.identify({**fit, "material": {**fit["material"], "yield_stress": ["2 GPa", "1 GPa"]}})


def test_the_scripts_of_the_front_page_run(tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    pytest.importorskip("pandas")
    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    text = (pathlib.Path(__file__).parents[1] / "README.md").read_text()
    blocks = [block.split("```")[0] for block in text.split("```python\n")[1:]]
    assert len(blocks[0].splitlines()) <= 15
    scope: dict[str, Any] = {}
    for block in blocks:
        exec(block, scope)
    assert (tmp_path / "both.png").stat().st_size > 10_000
    front_page = (pathlib.Path(__file__).parents[2] / "README.md").read_text().split("```python\n")
    assert len(front_page) == 2
    exec(front_page[1].split("```")[0], scope)
    assert 0 < scope["ball"].summary["estimated_error"] < 0.05
    assert len(scope["study"].results) == 12 and set(scope["study"].results["status"]) == {"ok"}
    # the arrays of a ball's curve give its metal back
    found = scope["found"].parameters["yield_stress"]
    assert found["low"] < 200.0 < found["high"] and found["high"] < 1.2 * found["low"], found


def test_doubts_are_told_as_warnings() -> None:
    deep: Any = {**SCENE, "loading": {"depth": "20 um"}}
    with pytest.warns(UserWarning, match="contact area"):
        result = asperity.crush(deep)
    assert result.warnings


def test_a_wrong_name_is_told_those_like_it_and_a_wrong_scene_where_it_goes() -> None:
    result = asperity.crush(asperity.Scene(**SCENE))
    with pytest.raises(KeyError, match="peak_force_N"):
        result.summary["peak_force"]
    rough = asperity.RoughScene(material=STEEL, closure="johnson", surface={}, load={"pressure": "50 MPa"})
    with pytest.raises(asperity.InputError, match="press"):
        asperity.crush(rough)  # type: ignore[arg-type]
    with pytest.raises(asperity.InputError, match="crush"):
        asperity.press(asperity.Scene(**SCENE))
    wrong: FitTable = {"material": SCENE["material"], "curve": [{"depth_um": [0, 1], "force_N": [0]}]}
    with pytest.raises(asperity.InputError, match="go together"):
        asperity.identify(wrong)


def test_a_study_takes_the_tables_of_a_scene() -> None:
    tables: Any = SCENE
    study = asperity.study(tables, {"loading.depth": ["1 um", "2 um"]})
    assert list(study.results["status"]) == ["ok", "ok"]


def test_a_joint_is_a_table_with_its_errors_and_the_files_of_the_command(tmp_path: pathlib.Path) -> None:
    tables: dict[str, Any] = {
        "material": {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3},
        "surface": {"periodic": True, "level": "mean"},
        "load": {"pressure": "50 MPa"},
        "thermal": {"conductivity": ["50 W/(m K)", "50 W/(m K)"]},
        "joint": {"loads": 9},
    }
    joint = asperity.joint(waves(), pixel_size_um=(1.0, 2.0), out=tmp_path / "joint", **tables)
    pressures = joint.table["pressure_MPa"]
    loading = np.array([phase == "load" for phase in joint.table["phase"]]) & (pressures > 0)
    assert loading.sum() == 9 and pressures.max() == pytest.approx(50.0, rel=1e-6)
    # conductance is k S/E*
    expected = 50.0 * joint.table["elastic_stiffness_MPa_per_um"] * 1e6 / joint.summary["reduced_modulus_MPa"]
    assert joint.table["conductance_W_per_m2K"][loading] == pytest.approx(expected[loading], rel=1e-9)
    assert (np.diff(joint.law["approach_um"]) > 0).all()
    assert (tmp_path / "joint" / "calculix.inp").exists() and "<html" in joint.report()
    twice = asperity.joint([waves(), waves()], pixel_size_um=(1.0, 2.0), **tables)
    assert twice.table["repeatability"][loading] == pytest.approx(0.0, abs=1e-9)
    with pytest.raises(asperity.InputError, match="of one size"):
        asperity.joint([waves(), waves()[:32]], pixel_size_um=(1.0, 2.0), **tables)


def test_scales_are_a_row_a_cutoff_and_closure_with_verdicts(tmp_path: pathlib.Path) -> None:
    tables: dict[str, Any] = {
        "material": {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "yield_stress": "800 MPa"},
        "surface": {"periodic": True, "level": "mean"},
        "load": {"pressure": "50 MPa"},
    }
    found = asperity.scales(waves(), pixel_size_um=(1.0, 2.0), out=tmp_path / "scales", **tables)
    elastic = np.array([closure == "half-space" for closure in found.table["closure"]])
    load = found.table["contact_area_ratio"] * found.table["mean_pressure_MPa"]
    assert load[elastic] == pytest.approx(50.0, rel=1e-3)
    assert elastic.sum() == len(found.slopes["cutoff_um"])
    assert (np.diff(found.slopes["rms_slope"]) > 0).all()
    classes = {"converged", "converging", "not converging", "map too small"}
    assert {verdict["class"] for verdict in found.verdicts.values()} <= classes
    assert (tmp_path / "scales" / "scales.csv").exists() and "<html" in found.report()
    with pytest.raises(asperity.InputError, match="repetition"):
        asperity.scales([waves(), waves()[:32]], pixel_size_um=(1.0, 2.0), **tables)
