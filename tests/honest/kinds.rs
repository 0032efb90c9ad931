//! The newer kinds corrupted: every verb refuses, gives the right number, or names a fault.

use crate::honest::benches;
use crate::honest::file::{File, noise};
use crate::honest::matrix::{Corruption, Verb, nothing_to_get_wrong, same_causes, table};
use serde_json::Value;

fn near(found: &Value, clean: &Value, share: f64) -> bool {
    match (found.as_f64(), clean.as_f64()) {
        (Some(a), Some(b)) => (a - b).abs() <= share * b.abs(),
        _ => false,
    }
}

/// Every value that both documents identify agrees within a share, and as many are identified.
fn same_parameters(found: &Value, clean: &Value, share: f64) -> bool {
    let list = |d: &Value| d["parameters"].as_array().cloned().unwrap_or_default();
    let (a, b) = (list(found), list(clean));
    let both = a.iter().zip(&b);
    a.len() == b.len()
        && both
            .filter(|(a, b)| !a["value"].is_null() && !b["value"].is_null())
            .all(|(a, b)| near(&a["value"], &b["value"], share) || a["name"] != b["name"])
}

fn same_figures(found: &Value, clean: &Value) -> bool {
    let key = |d: &Value, k: &str| d["iso230_2"][k].clone();
    ["A_um", "B_mean_um", "E_um"]
        .iter()
        .all(|k| near(&key(found, k), &key(clean, k), 0.1))
        && near(&found["backlash_um"], &clean["backlash_um"], 0.1)
}

fn same_weight(found: &Value, clean: &Value) -> bool {
    let of = |d: &Value, i: usize| d["parameters"][i]["value"].clone();
    near(&of(found, 0), &of(clean, 0), 0.02) && near(&of(found, 3), &of(clean, 3), 0.05)
}

fn same_cutting(found: &Value, clean: &Value) -> bool {
    let of = |d: &Value, i: usize| d["parameters"][i]["value"].clone();
    (0..2).all(|i| near(&of(found, i), &of(clean, i), 0.1))
}

fn same_springs(found: &Value, clean: &Value) -> bool {
    same_parameters(found, clean, 0.15)
}

fn cut_within_a_row(mut f: File) -> File {
    f.rows.last_mut().unwrap().truncate(2);
    f
}

fn repeated(mut f: File) -> File {
    let all = f.rows.clone();
    f.rows.extend(all);
    f
}

const SCREW: &[Corruption] = &[
    ("actual in µm", |f| f.title("actual_mm", "actual_um")),
    ("target in m", |f| f.title("target_mm", "target_m")),
    ("sign of the scale", |f| f.map("actual_mm", |_, v| -v)),
    ("dead scale", |f| f.map("actual_mm", |_, _| 12.0)),
    ("scale clipped", |f| f.clip("actual_mm", 0.7, 1.0)),
    ("noise for the scale", |f| {
        f.map("actual_mm", |i, _| 100.0 * noise(i, 1))
    }),
    ("one reading of 1e40", |f| {
        f.map("actual_mm", |i, v| if i == 30 { 1e40 } else { v })
    }),
    ("target and actual swapped", |f| {
        f.swap("target_mm", "actual_mm")
    }),
    ("directions swapped", |mut f| {
        for row in &mut f.rows {
            row[1] = match row[1].as_str() {
                "forward" => "backward".into(),
                _ => "forward".into(),
            };
        }
        f
    }),
    ("cut in the last run", |f| {
        let n = f.rows.len() - 60;
        f.rows(move |i| i < n)
    }),
    ("cut within a row", cut_within_a_row),
    ("repeated as a whole", repeated),
    ("misspelt fact", |f| {
        f.without("pitch_mm").fact("pitch", "5.0")
    }),
];

const SENSOR: &[Corruption] = &[
    ("fx in kN", |f| f.title("fx_N", "fx_kN")),
    ("moments in N·mm", |f| {
        f.map("mx_Nm", |_, v| 1e3 * v)
            .map("my_Nm", |_, v| 1e3 * v)
            .map("mz_Nm", |_, v| 1e3 * v)
    }),
    ("all forces in kN", |f| {
        f.title("fx_N", "fx_kN")
            .title("fy_N", "fy_kN")
            .title("fz_N", "fz_kN")
    }),
    ("sign of fz", |f| f.map("fz_N", |_, v| -v)),
    ("sign of all forces", |f| {
        f.map("fx_N", |_, v| -v)
            .map("fy_N", |_, v| -v)
            .map("fz_N", |_, v| -v)
    }),
    ("fx and fy swapped", |f| f.swap("fx_N", "fy_N")),
    ("dead fy", |f| f.map("fy_N", |_, _| 0.0)),
    ("dead mx", |f| f.map("mx_Nm", |_, _| 0.3)),
    ("fx clipped", |f| f.clip("fx_N", 0.3, 0.3)),
    ("noise for fz", |f| {
        f.map("fz_N", |i, _| 100.0 * noise(i, 1))
    }),
    ("noise for all forces", |f| {
        f.map("fx_N", |i, _| 100.0 * noise(i, 1))
            .map("fy_N", |i, _| 100.0 * noise(i, 2))
            .map("fz_N", |i, _| 100.0 * noise(i, 3))
    }),
    ("orientation unchanged", |f| {
        f.map("a_deg", |_, _| 0.0)
            .map("b_deg", |_, _| 0.0)
            .map("c_deg", |_, _| 0.0)
    }),
    ("one force of 1e40", |f| {
        f.map("fx_N", |i, v| if i == 7 { 1e40 } else { v })
    }),
    ("cut within a row", cut_within_a_row),
    ("misspelt fact", |f| f.fact("nominal_wieght_N", "3.0")),
];

const CUTS: &[Corruption] = &[
    ("forces in kN", |f| {
        f.title("fx_N", "fx_kN")
            .title("fy_N", "fy_kN")
            .title("fz_N", "fz_kN")
    }),
    ("sign of all forces", |f| {
        f.map("fx_N", |_, v| -v)
            .map("fy_N", |_, v| -v)
            .map("fz_N", |_, v| -v)
    }),
    ("time in ms", |f| f.title("time_s", "time_ms")),
    ("dead fx", |f| f.map("fx_N", |_, _| 1.0)),
    ("dead fz", |f| f.map("fz_N", |_, _| 0.0)),
    ("fy clipped", |f| f.clip("fy_N", 0.5, 0.5)),
    ("noise for fx", |f| {
        f.map("fx_N", |i, _| 100.0 * noise(i, 1))
    }),
    ("noise for all", |f| {
        f.map("fx_N", |i, _| 100.0 * noise(i, 1))
            .map("fy_N", |i, _| 100.0 * noise(i, 2))
            .map("fz_N", |i, _| 100.0 * noise(i, 3))
    }),
    ("one force of 1e40", |f| {
        f.map("fy_N", |i, v| if i == 40 { 1e40 } else { v })
    }),
    ("cut within a row", cut_within_a_row),
    ("misspelt fact", |f| f.fact("force_onn", "\"tool\"")),
];

const CUBES: &[Corruption] = &[
    ("force in kN", |f| {
        f.title("fx_N", "fx_kN")
            .title("fy_N", "fy_kN")
            .title("fz_N", "fz_kN")
    }),
    ("dx in m", |f| f.title("dx_mm", "dx_m")),
    ("rotations in rad", |f| {
        f.title("rx_mrad", "rx_rad")
            .title("ry_mrad", "ry_rad")
            .title("rz_mrad", "rz_rad")
    }),
    ("sign of dz", |f| f.map("dz_mm", |_, v| -v)),
    ("sign of all displacements", |f| {
        f.map("dx_mm", |_, v| -v)
            .map("dy_mm", |_, v| -v)
            .map("dz_mm", |_, v| -v)
    }),
    ("dx and dy swapped", |f| f.swap("dx_mm", "dy_mm")),
    ("dead dx", |f| f.map("dx_mm", |_, _| 0.0)),
    ("dx clipped", |f| f.clip("dx_mm", 0.3, 0.3)),
    ("noise for dz", |f| f.map("dz_mm", |i, _| noise(i, 1))),
    ("no load", |mut f| {
        f.rows
            .iter_mut()
            .for_each(|r| (1..7).for_each(|k| r[k] = "0".into()));
        f
    }),
    ("one displacement of 1e40", |f| {
        f.map("dy_mm", |i, v| if i == 9 { 1e40 } else { v })
    }),
    ("cut in the last test", |f| {
        let n = f.rows.len() - 3;
        f.rows(move |i| i < n)
    }),
    ("cut within a row", cut_within_a_row),
    ("repeated as a whole", repeated),
    ("misspelt fact", |f| f.fact("frame_std", "0.1")),
];

const MOTION: &[Corruption] = &[
    ("motor in rad", |f| {
        f.title("motor_angle_deg_2", "motor_angle_rad_2")
    }),
    ("torque in kN·m", |f| {
        f.title("motor_torque_Nm_2", "motor_torque_kNm_2")
    }),
    ("sign of the link", |f| f.map("link_angle_deg_2", |_, v| -v)),
    ("sign of the torque", |f| {
        f.map("motor_torque_Nm_2", |_, v| -v)
    }),
    ("dead link", |f| f.map("link_angle_deg_2", |_, _| 3.0)),
    ("dead torque", |f| f.map("motor_torque_Nm_2", |_, _| 0.0)),
    ("one encoder in both columns", |f| {
        let motor = f.column("motor_angle_deg_2");
        let angles: Vec<f64> = (0..f.rows.len()).map(|i| f.number(i, motor)).collect();
        f.map("link_angle_deg_2", |i, _| angles[i])
    }),
    ("link clipped", |f| f.clip("link_angle_deg_2", 0.7, 1.0)),
    ("torque clipped", |f| f.clip("motor_torque_Nm_2", 0.7, 1.0)),
    ("noise for the link", |f| {
        f.map("link_angle_deg_2", |i, _| 10.0 * noise(i, 1))
    }),
    ("noise for the torque", |f| {
        f.map("motor_torque_Nm_2", |i, _| 10.0 * noise(i, 2))
    }),
    ("motor angle not divided by the gear", |f| {
        f.map("motor_angle_deg_2", |_, v| 200.0 * v)
    }),
    ("all times equal", |f| f.map("time_s", |_, _| 1.0)),
    ("cut within a row", cut_within_a_row),
    ("misspelt fact", |f| {
        f.without("gear_ratio").fact("gear_ration", "200.0")
    }),
];

const INSPECT: Verb = (&["inspect", "--json"], nothing_to_get_wrong);
const DIAGNOSE: Verb = (&["diagnose", "--json", "--dry-run"], same_causes);

#[test]
fn no_corrupted_screw_gives_a_silent_wrong_number() {
    let verbs = &[
        INSPECT,
        (
            &["screw", "--json", "--dry-run"] as &[&str],
            same_figures as _,
        ),
        DIAGNOSE,
    ];
    assert_eq!(table("screw", &benches::screw(), SCREW, verbs), 0);
}

#[test]
fn no_corrupted_force_sensor_gives_a_silent_wrong_number() {
    let verbs = &[
        INSPECT,
        (
            &["sensor", "--json", "--dry-run"] as &[&str],
            same_weight as _,
        ),
        DIAGNOSE,
    ];
    assert_eq!(table("force sensor", &benches::sensor(), SENSOR, verbs), 0);
}

#[test]
fn no_corrupted_cut_gives_a_silent_wrong_number() {
    let verbs = &[
        INSPECT,
        (
            &["force", "--json", "--dry-run"] as &[&str],
            same_cutting as _,
        ),
    ];
    assert_eq!(table("cuts", &benches::cuts(), CUTS, verbs), 0);
}

#[test]
fn no_corrupted_cubes_give_a_silent_wrong_number() {
    let verbs = &[
        INSPECT,
        (
            &["stiffness", "--json", "--dry-run"] as &[&str],
            same_springs as _,
        ),
        DIAGNOSE,
    ];
    assert_eq!(table("cubes", &benches::cubes(), CUBES, verbs), 0);
}

#[test]
fn no_corrupted_joint_motion_gives_a_silent_wrong_number() {
    let motion = benches::motion();
    assert_eq!(
        table("joint motion", &motion, MOTION, &[INSPECT, DIAGNOSE]),
        0
    );
}

/// The gate must let through what is fine.
#[test]
fn clean_files_of_every_kind_raise_no_doubt() {
    let cases: [(File, &[&str]); 5] = [
        (benches::screw(), &["screw", "--json", "--dry-run"]),
        (benches::sensor(), &["sensor", "--json", "--dry-run"]),
        (benches::cuts(), &["force", "--json", "--dry-run"]),
        (benches::cubes(), &["stiffness", "--json", "--dry-run"]),
        (benches::motion(), &["diagnose", "--json", "--dry-run"]),
    ];
    for (file, verb) in cases {
        let ran = crate::honest::matrix::run(verb, &file);
        assert!(ran.status < 2, "{}: {}", verb[0], ran.errors);
        let document: Value = serde_json::from_str(&ran.out).unwrap();
        let doubts = document["doubts"].as_array().expect("doubts are said");
        assert!(doubts.is_empty(), "{}: {doubts:?}", verb[0]);
    }
}
