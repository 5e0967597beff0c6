use std::ops::Range;

use super::group::Reader;
use super::lexer::{Kind, Token};
use super::number::{self, NotANumber, Reading};
use super::symbols::{Extent, Group, NumberKind, Numbering, Symbol};
use super::values::{Array, Cell, Key, Sizes, full_name};
use super::{names, shown};
use crate::diagnostic::{Position, Report, quoted};

/// Stations of a segment, at most.
pub(crate) const MOST_STATIONS: usize = 5;

/// Most elements that a deck may assign in all; twenty times what the largest deck can use.
const MOST_ASSIGNED: usize = 4_000_000;

/// Something is wrong and has been reported.
struct Reported;

/// The target of an assignment.
struct Target {
    symbol: &'static Symbol,
    key: Key,
    at: Position,
    extents: Vec<usize>,
}

impl Target {
    fn len(&self) -> usize {
        self.extents.iter().product()
    }
}

/// `count` times a value, or a null.
struct Item {
    count: u64,
    value: Option<f64>,
    at: Position,
}

impl Reader<'_, '_, '_> {
    /// Reads `NAME=values` or `NAME(subscripts)=values` up to the next name or mark.
    pub fn assignment(&mut self, group: Group) {
        let name = self.advance();
        let Ok(target) = self.target(group, name) else {
            self.skip_to_name();
            return;
        };
        if self.elements(&target).and_then(|range| self.items(&target, range)).is_err() {
            self.array(&target).damaged = true;
            self.skip_to_name();
        }
    }

    fn array(&mut self, target: &Target) -> &mut Array {
        self.values.array_mut(target.key, target.symbol, target.at)
    }

    fn error(&mut self, at: Position, symbol: &str, found: String, expected: String) -> Reported {
        self.report.error(at, symbol, found, expected);
        Reported
    }

    fn target(&mut self, group: Group, name: Token<'_>) -> Result<Target, Reported> {
        let Some(reading) = names::find(name.text) else {
            let expected = match names::suggestion(name.text) {
                Some(near) => format!("a symbol of the deck, such as {near}"),
                None => "a symbol of the deck".to_owned(),
            };
            return Err(self.error(name.at, group.name(), quoted(name.text), expected));
        };
        let (Reading::Plain(found) | Reading::Repaired(found)) = reading;
        let symbol = found.symbol;
        let sizes = self.values.sizes.unwrap_or(Sizes::LARGEST);
        let (segment, station) = self.check_numbers(name, &found, sizes)?;
        let key = (symbol.name, segment, station);
        if matches!(reading, Reading::Repaired(_)) {
            let expected = format!("{}; it is read as that", full_name(key));
            self.report.warn(name.at, &full_name(key), quoted(name.text), expected);
        }
        if symbol.group != group {
            let expected = format!("it in {}", symbol.group.name());
            let found = format!("it in {}", group.name());
            return Err(self.error(name.at, &full_name(key), found, expected));
        }
        Ok(Target { symbol, key, at: name.at, extents: sizes.extents(symbol) })
    }

    /// The numbers that are part of a name, in range.
    fn check_numbers(
        &mut self,
        token: Token<'_>,
        name: &names::Name,
        sizes: Sizes,
    ) -> Result<(usize, usize), Reported> {
        let symbol = name.symbol.name;
        let mut check = |what: &str, number: u64, most: usize| {
            if (1..=most as u64).contains(&number) {
                return Ok(number as usize);
            }
            let expected = format!("a {what} from 1 to {most}");
            Err(self.error(token.at, symbol, format!("{what} {number}"), expected))
        };
        Ok(match name.symbol.numbering {
            Numbering::None => (0, 0),
            Numbering::Segment => (check("segment", name.segment, sizes.segments)?, 0),
            Numbering::SegmentAndStation => {
                let segment = check("segment", name.segment, sizes.segments)?;
                (segment, check("station", name.station, MOST_STATIONS)?)
            }
        })
    }

    /// Which elements, in storage order, the values after `=` may fill.
    fn elements(&mut self, target: &Target) -> Result<Range<usize>, Reported> {
        let name = full_name(target.key);
        let range = if self.token.kind == Kind::LeftParenthesis {
            let at = self.token.at;
            let subscripts = self.subscripts(target)?;
            if subscripts.len() != target.extents.len() {
                let found = format!("{} subscripts", subscripts.len());
                let expected = target.extents.len().to_string();
                return Err(self.error(at, &name, found, expected));
            }
            range_from(target, &subscripts)
        } else if target.symbol.needs_subscripts() {
            let expected = format!("subscripts, as in {name}(1,1)=");
            let found = "an assignment to the whole array".to_owned();
            return Err(self.error(target.at, &name, found, expected));
        } else {
            0..target.len()
        };
        let token = self.advance();
        if token.kind != Kind::Equals {
            return Err(self.error(token.at, &name, quoted(token.text), "`=`".to_owned()));
        }
        Ok(range)
    }

    /// `(i,j,..)`, each from 1.
    fn subscripts(&mut self, target: &Target) -> Result<Vec<usize>, Reported> {
        let mut subscripts = Vec::new();
        loop {
            // The opening parenthesis or a comma.
            self.advance();
            let most = target.extents.get(subscripts.len()).copied();
            subscripts.push(self.subscript(target, most)?);
            match self.token.kind {
                Kind::Comma if subscripts.len() <= target.extents.len() => {}
                Kind::RightParenthesis => {
                    self.advance();
                    return Ok(subscripts);
                }
                _ => {
                    let name = full_name(target.key);
                    let (at, found) = (self.token.at, quoted(self.token.text));
                    return Err(self.error(at, &name, found, "`)`".to_owned()));
                }
            }
        }
    }

    fn subscript(&mut self, target: &Target, most: Option<usize>) -> Result<usize, Reported> {
        let token = self.advance();
        let name = full_name(target.key);
        let Ok(Reading::Plain(number) | Reading::Repaired(number)) = number::count(token.text)
        else {
            let expected = "a subscript".to_owned();
            return Err(self.error(token.at, &name, quoted(token.text), expected));
        };
        // One subscript too many is reported as such by the caller.
        let most = most.unwrap_or(usize::MAX);
        if (1..=most as u64).contains(&number) {
            return Ok(number as usize);
        }
        let expected = format!("a subscript from 1 to {most}");
        Err(self.error(token.at, &name, number.to_string(), expected))
    }

    fn items(&mut self, target: &Target, range: Range<usize>) -> Result<(), Reported> {
        let mut next = range.start;
        let mut separated = true;
        if matches!(self.token.kind, Kind::Name | Kind::Mark | Kind::End) {
            let expected = "a number".to_owned();
            let found = "no value".to_owned();
            return Err(self.error(target.at, &full_name(target.key), found, expected));
        }
        loop {
            let token = self.token;
            let item = match token.kind {
                Kind::Comma => {
                    self.advance();
                    let null = Item { count: 1, value: None, at: token.at };
                    std::mem::replace(&mut separated, true).then_some(null)
                }
                Kind::Word => {
                    self.check_separator(target, token, separated)?;
                    separated = false;
                    Some(self.item(target, next)?)
                }
                Kind::Name | Kind::Mark | Kind::End => return Ok(()),
                _ => {
                    let (name, found) = (full_name(target.key), quoted(token.text));
                    let expected = "a number, a comma or the next symbol".to_owned();
                    return Err(self.error(token.at, &name, found, expected));
                }
            };
            if let Some(item) = item {
                next = self.store(target, &range, next, &item)?;
            }
        }
    }

    /// Values are separated by commas, by new cards or, with a warning, by blanks.
    fn check_separator(
        &mut self,
        target: &Target,
        token: Token<'_>,
        separated: bool,
    ) -> Result<(), Reported> {
        if separated {
            return Ok(());
        }
        let name = full_name(target.key);
        if token.glued {
            let expected = "a comma before it".to_owned();
            return Err(self.error(token.at, &name, quoted(token.text), expected));
        }
        if !token.first_on_card {
            let found = format!("a blank before {}", quoted(token.text));
            self.report.warn(token.at, &name, found, "a comma; it is read as one");
        }
        Ok(())
    }

    /// A value, `n*value` or `n*`.
    fn item(&mut self, target: &Target, index: usize) -> Result<Item, Reported> {
        let first = self.advance();
        let at = first.at;
        if self.token.kind != Kind::Star {
            return Ok(Item { count: 1, value: self.value(target, first, index)?, at });
        }
        self.advance();
        let count = self.repetition(target, first)?;
        let value = match self.token.kind {
            Kind::Word => {
                let word = self.advance();
                self.value(target, word, index)?
            }
            _ => None,
        };
        Ok(Item { count, value, at })
    }

    fn repetition(&mut self, target: &Target, word: Token<'_>) -> Result<u64, Reported> {
        let name = full_name(target.key);
        match number::count(word.text) {
            Ok(Reading::Plain(count)) if count > 0 => Ok(count),
            Ok(Reading::Repaired(count)) if count > 0 => {
                warn_of_letter_o(self.report, word, &name, &count.to_string());
                Ok(count)
            }
            _ => {
                let expected = "a positive integer before `*`".to_owned();
                Err(self.error(word.at, &name, quoted(word.text), expected))
            }
        }
    }

    /// The number that a word stands for. A word that only looks like a number is reported, and its
    /// element left out; a word of letters ends the assignment.
    fn value(
        &mut self,
        target: &Target,
        word: Token<'_>,
        index: usize,
    ) -> Result<Option<f64>, Reported> {
        let integer = target.symbol.kind == NumberKind::Integer;
        let expected = match number::real(word.text) {
            Ok(Reading::Plain(value) | Reading::Repaired(value))
                if integer && value.fract() != 0.0 =>
            {
                "an integer"
            }
            Ok(Reading::Plain(value)) => return Ok(Some(value)),
            Ok(Reading::Repaired(value)) => {
                let name = self.element_name(target, index);
                warn_of_letter_o(self.report, word, &name, &shown(value));
                return Ok(Some(value));
            }
            Err(NotANumber::Range) => "a number below 1.8e308",
            Err(NotANumber::Form) => "a finite number",
        };
        let name = self.element_name(target, index);
        let reported = self.error(word.at, &name, quoted(word.text), expected.to_owned());
        self.array(target).damaged = true;
        if word.text.starts_with(char::is_alphabetic) { Err(reported) } else { Ok(None) }
    }

    fn element_name(&self, target: &Target, index: usize) -> String {
        if index < target.len() {
            self.values.label(target.key, index)
        } else {
            full_name(target.key)
        }
    }

    /// Puts an item into the array and returns the index after it.
    fn store(
        &mut self,
        target: &Target,
        range: &Range<usize>,
        next: usize,
        item: &Item,
    ) -> Result<usize, Reported> {
        let room = (range.end - next) as u64;
        // A null beyond the end has no element to leave as it is.
        let Some(value) = item.value else { return Ok(next + item.count.min(room) as usize) };
        if item.count > room {
            return Err(self.report_excess(target, range, item.at));
        }
        let end = next + item.count as usize;
        self.spend(target, end - next, item.at)?;
        for index in next..end {
            let cell = Cell { value, at: item.at };
            let old = self.array(target).cells[index].replace(cell);
            if let Some(old) = old.filter(|old| old.value != value) {
                let name = self.values.label(target.key, index);
                let found =
                    format!("{} after {} in line {}", shown(value), shown(old.value), old.at.line);
                self.report.warn(item.at, &name, found, "one value; the later one holds");
            }
        }
        Ok(end)
    }

    /// A short text could assign thousands of elements over and over; this limit ends it.
    fn spend(&mut self, target: &Target, count: usize, at: Position) -> Result<(), Reported> {
        self.assigned += count;
        if self.assigned <= MOST_ASSIGNED {
            return Ok(());
        }
        let found = format!("more than {MOST_ASSIGNED} values in the deck");
        Err(self.error(at, &full_name(target.key), found, "fewer".to_owned()))
    }

    fn report_excess(&mut self, target: &Target, range: &Range<usize>, at: Position) -> Reported {
        let room = range.len();
        let column = if target.symbol.needs_subscripts() {
            "; the next column needs its own subscripts"
        } else {
            ""
        };
        let found = format!("more than {room} values");
        let expected = format!("at most {room}{column}");
        self.error(at, &full_name(target.key), found, expected)
    }
}

/// From the element with these subscripts to the end of the array; or, if the array's stride is not
/// known, to the end of the column.
fn range_from(target: &Target, subscripts: &[usize]) -> Range<usize> {
    let (mut start, mut stride) = (0, 1);
    for (subscript, extent) in subscripts.iter().zip(&target.extents) {
        start += (subscript - 1) * stride;
        stride *= extent;
    }
    let end = match target.symbol.shape {
        [Extent::Segments, _, ..] => (subscripts[1]) * target.extents[0],
        _ => target.len(),
    };
    start..end
}

fn warn_of_letter_o(report: &mut Report<'_>, word: Token<'_>, name: &str, value: &str) {
    let expected = format!("the digit 0 for the letter O; it is read as {value}");
    report.warn(word.at, name, quoted(word.text), expected);
}
