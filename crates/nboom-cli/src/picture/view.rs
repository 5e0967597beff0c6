//! Where points stand in a drawing, seen from above and from the side.

use std::ops::Range;

use nboom_scalar::Vec3;

/// Width and height of one of the two drawings, and the margin around what is drawn.
pub(super) const WIDTH: f64 = 480.0;
pub(super) const HEIGHT: f64 = 440.0;
const MARGIN: f64 = 60.0;

/// Direction of the eye: angle about z from x, and angle above the plane of x and y \[rad\].
const AZIMUTH: f64 = 0.6;
const ELEVATION: f64 = 0.42;

/// Longest that the bar of a round length may be, in the drawing.
const LONGEST_BAR: f64 = 90.0;

/// Sizes whose squares and shares are numbers.
const DRAWN: Range<f64> = 1e-100..1e100;

/// A view of all that is drawn.
pub(super) struct View {
    middle: [f64; 2],
    scale: f64,
    /// The larger of width and height of what is drawn, in the scene's unit.
    pub size: f64,
    right: Vec3<f64>,
    up: Vec3<f64>,
    /// Towards the eye.
    eye: Vec3<f64>,
}

impl View {
    /// The view in which all points have room; none if they are farther from each other, or nearer, than can
    /// be drawn.
    pub fn of(points: impl IntoIterator<Item = Vec3<f64>>) -> Option<Self> {
        let ((sa, ca), (se, ce)) = (AZIMUTH.sin_cos(), ELEVATION.sin_cos());
        let right = Vec3::new(-sa, ca, 0.0);
        let up = Vec3::new(-ca * se, -sa * se, ce);
        let eye = Vec3::new(ca * ce, sa * ce, se);
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for (i, axis) in [right, up].into_iter().enumerate() {
                least[i] = least[i].min(point.dot(axis));
                most[i] = most[i].max(point.dot(axis));
            }
        }
        let extent = [0, 1].map(|i| most[i] - least[i]);
        // A main body alone has no extent.
        let size = extent[0].max(extent[1]);
        let size = if size > 0.0 { size } else { 1.0 };
        let fits = [WIDTH, HEIGHT].map(|room| room - 2.0 * MARGIN);
        let scale = (fits[0] / extent[0].max(0.3 * size)).min(fits[1] / extent[1].max(0.3 * size));
        let middle = [0, 1].map(|i| 0.5 * (least[i] + most[i]));
        let can_be_drawn = DRAWN.contains(&size) && middle.iter().all(|x| x.abs() < DRAWN.end);
        can_be_drawn.then_some(Self { middle, scale, size, right, up, eye })
    }

    /// Where a point stands in the drawing.
    pub fn place(&self, point: Vec3<f64>) -> (f64, f64) {
        let [right, up] = [point.dot(self.right), point.dot(self.up)];
        let (right, up) = (right - self.middle[0], up - self.middle[1]);
        (0.5 * WIDTH + right * self.scale, 0.5 * HEIGHT - up * self.scale)
    }

    /// How near to the eye a point is.
    pub fn depth(&self, point: Vec3<f64>) -> f64 {
        point.dot(self.eye)
    }

    /// A round length as it is in the drawing, and its number.
    pub fn round_length(&self) -> (f64, f64) {
        let longest = LONGEST_BAR / self.scale;
        let power = 10.0_f64.powf(longest.log10().floor());
        let digit = [5.0, 2.0, 1.0].into_iter().find(|digit| digit * power <= longest);
        let length = digit.unwrap_or(1.0) * power;
        // Powers of ten are not exact.
        let shown = format!("{length:.0e}").parse().unwrap_or(length);
        (length * self.scale, shown)
    }
}
