//! What may stand in a scene: the tables and their keys. Reader, schema and documentation follow it.

/// A table of a scene.
#[derive(Debug)]
pub struct TableKind {
    /// What messages call it.
    pub name: &'static str,
    /// What it describes, one sentence.
    pub about: &'static str,
    /// Its keys.
    pub keys: &'static [Key],
    /// Keys of which exactly one must be given, if there are such.
    pub one_of: &'static [&'static str],
}

/// A key of a table.
#[derive(Debug)]
pub struct Key {
    /// The name; that of an angle is followed by `_deg` or `_rad`.
    pub name: &'static str,
    /// What its value is.
    pub holds: Holds,
    /// Whether it must be given.
    pub is_required: bool,
    /// What it means, with unit and default; one sentence.
    pub about: &'static str,
}

/// What the value of a key is.
#[derive(Debug)]
pub enum Holds {
    /// Any text.
    Text,
    /// Texts.
    Texts,
    /// One of these texts.
    Choice(&'static [&'static str]),
    /// A whole number from 1 on.
    Count,
    /// A number, or an expression that gives one.
    Number,
    /// An angle or a rate; the key ends in `_deg` or `_rad`.
    Angle,
    /// So many angles or rates; the key ends in `_deg` or `_rad`.
    Angles(usize),
    /// So many numbers.
    Numbers(usize),
    /// Any count of numbers.
    List,
    /// Lists of so many numbers.
    Rows(usize),
    /// Pairs of an angle and a number; the key ends in `_deg` or `_rad`.
    AnglePairs,
    /// Pairs of a time and an angle or a rate; the key ends in `_deg` or `_rad`.
    AnglesOverTime,
    /// A direction: `"x"`, `"-x"`, `"y"`, … or three numbers.
    Direction,
    /// Three moments of inertia, or a table of moments and products.
    Inertia(&'static TableKind),
    /// A table.
    Table(&'static TableKind),
    /// A list of tables.
    Tables(&'static TableKind),
    /// Tables by names that the scene chooses.
    Named(&'static TableKind),
    /// Numbers by names that the scene chooses.
    NamedNumbers,
    /// One of these texts, or a table.
    ChoiceOr(&'static [&'static str], &'static TableKind),
}

/// The endings of keys of angles.
pub(crate) const ENDINGS: [&str; 2] = ["_deg", "_rad"];

/// Keys of angles whose values are rates.
const RATES: [&str; 2] = ["rate", "speed"];

impl Holds {
    /// Whether its keys end in `_deg` or `_rad`.
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Angle | Self::Angles(_) | Self::AnglePairs | Self::AnglesOverTime)
    }

    /// The kinds of tables in it.
    pub fn table(&self) -> Option<&'static TableKind> {
        match self {
            Self::Inertia(kind)
            | Self::Table(kind)
            | Self::Tables(kind)
            | Self::Named(kind)
            | Self::ChoiceOr(_, kind) => Some(kind),
            _ => None,
        }
    }
}

impl Key {
    /// The names under which it may stand.
    pub fn names(&self) -> Vec<String> {
        if self.holds.is_angle() {
            ENDINGS.iter().map(|ending| format!("{}{ending}", self.name)).collect()
        } else {
            vec![self.name.to_owned()]
        }
    }

    /// The unit of its numbers under this name, with T for that of times; none unless the ending says one of all of them.
    pub(crate) fn unit(&self, name: &str) -> Option<&'static str> {
        let is_of_all = matches!(self.holds, Holds::Angle | Holds::Angles(_));
        let ending =
            ENDINGS.iter().position(|ending| name.ends_with(ending)).filter(|_| is_of_all)?;
        let units = if RATES.contains(&self.name) { ["deg/T", "rad/T"] } else { ["deg", "rad"] };
        Some(units[ending])
    }

    /// Whether it may stand under this name.
    pub(crate) fn is_called(&self, name: &str) -> bool {
        if self.holds.is_angle() {
            ENDINGS.iter().any(|ending| name.strip_suffix(ending) == Some(self.name))
        } else {
            name == self.name
        }
    }
}

impl TableKind {
    /// The key that is called so, endings left out.
    pub fn key_called(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// The key that may stand under this name.
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|key| key.is_called(name))
    }
}

/// This table and all that may stand in it, each once.
pub fn all_tables(root: &'static TableKind) -> Vec<&'static TableKind> {
    let mut all: Vec<&'static TableKind> = Vec::new();
    let mut next = vec![root];
    while let Some(kind) = next.pop() {
        if !all.iter().any(|known| std::ptr::eq(*known, kind)) {
            all.push(kind);
            next.extend(kind.keys.iter().rev().filter_map(|key| key.holds.table()));
        }
    }
    all
}
