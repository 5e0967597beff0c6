//! Curves on logarithmic axes as a picture (SVG).

use std::fmt::Write;

/// A named curve of errors and run times.
pub(crate) struct Curve {
    pub name: String,
    /// Error, and microseconds.
    pub points: Vec<(f64, f64)>,
}

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 600.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 300.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 50.0;

/// Hues a golden angle apart differ as much as possible, however many there are.
const GOLDEN_ANGLE: f64 = 137.508;

/// Run time over error, both in decades, with a legend.
pub(crate) fn plot(title: &str, curves: &[Curve]) -> String {
    let all = || curves.iter().flat_map(|curve| &curve.points).filter(|(error, _)| *error > 0.0);
    let x = Axis::over(all().map(|(error, _)| *error), LEFT, WIDTH - RIGHT);
    let y = Axis::over(all().map(|(_, time)| *time), HEIGHT - BOTTOM, TOP);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>\n\
         <text x=\"{LEFT}\" y=\"24\" font-size=\"15\">{}: microseconds of a run over its relative \
         error</text>\n",
        escaped(title)
    );
    let mut add = |element: String| writeln!(svg, "{element}").expect("a string takes any text");
    for decade in x.decades() {
        let (at, bottom) = (x.place(decade), HEIGHT - BOTTOM);
        add(line(at, TOP, at, bottom));
        add(label(at, bottom + 18.0, "middle", decade));
    }
    for decade in y.decades() {
        let at = y.place(decade);
        add(line(LEFT, at, WIDTH - RIGHT, at));
        add(label(LEFT - 6.0, at + 4.0, "end", decade));
    }
    for (i, Curve { name, points }) in curves.iter().enumerate() {
        let colour = format!("hsl({:.0} 70% 40%)", (i as f64 * GOLDEN_ANGLE) % 360.0);
        let shown = points.iter().filter(|(error, _)| *error > 0.0);
        let places = shown.map(|&(e, t)| format!("{:.1},{:.1}", x.place(e), y.place(t)));
        let places: Vec<String> = places.collect();
        add(format!(
            "<polyline fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\" points=\"{}\"/>",
            places.join(" ")
        ));
        let (at, height) = (WIDTH - RIGHT + 16.0, TOP + 16.0 * i as f64);
        add(format!("<text x=\"{at}\" y=\"{height}\" fill=\"{colour}\">{}</text>", escaped(name)));
    }
    svg + "</svg>\n"
}

/// A logarithmic axis.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Whole decades around `values`, from one place to another.
    fn over(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.filter(|value| value.is_finite() && *value > 0.0) {
            (low, high) = (low.min(value.log10().floor()), high.max(value.log10().ceil()));
        }
        let nothing = low > high;
        let (low, high) = if nothing { (0.0, 1.0) } else { (low, high.max(low + 1.0)) };
        Self { low, high, from, to }
    }

    fn place(&self, value: f64) -> f64 {
        self.from + (self.to - self.from) * (value.log10() - self.low) / (self.high - self.low)
    }

    fn decades(&self) -> impl Iterator<Item = f64> {
        (self.low as i32..=self.high as i32).map(|decade| 10.0_f64.powi(decade))
    }
}

fn line(x1: f64, y1: f64, x2: f64, y2: f64) -> String {
    format!("<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"#ddd\"/>")
}

fn label(x: f64, y: f64, anchor: &str, value: f64) -> String {
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{value:.0e}</text>")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_stand_at_equal_distances() {
        let axis = Axis::over([2e-9, 3e-3].into_iter(), 0.0, 70.0);
        let places: Vec<f64> = axis.decades().map(|decade| axis.place(decade)).collect();
        assert_eq!(places.len(), 8);
        for (i, place) in places.iter().enumerate() {
            assert!((place - 10.0 * i as f64).abs() < 1e-9, "{places:?}");
        }
    }

    #[test]
    fn names_and_titles_are_text() {
        let curve = Curve { name: "a<b".to_owned(), points: vec![(1e-3, 5.0), (0.0, 7.0)] };
        let svg = plot("x & y", &[curve]);
        assert!(svg.contains("a&lt;b") && svg.contains("x &amp; y"), "{svg}");
        assert!(plot("nothing", &[]).ends_with("</svg>\n"));
    }
}
