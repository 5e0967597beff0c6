/// A named group of numbers, or the same for several links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group {
    /// Name.
    pub name: &'static str,
    /// What the numbers of one are called.
    pub numbers: &'static [&'static str],
    /// Whose these are, counted from 1, and of how many; those of one alone are not counted.
    links: Option<(usize, usize)>,
}

impl Group {
    pub(super) const fn new(name: &'static str, numbers: &'static [&'static str]) -> Self {
        Self { name, numbers, links: None }
    }

    /// The same numbers for each of `count` links from link `first` on.
    pub(super) const fn of_links(self, first: usize, count: usize) -> Self {
        Self { links: Some((first, count)), ..self }
    }

    /// How many numbers it has.
    pub fn size(self) -> usize {
        self.links.map_or(1, |(_, count)| count) * self.numbers.len()
    }

    /// What each of its numbers is called.
    pub fn names(self) -> Vec<String> {
        let plain = || self.numbers.iter().map(|&name| name.to_owned()).collect();
        let of_link = |link: usize| self.numbers.iter().map(move |name| format!("{name}_{link}"));
        self.links
            .map_or_else(plain, |(first, count)| (first..first + count).flat_map(of_link).collect())
    }
}
