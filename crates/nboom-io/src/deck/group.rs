use super::lexer::{Kind, Lexer, Token};
use super::names;
use super::number::Reading;
use super::symbols::Group;
use super::values::{LARGEST_COUNT, Sizes, Values, plain};
use crate::diagnostic::{Position, Report, quoted};

/// The symbol in messages about the deck as a whole.
const DECK: &str = "deck";

/// Reads groups and assignments into [`Values`], one token ahead.
pub(crate) struct Reader<'t, 'r, 'f> {
    lexer: Lexer<'t>,
    pub token: Token<'t>,
    pub values: Values,
    pub report: &'r mut Report<'f>,
    /// How many elements have been assigned.
    pub assigned: usize,
}

/// All that a deck says; unreadable parts are reported and left out.
pub(crate) fn read(text: &str, report: &mut Report<'_>) -> Values {
    let mut lexer = Lexer::new(text);
    let token = lexer.next_token();
    let mut reader = Reader { lexer, token, values: Values::default(), report, assigned: 0 };
    let mut last = None;
    while reader.find_mark() {
        reader.group(&mut last);
    }
    reader.report_absent_groups();
    reader.values
}

impl<'t> Reader<'t, '_, '_> {
    /// Returns the token at hand and takes the next one.
    pub fn advance(&mut self) -> Token<'t> {
        let next = self.lexer.next_token();
        std::mem::replace(&mut self.token, next)
    }

    /// Whether there is nothing more to read, or no use in reading on.
    fn is_done(&self) -> bool {
        self.token.kind == Kind::End || self.report.is_full()
    }

    /// Skips everything up to the next assignment or group mark.
    pub fn skip_to_name(&mut self) {
        while !matches!(self.token.kind, Kind::Name | Kind::Mark | Kind::End) {
            self.advance();
        }
    }

    /// Goes to the next group mark; the original skipped cards between the groups.
    fn find_mark(&mut self) -> bool {
        let first = self.token;
        let mut assignment = None;
        while !self.is_done() && self.token.kind != Kind::Mark {
            let token = self.advance();
            if token.kind == Kind::Name {
                assignment.get_or_insert(token);
            }
        }
        let expected = "a group such as &DIM";
        if let Some(token) = assignment {
            let found = format!("{} outside of a group", quoted(token.text));
            self.report.error(token.at, DECK, found, expected);
        } else if !matches!(first.kind, Kind::Mark | Kind::End) {
            let found = format!("{} outside of a group", quoted(first.text));
            self.report.warn(first.at, DECK, found, format!("{expected}; it is ignored"));
        }
        !self.is_done()
    }

    /// Reads from the mark of a group to its &END.
    fn group(&mut self, last: &mut Option<Group>) {
        let mark = self.advance();
        self.check_column(mark);
        let Some(group) = self.open(mark) else {
            self.skip_group();
            return;
        };
        self.check_order(mark.at, group, *last);
        self.values.groups.entry(group).or_insert(mark.at);
        self.body(group);
        if group == Group::Dim && last.is_none() {
            self.values.sizes = sizes(&self.values, self.report);
        }
        *last = Some(group.max(last.unwrap_or(group)));
    }

    fn check_column(&mut self, mark: Token<'_>) {
        if mark.at.column != 2 {
            let found = format!("a group mark in column {}", mark.at.column);
            let symbol = format!("&{}", mark.text.to_uppercase());
            self.report.warn(mark.at, &symbol, found, "column 2; it is accepted");
        }
    }

    fn open(&mut self, mark: Token<'_>) -> Option<Group> {
        match names::find_group(mark.text) {
            Some(Reading::Plain(group)) => Some(group),
            Some(Reading::Repaired(group)) => {
                let expected = format!("{}; it is read as that", group.name());
                self.report.warn(mark.at, group.name(), quoted(mark.text), expected);
                Some(group)
            }
            None => {
                let found = quoted(&format!("&{}", mark.text));
                let known = Group::ALL.map(Group::name).join(", ");
                self.report.error(mark.at, DECK, found, format!("one of the groups {known}"));
                None
            }
        }
    }

    fn skip_group(&mut self) {
        while self.token.kind != Kind::Mark && !self.is_done() {
            self.advance();
        }
        if is_end(self.token) {
            self.advance();
        }
    }

    fn check_order(&mut self, at: Position, group: Group, last: Option<Group>) {
        let name = group.name();
        if self.values.groups.contains_key(&group) {
            self.report.error(at, name, format!("{name} once more"), "each group once");
        } else if let Some(last) = last.filter(|last| *last > group) {
            let found = format!("{name} after {}", last.name());
            let order = Group::ALL.map(Group::name).join(", ");
            self.report.error(at, name, found, format!("the order {order}"));
        }
    }

    fn body(&mut self, group: Group) {
        while !self.report.is_full() {
            match self.token.kind {
                Kind::Name => self.assignment(group),
                Kind::Mark if is_end(self.token) => {
                    let end = self.advance();
                    self.check_column(end);
                    return;
                }
                Kind::Mark | Kind::End => {
                    let found = match self.token.kind {
                        Kind::Mark => format!("`&{}`", self.token.text),
                        _ => "the end of the file".to_owned(),
                    };
                    self.report.error(self.token.at, group.name(), found, "&END before it");
                    return;
                }
                _ => {
                    let expected = "a symbol followed by =, or &END";
                    let found = quoted(self.token.text);
                    self.report.error(self.token.at, group.name(), found, expected);
                    self.skip_to_name();
                }
            }
        }
    }

    fn report_absent_groups(&mut self) {
        for group in Group::ALL {
            if !group.may_be_absent() && !self.values.groups.contains_key(&group) {
                let expected = format!("the group {}", group.name());
                self.report.error(self.token.at, group.name(), "the end of the deck", expected);
            }
        }
    }
}

fn is_end(token: Token<'_>) -> bool {
    token.kind == Kind::Mark && token.text.eq_ignore_ascii_case("END")
}

/// Lengths of the arrays; `None` when &DIM does not say them.
fn sizes(values: &Values, report: &mut Report<'_>) -> Option<Sizes> {
    let segments = size(values, "IXK", report);
    let appendages = size(values, "NA", report);
    Some(Sizes { segments: segments?, appendages: appendages? })
}

fn size(values: &Values, name: &'static str, report: &mut Report<'_>) -> Option<usize> {
    let value = values.get(name, 0)?;
    if (0.0..=LARGEST_COUNT as f64).contains(&value) {
        return Some(value as usize);
    }
    let at = values.position(plain(name), 0);
    report.error(at, name, super::shown(value), format!("a number from 0 to {LARGEST_COUNT}"));
    None
}
