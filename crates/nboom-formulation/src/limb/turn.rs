//! Turning about ê₁.

use nboom_scalar::{ArticulatedInertia, Mat3, Real, RigidInertia, Twist, Vec3, Wrench};

use crate::chain;

/// An angle about ê₁ by its sine and cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turn<R> {
    pub sin: R,
    pub cos: R,
}

impl<R: Real> Turn<R> {
    /// No angle.
    pub fn still() -> Self {
        Self { sin: R::zero(), cos: R::one() }
    }

    pub fn by(angle: R) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { sin, cos }
    }

    pub fn vector(self, v: Vec3<R>) -> Vec3<R> {
        let Self { sin: s, cos: c } = self;
        Vec3::new(v.x, c * v.y - s * v.z, s * v.y + c * v.z)
    }

    /// A vector turned back.
    pub fn vector_back(self, v: Vec3<R>) -> Vec3<R> {
        let Self { sin: s, cos: c } = self;
        Vec3::new(v.x, c * v.y + s * v.z, c * v.z - s * v.y)
    }

    /// A motion turned back.
    pub fn twist_back(self, v: Twist<R>) -> Twist<R> {
        Twist { angular: self.vector_back(v.angular), linear: self.vector_back(v.linear) }
    }

    pub fn wrench(self, wrench: Wrench<R>) -> Wrench<R> {
        Wrench { moment: self.vector(wrench.moment), force: self.vector(wrench.force) }
    }

    pub fn rigid(self, body: &RigidInertia<R>) -> RigidInertia<R> {
        RigidInertia {
            mass: body.mass,
            first_moment: self.vector(body.first_moment),
            about_origin: chain::turned_inertia(&body.about_origin, self.sin, self.cos),
        }
    }

    pub fn inertia(self, inertia: &ArticulatedInertia<R>) -> ArticulatedInertia<R> {
        let Self { sin: s, cos: c } = self;
        let [x, y, z] = inertia.coupling.rows;
        // As of a symmetric tensor: half sum and half difference of what is off the diagonal stay or turn at
        // the double angle.
        let (difference, sum) = (y.y - z.z, y.z + z.y);
        let single = s * difference + c * sum;
        let (shift, change) = (s * single, c * single - sum);
        let first_column = self.vector(Vec3::new(x.x, y.x, z.x));
        let coupling = Mat3::from_rows(
            self.vector(x),
            Vec3::new(first_column.y, y.y - shift, y.z + change),
            Vec3::new(first_column.z, z.y + change, z.z + shift),
        );
        ArticulatedInertia {
            angular: chain::turned_inertia(&inertia.angular, s, c),
            coupling,
            linear: chain::turned_inertia(&inertia.linear, s, c),
        }
    }
}
