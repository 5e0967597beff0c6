use std::io::{self, Write};

use nboom_model::Scene;
use nboom_sim::Snapshot;

use crate::Headings;
use crate::heads::Head;
use crate::number::{field, number};

/// Columns of the ledger of a run of `scene`; without residuals of momenta where the main body is held.
pub(crate) fn heads(scene: &Scene) -> Vec<Head> {
    let energy = |name, about: &'static str| Head::number(name, "F L", about);
    let mut heads = vec![
        Head::time("time"),
        energy("kinetic_energy", "kinetic energy of all bodies"),
        energy("potential_energy", "potential energy of springs and gravity"),
        energy("dashpot_work", "work of friction and of what depends on rates at hinges"),
        energy("thrust_work", "work of what acts from outside or moves a main body that is held"),
        energy("motor_work", "work of the motors of rotors"),
        energy("lock_up_loss", "kinetic energy that lock-ups and impacts have taken away"),
    ];
    let residual = |name, about: &'static str| Head::number(name, "1", about);
    if !scene.base.is_held() {
        heads.push(residual("residual_linear_momentum", "what is left of its balance, relative"));
        heads.push(residual("residual_angular_momentum", "what is left of its balance, relative"));
    }
    heads.push(residual("residual_energy", "what is left of its balance, relative"));
    heads
}

/// Writes the table of what became of energy and momentum, one row for each output time.
#[derive(Debug)]
pub(crate) struct LedgerWriter<W> {
    out: W,
}

impl<W: Write> LedgerWriter<W> {
    /// Writes the header for a run of `scene`.
    pub fn new(mut out: W, scene: &Scene, headings: &Headings) -> io::Result<Self> {
        writeln!(out, "{}", headings.line(&heads(scene)))?;
        Ok(Self { out })
    }

    /// Writes a row, of a snapshot that has an account.
    pub fn write(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        let Some(account) = &snapshot.account else { return Ok(()) };
        let residuals = &account.residuals;
        let out = &mut self.out;
        number(out, snapshot.time)?;
        let numbers = [
            snapshot.kinetic_energy,
            account.potential_energy,
            account.dashpot_work,
            account.thrust_work,
            account.motor_work,
            account.lock_up_loss,
        ];
        numbers.into_iter().try_for_each(|value| field(out, value))?;
        let momenta = [residuals.linear_momentum, residuals.angular_momentum];
        let residuals = momenta.into_iter().flatten().chain([residuals.energy]);
        residuals.into_iter().try_for_each(|residual| field(out, residual))?;
        writeln!(out)
    }

    pub fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
