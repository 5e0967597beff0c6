//! The page that shows a run: `report.html`, one file that needs no network and no program but a browser.
//!
//! [`Run::read`] takes what a run left in its directory, and [`page`] puts it into the page. What is missing or
//! cut off becomes a gap that the page names. What the page and figures for documents both show is found here once:
//! hinges, rotors and their names, forces of kick-off springs, speeds of rotors, captions, what is only rounding, the rows that an eye can tell
//! apart. Positions of bodies follow from joint angles and the scene in the page itself.
//!
//! The page is made of the modules in `page/src`, bundled with their libraries into `page/bundle` by
//! `npm run build`; `cargo build` needs only the bundle. So is the page of a sweep, for whose data [`sweep_page`] has
//! the place.

mod captions;
mod error;
mod events;
mod geometry;
mod hinges;
mod kick_offs;
mod loads;
mod nutation;
mod pack;
mod page;
mod requested;
mod rotors;
mod rounding;
mod run;
mod table;
mod text;
mod thin;

pub use captions::{Captioned, Captions};
pub use error::{Gap, ReportError};
pub use events::EventKeys;
pub use hinges::Hinge;
pub use loads::{Largest, Worst};
pub use nutation::SpinAxis;
pub use page::{MOST_BYTES, page, sweep_page};
pub use rotors::Rotor;
pub use run::Run;
pub use table::Table;
pub use text::escaped;
pub use thin::{Thinned, thinned};
