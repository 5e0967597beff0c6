//! Reads numbers out of a figure: by the lines of its grid and the numbers beside them, and nothing else.

use roxmltree::{Document, Node};

type Place = [f64; 2];

/// An axis: number = offset + slope · place.
#[derive(Debug, Clone, Copy)]
pub struct Ruler {
    offset: f64,
    slope: f64,
}

impl Ruler {
    /// From places and their numbers, both ascending or one of them descending.
    fn of(places: &[f64], numbers: &[f64]) -> Self {
        assert_eq!(places.len(), numbers.len(), "a number for each line: {places:?} {numbers:?}");
        let last = places.len() - 1;
        let slope = (numbers[last] - numbers[0]) / (places[last] - places[0]);
        let ruler = Self { offset: numbers[0] - slope * places[0], slope };
        for (place, number) in places.iter().zip(numbers) {
            assert!((ruler.read(*place) - number).abs() <= 0.02 * slope.abs(), "even ticks");
        }
        ruler
    }

    pub fn read(self, place: f64) -> f64 {
        self.offset + self.slope * place
    }

    /// How much a pixel is.
    pub fn pixel(self) -> f64 {
        self.slope.abs()
    }
}

/// The only panel of a figure, or the one of a number from above.
pub struct Panel<'d> {
    pub time: Ruler,
    pub value: Ruler,
    pub top: f64,
    pub bottom: f64,
    document: &'d Document<'d>,
}

fn number(text: &str) -> f64 {
    text.replace('\u{2212}', "-").parse().unwrap_or_else(|_| panic!("{text:?} is no number"))
}

fn points(node: Node<'_, '_>) -> Vec<Place> {
    let pair = |pair: &str| {
        let (x, y) = pair.split_once(',').expect("two coordinates");
        [number(x), number(y)]
    };
    node.attribute("points").map_or_else(Vec::new, |all| all.split(' ').map(pair).collect())
}

pub fn elements<'d>(document: &'d Document<'d>, tag: &str) -> impl Iterator<Item = Node<'d, 'd>> {
    document.descendants().filter(move |node| node.has_tag_name(tag))
}

/// The name that an element carries.
fn name(node: Node<'_, '_>) -> Option<String> {
    let title = node.children().find(|child| child.has_tag_name("title"))?;
    title.text().map(str::to_owned)
}

fn attribute(node: Node<'_, '_>, name: &str) -> f64 {
    number(node.attribute(name).unwrap_or_else(|| panic!("no {name}")))
}

/// Texts with this anchor and their places, exponents after a caret.
fn ticks(document: &Document<'_>, anchor: &str) -> Vec<(Place, String)> {
    let is_tick = |node: &Node<'_, '_>| {
        node.attribute("text-anchor") == Some(anchor) && node.attribute("transform").is_none()
    };
    let texts = elements(document, "text").filter(is_tick);
    let text = |node: Node<'_, '_>| {
        let mut parts = node.descendants().filter(Node::is_text).filter_map(|part| part.text());
        let (base, raised) = (parts.next().unwrap_or_default(), parts.next());
        let text = raised.map_or_else(|| base.to_owned(), |raised| format!("{base}^{raised}"));
        ([attribute(node, "x"), attribute(node, "y")], text)
    };
    texts.map(text).collect()
}

impl<'d> Panel<'d> {
    pub fn new(document: &'d Document<'d>, which: usize) -> Self {
        let frames: Vec<Vec<Place>> = elements(document, "polyline").map(points).collect();
        let frames: Vec<&Vec<Place>> =
            frames.iter().filter(|points| points.len() == 5 && points[0] == points[4]).collect();
        let (top, bottom) = (frames[which][0][1], frames[which][2][1]);
        let lines: Vec<Vec<Place>> = elements(document, "polyline")
            .filter(|node| node.attribute("stroke") == Some("#e3e6ea"))
            .map(points)
            .collect();
        let is_in = |y: f64| y >= top - 0.1 && y <= bottom + 0.1;
        let level = lines.iter().filter(|line| line[0][1] == line[1][1] && is_in(line[0][1]));
        let upright = lines.iter().filter(|line| line[0][0] == line[1][0] && is_in(line[0][1]));
        let (mut ys, mut xs): (Vec<f64>, Vec<f64>) =
            (level.map(|line| line[0][1]).collect(), upright.map(|line| line[0][0]).collect());
        ys.sort_by(f64::total_cmp);
        xs.sort_by(f64::total_cmp);
        // Numbers of the vertical axis end at it, those of time stand around their place below all panels.
        let numbers = ticks(document, "end")
            .into_iter()
            .filter(|([x, y], _)| *x < 100.0 && *y > top && *y < bottom + 6.0);
        let mut values: Vec<(f64, f64)> =
            numbers.map(|([_, y], text)| (y, self::value(&text))).collect();
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let is_time =
            |text: &str| text.chars().all(|c| c.is_ascii_digit() || "\u{2212}.".contains(c));
        let times = ticks(document, "middle").into_iter().filter(|(_, text)| is_time(text));
        let mut times: Vec<(f64, f64)> = times.map(|([x, _], text)| (x, number(&text))).collect();
        times.sort_by(|a, b| a.0.total_cmp(&b.0));
        let second = |pairs: &[(f64, f64)]| pairs.iter().map(|pair| pair.1).collect::<Vec<_>>();
        let (time, value) = (Ruler::of(&xs, &second(&times)), Ruler::of(&ys, &second(&values)));
        Self { time, value, top, bottom, document }
    }

    fn has(&self, [_, y]: Place) -> bool {
        y >= self.top - 1.0 && y <= self.bottom + 1.0
    }

    /// The points of the curve of this name, as times and values; pieces one after the other.
    pub fn curve(&self, wanted: &str) -> Vec<Place> {
        let nodes = elements(self.document, "polyline")
            .filter(|node| name(*node).as_deref() == Some(wanted));
        let places = nodes.flat_map(points).filter(|place| self.has(*place));
        places.map(|[x, y]| [self.time.read(x), self.value.read(y)]).collect()
    }

    /// Time and value of the dot of this name.
    pub fn dot(&self, wanted: &str) -> Option<Place> {
        let mut nodes =
            elements(self.document, "circle").filter(|node| name(*node).as_deref() == Some(wanted));
        let places = nodes.find_map(|node| {
            Some([attribute(node, "cx"), attribute(node, "cy")]).filter(|place| self.has(*place))
        });
        places.map(|[x, y]| [self.time.read(x), self.value.read(y)])
    }

    /// Times of lines from the top of the panel to its bottom, but those of the grid.
    pub fn marks(&self) -> Vec<f64> {
        let lines = elements(self.document, "polyline")
            .filter(|node| node.attribute("stroke") != Some("#e3e6ea"))
            .map(points);
        let across = |line: &Vec<Place>| {
            line.len() == 2
                && line[0][0] == line[1][0]
                && line[0][1] <= self.top + 0.1
                && line[1][1] >= self.bottom - 0.1
        };
        lines.filter(across).map(|line| self.time.read(line[0][0])).collect()
    }
}

/// A number of an axis; of a power of ten its exponent.
fn value(text: &str) -> f64 {
    text.split_once('^').map_or_else(
        || number(text),
        |(base, raised)| {
            assert_eq!(base, "10");
            number(raised)
        },
    )
}
