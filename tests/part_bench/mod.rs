//! Small jobs of a soft robot: a slot through a block, and a corner.
#![allow(dead_code)]

use ident::ground::random::Random;
use ident::process::Planned;
use ident::process::setup::Setup;
use std::path::{Path, PathBuf};

/// Through a block and out of it, then across: a slot with an entry, a corner and an exit.
pub const CORNER: &str = "-16,20,-2\n40,20,-2\n40,66,-2\n";
/// A pocket's outline: feeds in four directions, corners, in and out.
pub const OUTLINE: &str = "-14,12,-2\n38,12,-2\n38,38,-2\n12,38,-2\n12,24,-2\n30,24,-2\n30,64,-2\n";
/// One slot, in and out.
pub const SLOT: &str = "-16,20,-3\n66,20,-3\n";
/// The same, six millimetres deep: more than 400 N.
pub const DEEP: &str = "-16,20,-6\n66,20,-6\n";

/// A job in a folder: its points (x, y, z in mm), feed in mm/min; more lines of TOML at the top.
pub fn job(folder: &Path, points: &str, feed: f64, top: &str) -> PathBuf {
    let path = format!("# kind = \"path\"\n# synthetic = true\nx_mm,y_mm,z_mm\n{points}");
    std::fs::write(folder.join("path.csv"), path).unwrap();
    let text = format!(
        "kind = \"job\"\nsynthetic = true\nrobot = \"kr210\"\npath = \"path.csv\"\nfeed_mm_min = {feed}\n\
         blend_radius_mm = 2.0\nstart_joints_deg = [0, -90, 90, 0, 0, 0]\n{top}\n\
         [workpiece]\norigin_m = [1.5, 0.0, 0.8]\nabc_deg = [0.0, 0.0, 0.0]\n\
         stock_min_mm = [0.0, 0.0, -12.0]\nstock_max_mm = [50.0, 50.0, 0.0]\n\n\
         [tool]\ndiameter_mm = 16.0\nteeth = 3\nhelix_deg = 30.0\nflute_mm = 20.0\nspindle_rpm = 13000.0\n\n\
         [material]\nname = \"Al7075\"\nKtc_N_mm2 = 1319.41\nKrc_N_mm2 = 788.83\nKac_N_mm2 = 48.75\n\
         Kte_N_mm = 19.65\nKre_N_mm = 26.77\nKae_N_mm = 2.05\nrel_std = 0.1\n\n\
         [limits]\npath_acceleration_m_s2 = 1.0\npath_jerk_m_s3 = 20.0\ntolerance_mm = 0.3\n"
    );
    let job = folder.join("job.toml");
    std::fs::write(&job, text).unwrap();
    job
}

/// The job, planned and ready.
pub fn ready(job: &Path) -> (Planned, Setup) {
    let planned = Planned::read(job).unwrap();
    let setup = planned.setup(None).unwrap();
    (planned, setup)
}

/// Another robot and material: every stiffness, damping and coefficient off by `spread` (relative standard
/// deviation), or by exactly so much with either sign.
pub fn plant(setup: &Setup, seed: u64, spread: f64, exactly: bool) -> Setup {
    let mut random = Random::new(seed);
    let mut factor = || {
        let z = random.normal();
        1.0 + spread
            * if exactly {
                z.signum()
            } else {
                z.clamp(-3.0, 3.0)
            }
    };
    let mut other = setup.clone();
    for (_, spring) in other.robot.springs_mut() {
        spring.stiffness *= factor();
        spring.damping *= factor();
    }
    other
        .material
        .coefficients
        .iter_mut()
        .for_each(|k| *k *= factor());
    other
}
