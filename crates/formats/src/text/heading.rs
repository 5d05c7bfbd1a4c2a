//! Names and units of columns, as instruments and people write them.

use crate::dimension::{Dimension, PREFIXES};

/// A quantity that is wanted from a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Its name in messages and as a key.
    pub name: &'static str,
    /// Its dimension.
    pub dimension: Dimension,
    /// Names of columns, in small letters without accents, words apart by blanks.
    pub called: &'static [&'static str],
    /// A head that can be read.
    pub example: &'static str,
}

/// The head of a column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Heading {
    /// As it stands in the file.
    pub text: String,
    /// Its name, in small letters without accents, words apart by blanks.
    pub name: String,
    /// Its unit, where one stands with it.
    pub unit: Option<String>,
}

/// Added to the rank of a name that says that it is not corrected.
const RANK_OF_RAW: u8 = 10;
/// Added to the rank of a name that is refused where no other column has the quantity.
const RANK_OF_DOUBT: u8 = 20;

/// Words of a stress or a strain that change nothing of it: a name with others is not taken, for they may be
/// a unit, or make another quantity of it.
const HARMLESS: [&str; 62] = [
    "vraie",
    "vrai",
    "vera",
    "reale",
    "verdadera",
    "wahre",
    "plastique",
    "plastica",
    "plastische",
    "effektive",
    "true",
    "cauchy",
    "real",
    "yield",
    "flow",
    "equivalent",
    "eq",
    "effective",
    "eff",
    "von",
    "mises",
    "vonmises",
    "log",
    "logarithmic",
    "hencky",
    "plastic",
    "pl",
    "p",
    "accumulated",
    "cumulative",
    "cumulated",
    "total",
    "uniaxial",
    "axial",
    "tensile",
    "compressive",
    "compression",
    "tension",
    "mean",
    "average",
    "avg",
    "measured",
    "peeq",
    "eps",
    "epsilon",
    "ε",
    "εp",
    "ep",
    "e",
    "sigma",
    "σ",
    "σy",
    "sy",
    "kf",
    "abs",
    "absolute",
    "phi",
    "φ",
    "corrected",
    "korrigiert",
    "corrige",
    "corrigee",
];
/// Words of the force over the area before the test and of the growth over the length before it.
const OF_ENGINEERS: [&str; 15] = [
    "engineering",
    "eng",
    "engr",
    "nominal",
    "nominell",
    "nominelle",
    "technische",
    "technisch",
    "conventionnelle",
    "nominale",
    "ingenieur",
    "nenn",
    "ingegneristica",
    "ingenieril",
    "1st",
];

/// Words that make a function of a depth or a force; strains are logarithmic.
const FUNCTIONS: [&str; 16] = [
    "sqrt",
    "√",
    "squared",
    "ln",
    "lg",
    "log10",
    "delta",
    "δ",
    "inverse",
    "increment",
    "normalized",
    "normalised",
    "normiert",
    "normalise",
    "hmax",
    "pmax",
];

/// True where a text is the unit of something.
pub(super) fn is_unit(text: &str) -> bool {
    let is_of = |dimension: &Dimension| dimension.scale(text).is_some();
    [Dimension::Length, Dimension::Force, Dimension::Stress].iter().any(is_of) || is_unit_of_ratio(text)
}

/// A unit without the brackets about it.
pub(super) fn unbracketed(unit: &str) -> &str {
    unit.trim_matches(['(', ')', '[', ']', '{', '}']).trim()
}

/// True of a unit of ratios that is more than a number or a dash.
fn is_unit_of_ratio(text: &str) -> bool {
    Dimension::Ratio.scale(text).is_some() && text.contains(|c: char| c.is_alphabetic() || "%‰".contains(c))
}

/// Small letters without accents, words apart by single blanks.
pub(crate) fn folded(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars().flat_map(char::to_lowercase) {
        match c {
            'à' | 'á' | 'â' | 'ä' | 'ã' => out.push('a'),
            'è' | 'é' | 'ê' | 'ë' | 'ě' => out.push('e'),
            'ì' | 'í' | 'î' | 'ï' => out.push('i'),
            'ò' | 'ó' | 'ô' | 'ö' | 'õ' => out.push('o'),
            'ù' | 'ú' | 'û' | 'ü' => out.push('u'),
            'ý' => out.push('y'),
            'ñ' => out.push('n'),
            'ç' => out.push('c'),
            'ß' => out.push_str("ss"),
            '_' | '-' | '/' | ':' | ',' | '=' => out.push(' '),
            '\u{307}' => {}
            _ => out.push(c),
        }
    }
    out.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Name of a head, as [`folded`] writes it, and its unit.
pub(crate) fn folded_name(text: &str) -> (String, Option<String>) {
    let heading = Heading::new(text);
    (heading.name, heading.unit)
}

impl Heading {
    /// The head `text`: `depth_um`, `Depth (nm)`, `Load [mN]`, `h/nm`, `Weg in mm`, `load_micro_N`.
    pub fn new(text: &str) -> Heading {
        let text = text.trim();
        let (name, unit) = parts(&text.replace(['（', '［'], "(").replace(['）', '］'], ")"));
        let (name, unit) = (folded(&name), unit.map(|unit| with_case(text, unit.trim())));
        let (name, unit) = with_prefix(name, unit);
        // one word of German
        let engineers = ["nenn", "ingenieur"].iter().find_map(|of| Some((of, name.strip_prefix(of)?)));
        let name = match engineers.filter(|(_, rest)| ["spannung", "dehnung"].contains(rest)) {
            Some((of, rest)) => format!("{of} {rest}"),
            None => name,
        };
        // "Depth 2" is the depth of the second test
        let name = name.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.' || c == ' ');
        let name = ["in", "en", "#"]
            .iter()
            .find_map(|end| name.strip_suffix(end)?.strip_suffix(' '))
            .unwrap_or(name);
        Heading { text: text.into(), name: name.into(), unit }
    }

    /// The head with the `unit` of another cell, in brackets or not, where it has none of its own.
    fn in_unit(mut self, unit: Option<&String>) -> Heading {
        let bare = unit.map(|unit| unbracketed(unit).to_string());
        self.unit =
            self.unit.or(bare.filter(|unit| !unit.is_empty()).map(|unit| with_case(&self.text, &unit)));
        self
    }

    /// The heads in `cells` above columns of which `filled` tells those that hold numbers, with the `units`
    /// of a line below. A unit in a cell of its own belongs to the name before it: one beside every name
    /// above half as many columns, or one above a column without numbers.
    pub fn list(cells: &[String], units: &[String], filled: &[bool]) -> Vec<Heading> {
        let last = |is_used: &dyn Fn(usize) -> bool, count| (0..count).rev().find(|i| is_used(*i));
        let width = last(&|i| !cells[i].is_empty(), cells.len()).map_or(0, |last| last + 1);
        let columns = last(&|i| filled[i], filled.len()).map_or(0, |last| last + 1);
        let beside = |i: usize| cells.get(i + 1).filter(|unit| is_unit(unit));
        let are_pairs = [columns, filled.len()].contains(&width.div_ceil(2))
            && (0..width).step_by(2).any(|i| beside(i).is_some())
            && (1..width).step_by(2).all(|i| beside(i).is_none());
        let heads: Vec<Heading> = if are_pairs {
            cells[..width].chunks(2).map(|pair| Heading::new(&pair[0]).in_unit(pair.get(1))).collect()
        } else {
            let is_empty = |i: usize| filled.get(i + 1) == Some(&false);
            let own = |i: usize| beside(i).filter(|_| is_empty(i));
            cells.iter().enumerate().map(|(i, cell)| Heading::new(cell).in_unit(own(i))).collect()
        };
        let mut heads: Vec<Heading> =
            heads.into_iter().enumerate().map(|(i, head)| head.in_unit(units.get(i))).collect();
        // beside UM and NM, MN is mN
        let has_unit =
            |head: &Heading, names: &[&str]| head.unit.as_deref().is_some_and(|u| names.contains(&u));
        if heads.iter().any(|head| has_unit(head, &["UM", "NM"])) {
            for head in heads.iter_mut().filter(|head| has_unit(head, &["MN"])) {
                head.unit = Some("mN".into());
            }
        }
        heads
    }

    /// Rank of the name as one of `quantity`: 0 best.
    pub fn rank(&self, quantity: &Quantity) -> Option<u8> {
        let doubt = self.doubt(quantity).map_or(0, |_| RANK_OF_DOUBT);
        let rank = self.bare_rank(quantity)? + doubt;
        let has = |words: &[&str]| self.name.split(' ').any(|word| words.contains(&word));
        // as it came from the gauge, with the frame and the way to the surface in it
        if has(&["raw", "uncorrected", "unkorrigiert", "roh", "brut"]) {
            return Some(rank + RANK_OF_RAW);
        }
        // that of the sample beside that of the drive is asked about, and so is one with less in it
        let ends = ["into surface", "on sample", "sample displacement", "from preload", "above surface"];
        let is_of_curve = matches!(quantity.dimension, Dimension::Length | Dimension::Force);
        let is_less =
            has(&["corrected", "korrigiert", "corrige", "corrigee"]) || is_of_curve && has(&["net", "true"]);
        let is_asked = is_less || ends.iter().any(|end| self.name.ends_with(end));
        Some(if doubt == 0 && is_asked { 0 } else { rank })
    }

    /// The reason why the name is not taken for `quantity` as it stands, with a way out.
    pub fn doubt(&self, quantity: &Quantity) -> Option<String> {
        if let Some(factor) = self.factor() {
            return Some(format!(
                "names a factor, \"{factor}\": write the numbers without it, and leave it out of the name"
            ));
        }
        let is_log =
            |word: &str| word == "log" && matches!(quantity.dimension, Dimension::Length | Dimension::Force);
        if let Some(of) = self.name.split(' ').find(|word| FUNCTIONS.contains(word) || is_log(word)) {
            return Some(format!(
                "names a function, \"{of}\", of what is wanted: write the quantity itself, like {}",
                quantity.example
            ));
        }
        if !matches!(quantity.dimension, Dimension::Ratio | Dimension::Stress)
            || quantity.called.contains(&self.name.as_str())
        {
            return None;
        }
        let words = || self.name.split(' ').map(|word| word.trim_matches('.'));
        if words().any(|word| OF_ENGINEERS.contains(&word)) {
            let way = "true stress is σ (1 + ε), true strain ln(1 + ε), plastic strain the true one less true stress over Young's modulus";
            return Some(format!("counts over the sizes before the test, but true values are wanted: {way}"));
        }
        let is_known = |word: &&str| {
            HARMLESS.contains(word)
                || quantity.called.iter().any(|called| called.split(' ').any(|c| c == *word))
        };
        let unknown: Vec<&str> = words().filter(|word| !is_known(word)).collect();
        let unknown = (!unknown.is_empty()).then(|| unknown.join(" "))?;
        Some(format!(
            "has words that may be a unit or make it another quantity, \"{unknown}\": call it {} if it is that, a unit behind it in brackets",
            quantity.example
        ))
    }

    /// A factor in the name or behind the unit: `x 10` of "Load x 10 (mN)", `/10` of "Load (mN) /10".
    fn factor(&self) -> Option<String> {
        let outside = unit_apart(&self.text).to_lowercase();
        let words: Vec<&str> = outside.split_whitespace().collect();
        let is_digit = |c: char| c.is_ascii_digit();
        let starts = |word: &str| word.starts_with(is_digit);
        let signs = ['x', '×', '*', '·', '/', '÷', '^'];
        let is_factor = |i: usize| {
            let word = words[i];
            let after = words.get(i + 1).is_some_and(|next| starts(next));
            word.len() <= 2 && word.starts_with(signs) && word.chars().count() == 1 && after
                || word.strip_prefix(signs).is_some_and(starts)
                || word.strip_suffix(['x', '×']).is_some_and(|n| !n.is_empty() && n.chars().all(is_digit))
                || word.contains("10^")
                || word.contains("10**")
        };
        let place = (1..words.len()).find(|i| is_factor(*i))?;
        Some(words[place..].join(" "))
    }

    /// The rank of the name, whatever it says of corrections.
    fn bare_rank(&self, quantity: &Quantity) -> Option<u8> {
        const OTHERS: [&str; 20] = [
            "lateral",
            "tangential",
            "transverse",
            "rate",
            "nodal",
            "error",
            "stiffness",
            "slope",
            "time",
            "area",
            "deviation",
            "std",
            "voltage",
            "stress",
            "energy",
            "sd",
            "stdev",
            "max",
            "maximum",
            "maximale",
        ];
        /// Names that other quantities have too: a simulation calls what its contact law lets overlap so.
        const WEAK: [&str; 1] = ["penetration"];
        /// Depths that are computed from a curve.
        const COMPUTED: [&str; 4] =
            ["contact depth", "plastic depth", "residual depth", "contact displacement"];
        let name = self.name.as_str();
        let is_computed = COMPUTED.iter().any(|other| name.starts_with(other) || name.ends_with(other));
        if is_computed && quantity.dimension == Dimension::Length {
            return None;
        }
        if quantity.called.contains(&name) {
            return Some(u8::from(WEAK.contains(&name)));
        }
        let other = |word: &str| OTHERS.contains(&word) && !quantity.called.iter().any(|c| c.contains(word));
        if name.split(' ').any(other) {
            return None;
        }
        let follows = |rest: &str| rest.is_empty() || rest.starts_with(' ');
        let ends =
            |called: &&str| called.len() > 1 && name.strip_suffix(*called).is_some_and(|r| r.ends_with(' '));
        let starts = |called: &&str| called.len() > 3 && name.strip_prefix(*called).is_some_and(follows);
        if quantity.called.iter().any(ends) {
            Some(1)
        } else if quantity.called.iter().any(starts) {
            Some(2)
        } else {
            None
        }
    }
}

/// The head `text` with a blank in place of what stands in brackets.
fn unit_apart(text: &str) -> String {
    let open = text.find(['(', '[', '{']).unwrap_or(text.len());
    let behind = text[open..].find([')', ']', '}']).map_or("", |close| &text[open + close + 1..]);
    format!("{} {behind}", &text[..open])
}

/// The `unit` of the head `text`: in one of words in capitals alone MN is mN.
fn with_case(text: &str, unit: &str) -> String {
    let letters = text.split(['(', '[']).next().map_or(0, |name| name.matches(char::is_alphabetic).count());
    let is_small = unit == "MN" && letters > 1 && !text.contains(char::is_lowercase);
    if is_small { "mN".into() } else { unit.into() }
}

/// Name and unit of a head.
fn parts(text: &str) -> (String, Option<String>) {
    if let Some(open) = text.rfind(['(', '[', '{']) {
        let inside = &text[open + 1..];
        let close = inside.find([')', ']', '}']).unwrap_or(inside.len());
        let after = inside.get(close + 1..).unwrap_or("");
        return (format!("{} {after}", &text[..open]), Some(inside[..close].into()));
    }
    // the longest end that is a unit: micro_N before N
    let marks = text.char_indices().filter(|(_, c)| [' ', '_', '/', ',', '-', '|'].contains(c));
    let unit = marks.map(|(i, c)| (&text[..i], &text[i + c.len_utf8()..])).find(|(_, unit)| is_unit(unit));
    match unit.or_else(|| Some(text.split_at(text.find(['%', '‰']).filter(|i| *i > 0)?))) {
        Some((name, unit)) => (name.into(), Some(unit.into())),
        None => (text.into(), None),
    }
}

/// A prefix that stands in the name belongs to the unit: without one behind it the unit is not known.
fn with_prefix(name: String, unit: Option<String>) -> (String, Option<String>) {
    let Some(prefix) = name.rsplit(' ').next().filter(|word| PREFIXES.iter().any(|(p, _)| p == word)) else {
        return (name, unit);
    };
    let unit = format!("{prefix} {}", unit.as_deref().unwrap_or(""));
    let name = name[..name.len() - prefix.len()].trim_end().to_string();
    (name, Some(unit.trim_end().into()))
}
