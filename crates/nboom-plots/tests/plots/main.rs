//! Figures as an independent reader finds them: SVG parsed as XML and measured by its own ticks, PNG decoded,
//! PDF by its table of objects.

mod curves;
mod directory;
mod formats;
mod hostile;
mod reader;
