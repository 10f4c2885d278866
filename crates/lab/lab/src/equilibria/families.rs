//! Families of equilibria: one entry of the list each, whichever of their members are found.

use motiform_analysis::RelativeEquilibrium;
use motiform_dynamics::Model;

/// The members of one family that are known.
#[derive(Debug)]
struct Family {
    /// The place of its entry in the list.
    place: usize,
    first: RelativeEquilibrium,
    others: Vec<RelativeEquilibrium>,
}

/// The families that are known.
#[derive(Debug, Default)]
pub(super) struct Families(Vec<Family>);

impl Families {
    /// The place of the entry whose family this equilibrium belongs to; `None` where it is alone, or of another family.
    ///
    /// Along the family the way from the nearest known member is tried first: the more of them are known, the shorter it is.
    pub(super) fn place_of(&mut self, model: &dyn Model, new: &RelativeEquilibrium) -> Option<usize> {
        if new.vanishing_count() == 0 {
            return None;
        }
        let near = self.0.iter().position(|family| family.nearest(model, new).leads_to(model, new));
        let known =
            near.or_else(|| self.0.iter().position(|family| family.first.is_in_family_of(model, new)));
        let family = &mut self.0[known?];
        family.others.push(new.clone());
        Some(family.place)
    }

    /// Takes in the first known member of a family, whose entry is at this place.
    pub(super) fn begin(&mut self, place: usize, first: &RelativeEquilibrium) {
        self.0.push(Family { place, first: first.clone(), others: Vec::new() });
    }
}

impl Family {
    fn nearest(&self, model: &dyn Model, new: &RelativeEquilibrium) -> &RelativeEquilibrium {
        let away = |one: &RelativeEquilibrium| new.distance(model, &one.shape);
        let nearer = |best, one| if away(one) < away(best) { one } else { best };
        self.others.iter().fold(&self.first, nearer)
    }
}
