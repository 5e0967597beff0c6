/// A consistent set of units, for labels only: no number is ever converted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum UnitSystem {
    /// Unknown units; the labels are the letters L, T and F.
    #[default]
    None,
    /// Metre, second, newton.
    Si,
    /// Foot, second, pound of force.
    FtLbfS,
    /// Inch, second, pound of force.
    InLbfS,
    /// Labels of the scene's own.
    Custom {
        /// Of a length.
        length: String,
        /// Of a time.
        time: String,
        /// Of a force.
        force: String,
    },
}

impl UnitSystem {
    /// Those that have a name.
    pub const NAMED: [Self; 4] = [Self::None, Self::Si, Self::FtLbfS, Self::InLbfS];

    /// The name used in files and on the command line.
    pub fn name(&self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Si => "SI",
            Self::FtLbfS => "ft-lbf-s",
            Self::InLbfS => "in-lbf-s",
            Self::Custom { .. } => "custom",
        }
    }

    /// The set of that name, letter case ignored.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::NAMED.into_iter().find(|units| units.name().eq_ignore_ascii_case(name))
    }

    /// Label of a length.
    pub fn length(&self) -> &str {
        match self {
            Self::None => "L",
            Self::Si => "m",
            Self::FtLbfS => "ft",
            Self::InLbfS => "in",
            Self::Custom { length, .. } => length,
        }
    }

    /// Label of a time.
    pub fn time(&self) -> &str {
        match self {
            Self::None => "T",
            Self::Si | Self::FtLbfS | Self::InLbfS => "s",
            Self::Custom { time, .. } => time,
        }
    }

    /// Label of a force.
    pub fn force(&self) -> &str {
        match self {
            Self::None => "F",
            Self::Si => "N",
            Self::FtLbfS | Self::InLbfS => "lbf",
            Self::Custom { force, .. } => force,
        }
    }

    /// Label of a unit that is made of those of length L, time T and force F, as `F L/T`.
    pub fn label(&self, unit: &str) -> String {
        let mut label = String::with_capacity(2 * unit.len());
        for letter in unit.chars() {
            match letter {
                'L' => label.push_str(self.length()),
                'T' => label.push_str(self.time()),
                'F' => label.push_str(self.force()),
                other => label.push(other),
            }
        }
        label
    }

    /// Label of an energy.
    pub fn energy(&self) -> String {
        if *self == Self::Si { "J".to_owned() } else { self.torque() }
    }

    /// Label of a torque.
    pub fn torque(&self) -> String {
        if *self == Self::Si {
            return "N m".to_owned();
        }
        format!("{} {}", self.length(), self.force())
    }

    /// Label of a stress.
    pub fn stress(&self) -> String {
        match (self.force(), self.length()) {
            ("N", "m") => "Pa".to_owned(),
            (force, length) => format!("{force}/{length}²"),
        }
    }

    /// Label of a speed.
    pub fn speed(&self) -> String {
        self.label("L/T")
    }

    /// Label of a linear momentum or an impulsive force.
    pub fn momentum(&self) -> String {
        format!("{} {}", self.force(), self.time())
    }

    /// Label of an angular momentum or an impulsive torque.
    pub fn angular_momentum(&self) -> String {
        format!("{} {}", self.torque(), self.time())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back_to_their_sets() {
        for units in UnitSystem::NAMED {
            assert_eq!(UnitSystem::from_name(units.name()), Some(units));
        }
        assert_eq!(UnitSystem::from_name("si"), Some(UnitSystem::Si));
        assert_eq!(UnitSystem::from_name("cubits"), None);
    }

    #[test]
    fn labels_of_a_scene_make_up_the_others() {
        let [length, time, force] = ["mm", "ms", "kN"].map(str::to_owned);
        let units = UnitSystem::Custom { length, time, force };
        assert_eq!(units.angular_momentum(), "mm kN ms");
        assert_eq!(units.label("rad/T"), "rad/ms");
        assert_eq!(units.label("F/L^2"), "kN/mm^2");
        assert_eq!([units.stress(), units.speed()], ["kN/mm²", "mm/ms"]);
        assert_eq!(UnitSystem::Si.stress(), "Pa");
        assert_eq!(UnitSystem::FtLbfS.label("F L T"), "lbf ft s");
        assert_eq!(UnitSystem::None.label("F L T"), "F L T");
    }
}
