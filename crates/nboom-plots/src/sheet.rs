//! What a figure is drawn with: lines, dots and words, which every format writes in its own way.

/// Red, green and blue.
pub(crate) type Colour = [u8; 3];

/// A point, from the upper left corner \[px, of 1/96 inch\].
pub(crate) type Place = [f64; 2];

/// A figure as it is drawn; later marks cover earlier ones.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sheet {
    pub title: String,
    pub width: f64,
    pub height: f64,
    pub marks: Vec<Mark>,
}

#[derive(Debug, Clone)]
pub(crate) enum Mark {
    /// A line through points, with the name of the curve that it is.
    Line { points: Vec<Place>, stroke: Stroke, name: Option<String> },
    /// A filled disc with a white edge, with the name of what it marks.
    Dot { at: Place, radius: f64, colour: Colour, name: Option<String> },
    /// Words.
    Words(Words),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    pub colour: Colour,
    pub width: f64,
    /// Lengths of dashes and gaps; none of a whole line.
    pub dash: &'static [f64],
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of text.
#[derive(Debug, Clone)]
pub(crate) struct Words {
    pub text: String,
    /// An exponent after the text, smaller and higher.
    pub raised: String,
    /// Which point of its base line `at` is.
    pub anchor: Anchor,
    pub at: Place,
    pub size: f64,
    pub colour: Colour,
    /// Whether it reads from below to above.
    pub upward: bool,
}

/// Size of an exponent, and how high it stands, as shares of the size of its text.
pub(crate) const RAISED_SIZE: f64 = 0.72;
pub(crate) const RAISED_BY: f64 = 0.42;

impl Words {
    /// Level, dark words that begin at a place.
    pub fn new(text: impl Into<String>, at: Place, size: f64) -> Self {
        let (text, raised) = (text.into(), String::new());
        let (anchor, colour) = (Anchor::Start, crate::style::INK);
        Self { text, raised, anchor, at, size, colour, upward: false }
    }

    pub fn anchored(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    pub fn raised(self, raised: String) -> Self {
        Self { raised, ..self }
    }

    pub fn coloured(self, colour: Colour) -> Self {
        Self { colour, ..self }
    }

    pub fn upward(self) -> Self {
        Self { upward: true, ..self }
    }
}

impl Sheet {
    pub fn line(&mut self, points: &[Place], stroke: Stroke) {
        self.marks.push(Mark::Line { points: points.to_vec(), stroke, name: None });
    }

    pub fn words(&mut self, words: Words) {
        self.marks.push(Mark::Words(words));
    }
}
