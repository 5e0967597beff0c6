use crate::{HingeLabel, Quantity};

/// A column of a table of the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// What it has.
    pub quantity: Quantity,
    /// Which of its numbers, from 0; of a quantity of rotors, which rotor of the scene.
    pub component: usize,
    /// The hinge, of a quantity of hinges.
    pub hinge: Option<usize>,
}

/// A table of the motion that somebody asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WantedTable {
    /// Its columns after the time.
    pub columns: Vec<Column>,
    /// Whether angles and rates are in degrees.
    pub in_degrees: bool,
}

impl WantedTable {
    /// The table of states of a scene with so many hinges: all columns, angles in radians.
    pub fn states(hinges: usize) -> Self {
        Self { columns: Column::all(hinges), in_degrees: false }
    }

    /// Whether it asks for something that only a main body that is held has.
    pub fn is_of_held_body(&self) -> bool {
        self.columns.iter().any(|column| Quantity::OF_A_HELD_BODY.contains(&column.quantity))
    }

    /// Whether it asks for something that takes an evaluation of the equations of motion.
    pub fn needs_detail(&self) -> bool {
        let asks = |column: &Column| column.quantity == Quantity::MotorTorque;
        self.is_of_held_body() || self.columns.iter().any(asks)
    }

    /// Adds columns that it does not have yet.
    pub fn add(&mut self, columns: impl IntoIterator<Item = Column>) {
        for column in columns {
            if !self.columns.contains(&column) {
                self.columns.push(column);
            }
        }
    }

    /// The unit of a column, made of those of length L, time T and force F, of a scene with these hinges.
    pub fn unit(&self, column: &Column, hinges: &[HingeLabel]) -> &'static str {
        match column.unit(hinges) {
            "rad" if self.in_degrees => "deg",
            "rad/T" if self.in_degrees => "deg/T",
            unit => unit,
        }
    }

    /// Whether this column is in degrees, of a scene with these hinges.
    pub fn is_in_degrees(&self, column: &Column, hinges: &[HingeLabel]) -> bool {
        self.unit(column, hinges) != column.unit(hinges)
    }
}

/// A text that names no column of a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("column `{found}` found, {expected} expected")]
pub struct UnknownColumn {
    /// The text.
    pub found: String,
    /// What would have been right.
    pub expected: &'static str,
    /// All that may stand there.
    pub known: Vec<String>,
}

impl Column {
    /// All of a scene with so many hinges, in the order of its table of states.
    pub fn all(hinges: usize) -> Vec<Self> {
        let of = |quantities: &'static [Quantity], hinge| {
            quantities.iter().flat_map(move |quantity| Self::of(*quantity, hinge))
        };
        let hinges = (0..hinges).flat_map(|i| of(&Quantity::OF_A_HINGE, Some(i)));
        let before = of(&Quantity::BEFORE_HINGES, None).chain(hinges);
        before.chain(of(&Quantity::AFTER_HINGES, None)).collect()
    }

    /// Those that `text` names: a quantity (`omega`; of hinges that of all, `beta`), the quantity
    /// of a hinge by its body's name or its numbers (`beta of inner boom`, `beta of 1,2`), or one column as the table of states
    /// calls it (`omega_x`, `beta_1_2`). There are so many `rotors`, which have columns too
    /// (`rotor_speed_1`).
    ///
    /// # Errors
    /// When it names none.
    pub fn named(
        text: &str,
        hinges: &[HingeLabel],
        rotors: usize,
    ) -> Result<Vec<Self>, UnknownColumn> {
        if let Some((quantity, body)) = text.split_once(" of ") {
            return Self::of_body(text, quantity, body, hinges);
        }
        let mut all = Self::all(hinges.len());
        all.extend(Quantity::OF_A_HELD_BODY.into_iter().flat_map(|held| Self::of(held, None)));
        all.extend(Quantity::OF_A_ROTOR.into_iter().flat_map(|quantity| {
            (0..rotors).map(move |component| Self { quantity, component, hinge: None })
        }));
        let is_meant =
            |column: &&Self| column.quantity.name() == text || column.name(hinges) == text;
        let named: Vec<Self> = all.iter().filter(is_meant).copied().collect();
        if !named.is_empty() {
            return Ok(named);
        }
        let is_there = |quantity: &Quantity| all.iter().any(|column| column.quantity == *quantity);
        let mut known: Vec<String> = all.iter().map(|column| column.name(hinges)).collect();
        known.extend(Quantity::all().filter(is_there).map(|quantity| quantity.name().to_owned()));
        let missing = Quantity::all().filter(|quantity| !is_there(quantity));
        let expected = match missing.into_iter().find(|quantity| quantity.is_beginning_of(text)) {
            Some(of_rotor) if of_rotor.is_of_rotor() => "columns of a scene without rotors",
            Some(_) => "columns of a scene without hinges",
            None => "a quantity as `omega`, or a column of states.csv",
        };
        Err(UnknownColumn { found: text.to_owned(), expected, known })
    }

    fn of_body(
        text: &str,
        quantity: &str,
        body: &str,
        hinges: &[HingeLabel],
    ) -> Result<Vec<Self>, UnknownColumn> {
        let of_hinges = Quantity::OF_A_HINGE;
        let quantity = of_hinges.into_iter().find(|known| known.name() == quantity);
        let hinge = HingeLabel::find(hinges, body);
        if let (Some(quantity), Some(hinge)) = (quantity, hinge) {
            return Ok(Self::of(quantity, Some(hinge)).collect());
        }
        let names = || hinges.iter().filter_map(|hinge| hinge.name.as_deref());
        let of_quantity =
            |quantity: Quantity| names().map(move |body| format!("{} of {body}", quantity.name()));
        let known = of_hinges.into_iter().flat_map(of_quantity).collect();
        let expected = "beta, tau, alpha, sigma or state of a hinge, by the name of its body, or as `beta_1_2`";
        Err(UnknownColumn { found: text.to_owned(), expected, known })
    }

    fn of(quantity: Quantity, hinge: Option<usize>) -> impl Iterator<Item = Self> {
        (0..quantity.columns().len()).map(move |component| Self { quantity, component, hinge })
    }

    /// What tables call it.
    pub fn name(&self, hinges: &[HingeLabel]) -> String {
        if self.quantity.is_of_rotor() {
            return format!("{}_{}", self.quantity.name(), self.component + 1);
        }
        let name = self.quantity.columns()[self.component];
        match self.hinge.map(|hinge| hinges[hinge].numbers()) {
            Some([appendage, segment]) => format!("{name}_{appendage}_{segment}"),
            None => name.to_owned(),
        }
    }

    /// Its unit, made of those of length L, time T and force F: of a slide that of its travel.
    pub fn unit(&self, hinges: &[HingeLabel]) -> &'static str {
        match self.quantity {
            Quantity::Angle | Quantity::AngleSum if self.slides(hinges) => "L",
            Quantity::Rate | Quantity::RateSum if self.slides(hinges) => "L/T",
            quantity => quantity.unit(),
        }
    }

    /// What it is, in one line.
    pub fn about(&self, hinges: &[HingeLabel]) -> &'static str {
        match self.quantity {
            Quantity::Angle | Quantity::AngleSum if self.slides(hinges) => {
                "travel relative to the inboard body"
            }
            Quantity::Rate | Quantity::RateSum if self.slides(hinges) => {
                "speed relative to the inboard body"
            }
            quantity => quantity.about(),
        }
    }

    fn slides(&self, hinges: &[HingeLabel]) -> bool {
        self.hinge.is_some_and(|hinge| hinges[hinge].joint.slides())
    }
}
