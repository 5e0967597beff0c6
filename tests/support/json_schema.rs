//! What a JSON Schema takes.

use boon::{Compiler, SchemaIndex, Schemas};
use serde_json::Value;

/// A schema, ready to compare values with.
pub struct JsonSchema {
    all: Schemas,
    root: SchemaIndex,
}

impl JsonSchema {
    /// # Panics
    /// When it is no schema.
    pub fn new(schema: &Value) -> Self {
        const PLACE: &str = "https://nboom.test/schema.json";
        let (mut compiler, mut all) = (Compiler::new(), Schemas::new());
        compiler.add_resource(PLACE, schema.clone()).expect("a place");
        let root = compiler.compile(PLACE, &mut all).expect("a schema");
        Self { all, root }
    }

    /// # Errors
    /// What it does not take, and where it says so.
    pub fn take(&self, value: &Value) -> Result<(), String> {
        self.all.validate(value, self.root).map_err(|error| format!("{error:#}"))
    }
}
