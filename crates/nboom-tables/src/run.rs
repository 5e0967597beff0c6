use std::collections::HashSet;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use nboom_results::{
    HDF5_FILE, PACKAGE_FILE, PARQUET_FILES, SCENE_FILE, SUMMARY_FILE, column_name,
};
use serde::Deserialize;
use serde_json::Value;

use crate::group::Group;
use crate::parquet::ParquetFile;
use crate::{Cell, Column, Fields, Format, Rows, TablesError, hdf5};

/// The longest summary, scene or description of columns that is read \[bytes\].
const LONGEST: u64 = 1 << 28;

/// How much of what is wrong in a file is told \[characters\].
const TOLD: usize = 60;

/// The tables of a run.
#[derive(Clone, Debug)]
pub struct Run {
    directory: PathBuf,
    summary: String,
    scene: Option<String>,
    pub(crate) tables: Vec<Table>,
}

/// A table in CSV.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    file: &'static str,
    /// Its name for Parquet.
    parquet: &'static str,
    /// Their names are without units.
    pub columns: Vec<Column>,
}

#[derive(Deserialize)]
struct PackageKeys {
    resources: Vec<ResourceKeys>,
}

#[derive(Deserialize)]
struct ResourceKeys {
    path: String,
    schema: SchemaKeys,
}

#[derive(Deserialize)]
struct SchemaKeys {
    fields: Vec<Column>,
}

/// A file that can be made from the tables of a run.
#[derive(Clone, Copy, Debug)]
pub struct Output<'a> {
    /// Its name.
    pub name: &'static str,
    run: &'a Run,
    what: What<'a>,
}

#[derive(Clone, Copy, Debug)]
enum What<'a> {
    Parquet(&'a Table),
    Hdf5,
}

impl Run {
    /// Reads what is in the directory of a complete run, without the rows of its tables.
    ///
    /// # Errors
    /// When it is no such directory.
    pub fn read(directory: &Path) -> Result<Self, TablesError> {
        let (run, is_complete) = Self::read_any(directory)?;
        let directory = directory.to_owned();
        if is_complete { Ok(run) } else { Err(TablesError::Incomplete { directory }) }
    }

    /// As [`Self::read`], also of a run that failed, whose tables end where it did.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_so_far(directory: &Path) -> Result<Self, TablesError> {
        Self::read_any(directory).map(|(run, _)| run)
    }

    /// A run, and whether it is complete.
    fn read_any(directory: &Path) -> Result<(Self, bool), TablesError> {
        let summary = text(directory, SUMMARY_FILE)?;
        let keys: Value = json(directory, SUMMARY_FILE, &summary)?;
        let Some(is_complete) = keys["complete"].as_bool() else {
            return Err(wrong(directory, SUMMARY_FILE, "no summary of a run".to_owned()));
        };
        if !is_complete && !directory.join(PACKAGE_FILE).exists() {
            // It was killed.
            return Err(TablesError::Incomplete { directory: directory.to_owned() });
        }
        let package = text(directory, PACKAGE_FILE)?;
        let package: PackageKeys = json(directory, PACKAGE_FILE, &package)?;
        let tables = package.resources.into_iter().map(table).collect::<Result<_, _>>();
        let tables = tables.map_err(|found| wrong(directory, PACKAGE_FILE, found))?;
        let scene = directory.join(SCENE_FILE);
        let scene = scene.exists().then(|| text(directory, SCENE_FILE)).transpose()?;
        Ok((Self { directory: directory.to_owned(), summary, scene, tables }, is_complete))
    }

    /// What belongs to all tables, by name: the summary, and the scene where the run has it.
    pub(crate) fn texts(&self) -> Vec<(&str, &str)> {
        let scene = self.scene.as_deref().map(|scene| ("scene", scene));
        [("summary", self.summary.as_str())].into_iter().chain(scene).collect()
    }

    /// The files of a format that can be made.
    ///
    /// # Errors
    /// [`TablesError::NotBuilt`].
    pub fn outputs(&self, format: Format) -> Result<Vec<Output<'_>>, TablesError> {
        format.require()?;
        let output = |name, what| Output { name, run: self, what };
        Ok(match format {
            Format::Parquet => {
                let tables = self.tables.iter();
                tables.map(|table| output(table.parquet, What::Parquet(table))).collect()
            }
            Format::Hdf5 => vec![output(HDF5_FILE, What::Hdf5)],
        })
    }
}

impl Output<'_> {
    /// Makes the file at `path`; after an error a part of it may be there.
    ///
    /// # Errors
    /// When a table is not what a run writes, and when the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), TablesError> {
        match self.what {
            What::Hdf5 => hdf5::write(self.run, path),
            What::Parquet(table) => {
                let mut file = ParquetFile::create(path, &table.columns, &self.run.texts())?;
                table.groups(self.run, |group| file.write(group))?;
                file.close()
            }
        }
    }
}

impl Table {
    /// Its name: that of the file without the ending.
    #[cfg_attr(not(feature = "hdf5"), expect(dead_code, reason = "groups of HDF5 have it"))]
    pub fn name(&self) -> &'static str {
        self.file.split_once('.').map_or(self.file, |(name, _)| name)
    }

    /// Hands on groups of rows, all of them as long but the last.
    ///
    /// # Errors
    /// When the table is not what a run writes, and that of `take`.
    pub fn groups(
        &self,
        run: &Run,
        mut take: impl FnMut(&Group) -> Result<(), TablesError>,
    ) -> Result<(), TablesError> {
        let directory = run.directory.clone();
        let failed = |source| TablesError::Rows { directory: directory.clone(), source };
        let opened = Rows::open(&directory, self.file).map_err(failed)?;
        let (directory, file) = (run.directory.clone(), self.file);
        let mut rows = opened.ok_or(TablesError::NoRun { directory, file })?;
        self.check(&rows.names).map_err(|found| failed(rows.wrong(found)))?;
        let mut group = Group::of(&self.columns);
        loop {
            let pushed = match rows.next_row().map_err(failed)? {
                None => break,
                Some(fields) => self.cells(&fields).map(|cells| group.push(&cells)),
            };
            pushed.map_err(|found| failed(rows.wrong(found)))?;
            if group.is_full() {
                take(&group)?;
                group.clear();
            }
        }
        if group.rows > 0 { take(&group) } else { Ok(()) }
    }

    /// # Errors
    /// When these names of columns are not those of the table.
    fn check(&self, names: &[String]) -> Result<(), String> {
        let known = self.columns.iter().map(|column| Some(&column.name)).chain([None]);
        let mut pairs = known.zip(names.iter().map(Some).chain([None]));
        let Some((expected, found)) = pairs.find(|(expected, found)| expected != found) else {
            return Ok(());
        };
        let told = |name: Option<&String>| match name {
            Some(name) => format!("the column `{}`", name.chars().take(TOLD).collect::<String>()),
            None => "the end of the line".to_owned(),
        };
        Err(format!("{} found, {} expected", told(found), told(expected)))
    }

    fn cells<'a>(&self, fields: &'a Fields<'_>) -> Result<Vec<Cell<'a>>, String> {
        let cell = |(place, column): (usize, &Column)| column.cell(&fields[place]);
        self.columns.iter().enumerate().map(cell).collect()
    }
}

/// A table as the description of the columns says it.
fn table(keys: ResourceKeys) -> Result<Table, String> {
    let ResourceKeys { path, schema } = keys;
    let told = |text: &str| text.chars().take(TOLD).collect::<String>();
    let found = PARQUET_FILES.into_iter().find(|(file, _)| *file == path);
    let (file, parquet) = found.ok_or_else(|| format!("the table `{}`", told(&path)))?;
    let mut columns = schema.fields;
    let mut names = HashSet::new();
    for column in &mut columns {
        // Units stand beside it.
        column.name = column_name(&column.name).to_owned();
        let is_of_a_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let is_name = !column.name.is_empty() && column.name.chars().all(is_of_a_name);
        if !is_name || !names.insert(column.name.clone()) {
            return Err(format!("the column `{}` of {file}", told(&column.name)));
        }
    }
    if columns.is_empty() {
        Err(format!("{file} without columns"))
    } else {
        Ok(Table { file, parquet, columns })
    }
}

/// The text of a file.
fn text(directory: &Path, file: &'static str) -> Result<String, TablesError> {
    let path = directory.join(file);
    if !path.is_file() {
        return Err(TablesError::NoRun { directory: directory.to_owned(), file });
    }
    let mut text = String::new();
    let read = File::open(&path).and_then(|file| file.take(LONGEST).read_to_string(&mut text));
    read.map_err(|source| TablesError::Read { path, source })?;
    Ok(text)
}

fn json<'a, T: Deserialize<'a>>(
    directory: &Path,
    file: &'static str,
    text: &'a str,
) -> Result<T, TablesError> {
    serde_json::from_str(text).map_err(|error| wrong(directory, file, error.to_string()))
}

fn wrong(directory: &Path, file: &'static str, found: String) -> TablesError {
    TablesError::Json { path: directory.join(file), found }
}
