//! A record of the sensor less what it reads without touching anything.

use crate::fit::force_sensor::fitted::rms;
use crate::fit::force_sensor::model::Model;
use crate::ground::files;
use crate::measurement::force_sensor::{CHANNELS, SensorTest};
use crate::measurement::workspace::Place;
use crate::sheet::number::significant;
use std::fmt::Write;
use std::path::PathBuf;

/// A corrected record.
pub struct Applied {
    /// The record.
    pub record: SensorTest,
    /// Its loads, corrected: N and N·m.
    pub loads: Vec<[f64; 6]>,
}

impl Applied {
    /// Corrects every reading.
    pub fn of(record: SensorTest, model: &Model) -> Self {
        let loads = record
            .readings
            .iter()
            .map(|r| model.corrected(r.quaternion, r.load));
        Self {
            loads: loads.collect(),
            record,
        }
    }

    /// Where the corrected record goes.
    pub fn path(&self) -> PathBuf {
        let place = Place::of(&self.record.path);
        place
            .fits()
            .join(format!("{}-corrected.csv", self.record.stem()))
    }

    /// Root mean square of the record as read and as corrected: forces, N, and moments, N·m.
    pub fn sizes(&self) -> [[f64; 2]; 2] {
        let read: Vec<[f64; 6]> = self.record.readings.iter().map(|r| r.load).collect();
        [rms(&read), rms(&self.loads)]
    }

    /// The record as a file of the same kind.
    pub fn text(&self) -> String {
        let mut text = String::from("# kind = \"force-sensor\"\n");
        if self.record.facts.synthetic {
            text.push_str("# synthetic = true\n");
        }
        let name = files::name(&self.record.path);
        let _ = writeln!(
            text,
            "# notes = {{ corrected = {name:?}, sha256 = \"{}\" }}",
            self.record.sha256
        );
        let (timed, pointed) = (
            self.record.readings.iter().any(|r| !r.time.is_nan()),
            self.record.readings.iter().any(|r| r.point.is_some()),
        );
        let mut header: Vec<String> = Vec::new();
        header.extend(pointed.then(|| "point".into()));
        header.extend(timed.then(|| "time_s".into()));
        header.extend(["qw", "qx", "qy", "qz"].map(String::from));
        header.extend(CHANNELS.map(|(name, unit)| format!("{name}_{unit}")));
        let _ = writeln!(text, "{}", header.join(","));
        for (reading, load) in self.record.readings.iter().zip(&self.loads) {
            let mut cells: Vec<String> = Vec::new();
            cells.extend(pointed.then(|| reading.point.map_or(String::new(), |p| p.to_string())));
            cells.extend(timed.then(|| {
                if reading.time.is_nan() {
                    String::new()
                } else {
                    reading.time.to_string()
                }
            }));
            cells.extend(reading.quaternion.iter().map(|q| format!("{q:.9}")));
            cells.extend(load.iter().map(|x| format!("{x:.6}")));
            let _ = writeln!(text, "{}", cells.join(","));
        }
        text
    }

    /// What was done, one sentence.
    pub fn sentence(&self, dry: bool) -> String {
        let [read, left] = self.sizes();
        let where_to = if dry {
            String::new()
        } else {
            format!(", written to {}", self.path().display())
        };
        format!(
            "{}: {} readings corrected, forces from {} to {} N rms{where_to}",
            self.record.path.display(),
            self.loads.len(),
            significant(read[0], 4),
            significant(left[0], 4)
        )
    }
}
