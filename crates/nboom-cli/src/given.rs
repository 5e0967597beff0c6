//! The options of a run in words, so that they can be written and given again.

use std::collections::{BTreeMap, BTreeSet};

use clap::parser::ValueSource;
use clap::{ArgMatches, Command, CommandFactory};
use serde::{Deserialize, Serialize};

use crate::Cli;

/// The options that a run was given or has by default, by name and in words.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Given {
    options: BTreeMap<String, Words>,
    /// Names of those that are no defaults.
    #[serde(skip)]
    by_hand: BTreeSet<String>,
}

/// What an option was given.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
enum Words {
    Flag(bool),
    One(String),
    Several(Vec<String>),
}

impl Words {
    /// All of them; none of a flag.
    fn all(&self) -> &[String] {
        match self {
            Self::Flag(_) => &[],
            Self::One(word) => std::slice::from_ref(word),
            Self::Several(words) => words,
        }
    }
}

/// The option whose words each give a parameter of the scene, as NAME=VALUE.
const SET: &str = "set";

/// The argument that is no option.
const SCENE: &str = "scene";

impl Given {
    /// Says an option in other words.
    pub(crate) fn with(mut self, name: &str, words: String) -> Self {
        self.options.insert(name.to_owned(), Words::One(words));
        self
    }

    /// Without these options.
    pub(crate) fn without(mut self, names: &[&str]) -> Self {
        self.options.retain(|name, _| !names.contains(&name.as_str()));
        self
    }

    /// The first of these options that is no default.
    pub(crate) fn first_by_hand<'n>(&self, names: &[&'n str]) -> Option<&'n str> {
        names.iter().find(|&&name| self.by_hand.contains(name)).copied()
    }

    /// With those that were given to `other`, in place of their own and of those that they exclude; a parameter that
    /// `other` does not give keeps the value that it had.
    pub(crate) fn changed_by(mut self, other: &Self) -> Self {
        let cli = Cli::command();
        let run = cli.find_subcommand("run").expect("a command");
        let exclude = |one: &str, another: &str| {
            let mut all = run.get_arguments();
            let one = all.find(|option| option.get_long() == Some(one));
            let excluded = one.map_or_else(Vec::new, |one| run.get_arg_conflicts_with(one));
            excluded.iter().any(|option| option.get_long() == Some(another))
        };
        self.options.retain(|name, _| {
            !other.by_hand.iter().any(|given| exclude(given, name) || exclude(name, given))
        });
        let parameters = self.parameters_with(other);
        let by_hand = other.options.iter().filter(|(name, _)| other.by_hand.contains(*name));
        self.options.extend(by_hand.map(|(name, words)| (name.clone(), words.clone())));
        self.options.extend(parameters.map(|words| (SET.to_owned(), words)));
        self
    }

    /// The words of both for parameters; of one that both give those of `other`.
    fn parameters_with(&self, other: &Self) -> Option<Words> {
        let given = other.options.get(SET)?.all();
        let name = |word: &str| word.split('=').next().map(|name| name.trim().to_owned());
        let is_kept = |word: &&String| !given.iter().any(|given| name(given) == name(word));
        let kept = self.options.get(SET).map_or(&[][..], Words::all).iter().filter(is_kept);
        Some(Words::Several(kept.chain(given).cloned().collect()))
    }

    /// Words of a command line.
    pub(crate) fn words(&self) -> Vec<String> {
        let option = |(name, words): (&String, &Words)| match words {
            Words::Flag(is_given) => Vec::from_iter(is_given.then(|| format!("--{name}"))),
            words => words.all().iter().map(|word| format!("--{name}={word}")).collect(),
        };
        self.options.iter().flat_map(option).collect()
    }
}

impl clap::FromArgMatches for Given {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut given = Self::default();
        // Groups of arguments have names of types.
        let is_option = |id: &&str| *id != SCENE && !id.starts_with(char::is_uppercase);
        for id in matches.ids().map(clap::Id::as_str).filter(is_option) {
            let name = id.replace('_', "-");
            if matches.value_source(id) == Some(ValueSource::CommandLine) {
                given.by_hand.insert(name.clone());
            }
            let words = match matches.try_get_one::<bool>(id) {
                Ok(Some(is_given)) => Words::Flag(*is_given),
                _ => {
                    let raw = matches.try_get_raw(id).ok().flatten().into_iter().flatten();
                    let mut words = raw.map(|word| word.to_string_lossy().into_owned());
                    match (words.next(), words.collect::<Vec<_>>()) {
                        (Some(one), others) if others.is_empty() => Words::One(one),
                        (first, others) => {
                            Words::Several(first.into_iter().chain(others).collect())
                        }
                    }
                }
            };
            given.options.insert(name, words);
        }
        Ok(given)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// No arguments of its own: it reads those of others.
impl clap::Args for Given {
    fn augment_args(command: Command) -> Command {
        command
    }

    fn augment_args_for_update(command: Command) -> Command {
        command
    }
}

#[cfg(test)]
mod tests {
    use crate::{Cli, RunArgs};
    use clap::{CommandFactory, Parser};

    fn run(words: &[&str]) -> RunArgs {
        let words = [&["nboom", "run", "a.toml"], words].concat();
        match Cli::try_parse_from(words).expect("right").command {
            crate::Command::Run(args) => *args,
            _ => unreachable!("the words say run"),
        }
    }

    #[test]
    fn words_say_the_options_again() {
        let words = [
            "--as-1970=tube-shear",
            "--certify",
            "--columns=beta,v_x",
            "--end-time=-1",
            "--listing",
            "--set=a=1",
            "--set=b=-2",
            "--tables=parquet,hdf5",
            "-o",
            "there",
            "--times",
            "0.5,1",
        ];
        let first = run(&words);
        let said = first.given.words();
        for word in [
            "--as-1970=tube-shear",
            "--atol=1e-12",
            "--certify=tighter-tolerance",
            "--columns=beta,v_x",
            "--end-time=-1",
            "--integrator=auto",
            "--listing",
            "--output=there",
            "--set=a=1",
            "--set=b=-2",
            "--tables=parquet",
            "--tables=hdf5",
            "--times=0.5,1",
        ] {
            assert!(said.iter().any(|said| said == word), "{word}: {said:?}");
        }
        let again = run(&said.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(format!("{:?}", first.tables), format!("{:?}", again.tables));
        assert_eq!(again.given.words(), said);
    }

    #[test]
    fn every_option_is_recorded_by_its_name() {
        let cli = Cli::command();
        let run = cli.find_subcommand("run").expect("a command");
        for option in run.get_arguments().filter(|arg| !arg.is_positional()) {
            let name = option.get_id().as_str().replace('_', "-");
            assert_eq!(option.get_long(), Some(&*name));
        }
    }

    #[test]
    fn what_is_given_later_replaces_what_was_given() {
        let [was, now] = [
            &["--rtol=1e-5", "--set=a=1", "--set=b=3", "--quiet"][..],
            &["--set=a=2", "--listing"],
        ];
        let said = run(was).given.changed_by(&run(now).given).words();
        for (word, is_there) in [
            ("--rtol=1e-5", true),
            ("--quiet", true),
            ("--listing", true),
            ("--set=a=2", true),
            ("--set=a=1", false),
            ("--set=b=3", true),
            ("--rtol=1e-9", false),
        ] {
            assert_eq!(said.iter().any(|said| said == word), is_there, "{word}: {said:?}");
        }
    }
}
