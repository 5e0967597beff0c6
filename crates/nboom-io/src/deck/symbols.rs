/// The groups of a deck, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Group {
    /// `&DIM`: how many of everything.
    Dim,
    /// `&NXPUT`: bodies, hinges, forces and initial motion.
    Nxput,
    /// `&DYNSTA`: sections and stations for the stresses; may be absent.
    Dynsta,
    /// `&DYNSTB`: inertias of the slices between stations; may be absent.
    Dynstb,
    /// `&ROCK`: times, integrator settings and hinge states.
    Rock,
}

impl Group {
    /// All groups in order.
    pub const ALL: [Self; 5] = [Self::Dim, Self::Nxput, Self::Dynsta, Self::Dynstb, Self::Rock];

    /// The name as a deck has it, with `&`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dim => "&DIM",
            Self::Nxput => "&NXPUT",
            Self::Dynsta => "&DYNSTA",
            Self::Dynstb => "&DYNSTB",
            Self::Rock => "&ROCK",
        }
    }

    /// Whether a deck may do without it.
    pub fn may_be_absent(self) -> bool {
        matches!(self, Self::Dynsta | Self::Dynstb)
    }
}

/// How far a subscript runs, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// To this number.
    Fixed(usize),
    /// To the number of segments, `IXK`.
    Segments,
    /// To the number of appendages, `NA`.
    Appendages,
}

/// What kind of numbers a symbol takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NumberKind {
    /// Whole numbers; `3.0` is one.
    Integer,
    /// Any finite numbers.
    Real,
}

/// Numbers that are part of a name, such as 35 in `DLI35`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbering {
    /// The name stands alone.
    None,
    /// The number of a segment follows: `DELC3`.
    Segment,
    /// The number of a segment and one digit for a station follow: `DLI154`.
    SegmentAndStation,
}

/// The meaning of a symbol that is not given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Absent {
    /// The deck is wrong.
    Error,
    /// The deck is wrong under this condition; otherwise zero.
    ErrorWhen(&'static str),
    /// It has this value.
    Is(f64),
    /// Something else.
    Means(&'static str),
}

/// One row of Table 16.1: a name that may stand in a deck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Symbol {
    /// Name, with the letter O where the original printed a slashed O; for a numbered symbol
    /// without the number.
    pub name: &'static str,
    /// Other names of the same thing.
    pub aliases: &'static [&'static str],
    /// Whether numbers follow the name.
    pub numbering: Numbering,
    /// The group it belongs to.
    pub group: Group,
    /// Ranges of the subscripts, the first running fastest; empty for a single value.
    pub shape: &'static [Extent],
    /// Integers or reals.
    pub kind: NumberKind,
    /// Unit in the original's letters: D degrees, R radians, F force, L length, T time.
    pub unit: &'static str,
    /// The meaning if it is not given.
    pub absent: Absent,
    /// Meaning in one phrase.
    pub meaning: &'static str,
}

impl Symbol {
    /// Whether assigning the whole array would depend on the original's unknown dimensions.
    pub fn needs_subscripts(&self) -> bool {
        matches!(self.shape, [Extent::Segments, _, ..])
    }

    const fn also(mut self, aliases: &'static [&'static str]) -> Self {
        self.aliases = aliases;
        self
    }

    const fn numbered(mut self, numbering: Numbering) -> Self {
        self.numbering = numbering;
        self
    }
}

const fn row(
    group: Group,
    name: &'static str,
    shape: &'static [Extent],
    kind: NumberKind,
    unit: &'static str,
    absent: Absent,
    meaning: &'static str,
) -> Symbol {
    let (aliases, numbering): (&[&str], _) = (&[], Numbering::None);
    Symbol { name, aliases, numbering, group, shape, kind, unit, absent, meaning }
}

use Absent::{Error, ErrorWhen, Is, Means};
use Extent::{Appendages, Fixed, Segments};
use Group::{Dim, Dynsta, Dynstb, Nxput, Rock};
use NumberKind::{Integer, Real};

const ONE: &[Extent] = &[];
const THREE: &[Extent] = &[Fixed(3)];
const MATRIX: &[Extent] = &[Fixed(3), Fixed(3)];
const N: &[Extent] = &[Segments];
const NA: &[Extent] = &[Appendages];
const POINTS: &[Extent] = &[Fixed(3), Segments];
const FRAMES: &[Extent] = &[Fixed(3), Appendages];
const STATIONS: &[Extent] = &[Fixed(5), Segments];
const WALLS: &[Extent] = &[Fixed(6), Fixed(5)];
const MASS: Absent = ErrorWhen("no slices say it, or EMIK, CNIK or HIIK of the segment is given");
const STRESS: Absent = ErrorWhen("INSTR is above 0 and the station exists");

/// Every name a deck may contain, Table 16.1.
#[rustfmt::skip]
pub const SYMBOLS: &[Symbol] = &[
    row(Dim, "NA", ONE, Integer, "-", Error, "appendages"),
    row(Dim, "NP", ONE, Integer, "-", Is(0.0), "paddles, the last NP of the appendages"),
    row(Dim, "IXK", ONE, Integer, "-", Error, "segments in all"),
    row(Dim, "IXYZ", ONE, Integer, "-", Is(0.0), "0: orientation by FTSM; 1: by EMO"),
    row(Dim, "IAB", ONE, Integer, "-", Is(0.0), "0: BETAIK and TAUIK are read; otherwise ALIK and SIGIK"),
    row(Dim, "NOPLT", ONE, Integer, "-", Is(0.0), "1: no plots; ignored, --plots asks for figures"),

    row(Nxput, "INSTR", ONE, Integer, "-", Is(0.0), "0: no stresses; n: stresses at every n-th print"),
    row(Nxput, "BETAIK", N, Real, "D", ErrorWhen("IAB is 0"), "initial angle relative to the inboard segment"),
    row(Nxput, "ALIK", N, Real, "D", ErrorWhen("IAB is not 0"), "initial angle relative to the main body (of a paddle's second body: to the first)"),
    row(Nxput, "TAUIK", N, Real, "D/T", Is(0.0), "rate of BETAIK"),
    row(Nxput, "SIGIK", N, Real, "D/T", Is(0.0), "rate of ALIK"),
    row(Nxput, "FTSM", THREE, Real, "D", Is(0.0), "psi, theta, phi of the main body, eq. (9.7)"),
    row(Nxput, "EMO", MATRIX, Real, "-", ErrorWhen("IXYZ is 1"), "initial orientation; its columns are the body axes in inertial axes"),
    row(Nxput, "BSIK", N, Real, "D", Means("the hinge never locks, with a warning"), "relative angle at which the hinge locks; 1e6 and more: never"),
    row(Nxput, "QNIK", &[Segments, Fixed(4)], Real, "FLT2/R2, FLT/R, FL/R2, FL/R", Is(0.0), "dashpot q1 to q4, eq. (6.1)"),
    row(Nxput, "EKNIK", &[Segments, Fixed(2)], Real, "FL/R2, FL/R", Is(0.0), "spring k1 (quadratic) and k2 (linear), eq. (6.1)"),
    row(Nxput, "GAMAIK", N, Real, "D", Is(0.0), "dashpot preload angle"),
    row(Nxput, "THETIK", N, Real, "D", Is(0.0), "spring preload angle"),
    row(Nxput, "RHO", THREE, Real, "L", Is(0.0), "O from the inertial origin, body components"),
    row(Nxput, "VBAR", THREE, Real, "L/T", Is(0.0), "rate of change of the components RHO"),
    row(Nxput, "OMEG", THREE, Real, "D/T", Is(0.0), "angular rate of the main body, body components"),
    row(Nxput, "NK", NA, Integer, "-", Error, "segments of each appendage"),
    row(Nxput, "DBK", FRAMES, Real, "L", Error, "first hinge point, body axes"),
    row(Nxput, "FTSIK", FRAMES, Real, "D", Error, "psi, theta, phi of the appendage axes, eq. (9.6)"),
    row(Nxput, "ELIK", N, Real, "L", Error, "length from hinge to hinge, or to the outer end"),
    row(Nxput, "EMIK", N, Real, "FT2/L", MASS, "mass"),
    row(Nxput, "HIIK", &[Fixed(3), Fixed(3), Segments], Real, "FLT2", MASS, "inertia about the mass centre, segment axes; products may be left out"),
    row(Nxput, "CNIK", &[Segments, Fixed(3)], Real, "L", Means("0, unless slices say it"), "mass centre from the inboard hinge, segment axes"),
    row(Nxput, "EMM", ONE, Real, "FT2/L", Error, "mass of the main body"),
    row(Nxput, "HM", MATRIX, Real, "FLT2", Error, "inertia of the main body about its mass centre; products may be left out"),
    row(Nxput, "BBM", THREE, Real, "L", Is(0.0), "mass centre of the main body from O"),
    row(Nxput, "X", ONE, Real, "-", Is(1.0), "first Euler parameter of eq. (9.13)"),
    row(Nxput, "EKBAR", THREE, Real, "-", Is(0.0), "the other three Euler parameters"),
    row(Nxput, "FT", ONE, Real, "F", Is(0.0), "thrust"),
    row(Nxput, "FTHAT", THREE, Real, "-", ErrorWhen("FT is not 0"), "unit vector along the thrust, body axes"),
    row(Nxput, "FTBAR", THREE, Real, "L", Is(0.0), "point of the thrust, body axes"),
    row(Nxput, "TINT", ONE, Real, "T", Is(0.0), "time at which the thrust starts"),
    row(Nxput, "TFIN", ONE, Real, "T", Is(0.0), "time at which the thrust stops"),
    row(Nxput, "G", ONE, Real, "L/T2", Is(0.0), "acceleration of gravity"),
    row(Nxput, "GHAT", THREE, Real, "-", ErrorWhen("G is not 0"), "unit vector away from the attracting centre, inertial axes").also(&["GH", "HS", "SH"]),
    row(Nxput, "RIK1", POINTS, Real, "L", Is(0.0), "kick-off spring's point on the main body, from O, body axes"),
    row(Nxput, "SIK1", POINTS, Real, "L", Is(0.0), "kick-off spring's point on the segment, from its hinge, segment axes"),
    row(Nxput, "AES", &[Fixed(4), Segments], Real, "F/L**j", Is(0.0), "kick-off force a0 to a3 as a polynomial in the spring's length; all zero: no spring"),
    row(Nxput, "XIKF", N, Real, "L", ErrorWhen("AES is not all zero"), "length beyond which the kick-off force is zero"),
    row(Nxput, "IREL", N, Integer, "-", Is(0.0), "0: RELTB is a time; J: RELTB is an angle of segment J"),
    row(Nxput, "RELTB", N, Real, "T or D", Is(0.0), "time, or relative angle of segment IREL, at which the segment is released; 1e6 and more: never"),
    row(Nxput, "TSK", NA, Real, "T", Means("IREL and RELTB say it"), "release time of each first segment; superseded, must agree with RELTB"),

    row(Dynsta, "NSTA", N, Integer, "-", ErrorWhen("INSTR is above 0"), "stations of each segment, 1 to 5"),
    row(Dynsta, "ICIR", N, Integer, "-", Is(0.0), "0: tube; otherwise polygon"),
    row(Dynsta, "NVER", STATIONS, Integer, "-", ErrorWhen("INSTR is above 0 and the section is a polygon"), "vertices at (station, segment), 3 to 6; 1 for a tube"),
    row(Dynsta, "S", STATIONS, Real, "L", Is(0.0), "station from the inboard hinge, outboard station first"),
    row(Dynsta, "DELM", STATIONS, Real, "FT2/L", Is(0.0), "mass of the slice between a station and the one outboard of it"),
    row(Dynsta, "R", STATIONS, Real, "L", STRESS, "radius of a tube"),
    row(Dynsta, "DELC", &[Fixed(3), Fixed(5)], Real, "L", Is(0.0), "mass centre of each slice from the inboard hinge, segment axes").numbered(Numbering::Segment),
    row(Dynsta, "T", WALLS, Real, "L", STRESS, "wall thickness at (vertex, station); the first one for a tube").numbered(Numbering::Segment),
    row(Dynsta, "XI", WALLS, Real, "L", Is(0.0), "first vertex coordinate at (vertex, station)").numbered(Numbering::Segment),
    row(Dynsta, "ZETA", WALLS, Real, "L", Is(0.0), "second vertex coordinate at (vertex, station)").numbered(Numbering::Segment),
    row(Dynsta, "CMN", N, Real, "T", ErrorWhen("INSTR is above 0"), "lock-up pulse: impulse over peak"),
    row(Dynsta, "XNU", N, Real, "-", Is(0.0), "Poisson's ratio; ignored, no stress depends on it"),
    row(Dynsta, "E", N, Real, "F/L2", ErrorWhen("INSTR is above 0"), "Young's modulus; ignored, no stress depends on it"),

    row(Dynstb, "DLI", MATRIX, Real, "FLT2", Is(0.0), "inertia of a slice about its own mass centre").numbered(Numbering::SegmentAndStation),

    row(Rock, "HZO", ONE, Real, "T", Means("no setting"), "first step"),
    row(Rock, "EU1", ONE, Real, "-", Means("no setting"), "error above which the step is halved").also(&["EU"]),
    row(Rock, "EL1", ONE, Real, "-", Means("no setting"), "error below which the step is doubled").also(&["EL"]),
    row(Rock, "HMIN", ONE, Real, "T", Means("no setting"), "smallest step"),
    row(Rock, "HMAX", ONE, Real, "T", Means("no setting"), "largest step"),
    row(Rock, "TZO", ONE, Real, "T", Is(0.0), "initial time"),
    row(Rock, "TF", ONE, Real, "T", Error, "final time"),
    row(Rock, "LSTEP", ONE, Integer, "-", Means("no setting"), "most steps"),
    row(Rock, "IAX", ONE, Integer, "-", Means("no setting"), "output times from one printout to the next after the twentieth, with --listing"),
    row(Rock, "SEGSTT", N, Integer, "-", Is(0.0), "0: unreleased; 1: released; 2: locked"),
];
