//! The sections of an MSH 4.1 file, as they stand.

use super::error::MshError;
use crate::ElementKind;
use std::collections::HashMap;

/// A quadrilateral or a piece of a side: its nodes by index into [`File::nodes`], and its line.
pub(super) struct Element {
    pub(super) line: usize,
    pub(super) nodes: Vec<usize>,
}

/// The pieces of a physical curve.
pub(super) struct Curve {
    pub(super) name: String,
    pub(super) lines: Vec<Element>,
}

/// The content of a file that makes a mesh of quadrilaterals.
pub(super) struct File {
    pub(super) kind: ElementKind,
    /// Coordinates x, y, z in the order of the file.
    pub(super) nodes: Vec<[f64; 3]>,
    pub(super) quads: Vec<Element>,
    pub(super) curves: Vec<Curve>,
}

/// Lines that hold something, with their number from 1.
struct Lines<'a> {
    rest: std::iter::Enumerate<std::str::Lines<'a>>,
    /// Line last handed out.
    line: usize,
}

impl<'a> Lines<'a> {
    fn next(&mut self) -> Option<&'a str> {
        let (i, text) = self.rest.find(|(_, text)| !text.trim().is_empty())?;
        self.line = i + 1;
        Some(text.trim())
    }

    fn error(&self, message: impl Into<String>) -> MshError {
        MshError::new(self.line, message)
    }

    /// The next line, which must exist and not end the section.
    fn expect(&mut self, what: &str) -> Result<&'a str, MshError> {
        match self.next() {
            Some(text) if !text.starts_with("$End") => Ok(text),
            Some(text) => Err(self.error(format!("expected {what}, found {text}"))),
            None => Err(self.error(format!("expected {what} after this line, found the end of the file"))),
        }
    }

    /// The words of the next line, at least `least` of them.
    fn words(&mut self, least: usize, what: &str) -> Result<Vec<&'a str>, MshError> {
        let words: Vec<&str> = self.expect(what)?.split_whitespace().collect();
        if words.len() < least {
            return Err(self.error(format!("expected {what}, found {} words", words.len())));
        }
        Ok(words)
    }

    fn number<T: std::str::FromStr>(&self, word: Option<&&str>, what: &str) -> Result<T, MshError> {
        let word = word.ok_or_else(|| self.error(format!("expected {what}, found the end of the line")))?;
        word.parse().map_err(|_| self.error(format!("expected {what}, found {word:?}")))
    }

    /// The next line as whole numbers, at least `least` of them.
    fn counts(&mut self, least: usize, what: &str) -> Result<Vec<usize>, MshError> {
        let words = self.words(least, what)?;
        words.iter().map(|w| self.number(Some(w), what)).collect()
    }

    /// Skips to behind the end of a section.
    fn skip(&mut self, name: &str) -> Result<(), MshError> {
        let end = format!("$End{name}");
        while let Some(text) = self.next() {
            if text == end {
                return Ok(());
            }
        }
        Err(self.error(format!("{end} is missing")))
    }

    /// The line that ends a section.
    fn end(&mut self, name: &str) -> Result<(), MshError> {
        let end = format!("$End{name}");
        match self.next() {
            Some(text) if text == end => Ok(()),
            Some(text) => Err(self.error(format!("expected {end}, found {text:?}"))),
            None => Err(self.error(format!("{end} is missing"))),
        }
    }
}

/// Nodes of the element types of Gmsh that this reader knows, with their name.
fn element_type(code: usize) -> Option<(usize, &'static str)> {
    match code {
        1 => Some((2, "line")),
        2 => Some((3, "triangle")),
        3 => Some((4, "4-node quadrangle")),
        8 => Some((3, "3-node line")),
        9 => Some((6, "6-node triangle")),
        10 => Some((9, "9-node quadrangle")),
        15 => Some((1, "point")),
        16 => Some((8, "8-node quadrangle")),
        _ => None,
    }
}

/// Collects the sections.
#[derive(Default)]
struct Reader {
    physical: HashMap<usize, String>,
    /// Names of the physical curves of each curve.
    curve_names: HashMap<usize, Vec<String>>,
    nodes: Vec<[f64; 3]>,
    index: HashMap<usize, usize>,
    kind: Option<ElementKind>,
    quads: Vec<Element>,
    curves: Vec<Curve>,
}

/// Reads the whole file.
pub(super) fn parse(text: &str) -> Result<File, MshError> {
    let mut lines = Lines { rest: text.lines().enumerate(), line: 0 };
    let mut reader = Reader::default();
    let mut first = true;
    while let Some(header) = lines.next() {
        let Some(name) = header.strip_prefix('$') else {
            let hint = if first { ": this is not an MSH file, which starts with $MeshFormat" } else { "" };
            let found = shorten(header);
            return Err(lines.error(format!("expected the $Name of a section, found {found:?}{hint}")));
        };
        if first && name != "MeshFormat" {
            return Err(lines.error(format!("expected $MeshFormat first, found ${}", shorten(name))));
        }
        first = false;
        match name {
            "MeshFormat" => reader.format(&mut lines)?,
            "PhysicalNames" => reader.physical_names(&mut lines)?,
            "Entities" => reader.entities(&mut lines)?,
            "Nodes" => reader.nodes(&mut lines)?,
            "Elements" => reader.elements(&mut lines)?,
            other => lines.skip(other)?,
        }
    }
    let none = "holds no quadrangles: mesh a surface with quadrangles (Recombine) and save its elements";
    let kind = reader.kind.filter(|_| !reader.quads.is_empty()).ok_or(MshError::whole(none))?;
    Ok(File { kind, nodes: reader.nodes, quads: reader.quads, curves: reader.curves })
}

/// The start of a text that may be long.
fn shorten(text: &str) -> String {
    let start: String = text.chars().take(40).collect();
    if start.len() < text.len() { start + "…" } else { start }
}

impl Reader {
    fn format(&mut self, lines: &mut Lines) -> Result<(), MshError> {
        let words = lines.words(3, "version, file type and data size, as \"4.1 0 8\"")?;
        if words[0] != "4.1" {
            return Err(lines.error(format!(
                "the file is MSH version {}, expected 4.1: save it as \"Version 4 ASCII\" (Mesh.MshFileVersion = 4.1)",
                shorten(words[0])
            )));
        }
        if words[1] != "0" {
            return Err(lines.error("the file is binary, expected ASCII: save it with Mesh.Binary = 0"));
        }
        lines.end("MeshFormat")
    }

    fn physical_names(&mut self, lines: &mut Lines) -> Result<(), MshError> {
        let count = lines.counts(1, "the number of physical names")?[0];
        for _ in 0..count {
            let text = lines.expect("dimension, tag and name of a physical group, as 1 3 \"surface\"")?;
            let mut parts = text.splitn(3, char::is_whitespace);
            let dimension: usize =
                lines.number(parts.next().as_ref(), "the dimension of a physical group")?;
            let tag: usize = lines.number(parts.next().as_ref(), "the tag of a physical group")?;
            let name = parts.next().map(|n| n.trim().trim_matches('"')).unwrap_or_default();
            if name.is_empty() {
                return Err(lines.error("expected the name of the physical group in quotes"));
            }
            if dimension == 1 {
                self.physical.insert(tag, name.to_string());
            }
        }
        lines.end("PhysicalNames")
    }

    fn entities(&mut self, lines: &mut Lines) -> Result<(), MshError> {
        let counts = lines.counts(4, "the numbers of points, curves, surfaces and volumes")?;
        for _ in 0..counts[0] {
            lines.words(5, "a point: tag, x, y, z, number of physical groups")?;
        }
        for _ in 0..counts[1] {
            let what = "a curve: tag, box (6 numbers), number of physical groups, their tags";
            let words = lines.words(8, what)?;
            let tag: usize = lines.number(words.first(), what)?;
            let groups: usize = lines.number(words.get(7), what)?;
            let mut names = Vec::new();
            for k in 0..groups {
                // a negative tag means that the curve runs backwards in its group
                let group: i64 = lines.number(words.get(8usize.saturating_add(k)), what)?;
                let group = usize::try_from(group.unsigned_abs()).unwrap_or(usize::MAX);
                names.extend(self.physical.get(&group).cloned());
            }
            self.curve_names.insert(tag, names);
        }
        for _ in 0..counts[2] {
            lines.words(8, "a surface: tag, box (6 numbers), number of physical groups")?;
        }
        if counts[3] > 0 {
            return Err(lines.error("holds volumes, expected a plane section: mesh in two dimensions only"));
        }
        lines.end("Entities")
    }

    fn nodes(&mut self, lines: &mut Lines) -> Result<(), MshError> {
        let header = lines.counts(4, "the numbers of blocks and nodes, the least and the largest tag")?;
        let header_line = lines.line;
        for _ in 0..header[0] {
            let block =
                lines.counts(4, "a block of nodes: dimension, entity, parametric, number of nodes")?;
            let mut tags = Vec::new();
            for _ in 0..block[3] {
                tags.push((lines.counts(1, "the tag of a node")?[0], lines.line));
            }
            for (tag, line) in tags {
                let what = "the coordinates x y z of a node";
                let words = lines.words(3, what)?;
                let mut point = [0.0_f64; 3];
                for (value, word) in point.iter_mut().zip(&words) {
                    *value = lines.number(Some(word), what)?;
                    if !value.is_finite() {
                        return Err(lines.error(format!("expected {what}, found {word}")));
                    }
                }
                if self.index.insert(tag, self.nodes.len()).is_some() {
                    return Err(MshError::new(line, format!("node {tag} is given twice")));
                }
                self.nodes.push(point);
            }
        }
        if self.nodes.len() != header[1] {
            let (promised, held) = (header[1], self.nodes.len());
            let message = format!("the section promises {promised} nodes and holds {held}");
            return Err(MshError::new(header_line, message));
        }
        lines.end("Nodes")
    }

    fn elements(&mut self, lines: &mut Lines) -> Result<(), MshError> {
        let header = lines.counts(4, "the numbers of blocks and elements, the least and the largest tag")?;
        for _ in 0..header[0] {
            let block =
                lines.counts(4, "a block of elements: dimension, entity, type, number of elements")?;
            let (dimension, entity, code, count) = (block[0], block[1], block[2], block[3]);
            let (width, type_name) = element_type(code).ok_or_else(|| {
                lines.error(format!("element type {code} is not known here: expected quadrangles and lines"))
            })?;
            self.set_kind(code).map_err(|message| lines.error(format!("{type_name}: {message}")))?;
            let mut elements = Vec::new();
            for _ in 0..count {
                elements.push(self.element(lines, width, type_name)?);
            }
            match (dimension, code) {
                (2, 3 | 16) => self.quads.append(&mut elements),
                (1, 1 | 8) => self.name_lines(entity, elements),
                (0, 15) => {}
                _ => return Err(lines.error(format!("a {type_name} on an entity of dimension {dimension}"))),
            }
        }
        lines.end("Elements")
    }

    /// The kind of the cells of the mesh; refuses those that are not quadrilaterals of one kind.
    fn set_kind(&mut self, code: usize) -> Result<(), &'static str> {
        let kind = match code {
            3 => ElementKind::Quad4,
            16 => ElementKind::Quad8,
            10 => return Err("expected 8 nodes: set Mesh.SecondOrderIncomplete = 1"),
            2 | 9 => return Err("expected quadrangles alone: recombine the mesh (Mesh.RecombineAll = 1)"),
            _ => return Ok(()),
        };
        match self.kind.replace(kind) {
            Some(other) if other != kind => Err("4-node and 8-node quadrangles are mixed, expected one kind"),
            _ => Ok(()),
        }
    }

    fn element(&self, lines: &mut Lines, width: usize, type_name: &str) -> Result<Element, MshError> {
        let tags = lines.counts(1 + width, &format!("a {type_name}: its tag and {width} nodes"))?;
        if tags.len() > 1 + width {
            return Err(lines.error(format!("a {type_name} has {width} nodes, found {}", tags.len() - 1)));
        }
        let index = |tag: &usize| {
            self.index.get(tag).copied().ok_or_else(|| lines.error(format!("there is no node {tag}")))
        };
        Ok(Element { line: lines.line, nodes: tags[1..].iter().map(index).collect::<Result<_, _>>()? })
    }

    /// Adds line elements to every physical curve they belong to.
    fn name_lines(&mut self, entity: usize, elements: Vec<Element>) {
        for name in self.curve_names.get(&entity).into_iter().flatten() {
            let lines = elements.iter().map(|e| Element { line: e.line, nodes: e.nodes.clone() });
            match self.curves.iter_mut().find(|c| c.name == *name) {
                Some(curve) => curve.lines.extend(lines),
                None => self.curves.push(Curve { name: name.clone(), lines: lines.collect() }),
            }
        }
    }
}
