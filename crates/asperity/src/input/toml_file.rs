//! Reading a TOML file into a type, with `--set` on top and errors that point at the line.

use crate::error::InputError;
use crate::input::missing_file::unreadable;
use crate::input::{kind, suggest};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue, Deserializer};

/// No scene is larger; a device that never ends is refused too.
pub(crate) const LARGEST_FILE: u64 = 16 << 20;

/// A file that was read, with what is needed to point at its lines later.
#[derive(Debug)]
pub struct TomlFile<T> {
    /// Its content, overrides applied.
    pub value: T,
    path: PathBuf,
    sources: Sources,
    under: Option<Under>,
}

/// The TOML text of the tables that lie under those of a file at this path: see [`TomlFile::parse_over`].
pub type Under = fn(&Path) -> Result<String, String>;

/// Key whose file gives what lies under the others, and the table that is joined with its own.
const UNDER_KEY: (&str, &str) = ("initial", "from");

impl<T: DeserializeOwned> TomlFile<T> {
    /// Reads `path`, applies overrides `key.path=value` in their order, and makes a `T` of the result.
    ///
    /// # Errors
    /// A file that cannot be read, is not text or not TOML, an override that names no place, or values that
    /// are not those of a `T`; each with its line and, for an unknown key, the nearest known one.
    pub fn read(path: &Path, overrides: &[String]) -> Result<Self, InputError> {
        TomlFile::parse(path, read_text(path)?, overrides)
    }

    /// The same of a `text` that stands for the file at `path`.
    ///
    /// # Errors
    /// As for [`TomlFile::read`].
    pub fn parse(path: &Path, text: String, overrides: &[String]) -> Result<Self, InputError> {
        TomlFile::parse_over(path, text, overrides, None)
    }

    /// The same; where it names a file under `initial.from`, and nothing else in that table, the tables that
    /// `under` makes of that file are added to its own, and it may hold none of them.
    ///
    /// # Errors
    /// As for [`TomlFile::read`], and what `under` says, pointing at the key.
    pub fn parse_over(
        path: &Path,
        text: String,
        overrides: &[String],
        under: Option<Under>,
    ) -> Result<Self, InputError> {
        let from_input = path == Path::new(STANDARD_INPUT);
        let name = if from_input { "standard input".into() } else { path.display().to_string() };
        let mut sources = Sources::new(name, text, overrides);
        if let Some(under) = under {
            sources.put_under(path, under)?;
        }
        let table = sources.table()?;
        let deserializer = Deserializer::from(Spanned::new(0..sources.text.len(), table));
        let value = T::deserialize(deserializer).map_err(|e| sources.refusal::<T>(&e))?;
        Ok(TomlFile { value, path: path.to_path_buf(), sources, under })
    }

    /// The same file with more overrides.
    ///
    /// # Errors
    /// As for [`TomlFile::read`].
    pub fn with(&self, overrides: &[String]) -> Result<Self, InputError> {
        let Sources { text, overrides: before, .. } = &self.sources;
        let all: Vec<String> = before.iter().map(|(_, text)| text).chain(overrides).cloned().collect();
        TomlFile::parse_over(&self.path, text.clone(), &all, self.under)
    }
}

impl<T> TomlFile<T> {
    /// The file's name without its extension, which names the results.
    pub fn stem(&self) -> String {
        let stem = self.path.file_stem().filter(|_| self.path != Path::new(STANDARD_INPUT));
        stem.map_or_else(|| "scene".into(), |s| s.to_string_lossy().into_owned())
    }

    /// The same file with another name in its messages: that of a text which lies in no file.
    #[must_use]
    pub fn called(mut self, name: String) -> Self {
        self.sources.name = name;
        self
    }

    /// A path of the file, which is relative to its folder.
    pub fn resolve(&self, path: &Path) -> PathBuf {
        path_beside(&self.path, path)
    }

    /// An error about the value at `path` (`asperity[0].height`), pointing at it or, where it is absent, at
    /// the innermost table that lacks it.
    pub fn error_at(&self, path: &str, message: &str) -> InputError {
        // `material.` is said of a key that the table lacks
        let path = path.trim_end_matches('.');
        let keys = path_keys(path).unwrap_or_default();
        let span = self.sources.table().ok().and_then(|table| find(&table, &keys));
        let message = if path.is_empty() { message.to_string() } else { format!("{path}: {message}") };
        self.sources.error(&message, span)
    }
}

/// The path `named` by the file at `path`.
fn path_beside(path: &Path, named: &Path) -> PathBuf {
    path.parent().map_or_else(|| named.to_path_buf(), |folder| folder.join(named))
}

/// `value` as the text of a TOML file.
///
/// # Errors
/// A value that TOML cannot hold; a sentence for the user.
pub fn to_toml(value: &impl Serialize) -> Result<String, String> {
    toml::to_string(value).map_err(|e| e.to_string())
}

/// Stands for standard input.
pub const STANDARD_INPUT: &str = "-";

/// Reads a whole text file, or standard input.
///
/// # Errors
/// Text that cannot be read: its name and what to give instead.
pub fn read_text(path: &Path) -> Result<String, InputError> {
    let from_input = path == Path::new(STANDARD_INPUT);
    let name = if from_input { "standard input".into() } else { path.display().to_string() };
    let error = |e: std::io::Error| {
        let told = unreadable(Path::new(&name), &e);
        let help = "give the path of a TOML file, or - for standard input";
        if told.help.is_some() { told } else { told.help(help) }
    };
    let mut bytes = Vec::new();
    if from_input {
        std::io::stdin().lock().take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(error)?;
    } else {
        let file = std::fs::File::open(path).map_err(error)?;
        file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(error)?;
    }
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(InputError::new(format!("{name} is larger than {} MB", LARGEST_FILE >> 20))
            .help("a scene is a text file of a few lines"));
    }
    let text = String::from_utf8(bytes).map_err(|e| {
        let valid = e.utf8_error().valid_up_to();
        let line = 1 + e.as_bytes()[..valid].iter().filter(|&&b| b == b'\n').count();
        InputError::new(format!("{name} is not a text file: line {line}, byte {} is not UTF-8", valid + 1))
            .help("a scene is a TOML file in UTF-8")
    })?;
    if text.trim().is_empty() {
        return Err(InputError::new(format!("{name} is empty"))
            .help("it must say what to compute: `asperity new` writes commented files of every kind"));
    }
    Ok(text)
}

/// The text of the file followed by the overrides: spans beyond the file belong to an override.
#[derive(Debug)]
struct Sources {
    name: String,
    text: String,
    overrides: Vec<(Range<usize>, String)>,
    /// Tables under those of the file, and the key that names where they come from.
    under: Option<(Range<usize>, String)>,
}

impl Sources {
    fn new(name: String, text: String, overrides: &[String]) -> Self {
        let mut start = text.len();
        let overrides = overrides
            .iter()
            .map(|text| {
                let text = with_digits_about_the_point(text);
                let span = start + 1..start + 1 + text.len();
                start = span.end;
                (span, text)
            })
            .collect();
        Sources { name, text, overrides, under: None }
    }

    /// Puts the tables of the file that is named here under the own ones.
    fn put_under(&mut self, path: &Path, under: Under) -> Result<(), InputError> {
        let table = self.table()?;
        let Some(DeValue::Table(named)) = table.get(UNDER_KEY.0).map(Spanned::get_ref) else { return Ok(()) };
        // a resolved scene holds what the file gave
        let Some(from) = named.get(UNDER_KEY.1).filter(|_| named.len() == 1) else { return Ok(()) };
        let (Some(file), span) = (from.get_ref().as_str(), from.span()) else { return Ok(()) };
        let text = under(&path_beside(path, Path::new(file))).map_err(|reason| {
            self.error(&format!("{}.{}: {reason}", UNDER_KEY.0, UNDER_KEY.1), Some(span.clone()))
        })?;
        self.under = Some((span, text));
        Ok(())
    }

    /// Adds the tables of the file under the own ones.
    fn add_under<'a>(&'a self, own: &mut DeTable<'a>) -> Result<(), InputError> {
        let Some((span, text)) = &self.under else { return Ok(()) };
        let under = DeTable::parse(text).map_err(|e| self.toml_error(&e))?.into_inner();
        for (key, value) in under {
            let name = key.into_inner();
            let value = moved(value.into_inner(), span);
            match own.get_mut(name.as_ref()) {
                None => {
                    own.insert(Spanned::new(span.clone(), name), value);
                }
                Some(table) if name == UNDER_KEY.0 => {
                    if let (DeValue::Table(own), DeValue::Table(more)) = (table.get_mut(), value.into_inner())
                    {
                        own.extend(more);
                    }
                }
                Some(own) => {
                    let message = format!(
                        "{name}: the body is that of {}.{}; remove this, or that",
                        UNDER_KEY.0, UNDER_KEY.1
                    );
                    return Err(self.error(&message, Some(own.span())));
                }
            }
        }
        Ok(())
    }

    /// The file as a table, overrides applied.
    fn table(&self) -> Result<DeTable<'_>, InputError> {
        let root = DeTable::parse(&self.text).map_err(|e| self.toml_error(&e))?.into_inner();
        let mut root = Spanned::new(0..self.text.len(), DeValue::Table(root));
        for (span, text) in &self.overrides {
            set(&mut root, text, span).map_err(|message| self.error(&message, Some(span.clone())))?;
        }
        match root.into_inner() {
            DeValue::Table(mut table) => {
                self.add_under(&mut table)?;
                Ok(table)
            }
            _ => Err(self.error("the overrides leave no table", None)),
        }
    }

    /// An error that shows the place; for the file as a whole it names the file.
    fn error(&self, message: &str, span: Option<Range<usize>>) -> InputError {
        let Some(span) = span.filter(|span| *span != (0..self.text.len())) else {
            return InputError::new(format!("{}: {message}", self.name));
        };
        match self.overrides.iter().find(|(place, _)| span.start >= place.start && span.end <= place.end) {
            Some((_, text)) => InputError::new(message).pointing_at("--set", text, 0..text.len()),
            None => InputError::new(message).pointing_at(&self.name, &self.text, span),
        }
    }

    /// The error of a file that is no `T`; of a file for another command that says so too.
    fn refusal<T: DeserializeOwned>(&self, e: &toml::de::Error) -> InputError {
        let error = self.toml_error(e);
        let own = DeTable::parse(&self.text).ok();
        let Some(hint) = own.and_then(|own| kind::of_another_command::<T>(own.get_ref(), &self.name)) else {
            return error;
        };
        let help = error.help.as_ref().map_or_else(String::new, |help| format!("; {help}"));
        error.help(hint + &help)
    }

    fn toml_error(&self, e: &toml::de::Error) -> InputError {
        let (message, help) = suggest::reword(e.message());
        let help = help.or_else(|| self.decimal_comma(e.span()?.start));
        let error = self.error(&message, e.span());
        match help {
            Some(help) => error.help(help),
            None => error,
        }
    }

    /// The way out where the value before `place` ends at a decimal comma.
    fn decimal_comma(&self, place: usize) -> Option<String> {
        let (before, after) = (self.text.get(..place)?, self.text.get(place..)?);
        let whole = before.rsplit(|c: char| c.is_whitespace() || "={".contains(c)).next()?;
        let decimals: String = after.strip_prefix(',')?.chars().take_while(char::is_ascii_digit).collect();
        let are_digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let bare = whole.trim_start_matches(['-', '+']);
        (are_digits(bare) && are_digits(&decimals)).then(|| match decimals.len() {
            3 => format!("write numbers without a comma: {whole}.{decimals} or {whole}{decimals}"),
            _ => format!("write the decimal point: {whole}.{decimals}"),
        })
    }
}

/// The keys of a path, "asperity[0].height" or "asperity.0.height"; `None` where one is empty or has odd
/// letters.
fn path_keys(path: &str) -> Option<Vec<&str>> {
    let keys: Vec<&str> =
        path.split(['.', '[']).map(|key| key.strip_suffix(']').unwrap_or(key).trim()).collect();
    let letters = |key: &str| key.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-');
    keys.iter().all(|key| !key.is_empty() && letters(key)).then_some(keys)
}

/// The span of the value at `keys`, or of the innermost table on the way to it; `None` for the root.
fn find(table: &DeTable<'_>, keys: &[&str]) -> Option<Range<usize>> {
    let mut value: &Spanned<DeValue<'_>> = table.get(*keys.first()?)?;
    for key in &keys[1..] {
        let inner = match value.get_ref() {
            DeValue::Table(table) => table.get(*key),
            DeValue::Array(array) => key.parse().ok().and_then(|i: usize| array.get(i)),
            _ => None,
        };
        match inner {
            Some(inner) => value = inner,
            None => break,
        }
    }
    Some(value.span())
}

/// Applies one override to the tree; the error is a sentence for the user.
fn set<'a>(root: &mut Spanned<DeValue<'a>>, text: &'a str, span: &Range<usize>) -> Result<(), String> {
    const FORM: &str = "--set takes key.path=value, for example --set \"loading.depth=5 um\" or --set asperity[0].slope_deg=8";
    let (path, value) = text.split_once('=').ok_or(FORM)?;
    let keys = path_keys(path.trim()).ok_or(FORM)?;
    let value = value.trim();
    if value.is_empty() {
        return Err(FORM.into());
    }
    // what is no TOML value is a bare string, so that shells need no second pair of quotes
    let value = DeValue::parse(value).map_or_else(|_| DeValue::String(value.into()), Spanned::into_inner);
    put(root, &keys, moved(value, span), span)
}

/// An override whose number has a bare point, `.005` or `5.`, as TOML writes it: people and programs leave
/// the 0 out.
fn with_digits_about_the_point(text: &str) -> String {
    let bare = text.split_once('=').filter(|(_, value)| {
        let value = value.trim();
        value.parse::<f64>().is_ok() && value.contains('.') && DeValue::parse(value).is_err()
    });
    bare.and_then(|(path, value)| Some(format!("{path}={:?}", value.trim().parse::<f64>().ok()?)))
        .unwrap_or_else(|| text.to_string())
}

/// Puts `new` at `keys`, making tables on the way.
fn put<'a>(
    at: &mut Spanned<DeValue<'a>>,
    keys: &[&'a str],
    new: Spanned<DeValue<'a>>,
    span: &Range<usize>,
) -> Result<(), String> {
    let [key, rest @ ..] = keys else {
        *at = new;
        return Ok(());
    };
    let numbered = |keys: &[&str]| keys.first().is_some_and(|k| k.parse::<usize>().is_ok());
    let empty = || {
        let value =
            if numbered(rest) { DeValue::Array(DeArray::new()) } else { DeValue::Table(DeTable::new()) };
        Spanned::new(span.clone(), value)
    };
    match at.get_mut() {
        DeValue::Table(table) => {
            let name = Spanned::new(span.clone(), (*key).into());
            put(table.entry(name).or_insert_with(empty), rest, new, span)
        }
        DeValue::Array(array) => {
            let len = array.len();
            let index = key.parse::<usize>().ok().filter(|&i| i <= len).ok_or_else(|| {
                if numbered(keys) {
                    return format!("`{key}` is not in a list of {len} tables: take one from 0 to {len}, where [{len}] adds one");
                }
                format!(
                    "`{key}` is asked of a list of {len} tables: name one by its number, from 0 to {len}, in brackets, as in \
                     [0].{key}; [{len}] adds one"
                )
            })?;
            if index == len {
                array.push(empty());
            }
            array.get_mut(index).map_or(Ok(()), |value| put(value, rest, new, span))
        }
        other => Err(format!("what stands to the left of `{key}` is a {}, not a table", other.type_str())),
    }
}

/// The value with every span replaced: an override is shown as a whole.
fn moved<'a>(value: DeValue<'a>, span: &Range<usize>) -> Spanned<DeValue<'a>> {
    let value = match value {
        DeValue::Array(array) => {
            DeValue::Array(array.into_iter().map(|v| moved(v.into_inner(), span)).collect())
        }
        DeValue::Table(table) => DeValue::Table(
            table
                .into_iter()
                .map(|(k, v)| (Spanned::new(span.clone(), k.into_inner()), moved(v.into_inner(), span)))
                .collect(),
        ),
        other => other,
    };
    Spanned::new(span.clone(), value)
}
