//! A scene: the tables that say what to crush, checked, with the files they name and the text they stand in.

use crate::error::{Error, InputError};
use crate::input::toml_file::{TomlFile, read_text, to_toml};
use crate::input::{RELATIVE_PATH_NOTE, hardening_file, profile_file};
use crate::results::crush_summary::Summary;
use asperity_formats::memory::read_file;
use asperity_material::{FlowCurve, OwnLaw};
use asperity_mesh::{Mesh, OwnTool, ToolOutline, read_msh};
use asperity_simulation::scene::{
    Asperity, EarlierLoad, HardeningChoice, Initial, Lateral, LineProfile, Material, MeshFile, Numerics,
    Scene as Tables, SceneError, Substrate, Symmetry, ToolShape,
};
use asperity_simulation::setup::discretisation::Discretisation;
use serde::Serialize;
use std::path::Path;
use std::sync::Arc;

/// A scene that makes sense, with the mesh and the hardening table that it names, ready to be crushed.
///
/// It is read from a file ([`Scene::read`]) or a text ([`Scene::from_toml`]), or made of tables that were
/// built in code ([`Scene::new`]). Later errors point at its text.
#[derive(Debug)]
pub struct Scene {
    file: TomlFile<Tables>,
    mesh: Option<Mesh>,
    own: Own,
    understood: Vec<String>,
}

/// The parts that a program hands in beside the text of a scene, which cannot hold them.
#[derive(Clone, Debug, Default)]
struct Own {
    law: Option<OwnLaw>,
    tool: Option<OwnTool>,
}

impl Own {
    /// Its part of `tables`, removed from them.
    fn taken_from(tables: &mut Tables) -> Own {
        let own = Own { law: tables.material.custom.take(), tool: tables.tool.custom.take() };
        if own.law.is_some() {
            tables.material.hardening_law = HardeningChoice::Hollomon;
        }
        if own.tool.is_some() {
            tables.tool.shape = ToolShape::Plane;
        }
        own
    }

    /// Puts it into `tables`.
    fn put_into(&self, tables: &mut Tables) {
        if let Some(law) = &self.law {
            let material = &mut tables.material;
            (material.hardening_law, material.custom) = (HardeningChoice::Custom, Some(law.clone()));
        }
        if let Some(tool) = &self.tool {
            (tables.tool.shape, tables.tool.custom) = (ToolShape::Custom, Some(tool.clone()));
        }
    }
}

impl Scene {
    /// A scene of tables that were built in code; the files that they name are relative to the working
    /// directory.
    ///
    /// # Errors
    /// Values that make no sense, with the allowed range; a mesh or hardening table that cannot be read.
    ///
    /// # Examples
    /// A cone of steel under a plane:
    /// ```
    /// use asperity::tables::{Asperity, Loading, Material, Scene as Tables, Symmetry, Tool, ToolForce};
    /// use asperity::{Force, Length, Scene, Stress};
    ///
    /// let steel = Material::elastic_body(Stress(210e9), 0.3).yielding(Stress(300e6), 0.3);
    /// let tables = Tables::new(Symmetry::Axisymmetric, steel, Tool::plane(), Loading::to_depth(Length(5e-6)));
    /// assert!(Scene::new(&tables).unwrap_err().to_string().contains("at least one [[asperity]]"));
    ///
    /// let cone = Asperity::cone(Length(20e-6), 10.0).rounded(Length(10e-6));
    /// let to_depth = tables.with(cone);
    /// assert!(Scene::new(&to_depth).is_ok());
    /// let to_force = Tables { loading: Loading::to_force(ToolForce::Total(Force(4.0))), ..to_depth };
    /// assert!(Scene::new(&to_force).is_ok());
    /// ```
    pub fn new(tables: &Tables) -> Result<Scene, Error> {
        let mut tables = tables.clone();
        let own = Own::taken_from(&mut tables);
        let text = to_toml(&tables).map_err(InputError::new)?;
        Scene::checked(TomlFile::parse_over(Path::new("scene"), text, &[], Some(body_of))?, own)
    }

    /// The scene with a hardening law of another crate, in place of a law by keys.
    ///
    /// # Errors
    /// Keys of another law, a law that falls or begins beyond the range of yield stresses.
    pub fn with_law(self, law: Arc<dyn FlowCurve>) -> Result<Scene, Error> {
        let own = Own { law: Some(OwnLaw::new(law)), ..self.own };
        Scene::checked(self.file.with(&[])?, own)
    }

    /// The scene with a tool of another crate, in place of a shape by keys.
    ///
    /// # Errors
    /// Keys of another shape, and what else makes no sense with the tool.
    pub fn with_tool(self, outline: Arc<dyn ToolOutline>) -> Result<Scene, Error> {
        let own = Own { tool: Some(OwnTool::new(outline)), ..self.own };
        Scene::checked(self.file.with(&[])?, own)
    }

    /// The scene that `text` says in TOML; the files that it names are relative to the folder `base`.
    ///
    /// # Errors
    /// A text that is no scene or makes no sense, pointing at its line; a mesh or hardening table that cannot
    /// be read.
    pub fn from_toml(text: &str, base: &Path) -> Result<Scene, Error> {
        let file = TomlFile::parse_over(&base.join("scene"), text.into(), &[], Some(body_of))?;
        Scene::checked(file, Own::default())
    }

    /// The scene of the file at `path`, with overrides `key.path=value` in their order; the files that it
    /// names are relative to its folder. `-` is standard input; a `summary.json` of an earlier run gives the
    /// scene of that run.
    ///
    /// # Errors
    /// As for [`Scene::from_toml`], and a file that cannot be read.
    pub fn read(path: &Path, overrides: &[String]) -> Result<Scene, Error> {
        if path.extension().is_some_and(|extension| extension == "json") {
            let text = to_toml(&as_asked(Summary::read(path)?)).map_err(InputError::new)?;
            return Scene::checked(
                TomlFile::parse_over(path, text, overrides, Some(body_of))?,
                Own::default(),
            );
        }
        Scene::checked(
            TomlFile::parse_over(path, read_text(path)?, overrides, Some(body_of))?,
            Own::default(),
        )
    }

    /// The scene with more overrides `key.path=value`, such as `loading.depth=2 um`.
    ///
    /// # Errors
    /// As for [`Scene::from_toml`], pointing at the override where it is wrong.
    pub fn with(&self, overrides: &[String]) -> Result<Scene, Error> {
        Scene::checked(self.file.with(overrides)?, self.own.clone())
    }

    /// Sets the value at `key`, such as `loading.depth` or `asperity[0].slope_deg`; the scene stays as it was
    /// where that makes no sense.
    ///
    /// # Errors
    /// As for [`Scene::with`].
    pub fn set(&mut self, key: &str, value: &str) -> Result<(), Error> {
        *self = self.with(&[format!("{key}={value}")])?;
        Ok(())
    }

    fn checked(mut file: TomlFile<Tables>, own: Own) -> Result<Scene, Error> {
        own.put_into(&mut file.value);
        let curve = hardening_file::read(&file)?;
        if let Some(curve) = &curve {
            curve.put_into(&mut file.value.material);
        }
        let outlines = profile_file::read(&mut file)?;
        let understood = curve.iter().map(hardening_file::ReadCurve::understood);
        let understood =
            understood.chain(outlines.iter().map(profile_file::ReadProfile::understood)).collect();
        // what is wrong with a table shows in the file that holds it
        file.value.validate().map_err(|e| {
            let shown = curve.and_then(|curve| curve.point_at(&file, &e));
            let shown = shown.or_else(|| outlines.iter().find_map(|outline| outline.point_at(&file, &e)));
            shown.unwrap_or_else(|| file.error_at(&e.path, &e.message))
        })?;
        let mesh = read_mesh(&file)?;
        Ok(Scene { file, mesh, own, understood })
    }

    /// One line on what was understood of each table and outline that the scene names.
    pub fn understood(&self) -> &[String] {
        &self.understood
    }

    /// The tables of the scene, in SI, tables of hardening and outlines in the place of their files.
    pub fn tables(&self) -> &Tables {
        &self.file.value
    }

    /// The tables with the numbers that the accuracy stands for.
    pub fn resolved(&self) -> Tables {
        let tables = self.tables();
        Tables { numerics: Discretisation::new(tables).numerics(), ..tables.clone() }
    }

    /// The mesh that the scene names, in metres, its highest point at height 0; `None` if it is to be built.
    pub fn mesh(&self) -> Option<&Mesh> {
        self.mesh.as_ref()
    }

    /// A path of the scene as one that can be opened.
    pub fn resolve(&self, path: &Path) -> std::path::PathBuf {
        self.file.resolve(path)
    }

    /// Name of the file without its extension; `scene` where there is none.
    pub fn name(&self) -> String {
        self.file.stem()
    }

    /// The scene as a file, in SI units.
    ///
    /// # Errors
    /// None that is known: what was read can be written.
    pub fn to_toml(&self) -> Result<String, Error> {
        to_toml(self.tables()).map_err(Error::Unfinished)
    }

    /// An error about a value of the scene, pointing at its line.
    pub fn error(&self, error: &SceneError) -> InputError {
        self.file.error_at(&error.path, &error.message)
    }
}

/// The tables of a body that was loaded before, as TOML: those of the result at `path`, with its loads.
fn body_of(path: &Path) -> Result<String, String> {
    let path = if path.extension().is_some_and(|extension| extension == "json") {
        path.to_path_buf()
    } else {
        path.join("summary.json")
    };
    let refuse = |reason: String| format!("{reason}; name the folder of a finished `asperity crush`");
    let summary = Summary::read(&path).map_err(|e| refuse(e.to_string()))?;
    if let Some(stopped) = summary.stopped {
        return Err(refuse(format!("{}: that run {stopped}", path.display())));
    }
    // a resolved scene refers to no other result: this comes to an end
    let scene = Scene::read(&path, &[]).map_err(|e| refuse(e.to_string()))?;
    let Tables {
        symmetry,
        lateral,
        material,
        asperity,
        profile,
        substrate,
        tool,
        loading,
        initial,
        mesh,
        ..
    } = scene.tables().clone();
    let mut load = initial.map_or_else(Vec::new, |initial| initial.load);
    load.push(EarlierLoad { tool, loading });
    let initial = Initial { from: None, load };
    let mesh = mesh.map(|mesh| MeshFile { file: scene.resolve(&mesh.file), ..mesh });
    to_toml(&Body { symmetry, lateral, initial, material, asperity, profile, substrate, mesh })
        .map_err(refuse)
}

/// The keys of a scene that describe its body; in a file, tables come after values.
#[derive(Serialize)]
struct Body {
    symmetry: Symmetry,
    lateral: Lateral,
    initial: Initial,
    material: Material,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    asperity: Vec<Asperity>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    profile: Vec<LineProfile>,
    #[serde(skip_serializing_if = "Option::is_none")]
    substrate: Option<Substrate>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mesh: Option<MeshFile>,
}

/// The scene of a run as it was asked for: numbers that follow from its accuracy are left to it again, so
/// that another one can be set.
fn as_asked(summary: Summary) -> Tables {
    let scene = *summary.scene;
    let open = Tables { numerics: Numerics::default(), ..scene.clone() };
    if Discretisation::new(&open).numerics() == scene.numerics { open } else { scene }
}

/// Bytes of the largest mesh file: some two million cells, more than a run can solve.
const LARGEST_MESH_FILE: u64 = 256 << 20;

/// The mesh that the scene names, in metres, its highest point at height 0; `None` if it is to be built.
fn read_mesh(file: &TomlFile<Tables>) -> Result<Option<Mesh>, InputError> {
    let Some(named) = &file.value.mesh else { return Ok(None) };
    let path = file.resolve(&named.file);
    let error = |reason: String| {
        file.error_at("mesh.file", &format!("{}: {reason}", path.display()))
            .help("a mesh is a Gmsh MSH 4.1 ASCII file of quadrangles with physical curves axis, base, surface, outer")
    };
    let bytes = read_file(&path, LARGEST_MESH_FILE, "the limit of a mesh")
        .map_err(|e| error(format!("cannot be read: {e}; {RELATIVE_PATH_NOTE}")))?;
    let mut mesh = read_msh(&bytes).map_err(|e| error(e.to_string()))?;
    let scale = named.unit.map_or(1.0, |unit| unit.0);
    let summit = mesh.nodes.iter().map(|node| node[1]).fold(f64::NEG_INFINITY, f64::max);
    for [r, z] in &mut mesh.nodes {
        (*r, *z) = (*r * scale, (*z - summit) * scale);
    }
    Ok(Some(mesh))
}
