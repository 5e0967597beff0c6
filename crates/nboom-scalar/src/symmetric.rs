use std::ops::{Add, AddAssign, Mul, Sub};

use crate::{Mat3, Real, Vec3};

/// A symmetric 3×3 matrix by its six entries.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the fields are the entries they are named after")]
pub struct Sym3<R> {
    pub xx: R,
    pub yy: R,
    pub zz: R,
    pub xy: R,
    pub xz: R,
    pub yz: R,
}

impl<R> Sym3<R> {
    /// The matrix of what `f` makes of each entry.
    #[inline(always)]
    pub fn map<S>(self, mut f: impl FnMut(R) -> S) -> Sym3<S> {
        Sym3 {
            xx: f(self.xx),
            yy: f(self.yy),
            zz: f(self.zz),
            xy: f(self.xy),
            xz: f(self.xz),
            yz: f(self.yz),
        }
    }
}

impl<R: Real> Sym3<R> {
    /// The zero matrix.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::diagonal(R::zero(), R::zero(), R::zero())
    }

    /// The diagonal matrix with these entries.
    #[inline(always)]
    pub fn diagonal(xx: R, yy: R, zz: R) -> Self {
        Self { xx, yy, zz, xy: R::zero(), xz: R::zero(), yz: R::zero() }
    }

    /// Makes every entry a scalar of this kind.
    #[inline(always)]
    pub fn constant(m: Sym3<f64>) -> Self {
        m.map(R::constant)
    }

    /// The dyad `v vᵀ`.
    #[inline(always)]
    pub fn outer(v: Vec3<R>) -> Self {
        Self {
            xx: v.x * v.x,
            yy: v.y * v.y,
            zz: v.z * v.z,
            xy: v.x * v.y,
            xz: v.x * v.z,
            yz: v.y * v.z,
        }
    }

    /// `(a·b) U − ½ (a bᵀ + b aᵀ)`: for a = m p and b = p, the inertia about the origin of a point mass m at p.
    ///
    /// No diagonal entry is a difference, so that a slender body keeps the digits of its small inertia where it
    /// is added to this.
    #[inline(always)]
    pub fn across(a: Vec3<R>, b: Vec3<R>) -> Self {
        let [x, y, z] = [a.x * b.x, a.y * b.y, a.z * b.z];
        let half = -R::constant(0.5);
        Self {
            xx: y + z,
            yy: z + x,
            zz: x + y,
            xy: (a.x * b.y + a.y * b.x) * half,
            xz: (a.x * b.z + a.z * b.x) * half,
            yz: (a.y * b.z + a.z * b.y) * half,
        }
    }

    /// The symmetric matrix whose upper triangle is that of `m`.
    #[inline(always)]
    pub fn upper_of(m: &Mat3<R>) -> Self {
        let [a, b, c] = m.rows;
        Self { xx: a.x, yy: b.y, zz: c.z, xy: a.y, xz: a.z, yz: b.z }
    }

    /// The sum of the diagonal.
    #[inline(always)]
    pub fn trace(self) -> R {
        self.xx + self.yy + self.zz
    }

    /// All nine entries.
    #[inline(always)]
    pub fn to_matrix(self) -> Mat3<R> {
        Mat3::from_rows(
            Vec3::new(self.xx, self.xy, self.xz),
            Vec3::new(self.xy, self.yy, self.yz),
            Vec3::new(self.xz, self.yz, self.zz),
        )
    }

    /// `self⁻¹ right` of a positive definite matrix, by L D Lᵀ.
    #[inline(always)]
    pub fn solve(self, right: Vec3<R>) -> Vec3<R> {
        let inverse_x = R::one() / self.xx;
        let (yx, zx) = (self.xy * inverse_x, self.xz * inverse_x);
        let inverse_y = R::one() / (self.yy - yx * self.xy);
        let below = self.yz - zx * self.xy;
        let zy = below * inverse_y;
        let pivot_z = self.zz - zx * self.xz - zy * below;
        let y = right.y - yx * right.x;
        let z = (right.z - zx * right.x - zy * y) / pivot_z;
        let y = y * inverse_y - zy * z;
        Vec3::new(right.x * inverse_x - yx * y - zx * z, y, z)
    }

    /// `rot self rotᵀ`: the same tensor along other axes.
    #[inline(always)]
    pub fn rotated(self, rot: &Mat3<R>) -> Self {
        let [a, b, c] = rot.rows;
        let (sa, sb, sc) = (self * a, self * b, self * c);
        Self {
            xx: a.dot(sa),
            yy: b.dot(sb),
            zz: c.dot(sc),
            xy: a.dot(sb),
            xz: a.dot(sc),
            yz: b.dot(sc),
        }
    }
}

impl Sym3<f64> {
    /// Whether all entries are finite.
    pub fn is_finite(&self) -> bool {
        self.entries().iter().all(|e| e.is_finite())
    }

    /// Magnitude of the largest entry.
    pub fn largest_entry(&self) -> f64 {
        self.entries().iter().fold(0.0, |largest, e| largest.max(e.abs()))
    }

    fn entries(&self) -> [f64; 6] {
        [self.xx, self.yy, self.zz, self.xy, self.xz, self.yz]
    }
}

impl<R: Real> Mul<Vec3<R>> for Sym3<R> {
    type Output = Vec3<R>;
    #[inline(always)]
    fn mul(self, v: Vec3<R>) -> Vec3<R> {
        Vec3::new(
            self.xx * v.x + self.xy * v.y + self.xz * v.z,
            self.xy * v.x + self.yy * v.y + self.yz * v.z,
            self.xz * v.x + self.yz * v.y + self.zz * v.z,
        )
    }
}

impl<R: Real> Mul<R> for Sym3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, f: R) -> Self {
        Self {
            xx: self.xx * f,
            yy: self.yy * f,
            zz: self.zz * f,
            xy: self.xy * f,
            xz: self.xz * f,
            yz: self.yz * f,
        }
    }
}

impl<R: Real> Add for Sym3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self {
            xx: self.xx + o.xx,
            yy: self.yy + o.yy,
            zz: self.zz + o.zz,
            xy: self.xy + o.xy,
            xz: self.xz + o.xz,
            yz: self.yz + o.yz,
        }
    }
}

impl<R: Real> Sub for Sym3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self {
            xx: self.xx - o.xx,
            yy: self.yy - o.yy,
            zz: self.zz - o.zz,
            xy: self.xy - o.xy,
            xz: self.xz - o.xz,
            yz: self.yz - o.yz,
        }
    }
}

impl<R: Real> AddAssign for Sym3<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
