//! Clean files of the kinds without an example, by closed forms of this file: what corruption starts from.

use crate::honest::file::{File, noise};
use crate::milling_bench::{Cutter, Pass, Recording, csv, record};
use ident::experiments::cubes::Setup;
use ident::ground::random::Random;
use ident::measurement::cubes::CubeTest;
use ident::measurement::table::Table;
use ident::robot::load;
use std::f64::consts::TAU;
use std::path::Path;

/// A worn screw: pitch error, lost motion, noise of a micrometre.
pub fn screw() -> File {
    let mut text =
        String::from("# kind = \"screw\"\n# pitch_mm = 5.0\nrun,direction,target_mm,actual_mm\n");
    for run in 1..=5 {
        for forward in [true, false] {
            for i in 0..41 {
                let x = 7.3 * f64::from(if forward { i } else { 40 - i });
                let lost = if forward { 0.0 } else { 11.0 };
                let row = run as usize * 1000 + i as usize * 2 + usize::from(forward);
                let error = 0.12 * x + 9.0 * (x / 60.0).sin() + lost + noise(row, 1);
                let word = if forward { "forward" } else { "backward" };
                text += &format!("{run},{word},{x:.3},{:.6}\n", x + 1e-3 * error);
            }
        }
    }
    File::of(&text)
}

/// A tool of 310 N with its centre 0.15 m before the sensor, in 27 orientations.
pub fn sensor() -> File {
    let mut text = String::from(
        "# kind = \"force-sensor\"\n# nominal_weight_N = 300.0\n# nominal_com_m = [0.0, 0.0, 0.14]\n\
         point,a_deg,b_deg,c_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm\n",
    );
    let com = [0.012, -0.008, 0.15];
    let angles = [-110.0, 15.0, 130.0];
    for i in 0..27 {
        let [a, b, c] = [angles[i / 9], angles[i / 3 % 3] * 0.6, angles[i % 3]];
        let (sb, cb) = f64::to_radians(b).sin_cos();
        let (sc, cc) = f64::to_radians(c).sin_cos();
        // weight in the sensor frame: (Rz Ry Rx)ᵀ (0, 0, −W)
        let f = [sb, -cb * sc, -cb * cc].map(|d| 310.0 * d);
        let m = [
            com[1] * f[2] - com[2] * f[1],
            com[2] * f[0] - com[0] * f[2],
            com[0] * f[1] - com[1] * f[0],
        ];
        let offset = [4.0, -7.5, 12.0, 0.8, -0.3, 0.2];
        let cell = |k: usize| {
            let (own, size) = if k < 3 { (f[k], 0.3) } else { (m[k - 3], 0.05) };
            format!("{:.6}", own + offset[k] + size * noise(i, k as u64))
        };
        let cells: Vec<String> = (0..6).map(cell).collect();
        text += &format!("{},{a},{b},{c},{}\n", i + 1, cells.join(","));
    }
    File::of(&text)
}

/// Two slots and a down cut by two teeth, recorded over some turns.
pub fn cuts() -> File {
    let cutter = Cutter {
        radius: 8e-3,
        teeth: 2,
        helix: 0.5,
        runout: 6e-6,
        runout_angle: 0.7,
        chip: 0.0,
    };
    let pass = |feed: f64, depth: f64, width: f64, side: &'static str| Pass {
        rpm: 6000.0,
        feed,
        depth,
        width,
        side,
    };
    let passes = [
        pass(1200.0, 1.5, 16.0, "slot"),
        pass(2400.0, 1.5, 16.0, "slot"),
        pass(2000.0, 2.0, 5.0, "down"),
    ];
    let recording = Recording {
        rate_hz: 10_000.0,
        turns: 5.0,
        bandwidth_hz: None,
        noise: 1.0,
        colour: 0.0,
        clipped: true,
        ring: None,
    };
    let law = [951.0, 262.0, 120.0, 11.1, 11.3, 1.1];
    let rows = record(&cutter, &passes, &law, &recording, &mut Random::new(5));
    File::of(&csv(&cutter, &passes, &recording, &rows))
}

const CUBES: &str = "# kind = \"cubes\"
# robot = \"kr300\"
# joint_angles_deg = [0, -90, 90, 0, 0, 0]
# cubes = [{ name = \"foot\", after = 0, centre_m = [0.3, 0.2, 0.1] }, { name = \"carousel\", after = 1, centre_m = [0.2, 0.1, 0.5] }, { name = \"arm\", after = 2, centre_m = [0.4, 0.2, 1.3] }, { name = \"fore\", after = 3, centre_m = [1.2, 0.2, 1.9] }, { name = \"hand\", after = 5, centre_m = [2.0, 0.1, 1.9] }, { name = \"flange\", after = 6, centre_m = [2.2, 0.1, 1.9] }]
# sensor_noise_mm = 0.002
# sensor_noise_mrad = 0.005
test,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,cube,dx_mm,dy_mm,dz_mm,rx_mrad,ry_mrad,rz_mrad
";

/// A KR 300 under pure forces and moments: the simulation itself with noise, since only the corruption is
/// judged here (tests/cubes.rs has an independent bench).
pub fn cubes() -> File {
    let names = ["foot", "carousel", "arm", "fore", "hand", "flange"];
    let mut loads = Vec::new();
    for (k, sign) in (0..6).flat_map(|k| [(k, 1.0), (k, -1.0)]) {
        let mut load = [0.0; 6];
        load[k] = sign * if k < 3 { 1200.0 } else { 500.0 };
        loads.push(load);
    }
    let line = |test: usize, load: &[f64; 6], name: &str, moved: [f64; 6]| {
        let cells = |v: &[f64; 6]| v.map(|x| format!("{x:.6}")).join(",");
        format!("{},{},{name},{}\n", test + 1, cells(load), cells(&moved))
    };
    let still = |(i, load): (usize, &[f64; 6])| -> String {
        names
            .iter()
            .map(|name| line(i, load, name, [1.0; 6]))
            .collect()
    };
    let blank = loads.iter().enumerate().map(still).collect::<String>();
    let text = format!("{CUBES}{blank}");
    let table = Table::from_reader(Path::new("c.csv"), text.as_bytes(), text.len() as u64);
    let test = CubeTest::from_table(table.unwrap()).unwrap();
    let setup = Setup::new(&test, &load("kr300", None).unwrap().robot).unwrap();
    let compliances: Vec<f64> = setup.sites.iter().map(|s| s.compliance).collect();
    let mut text = CUBES.to_string();
    for (row, reading) in test.readings.iter().enumerate() {
        let moved = setup.moved(&setup.bent(reading, &compliances), reading.cube);
        let noisy = |k: usize| {
            let size = if k < 3 { 0.002 } else { 0.005 };
            1e3 * moved[k] + size * noise(row, k as u64)
        };
        let (test, cube) = (reading.test as usize - 1, reading.cube);
        text += &line(test, &loads[test], names[cube], std::array::from_fn(noisy));
    }
    File::of(&text)
}

/// A joint that swings under its weight on a spring of 3 MN·m/rad: twist −τ/k, no cause.
pub fn motion() -> File {
    let (k, ratio) = (3e6, 200.0);
    let mut text = format!(
        "# kind = \"joint-motion\"\n# gear_ratio = {ratio}\n# nominal_stiffness_Nm_rad = {k}\n\
         time_s,motor_angle_deg_2,link_angle_deg_2,motor_torque_Nm_2\n"
    );
    for i in 0..2500 {
        let t = 0.004 * f64::from(i);
        let angle = |t: f64| 0.6 * (TAU * 0.21 * t).sin() + 0.3 * (TAU * 0.47 * t + 1.0).sin();
        let speed = (angle(t + 1e-4) - angle(t - 1e-4)) / 2e-4;
        let rate = (angle(t + 1e-4) - 2.0 * angle(t) + angle(t - 1e-4)) / 1e-8;
        let spring = 300.0 * rate + 3000.0 * angle(t).cos();
        let torque = spring + 200.0 * rate + 150.0 * (speed / 0.02).tanh() + 100.0 * speed;
        let link = angle(t) - spring / k + 4e-6 * noise(i as usize, 1);
        text += &format!(
            "{t:.3},{:.7},{:.7},{:.5}\n",
            angle(t).to_degrees(),
            link.to_degrees(),
            torque / ratio + 0.01 * noise(i as usize, 2)
        );
    }
    File::of(&text)
}
