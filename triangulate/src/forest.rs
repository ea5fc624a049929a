//! Groups of members, each of which has either the orientation of its group or the opposite one.
//!
//! The method is the disjoint sets of Galler and Fischer with path halving, with one parity bit on each
//! link. Without parities it finds connected components. With parities it finds whether a surface is
//! orientable.

/// Disjoint groups of the members `0..count`.
#[derive(Debug)]
pub struct Forest {
    links: Vec<Link>,
}

/// A link to another member of the group. The root's link leads to itself.
#[derive(Debug, Clone, Copy)]
struct Link {
    to: usize,
    turned: bool,
}

impl Forest {
    /// Returns `count` groups of one member each.
    pub fn new(count: usize) -> Self {
        Self { links: (0..count).map(|to| Link { to, turned: false }).collect() }
    }

    /// Returns the root of the group of `of`, and whether `of` is turned against the root.
    pub fn root(&mut self, mut of: usize) -> (usize, bool) {
        let mut turned = false;
        loop {
            let Link { to: up, turned: first } = self.links[of];
            if up == of {
                return (of, turned);
            }
            // Links to the grandparent: the next search takes half as many steps.
            let Link { to: top, turned: second } = self.links[up];
            self.links[of] = Link { to: top, turned: first ^ second };
            turned ^= first ^ second;
            of = top;
        }
    }

    /// Joins the groups of `a` and `b` so that the two are turned against each other exactly if
    /// `turned`. Returns false when both were in one group already with the opposite relation.
    pub fn join(&mut self, a: usize, b: usize, turned: bool) -> bool {
        let ((a, a_turned), (b, b_turned)) = (self.root(a), self.root(b));
        let turned = turned ^ a_turned ^ b_turned;
        if a != b {
            self.links[a] = Link { to: b, turned };
        }
        a != b || !turned
    }

    /// Returns the number of groups.
    pub fn groups(&self) -> usize {
        self.links.iter().enumerate().filter(|(member, link)| link.to == *member).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_closes_when_it_is_turned_an_even_number_of_times() {
        for count in [3, 4, 100, 101] {
            for (every, fits) in [(false, true), (true, count % 2 == 0)] {
                let mut ring = Forest::new(count);
                for member in 1..count {
                    assert!(ring.join(member - 1, member, every));
                }
                assert_eq!(ring.groups(), 1);
                let (first, last) = (ring.root(0).1, ring.root(count - 1).1);
                assert_eq!(first != last, every && count % 2 == 0);
                assert_eq!(ring.join(count - 1, 0, every), fits);
            }
        }
    }

    #[test]
    fn what_was_not_joined_stays_apart() {
        let mut forest = Forest::new(5);
        assert!(forest.join(0, 3, false) && forest.join(4, 1, true) && forest.join(3, 0, false));
        assert_eq!(forest.groups(), 3);
        assert_eq!(forest.root(0), forest.root(3));
        assert_ne!(forest.root(1).0, forest.root(2).0);
    }
}
