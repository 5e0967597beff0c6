use clap::{Args, ValueEnum};

/// Options of `nboom schema`.
#[derive(Args, Debug)]
pub struct SchemaArgs {
    /// What the schema is of.
    #[arg(value_name = "KIND", value_enum, default_value = "scene")]
    pub kind: SchemaKind,
}

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SchemaKind {
    /// A scene, for nboom run.
    Scene,
    /// A study, for nboom sweep.
    Study,
}

/// The schema in JSON, for standard output.
pub(crate) fn schema(args: &SchemaArgs) -> String {
    let schema = match args.kind {
        SchemaKind::Scene => nboom_io::schema(),
        SchemaKind::Study => nboom_study::schema(),
    };
    format!("{schema:#}\n")
}
