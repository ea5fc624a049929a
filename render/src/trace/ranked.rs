//! Volumes that may overlap, in the order of their precedence.
//!
//! Nearly all rays are in few volumes, which are searched one by one. For more than [`FEW`] volumes
//! an index is built, so that a step takes at most the logarithm of their number.

use super::medium::Medium;
use std::collections::BTreeMap;

/// Largest number of volumes that are searched without an index.
///
/// If larger, rays through thousands of volumes become slower. If smaller, rays through a handful
/// of volumes become slower.
const FEW: usize = 16;

/// Precedence of a volume: the highest priority first, and of equal priorities the volume entered
/// last.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Rank {
    /// Priority of the volume's material.
    pub priority: u8,
    /// Order of entry: a larger number is later.
    pub order: u64,
}

/// Volumes, at most one for each object.
#[derive(Debug, Clone, Default)]
pub struct Ranked {
    few: Vec<(Rank, Medium)>,
    /// All volumes if there are many; `few` is then empty.
    many: Option<Box<Many>>,
}

/// An index over many volumes.
#[derive(Debug, Clone, Default)]
struct Many {
    by_rank: BTreeMap<Rank, Medium>,
    of_object: BTreeMap<u32, Rank>,
}

impl Ranked {
    /// Number of volumes.
    #[must_use]
    pub fn len(&self) -> usize {
        self.many.as_ref().map_or(self.few.len(), |many| many.by_rank.len())
    }

    /// Returns whether there are no volumes.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the rank of an object's volume, if the list contains it.
    #[must_use]
    pub fn rank_of(&self, object: u32) -> Option<Rank> {
        match &self.many {
            Some(many) => many.of_object.get(&object).copied(),
            None => self.few.iter().find(|(_, m)| m.object == object).map(|(rank, _)| *rank),
        }
    }

    /// Returns the volume of the highest rank.
    #[must_use]
    pub fn first(&self) -> Option<(Rank, Medium)> {
        match &self.many {
            Some(many) => many.by_rank.iter().next_back().map(|(rank, medium)| (*rank, *medium)),
            None => self.few.iter().copied().max_by_key(|(rank, _)| *rank),
        }
    }

    /// Returns the volume of the highest rank among those of other objects.
    #[must_use]
    pub fn first_but(&self, object: u32) -> Option<(Rank, Medium)> {
        match &self.many {
            Some(many) => {
                // The object has at most one volume, so two steps suffice.
                let mut all = many.by_rank.iter().rev();
                let other = all.find(|(_, medium)| medium.object != object);
                other.map(|(rank, medium)| (*rank, *medium))
            }
            None => {
                let others = self.few.iter().filter(|(_, medium)| medium.object != object);
                others.copied().max_by_key(|(rank, _)| *rank)
            }
        }
    }

    /// Adds a volume whose object has none yet.
    pub fn insert(&mut self, rank: Rank, medium: Medium) {
        if self.many.is_none() && self.few.len() >= FEW {
            let mut many = Many::default();
            self.few.drain(..).for_each(|(rank, medium)| many.insert(rank, medium));
            self.many = Some(Box::new(many));
        }
        match &mut self.many {
            Some(many) => many.insert(rank, medium),
            None => self.few.push((rank, medium)),
        }
    }

    /// Removes the volume of an object, if the list contains it, and returns it.
    pub fn remove(&mut self, object: u32) -> Option<(Rank, Medium)> {
        if let Some(many) = &mut self.many {
            let rank = many.of_object.remove(&object)?;
            return many.by_rank.remove(&rank).map(|medium| (rank, medium));
        }
        let at = self.few.iter().position(|(_, medium)| medium.object == object)?;
        Some(self.few.swap_remove(at))
    }
}

impl Many {
    fn insert(&mut self, rank: Rank, medium: Medium) {
        self.by_rank.insert(rank, medium);
        self.of_object.insert(medium.object, rank);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Compares with a plain list, below and above the number of volumes at which the index
        /// begins.
        #[test]
        fn few_and_many_volumes_are_ranked_alike(
            steps in prop::collection::vec((0u32..40, 0u8..3, any::<bool>()), 1..200),
        ) {
            let mut ranked = Ranked::default();
            let mut list: Vec<(Rank, Medium)> = Vec::new();
            for (order, (object, priority, enters)) in (0..).zip(steps) {
                let gone = list.iter().position(|(_, medium)| medium.object == object);
                prop_assert_eq!(ranked.rank_of(object), gone.map(|at| list[at].0));
                prop_assert_eq!(ranked.remove(object), gone.map(|at| list.remove(at)));
                if enters {
                    let (rank, medium) = (Rank { priority, order }, Medium { object, material: 0 });
                    ranked.insert(rank, medium);
                    list.push((rank, medium));
                }
                let most = |but: Option<u32>| {
                    let others = list.iter().filter(|(_, medium)| Some(medium.object) != but);
                    others.copied().max_by_key(|(rank, _)| *rank)
                };
                prop_assert_eq!(ranked.first(), most(None));
                prop_assert_eq!(ranked.first_but(7), most(Some(7)));
                prop_assert_eq!(ranked.len(), list.len());
            }
        }
    }
}
