//! A scene of `asperity rough` with the files that it names.

use crate::batch::journal::fingerprint;
use crate::error::InputError;
use crate::input::RELATIVE_PATH_NOTE;
use crate::input::missing_file::unreadable;
use crate::input::toml_file::{LARGEST_FILE, TomlFile, to_toml};
use asperity_formats::memory::read_file;
use asperity_formats::surface::{Measured, Spacing};
use asperity_material::HardeningLaw;
use asperity_roughness::scene::{Choice, LoadScene, OwnClosure, Scene, SceneError};
use asperity_roughness::{Closure, Coefficient, IslandClosure, Surface};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A rough surface, its material and its load, with the place that its paths are relative to.
#[derive(Debug)]
pub struct RoughScene {
    scene: Scene,
    /// The text that it was read from, for errors that point at a line.
    source: Option<TomlFile<Scene>>,
    base: PathBuf,
}

impl RoughScene {
    /// Reads the file at `path` and applies overrides `key.path=value` in their order.
    ///
    /// # Errors
    /// A file that cannot be read or is no scene, pointing at the line.
    pub fn read(path: &Path, overrides: &[String]) -> Result<RoughScene, InputError> {
        TomlFile::read(path, overrides).map(RoughScene::of_file)
    }

    /// Reads TOML text; its paths are relative to the folder `base`.
    ///
    /// # Errors
    /// A text that is no scene, pointing at the line.
    pub fn from_toml(text: &str, base: &Path) -> Result<RoughScene, InputError> {
        let file = TomlFile::parse(&base.join("scene"), text.into(), &[])?;
        Ok(RoughScene::of_file(file))
    }

    /// The surface of the file at `path` with metal, load and all else of the scene `like`, then overrides
    /// `key.path=value`. Of a generated surface's scene the file is levelled by its own default.
    ///
    /// # Errors
    /// A path that is no text, an override that names no key or a value of another kind.
    pub fn of_map(path: &Path, like: &RoughScene, overrides: &[String]) -> Result<RoughScene, InputError> {
        if let Err(e) = std::fs::metadata(path) {
            let help = "give a map of heights (.sur, .x3p, .sdf, .al3d, .gwy, .gsf, .npy, .csv, .txt, .xyz) or a scene of `asperity rough` (.toml)";
            let told = unreadable(path, &e);
            return Err(if told.help.is_some() { told } else { told.help(help) });
        }
        let mut scene = like.scene.clone();
        let surface = &mut scene.surface;
        (surface.generate, surface.heights) = (None, None);
        surface.file = path.file_name().map(PathBuf::from);
        if surface.file.as_ref().is_none_or(|name| name.to_str().is_none()) {
            let message = format!("{} does not end with the name of a file that is text", path.display());
            return Err(InputError::new(message).help("name a file of heights or a scene"));
        }
        if let Some(file) = &scene.coefficient {
            let known = like.resolve(file);
            scene.coefficient = Some(std::path::absolute(&known).unwrap_or(known));
        }
        let text = to_toml(&RoughScene::plain(&scene)).map_err(InputError::new)?;
        let file = TomlFile::parse(&path.with_extension(""), text, overrides)?;
        let mut read = RoughScene::of_file(file.called(format!("scene of {}", path.display())));
        if scene.custom.is_some() {
            (read.scene.closure, read.scene.custom) = (scene.closure, scene.custom);
        }
        Ok(read)
    }

    /// The scene that stands for what is not said: metal, load and treatment of the surface as `asperity new
    /// surface` writes them.
    ///
    /// # Errors
    /// None: the text comes with the program.
    pub fn usual() -> Result<RoughScene, InputError> {
        RoughScene::from_toml(crate::scenes::SURFACE, Path::new(""))
    }

    /// The same for a joint: the whole of the map under no load of its own, so that the metal says where the
    /// joint ends.
    ///
    /// # Errors
    /// As for [`RoughScene::usual`].
    pub fn usual_joint() -> Result<RoughScene, InputError> {
        let mut usual = RoughScene::usual()?;
        (usual.scene.closure, usual.scene.load) = (Choice::HalfSpacePlastic, LoadScene::default());
        Ok(usual)
    }

    /// A scene built in code; its paths are relative to the folder `base`.
    pub fn new(scene: Scene, base: &Path) -> RoughScene {
        RoughScene { scene, source: None, base: base.into() }
    }

    fn of_file(file: TomlFile<Scene>) -> RoughScene {
        RoughScene { scene: file.value.clone(), base: file.resolve(Path::new("")), source: Some(file) }
    }

    /// The same scene with the surface of these heights (m) in place of its own, row by row, `columns` to a
    /// row, NaN where nothing was measured; `pixel` is the distance of the points along x and y (m).
    #[must_use]
    pub fn with_heights(mut self, columns: usize, pixel: [f64; 2], heights: Vec<f64>) -> RoughScene {
        let rows = heights.len() / columns.max(1);
        let (spacing, height_unit) = (Spacing::Metres(pixel), Some(1.0));
        let surface = &mut self.scene.surface;
        (surface.file, surface.generate) = (None, None);
        surface.heights = Some(Measured {
            columns,
            rows,
            heights,
            spacing,
            spacing_error: 0.0,
            height_unit,
            notes: Vec::new(),
        });
        self
    }

    /// The same scene with a closure of another crate in place of its own.
    #[must_use]
    pub fn with_closure(mut self, closure: Arc<dyn IslandClosure>) -> RoughScene {
        (self.scene.closure, self.scene.custom) = (Choice::Custom, Some(OwnClosure::new(closure)));
        self
    }

    /// The tables as a file can hold them: without a closure of another crate.
    fn plain(scene: &Scene) -> Scene {
        let closure = if scene.custom.is_some() { Choice::Published } else { scene.closure };
        Scene { closure, custom: None, ..scene.clone() }
    }

    /// The scene with more overrides `key.path=value`, such as `load.pressure=100 MPa`; heights in memory
    /// stay.
    ///
    /// # Errors
    /// An override that names no key, or a value of another kind.
    pub fn with(&self, overrides: &[String]) -> Result<RoughScene, InputError> {
        let file = match &self.source {
            Some(file) => file.with(overrides)?,
            None => {
                let text = to_toml(&RoughScene::plain(&self.scene)).map_err(InputError::new)?;
                TomlFile::parse(&self.base.join("scene"), text, overrides)?
            }
        };
        let mut scene = RoughScene::of_file(file);
        if let Some(own) = &self.scene.custom {
            (scene.scene.closure, scene.scene.custom) = (Choice::Custom, Some(own.clone()));
        }
        if let Some(heights) = &self.scene.surface.heights {
            let surface = &mut scene.scene.surface;
            (surface.file, surface.generate, surface.heights) = (None, None, Some(heights.clone()));
        }
        Ok(scene)
    }

    /// A number for the heights in memory; 0 where there are none.
    pub(crate) fn heights_mark(&self) -> u64 {
        let Some(surface) = &self.scene.surface.heights else { return 0 };
        let bits = surface.heights.iter().flat_map(|z| z.to_le_bytes());
        fingerprint(bits.collect::<Vec<u8>>())
            ^ fingerprint(format!("{} {:?}", surface.columns, surface.spacing))
    }

    /// Every value of the scene.
    pub fn tables(&self) -> &Scene {
        &self.scene
    }

    /// Checks every value that can be checked without reading the surface.
    ///
    /// # Errors
    /// The first value that makes no sense, pointing at its line where there is one.
    pub fn validate(&self) -> Result<(), InputError> {
        self.scene.validate().map_err(|e| self.error(&e))
    }

    /// The surface as it is pressed: read or generated, levelled and filtered.
    ///
    /// # Errors
    /// A surface that cannot be read or makes no sense, pointing at its line where there is one.
    pub(crate) fn prepare_surface(&self) -> Result<Surface, InputError> {
        self.scene.surface.prepare(|path| self.resolve(path)).map_err(|e| self.error(&e))
    }

    /// Name of the scene: that of its file without extension.
    pub fn name(&self) -> String {
        self.source.as_ref().map_or_else(|| "surface".into(), TomlFile::stem)
    }

    /// Name of the surface in tables: the kind it is generated as, or the name of its file.
    pub(crate) fn surface_name(&self) -> String {
        let surface = &self.scene.surface;
        match (&surface.file, &surface.generate) {
            (Some(path), _) => {
                path.file_stem().map_or_else(|| "surface".into(), |s| s.to_string_lossy().into_owned())
            }
            (None, Some(made)) => made.kind.name().into(),
            (None, None) => self.name(),
        }
    }

    /// A path of the scene as one that can be opened.
    pub(crate) fn resolve(&self, path: &Path) -> PathBuf {
        self.base.join(path)
    }

    pub(crate) fn error(&self, error: &SceneError) -> InputError {
        match &self.source {
            Some(file) => file.error_at(&error.path, &error.message),
            None => InputError::new(error.to_string()),
        }
    }

    /// The calibration that the scene names, or the one that comes with the program; `None` where no closure
    /// needs it.
    pub(crate) fn coefficient(&self) -> Result<Option<Coefficient>, InputError> {
        self.coefficient_of(&self.scene.closure.closures())
    }

    /// The same for these closures.
    pub(crate) fn coefficient_of(&self, closures: &[Closure]) -> Result<Option<Coefficient>, InputError> {
        if !closures.iter().any(|closure| closure.takes_calibration()) {
            return Ok(None);
        }
        self.calibration().map(Some)
    }

    /// The law of hardening of the metal: by default that of the calibration. Metal without an exponent has
    /// none, and any serves.
    ///
    /// # Errors
    /// A calibration that cannot be read.
    pub(crate) fn hardening_law(&self) -> Result<HardeningLaw, InputError> {
        let material = &self.scene.material;
        match material.hardening_law {
            Some(law) => Ok(law),
            None if material.hardness.is_some() || material.hardening_exponent.is_none() => {
                Ok(HardeningLaw::Hollomon)
            }
            None => Ok(self.calibration()?.law),
        }
    }

    /// The calibration that the scene names, or the one that comes with the program.
    pub(crate) fn calibration(&self) -> Result<Coefficient, InputError> {
        let error = |key: &str, message: String| self.error(&SceneError::new(key, message));
        let Some(path) = &self.scene.coefficient else {
            let refused = |e| error("closure", format!("the calibration of this program: {e}"));
            return Coefficient::committed().map_err(refused);
        };
        let path = self.resolve(path);
        let bytes = read_file(&path, LARGEST_FILE, "the limit of a calibration").map_err(|e| {
            error("coefficient", format!("{}: cannot be read: {e}; {RELATIVE_PATH_NOTE}", path.display()))
        })?;
        Coefficient::from_toml(&String::from_utf8_lossy(&bytes))
            .map_err(|e| error("coefficient", format!("{}: {e}", path.display())))
    }
}
