//! Parts of a limb that are equal and hang side by side on one link, as arms on a torso do.

use crate::limb::{Limb, LimbJoint, LimbLink};

/// Equal parts of a limb that hang on one of its links, one after the other in its order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EqualParts {
    /// The link that carries them.
    pub carrier: usize,
    /// The first link of the first of them.
    pub first: usize,
    /// How many they are, at least two.
    pub count: usize,
    /// Each of them, as a limb of its own.
    pub part: Limb,
}

impl EqualParts {
    /// Whether a link belongs to one of them.
    pub fn contains(&self, link: usize) -> bool {
        (self.first..self.first + self.count * self.part.links().len()).contains(&link)
    }
}

impl Limb {
    /// All equal parts but those within others.
    ///
    /// Parts that begin with a joint parallel to that of their carrier are none: their axes are the carrier's.
    pub fn equal_parts(&self) -> Vec<EqualParts> {
        let sizes = self.sizes();
        let mut found: Vec<EqualParts> = Vec::new();
        let mut first = 1;
        while let Some(link) = self.links.get(first) {
            let size = sizes[first];
            let part = self.part(first, size);
            let is_equal = |&root: &usize| {
                let next = self.links.get(root);
                next.is_some_and(|next| next.inboard == link.inboard)
                    && sizes[root] == size
                    && self.part(root, size).eq(self.part(first, size))
            };
            let count = (first..).step_by(size).take_while(is_equal).count();
            let carrier = link.inboard.map_or(0, usize::from);
            let are_equal = link.joint != LimbJoint::Parallel && count > 1;
            if are_equal {
                found.push(EqualParts {
                    carrier,
                    first,
                    count,
                    part: Self { links: part.collect() },
                });
            }
            first += if are_equal { count * size } else { 1 };
        }
        found
    }

    /// How many links the part has that begins with each link.
    fn sizes(&self) -> Vec<usize> {
        let mut sizes = vec![1; self.links.len()];
        for (i, link) in self.links.iter().enumerate().rev() {
            if let Some(inboard) = link.inboard {
                sizes[usize::from(inboard)] += sizes[i];
            }
        }
        sizes
    }

    /// The links of the part that begins with link `root`, numbered from there.
    fn part(&self, root: usize, size: usize) -> impl Iterator<Item = LimbLink> {
        let from_root = move |link: &LimbLink| {
            let inboard = link.inboard.and_then(|inboard| inboard.checked_sub(root as u16));
            LimbLink { inboard, joint: link.joint }
        };
        self.links[root..root + size].iter().map(from_root)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(name: &str) -> Vec<(usize, usize, usize, String)> {
        let found = Limb::named(name).expect("a limb").equal_parts().into_iter();
        found
            .map(|parts| (parts.carrier, parts.first, parts.count, parts.part.to_string()))
            .collect()
    }

    #[test]
    fn parts_are_equal_whole_and_side_by_side() {
        assert_eq!(parts("Trr(rps)(rps)(sr)"), [(1, 2, 2, "Trps".to_owned())]);
        assert_eq!(parts("Tr(rr)(r)(r)(r)"), [(0, 3, 3, "Tr".to_owned())]);
        assert_eq!(parts("Trp(rr(s)(s))(pp)(pp)(rr)"), [(3, 4, 2, "Ts".to_owned())]);
        assert_eq!(parts("Trrrp"), []);
    }

    #[test]
    fn parts_within_equal_parts_are_theirs() {
        let found = [(0, 1, 2, "Tr(rr)(rr)".to_owned())];
        assert_eq!(parts("Tr(r(rr)(rr))(r(rr)(rr))"), found);
        let deep = [(1, 2, 2, "Trr".to_owned()), (0, 6, 2, "Tsr".to_owned())];
        assert_eq!(parts("Tr(r(rr)(rr))(sr)(sr)"), deep);
    }

    #[test]
    fn equal_parts_on_different_links_are_apart() {
        assert_eq!(parts("Tr(rrr)(rrs)"), []);
        assert_eq!(parts("Tr(sr)(sr)"), [(0, 1, 2, "Tsr".to_owned())]);
    }
}
