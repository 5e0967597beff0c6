//! A drawing of a scene: as it starts, and with all hinges latched.

use std::fmt::Write;

use nboom_model::{HingePlace, Posture, Scene};
use nboom_scalar::Vec3;

/// Width and height of one of the two drawings, and the margin around what is drawn.
const WIDTH: f64 = 460.0;
const HEIGHT: f64 = 440.0;
const MARGIN: f64 = 60.0;

/// Colours of x, y and z.
const COLOURS: [&str; 3] = ["#c0392b", "#27864a", "#2463ac"];

/// Share of the drawing's extent that the main body's axes have; those of others are shorter.
const AXIS: f64 = 0.16;

/// The drawing, as a file in SVG.
pub(crate) fn svg(scene: &Scene) -> String {
    let postures =
        [("at the start", Posture::at_start(scene)), ("latched", Posture::locked(scene))];
    let points = postures.iter().flat_map(|(_, posture)| posture.hinges.iter());
    let points = points.flat_map(|hinge| [hinge.point, hinge.tip]).chain([Vec3::zero()]);
    let view = View::of(points.map(projected).collect());
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {HEIGHT}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        2.0 * WIDTH
    );
    for (number, (title, posture)) in postures.iter().enumerate() {
        let _ = writeln!(text, "<g transform=\"translate({} 0)\">", WIDTH * number as f64);
        let title = escaped(&format!("{}, {title}", scene.name));
        let _ = writeln!(text, "<text x=\"16\" y=\"24\" font-size=\"15\">{title}</text>");
        let mut drawing = Drawing { text: &mut text, view: &view };
        drawing.scene(scene, posture);
        text.push_str("</g>\n");
    }
    text + "</svg>\n"
}

/// A point as seen from above and from the side: to the right, and up.
fn projected(point: Vec3<f64>) -> [f64; 2] {
    let (azimuth, elevation) = (0.6_f64, 0.42_f64);
    let (sa, ca) = azimuth.sin_cos();
    let (se, ce) = elevation.sin_cos();
    let Vec3 { x, y, z } = point;
    [y * ca - x * sa, z * ce - (x * ca + y * sa) * se]
}

/// Where projected points stand in a drawing.
struct View {
    middle: [f64; 2],
    scale: f64,
    /// Length of the main body's axes, in the scene's unit.
    axis: f64,
}

impl View {
    fn of(points: Vec<[f64; 2]>) -> Self {
        let bound = |i: usize, pick: fn(f64, f64) -> f64, start: f64| {
            points.iter().map(|point| point[i]).fold(start, pick)
        };
        let least = [0, 1].map(|i| bound(i, f64::min, f64::INFINITY));
        let most = [0, 1].map(|i| bound(i, f64::max, f64::NEG_INFINITY));
        let extent = [0, 1].map(|i| most[i] - least[i]);
        // A main body alone has no extent.
        let size = extent[0].max(extent[1]);
        let size = if size > 0.0 { size } else { 1.0 };
        let fits = [WIDTH, HEIGHT].map(|room| room - 2.0 * MARGIN);
        let scale = (fits[0] / extent[0].max(0.3 * size)).min(fits[1] / extent[1].max(0.3 * size));
        Self { middle: [0, 1].map(|i| 0.5 * (least[i] + most[i])), scale, axis: AXIS * size }
    }

    fn place(&self, point: Vec3<f64>) -> (f64, f64) {
        let [right, up] = projected(point);
        let (right, up) = (right - self.middle[0], up - self.middle[1]);
        (0.5 * WIDTH + right * self.scale, 0.5 * HEIGHT - up * self.scale)
    }
}

struct Drawing<'t> {
    text: &'t mut String,
    view: &'t View,
}

impl Drawing<'_> {
    fn scene(&mut self, scene: &Scene, posture: &Posture) {
        for (body, place) in scene.bodies.iter().zip(&posture.hinges) {
            let from = body.inboard.map_or(Vec3::zero(), |inboard| posture.hinges[inboard].point);
            self.line(from, place.point, "#999999", 1.0);
        }
        for place in &posture.hinges {
            self.line(place.point, place.tip, "#333333", 4.0);
        }
        let axes = [Vec3::unit_x(), Vec3::unit_y(), Vec3::unit_z()];
        self.triad(Vec3::zero(), axes, self.view.axis, ["x", "y", "z"]);
        for (i, place) in posture.hinges.iter().enumerate() {
            self.hinge(place);
            let label = scene.name_of(i).map_or_else(|| scene.label(i).to_string(), str::to_owned);
            let (x, y) = self.view.place((place.point + place.tip) * 0.5);
            let label = escaped(&label);
            let _ = writeln!(
                self.text,
                "<text x=\"{:.1}\" y=\"{:.1}\">{label}</text>",
                x + 8.0,
                y - 6.0
            );
        }
    }

    /// The hinge, its axis dashed, and the body's axes.
    fn hinge(&mut self, place: &HingePlace) {
        let axes = [0, 1, 2].map(|j| place.body_axes.column(j));
        self.triad(place.point, axes, 0.4 * self.view.axis, ["", "", ""]);
        let along = place.axis * (0.7 * self.view.axis);
        let ((x1, y1), (x2, y2)) =
            (self.view.place(place.point + along * -1.0), self.view.place(place.point + along));
        let _ = writeln!(
            self.text,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"#b36b00\" \
             stroke-width=\"1.5\" stroke-dasharray=\"5 3\"/>\n\
             <circle cx=\"{x2:.1}\" cy=\"{y2:.1}\" r=\"2.5\" fill=\"#b36b00\"/>"
        );
        let (x, y) = self.view.place(place.point);
        let _ = writeln!(
            self.text,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"white\" stroke=\"#333333\"/>"
        );
    }

    fn triad(&mut self, at: Vec3<f64>, axes: [Vec3<f64>; 3], length: f64, names: [&str; 3]) {
        for ((axis, colour), name) in axes.into_iter().zip(COLOURS).zip(names) {
            self.line(at, at + axis * length, colour, 1.5);
            if !name.is_empty() {
                let (x, y) = self.view.place(at + axis * (1.2 * length));
                let _ = writeln!(
                    self.text,
                    "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{colour}\">{name}</text>"
                );
            }
        }
    }

    fn line(&mut self, from: Vec3<f64>, to: Vec3<f64>, colour: &str, width: f64) {
        let ((x1, y1), (x2, y2)) = (self.view.place(from), self.view.place(to));
        let _ = writeln!(
            self.text,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\" \
             stroke-width=\"{width}\" stroke-linecap=\"round\"/>"
        );
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
