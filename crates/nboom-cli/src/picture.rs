//! A drawing of a scene: stowed, as it starts, and deployed, with all hinges latched.

mod acting;
mod labels;
mod solids;
mod view;

use std::fmt::Write;

use nboom_io::SceneFile;
use nboom_model::{Body, HingePlace, Posture, Scene, UnitSystem};
use nboom_report::escaped;
use nboom_scalar::{Mat3, Vec3};

use acting::{Kind, Mark, marks};
use labels::Labels;
use solids::{Patch, corners, patches};
use view::{HEIGHT, View, WIDTH};

/// Heights of the line below the drawings, and of the legend of what acts.
const FOOT: f64 = 34.0;
const LEGEND: f64 = 20.0;

/// Width of a mark in the legend, and of a character.
const SAMPLE: f64 = 26.0;
const CHARACTER: f64 = 6.4;

/// Colours of x, y and z.
const COLOURS: [&str; 3] = ["#c0392b", "#27864a", "#2463ac"];

/// Colour of hinge axes.
const HINGE: &str = "#b36b00";

/// Share of the drawing's extent that the axes of a hinged body have.
const AXIS: f64 = 0.055;

/// Bodies beyond these have no label; there would be no room.
const MOST_LABELS: usize = 100;

/// The drawing, as a file in SVG; none of a scene too large or too small to be drawn.
pub fn svg(file: &SceneFile) -> Option<String> {
    let scene = &file.scene;
    let units = file.settings.units.clone().unwrap_or_default();
    let deployed = match scene.bodies.iter().filter(|body| body.hinge.can_latch()).count() {
        0 => "nothing latches",
        count if count < scene.bodies.len() => "deployed, what latches is latched",
        _ => "deployed, all is latched",
    };
    let postures =
        [("stowed, as it starts", Posture::at_start(scene)), (deployed, Posture::locked(scene))];
    let points = postures.iter().flat_map(|(_, posture)| {
        points(scene, posture).into_iter().chain(acting::points(file, posture))
    });
    let view = View::of(points)?;
    let acting: Vec<Vec<Mark>> = postures
        .iter()
        .enumerate()
        .map(|(number, (_, posture))| marks(file, posture, number == 0, &view))
        .collect();
    let is_drawn = |kind: &Kind| acting.iter().flatten().any(|mark| mark.kind == *kind);
    let kinds: Vec<Kind> = Kind::ALL.into_iter().filter(is_drawn).collect();
    let legend_height = if kinds.is_empty() { 0.0 } else { LEGEND };
    let (width, height) = (2.0 * WIDTH, HEIGHT + FOOT + legend_height);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    for (number, (title, posture)) in postures.iter().enumerate() {
        let _ = writeln!(text, "<g transform=\"translate({} 0)\">", WIDTH * number as f64);
        let title = escaped(&format!("{}: {title}", scene.name));
        let _ = writeln!(text, "<text x=\"16\" y=\"24\" font-size=\"15\">{title}</text>");
        let mut drawing = Drawing { text: &mut text, view: &view };
        drawing.scene(scene, posture, &acting[number]);
        text.push_str("</g>\n");
    }
    foot(&mut text, &view, &units);
    legend(&mut text, &kinds);
    Some(text + "</svg>\n")
}

/// All points that a drawing must have room for.
fn points(scene: &Scene, posture: &Posture) -> Vec<Vec3<f64>> {
    let shapes = scene.shapes();
    let mut points = vec![Vec3::zero()];
    let main_body = shapes.main_body.iter();
    points.extend(main_body.flat_map(|shape| corners(shape, Vec3::zero(), Mat3::identity())));
    for (i, place) in posture.hinges.iter().enumerate() {
        points.push(place.point);
        match shapes.of(i) {
            Some(shape) => points.extend(corners(shape, place.point, place.body_axes)),
            None => points.push(place.tip),
        }
    }
    points
}

/// What the lines mean, and how long a length is.
fn foot(text: &mut String, view: &View, units: &UnitSystem) {
    let (x, y) = (16.0, HEIGHT + 14.0);
    let (length, label) = view.round_length();
    let end = x + length;
    let unit = escaped(units.length());
    let _ = writeln!(
        text,
        "<path d=\"M{x} {0} V{1} H{end:.1} V{0}\" fill=\"none\" stroke=\"#333333\"/>\n\
         <text x=\"{2:.1}\" y=\"{1}\">{label} {unit}</text>",
        y - 8.0,
        y - 2.0,
        end + 8.0
    );
    let mark = 0.36 * WIDTH;
    mass_center_mark(text, (mark, y - 4.0));
    let _ =
        writeln!(text, "<text x=\"{}\" y=\"{y}\" fill=\"#333333\">mass centre</text>", mark + 10.0);
    let mut words = WIDTH * 0.6;
    let mut say = |colour: &str, word: &str, room: f64| {
        let _ = writeln!(text, "<text x=\"{words}\" y=\"{y}\" fill=\"{colour}\">{word}</text>");
        words += room;
    };
    say("#333333", "axes of each body:", 122.0);
    for (colour, name) in COLOURS.into_iter().zip(["x", "y", "z"]) {
        say(colour, name, 14.0);
    }
    say(HINGE, "hinge axis, dot at the end about which angles turn by the right hand", 0.0);
}

/// The marks of what acts, with what they mean.
fn legend(text: &mut String, kinds: &[Kind]) {
    let (mut x, y) = (16.0, HEIGHT + FOOT);
    for &kind in kinds {
        let to = (x + if kind == Kind::Station { 0.5 * SAMPLE } else { SAMPLE }, y);
        Mark { kind, from: (x, y), to }.write(text);
        let words = kind.words();
        let _ = writeln!(
            text,
            "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#333333\">{words}</text>",
            x + SAMPLE + 8.0,
            y + 4.0
        );
        x += SAMPLE + 30.0 + CHARACTER * words.len() as f64;
    }
}

struct Drawing<'t> {
    text: &'t mut String,
    view: &'t View,
}

impl Drawing<'_> {
    fn scene(&mut self, scene: &Scene, posture: &Posture, acting: &[Mark]) {
        let shapes = scene.shapes();
        let (view, origin) = (self.view, Vec3::zero());
        let mut all: Vec<Patch> = Vec::new();
        if let Some(shape) = &shapes.main_body {
            all.extend(patches(shape, origin, Mat3::identity(), view));
        }
        for (i, (body, place)) in scene.bodies.iter().zip(&posture.hinges).enumerate() {
            match shapes.of(i) {
                Some(shape) => all.extend(patches(shape, place.point, place.body_axes, view)),
                None => all.extend(Patch::line(place.point, place.tip, "#333333", 4.0, view)),
            }
            let inboard = body.inboard.map(|inboard| posture.hinges[inboard].point);
            let has_shape =
                body.inboard.map_or(shapes.main_body.as_ref(), |i| shapes.of(i)).is_some();
            if !has_shape {
                let from = inboard.unwrap_or(origin);
                all.extend(Patch::line(from, place.point, "#999999", 1.0, view));
            }
        }
        // What is nearer to the eye covers what is farther.
        all.sort_by(|a, b| a.depth.total_cmp(&b.depth));
        all.iter().for_each(|patch| patch.write(self.text, view));
        posture.hinges.iter().for_each(|place| self.hinge(place));
        acting.iter().for_each(|mark| mark.write(self.text));
        let mut labels = Labels::default();
        let center = view.place(mass_center(scene, posture));
        labels.keep_off(center);
        self.main_axes(scene, &mut labels);
        mass_center_mark(self.text, center);
        let labelled = || posture.hinges.iter().take(MOST_LABELS);
        labelled().for_each(|place| labels.keep_off(view.place(place.point)));
        for (i, place) in labelled().enumerate() {
            let label = scene.name_of(i).map_or_else(|| scene.label(i).to_string(), str::to_owned);
            let middle = shapes.of(i).map_or((place.point + place.tip) * 0.5, |shape| {
                place.point + place.body_axes * shape.middle
            });
            labels.place(self.text, &label, view.place(middle));
        }
    }

    /// The main body's axes, from O to outside of its shape.
    fn main_axes(&mut self, scene: &Scene, labels: &mut Labels) {
        let shape = scene.shapes().main_body.as_ref();
        let corners = shape.map(|shape| corners(shape, Vec3::zero(), Mat3::identity()));
        let units = [Vec3::unit_x(), Vec3::unit_y(), Vec3::unit_z()];
        for ((axis, colour), name) in units.into_iter().zip(COLOURS).zip(["x", "y", "z"]) {
            let reach = corners.iter().flatten().map(|corner| corner.dot(axis));
            let length = reach.fold(0.0, f64::max) + 2.0 * AXIS * self.view.size;
            self.line(Vec3::zero(), axis * length, colour, 1.5);
            let at = self.view.place(axis * (length + 0.4 * AXIS * self.view.size));
            labels.fixed(self.text, name, colour, at);
        }
    }

    /// The hinge, its axis dashed, and the body's axes.
    fn hinge(&mut self, place: &HingePlace) {
        let size = AXIS * self.view.size;
        for (j, colour) in COLOURS.into_iter().enumerate() {
            self.line(place.point, place.point + place.body_axes.column(j) * size, colour, 1.2);
        }
        let along = place.axis * (1.5 * size);
        let ((x1, y1), (x2, y2)) =
            (self.view.place(place.point + along * -1.0), self.view.place(place.point + along));
        let (x, y) = self.view.place(place.point);
        let _ = writeln!(
            self.text,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{HINGE}\" \
             stroke-width=\"1.5\" stroke-dasharray=\"5 3\"/>\n\
             <circle cx=\"{x2:.1}\" cy=\"{y2:.1}\" r=\"2.5\" fill=\"{HINGE}\"/>\n\
             <circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"white\" stroke=\"#333333\"/>"
        );
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

/// The mass centre of all bodies, from O along main-body axes.
fn mass_center(scene: &Scene, posture: &Posture) -> Vec3<f64> {
    let main = &scene.main_body;
    let bodies = scene.bodies.iter().zip(&posture.hinges);
    let of_body = |(body, place): (&Body, &HingePlace)| {
        let of = &body.mass_properties;
        (of.mass, place.point + place.body_axes * of.center_of_mass)
    };
    let start = (main.mass, main.center_of_mass * main.mass);
    let add = |(mass, sum): (f64, Vec3<f64>), (of_body, at): (f64, Vec3<f64>)| {
        (mass + of_body, sum + at * of_body)
    };
    let (mass, sum) = bodies.map(of_body).fold(start, add);
    // Nothing weighs anything in a scene whose main body is held.
    if mass > 0.0 { sum * (1.0 / mass) } else { Vec3::zero() }
}

/// The usual sign: a disc with two black quarters.
fn mass_center_mark(text: &mut String, (x, y): (f64, f64)) {
    let _ = writeln!(
        text,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\" fill=\"white\" stroke=\"#111111\"/>\n\
         <path class=\"mass-centre\" transform=\"translate({x:.1} {y:.1})\" \
         d=\"M0 0V-5A5 5 0 0 1 5 0ZM0 0V5A5 5 0 0 1 -5 0Z\" fill=\"#000000\"/>"
    );
}
