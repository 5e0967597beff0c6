use std::collections::BTreeMap;
use std::ops::Range;

use nboom_scalar::Vec3;

use super::symbols::{Extent, Group, Numbering, SYMBOLS, Symbol};
use crate::diagnostic::Position;

/// The most segments or appendages a deck may have.
pub const LARGEST_COUNT: usize = 1000;

/// How long the arrays of a deck are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Sizes {
    pub segments: usize,
    pub appendages: usize,
}

impl Sizes {
    /// Lengths of arrays when &DIM does not say them.
    pub const LARGEST: Self = Self { segments: LARGEST_COUNT, appendages: LARGEST_COUNT };

    pub fn extents(self, symbol: &Symbol) -> Vec<usize> {
        let extent = |extent: &Extent| match extent {
            Extent::Fixed(count) => *count,
            Extent::Segments => self.segments,
            Extent::Appendages => self.appendages,
        };
        symbol.shape.iter().map(extent).collect()
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cell {
    pub value: f64,
    pub at: Position,
}

/// Name, segment and station.
pub(crate) type Key = (&'static str, usize, usize);

/// The key of a symbol whose name stands alone.
pub(crate) fn plain(name: &'static str) -> Key {
    (name, 0, 0)
}

#[derive(Clone, Debug)]
pub(crate) struct Array {
    pub cells: Vec<Option<Cell>>,
    /// Where the symbol is first assigned to.
    pub at: Position,
    /// Its values have an error, which has been reported.
    pub damaged: bool,
}

/// Everything a deck says.
#[derive(Clone, Debug, Default)]
pub(crate) struct Values {
    pub arrays: BTreeMap<Key, Array>,
    pub groups: BTreeMap<Group, Position>,
    /// Lengths of the arrays, once &DIM has said them.
    pub sizes: Option<Sizes>,
}

impl Values {
    pub fn array_mut(&mut self, key: Key, symbol: &Symbol, at: Position) -> &mut Array {
        let sizes = self.sizes.unwrap_or(Sizes::LARGEST);
        self.arrays.entry(key).or_insert_with(|| Array {
            cells: vec![None; sizes.extents(symbol).iter().product()],
            at,
            damaged: false,
        })
    }

    pub fn is_given(&self, name: &'static str) -> bool {
        self.arrays.contains_key(&plain(name))
    }

    pub fn is_damaged(&self, key: Key) -> bool {
        self.arrays.get(&key).is_some_and(|array| array.damaged)
    }

    pub fn cell(&self, key: Key, index: usize) -> Option<Cell> {
        *self.arrays.get(&key)?.cells.get(index)?
    }

    /// Element `index` in storage order, if it is given.
    pub fn get(&self, name: &'static str, index: usize) -> Option<f64> {
        self.cell(plain(name), index).map(|cell| cell.value)
    }

    /// Element `index` in storage order, or zero.
    pub fn real(&self, name: &'static str, index: usize) -> f64 {
        self.get(name, index).unwrap_or(0.0)
    }

    /// Elements in storage order, zero where they are not given.
    pub fn reals(&self, key: Key, range: Range<usize>) -> Vec<f64> {
        range.map(|index| self.cell(key, index).map_or(0.0, |cell| cell.value)).collect()
    }

    /// Column `column` of an array whose first subscript runs to 3, or zeros.
    pub fn vector(&self, name: &'static str, column: usize) -> Vec3<f64> {
        let component = |i| self.real(name, 3 * column + i);
        Vec3::new(component(0), component(1), component(2))
    }

    /// Whether the symbol has an element that is not zero.
    pub fn has_nonzero(&self, name: &'static str) -> bool {
        let cells = self.arrays.get(&plain(name)).map_or(&[][..], |array| &array.cells);
        cells.iter().flatten().any(|cell| cell.value != 0.0)
    }

    /// Whether the deck asks for stresses.
    pub fn wants_stresses(&self) -> bool {
        self.real("INSTR", 0) > 0.0
    }

    /// Whether stations are there and asked for, and with them the slices of all segments, which
    /// without `&DYNSTB` have no inertia of their own.
    pub fn has_slices(&self) -> bool {
        self.wants_stresses() && self.groups.contains_key(&Group::Dynsta)
    }

    /// Whether only its slices say how much mass segment `i`, from 0, has and where.
    pub fn is_by_slices(&self, i: usize) -> bool {
        let segments = self.sizes.map_or(0, |sizes| sizes.segments);
        let is_silent =
            |name, mut indices: Range<usize>| indices.all(|index| self.get(name, index).is_none());
        self.has_slices()
            && is_silent("EMIK", i..i + 1)
            && (0..3).all(|j| self.get("CNIK", i + j * segments).is_none())
            && is_silent("HIIK", 9 * i..9 * (i + 1))
    }

    /// The place of an element, or else of its symbol, of its group, or of the deck.
    pub fn position(&self, key: Key, index: usize) -> Position {
        let array = self.arrays.get(&key);
        let group = SYMBOLS.iter().find(|symbol| symbol.name == key.0).map(|symbol| symbol.group);
        self.cell(key, index)
            .map(|cell| cell.at)
            .or_else(|| array.map(|array| array.at))
            .or_else(|| self.groups.get(&group?).copied())
            .unwrap_or(Position::START)
    }

    /// The deck's name of an element: `HIIK(1,2,3)`.
    pub fn label(&self, key: Key, index: usize) -> String {
        let sizes = self.sizes.unwrap_or(Sizes::LARGEST);
        let symbol = SYMBOLS.iter().find(|symbol| symbol.name == key.0);
        let extents = symbol.map(|symbol| sizes.extents(symbol)).unwrap_or_default();
        full_name(key) + &subscripts(&extents, index)
    }
}

/// The name with its numbers: `DLI35`.
pub(crate) fn full_name((name, segment, station): Key) -> String {
    let numbering = SYMBOLS.iter().find(|s| s.name == name).map(|s| s.numbering);
    match numbering {
        Some(Numbering::Segment) => format!("{name}{segment}"),
        Some(Numbering::SegmentAndStation) => format!("{name}{segment}{station}"),
        _ => name.to_owned(),
    }
}

fn subscripts(extents: &[usize], mut index: usize) -> String {
    if extents.is_empty() {
        return String::new();
    }
    let mut subscripts = Vec::new();
    for &extent in extents {
        subscripts.push((index % extent.max(1) + 1).to_string());
        index /= extent.max(1);
    }
    format!("({})", subscripts.join(","))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_are_named_as_fortran_stores_them() {
        let values =
            Values { sizes: Some(Sizes { segments: 4, appendages: 2 }), ..Values::default() };
        assert_eq!(values.label(plain("HIIK"), 9 * 2 + 3), "HIIK(1,2,3)");
        assert_eq!(values.label(plain("QNIK"), 6), "QNIK(3,2)");
        assert_eq!(values.label(plain("EMM"), 0), "EMM");
        assert_eq!(values.label(("DLI", 15, 4), 1), "DLI154(2,1)");
        assert_eq!(values.label(("T", 3, 0), 6), "T3(1,2)");
    }
}
