//! Pages of directories as runs leave them, whole and broken.

mod budget;
mod bundle;
mod directory;
mod gaps;
mod hinges;
mod hostile;
mod rotors;
