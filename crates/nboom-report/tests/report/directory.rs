//! Directories with the files of a run.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use tempfile::TempDir;

/// A chain of so many segments, with a station each, over so many output times: curves with motion in
/// every part of them.
pub struct Chain {
    pub segments: usize,
    pub samples: usize,
    pub stations: usize,
}

impl Chain {
    /// Writes all files of a run.
    pub fn write(&self) -> TempDir {
        let place = tempfile::tempdir().expect("a directory");
        let at =
            |name: &str, text: &str| fs::write(place.path().join(name), text).expect("writable");
        at("summary.json", &self.summary("a chain"));
        at("scene.toml", &self.scene());
        at("states.csv", &self.states());
        at("instants.csv", &(self.states_header() + "\n"));
        at("ledger.csv", &self.ledger());
        at("events.csv", &self.events());
        if self.stations > 0 {
            at("hinge_loads.csv", &self.hinge_loads());
            at("stress.csv", &self.stress());
        }
        place
    }

    fn span(&self) -> f64 {
        60.0
    }

    fn time(&self, sample: usize) -> f64 {
        self.span() * sample as f64 / self.samples as f64
    }

    /// A value that swings and never repeats.
    fn wave(time: f64, which: usize) -> f64 {
        let pace = 0.3 + 0.07 * which as f64;
        (pace * time).sin() + 0.3 * (2.7 * pace * time + which as f64).cos()
    }

    pub fn summary(&self, scene: &str) -> String {
        let hinges: Vec<String> = (1..=self.segments)
            .map(|i| {
                format!(
                    r#"{{"appendage": 1, "segment": {i}, "state": 1, "time": {i}.5, "angle": 0.0}}"#
                )
            })
            .collect();
        let scene = serde_json::to_string(scene).expect("text");
        format!(
            r#"{{"scene": {scene}, "version": "{}", "complete": true, "units": "SI", "rtol": 1e-9, "atol": 1e-12,
            "formulation": "recursive", "integrator": "dopri5", "path": "generic", "generated_share": 0.0,
            "verdict": {{"hinges": [{}], "largest_impulse": null, "worst_load": null, "smallest_margin": null}},
            "conservation": {{"linear_momentum": 1e-13, "angular_momentum": 1e-13, "energy": 1e-12}}}}"#,
            env!("CARGO_PKG_VERSION"),
            hinges.join(",")
        )
    }

    fn scene(&self) -> String {
        let mut text = "name = \"a chain\"\n[run]\nend = 60.0\n[main_body]\nmass = 9.0\ninertia = [1.0, 1.0, 1.0]\n".to_owned();
        for i in 1..=self.segments {
            let on = if i > 1 { format!("on = \"segment {}\"\n", i - 1) } else { String::new() };
            let _ = write!(
                text,
                "[[body]]\nname = \"segment {i}\"\n{on}mass = 1.0\nmass_centre = [0.0, 0.5, 0.0]\n\
                 inertia = [0.1, 0.1, 0.1]\ntip = [0.0, 1.0, 0.0]\n[body.hinge]\nat = [0.0, 1.0, 0.0]\naxis = \"x\"\n"
            );
        }
        text
    }

    fn states_header(&self) -> String {
        let mut header =
            "t,rho_x,rho_y,rho_z,v_x,v_y,v_z,chi,kappa_x,kappa_y,kappa_z,omega_x,omega_y,omega_z"
                .to_owned();
        for i in 1..=self.segments {
            let _ = write!(header, ",beta_1_{i},tau_1_{i},alpha_1_{i},sigma_1_{i},state_1_{i}");
        }
        header
            + ",kinetic_energy,linear_momentum_x,linear_momentum_y,linear_momentum_z,angular_momentum_x,\
                  angular_momentum_y,angular_momentum_z,nutation"
    }

    fn table(&self, header: &str, columns: usize) -> String {
        let mut text = format!("{header}\n");
        for sample in 0..=self.samples {
            let time = self.time(sample);
            let _ = write!(text, "{time:.6}");
            for column in 0..columns {
                let _ = write!(text, ",{:.6}", Self::wave(time, column));
            }
            text.push('\n');
        }
        text
    }

    fn states(&self) -> String {
        self.table(&self.states_header(), 13 + 5 * self.segments + 8)
    }

    fn ledger(&self) -> String {
        let header = "t,kinetic_energy,potential_energy,dashpot_work,thrust_work,motor_work,lock_up_loss,\
                      residual_linear_momentum,residual_angular_momentum,residual_energy";
        self.table(header, 9)
    }

    fn events(&self) -> String {
        let mut text = "t,kind,appendage,segment,impulse,energy_before,energy_after\n".to_owned();
        for i in 1..=self.segments {
            let _ = writeln!(text, "{i}.5,lock_up,1,{i},-0.25,3.0,2.0");
        }
        text + "60.0,end,,,,2.0,2.0\n"
    }

    fn hinge_loads(&self) -> String {
        let mut text = "t,event,appendage,segment,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta\n".to_owned();
        for sample in 0..=self.samples {
            let time = self.time(sample);
            for i in 1..=self.segments {
                let load = Self::wave(time, i);
                let _ = writeln!(text, "{time:.6},,1,{i},{load:.6},0.0,0.0,{load:.6},1.0,0.0");
            }
        }
        text
    }

    fn stress(&self) -> String {
        let mut text = "t,event,appendage,segment,station,point,von_mises\n".to_owned();
        for sample in 0..=self.samples {
            let time = self.time(sample);
            for (i, station) in
                (1..=self.segments).flat_map(|i| (1..=self.stations).map(move |s| (i, s)))
            {
                let stress = Self::wave(time, i * station).abs();
                let _ = writeln!(text, "{time:.6},,1,{i},{station},max,{stress:.6}");
            }
        }
        text
    }
}

/// The page of a directory.
pub fn page_of(directory: &Path) -> String {
    nboom_report::page(vec![nboom_report::Run::read(directory).expect("a run")])
}
