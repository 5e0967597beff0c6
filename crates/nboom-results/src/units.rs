/// A consistent set of units, for labels only: no number is ever converted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
}

impl UnitSystem {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::None, Self::Si, Self::FtLbfS, Self::InLbfS];

    /// The name used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Si => "SI",
            Self::FtLbfS => "ft-lbf-s",
            Self::InLbfS => "in-lbf-s",
        }
    }

    /// The set of that name, letter case ignored.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|units| units.name().eq_ignore_ascii_case(name))
    }

    /// Label of a length.
    pub fn length(self) -> &'static str {
        match self {
            Self::None => "L",
            Self::Si => "m",
            Self::FtLbfS => "ft",
            Self::InLbfS => "in",
        }
    }

    /// Label of a time.
    pub fn time(self) -> &'static str {
        match self {
            Self::None => "T",
            Self::Si | Self::FtLbfS | Self::InLbfS => "s",
        }
    }

    /// Label of a force.
    pub fn force(self) -> &'static str {
        match self {
            Self::None => "F",
            Self::Si => "N",
            Self::FtLbfS | Self::InLbfS => "lbf",
        }
    }

    /// Label of an energy.
    pub fn energy(self) -> String {
        match self {
            Self::Si => "J".to_owned(),
            Self::None | Self::FtLbfS | Self::InLbfS => self.torque(),
        }
    }

    /// Label of a torque.
    pub fn torque(self) -> String {
        match self {
            Self::Si => "N m".to_owned(),
            _ => format!("{} {}", self.length(), self.force()),
        }
    }

    /// Label of a linear momentum or an impulsive force.
    pub fn momentum(self) -> String {
        format!("{} {}", self.force(), self.time())
    }

    /// Label of an angular momentum or an impulsive torque.
    pub fn angular_momentum(self) -> String {
        format!("{} {}", self.torque(), self.time())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back_to_their_sets() {
        for units in UnitSystem::ALL {
            assert_eq!(UnitSystem::from_name(units.name()), Some(units));
        }
        assert_eq!(UnitSystem::from_name("si"), Some(UnitSystem::Si));
        assert_eq!(UnitSystem::from_name("cubits"), None);
    }
}
