use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// A part of a sweep: consecutive cases, so that all parts together are the sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Shard {
    number: u64,
    of: u64,
}

/// A text is no shard.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{found}` found, a part of all such as 2/5 expected, of at least 1 and at most 1000000")]
pub struct NoSuchShard {
    found: String,
}

/// The most parts of a sweep.
const MOST: u64 = 1_000_000;

impl Shard {
    /// Which one it is, from 1.
    pub fn number(self) -> u64 {
        self.number
    }

    /// How many there are.
    pub fn of(self) -> u64 {
        self.of
    }

    /// Its share of so many cases; empty if there are fewer cases than shards.
    pub fn range(self, cases: u64) -> RangeInclusive<u64> {
        let up_to = |number: u64| u128::from(cases) * u128::from(number) / u128::from(self.of);
        let up_to = |number| u64::try_from(up_to(number)).unwrap_or(cases);
        up_to(self.number - 1) + 1..=up_to(self.number)
    }
}

impl FromStr for Shard {
    type Err = NoSuchShard;

    fn from_str(text: &str) -> Result<Self, NoSuchShard> {
        let numbers = text.split_once('/');
        let numbers =
            numbers.and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        let known = numbers.filter(|(number, of)| 1 <= *number && number <= of && *of <= MOST);
        let shard = known.map(|(number, of)| Self { number, of });
        shard.ok_or_else(|| NoSuchShard { found: text.chars().take(40).collect() })
    }
}

impl TryFrom<String> for Shard {
    type Error = NoSuchShard;

    fn try_from(text: String) -> Result<Self, NoSuchShard> {
        text.parse()
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_all_cases_once() {
        for cases in [0, 1, 5, 100, (1 << 53) - 1] {
            for of in [1, 2, 3, 7, 1000] {
                let mut next = 1;
                for number in 1..=of {
                    let range = Shard { number, of }.range(cases);
                    assert_eq!(*range.start(), next);
                    let size = range.end() + 1 - range.start();
                    assert!((cases / of..=cases.div_ceil(of)).contains(&size));
                    next = range.end() + 1;
                }
                assert_eq!(next, cases + 1);
            }
        }
    }

    #[test]
    fn texts_that_are_no_shards_are_refused() {
        assert_eq!("2/5".parse(), Ok(Shard { number: 2, of: 5 }));
        for text in ["", "1", "0/3", "4/3", "1/0", "-1/3", "1/3/3", "1/1000001", "a/b"] {
            text.parse::<Shard>().expect_err(text);
        }
    }
}
