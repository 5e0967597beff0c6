//! What the steps of a chain hand on, as numbers one after the other.

use nboom_scalar::{Real, Sym3, Vec3};

use crate::chain::{ChainLink, Eliminated, Turned};
use crate::parameters::Reader;

type Numbers<'a, R> = Reader<std::iter::Copied<std::slice::Iter<'a, R>>>;

impl<R: Real> Turned<R> {
    /// The numbers that vary; mass, hinge-axis moment and first component stay constants.
    pub(crate) fn flat(&self) -> Vec<R> {
        let k = &self.about_hinge;
        let mut flat = vec![self.first_moment.y, self.first_moment.z];
        flat.extend([k.yy, k.zz, k.xy, k.xz, k.yz]);
        flat.extend(self.next);
        flat.extend(self.moment.to_array());
        flat.extend(self.force.to_array());
        flat
    }

    pub(crate) fn read(link: &ChainLink<R>, reader: &mut Numbers<'_, R>) -> Self {
        let constant = &link.inertia;
        let first_moment = Vec3::new(constant.first_moment.x, reader.next(), reader.next());
        let about_hinge = Sym3 {
            xx: constant.about_origin.xx,
            yy: reader.next(),
            zz: reader.next(),
            xy: reader.next(),
            xz: reader.next(),
            yz: reader.next(),
        };
        Self {
            first_moment,
            about_hinge,
            mass: constant.mass,
            next: [reader.next(), reader.next()],
            moment: reader.vector(),
            force: reader.vector(),
        }
    }
}

impl<R: Real> Eliminated<R> {
    pub(crate) fn flat(&self) -> Vec<R> {
        let mut flat = self.angular.to_vec();
        flat.extend(self.linear.to_array());
        flat.extend([self.inverse_pivot, self.net_torque]);
        flat.extend(self.next);
        flat
    }

    pub(crate) fn read(reader: &mut Numbers<'_, R>) -> Self {
        Self {
            angular: [reader.next(), reader.next()],
            linear: reader.vector(),
            inverse_pivot: reader.next(),
            net_torque: reader.next(),
            next: [reader.next(), reader.next()],
        }
    }
}
