use std::{env, fmt};

use nboom_scalar::InstructionSet;
use serde::{Deserialize, Serialize};

/// A program and the machine that it runs on, as far as results depend on them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Maker {
    /// Of nboom.
    pub version: String,
    /// What the program was built with; none, and not in a file, where that is not told.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub features: Option<Vec<String>>,
    /// Vector instructions of generated code.
    pub instructions: String,
    /// Processor and system.
    pub platform: String,
}

impl Maker {
    /// This program on this machine, without its features, which it knows itself.
    pub fn current() -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            features: None,
            instructions: InstructionSet::of_this_processor().name().to_owned(),
            platform: format!("{}-{}", env::consts::ARCH, env::consts::OS),
        }
    }

    /// What is different about another, which is that of now, in words.
    pub fn differences(&self, now: &Self) -> Vec<String> {
        let features = |maker: &Self| match maker.features.as_deref() {
            None | Some([]) => "none".to_owned(),
            Some(features) => features.join(", "),
        };
        let pairs = [
            ("version", self.version.clone(), now.version.clone()),
            ("features", features(self), features(now)),
            ("instructions", self.instructions.clone(), now.instructions.clone()),
            ("platform", self.platform.clone(), now.platform.clone()),
        ];
        let different = pairs.into_iter().filter(|(_, then, now)| then != now);
        different.map(|(what, then, now)| format!("{what} {then} then, {now} now")).collect()
    }
}

impl fmt::Display for Maker {
    /// Without its features.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "nboom {}, {}, {}", self.version, self.instructions, self.platform)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_differs_is_told_and_features_are_in_a_file_where_they_are_told() {
        let features = |names: &[&str]| Some(names.iter().map(|&name| name.to_owned()).collect());
        let of = |version: &str, features| Maker {
            version: version.to_owned(),
            features,
            instructions: "avx2".to_owned(),
            platform: "x86_64-linux".to_owned(),
        };
        let (then, now) = (of("1", features(&["generator"])), of("2", features(&[])));
        assert_eq!(then.differences(&then), [""; 0]);
        assert_eq!(
            then.differences(&now),
            ["version 1 then, 2 now", "features generator then, none now"]
        );
        assert_eq!(then.to_string(), "nboom 1, avx2, x86_64-linux");
        for (maker, text) in [
            (then, r#"{"version":"1","features":["generator"],"#),
            (now, r#"{"version":"2","features":[],"#),
            (of("3", None), r#"{"version":"3","#),
        ] {
            let text = format!(r#"{text}"instructions":"avx2","platform":"x86_64-linux"}}"#);
            assert_eq!(serde_json::to_string(&maker).expect("texts"), text);
            assert_eq!(serde_json::from_str::<Maker>(&text).expect("a maker"), maker);
        }
    }
}
