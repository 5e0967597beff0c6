use std::io::{self, Write};

use nboom_model::Scene;
use nboom_sim::Snapshot;

use crate::number::{field, number};

const HEADER: &str =
    "t,kinetic_energy,potential_energy,dashpot_work,thrust_work,motor_work,lock_up_loss";

/// What follows, without momenta where the main body is held.
const RESIDUALS: [&str; 3] =
    ["residual_linear_momentum", "residual_angular_momentum", "residual_energy"];

/// Writes the table of what became of energy and momentum, one row for each output time.
#[derive(Debug)]
pub(crate) struct LedgerWriter<W> {
    out: W,
}

impl<W: Write> LedgerWriter<W> {
    /// Writes the header for a run of `scene`.
    pub fn new(mut out: W, scene: &Scene) -> io::Result<Self> {
        let residuals = if scene.base.is_held() { &RESIDUALS[2..] } else { &RESIDUALS };
        writeln!(out, "{HEADER},{}", residuals.join(","))?;
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
