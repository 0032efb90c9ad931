//! Templates, comparisons, completions, suggestions: from the command line.

use crate::bench_of_files::{Bench, rows};
use serde_json::Value;

fn json(out: &str) -> Value {
    serde_json::from_str(out).unwrap_or_else(|e| panic!("{e}: {out}"))
}

#[test]
fn templates_are_read_once_they_are_filled_in() {
    let bench = Bench::new();
    let cycle: String = rows(600).iter().map(|row| row.join(",") + "\n").collect();
    let points: String = (0..40)
        .map(|i| {
            format!(
                "1,x,{},{},{},,\n",
                i / 4,
                [0, 200, 0, -200][i % 4],
                [0.0, 0.1, 0.0, -0.1][i % 4]
            )
        })
        .collect();
    let hits: String = (0..3)
        .flat_map(|hit| (0..400).map(move |k| (hit, k)))
        .map(|(hit, k)| {
            let t = f64::from(k) / 1000.0;
            let force = if k == 20 { 300.0 } else { 0.0 };
            let ring = if k < 20 {
                0.0
            } else {
                (-8.0 * t).exp() * (90.0 * t).sin()
            };
            format!("x,{hit},{t:.3},{force},{ring:.6},0.0,0.0\n")
        })
        .collect();
    for (kind, file, body) in [
        ("load-cycle", "load-cycle.csv", cycle),
        ("workspace", "workspace.csv", points),
        ("hammer", "hammer.csv", hits),
    ] {
        let ran = bench.run(&["new", kind]);
        assert_eq!(ran.status, 0, "{}", ran.errors);
        let empty = bench.run(&["inspect", file]);
        assert_eq!(empty.status, 2, "{kind}: a template without rows was taken");
        let filled = bench.text(file) + &body;
        bench.put(file, filled.as_bytes());
        let ran = bench.run(&["inspect", file, "--json"]);
        assert!(ran.status < 2, "{kind}: {}", ran.errors);
        assert_eq!(json(&ran.out)["kind"], kind);
    }
    assert_eq!(bench.run(&["new", "robot", "own.toml"]).status, 0);
    let words = [
        "simulate",
        "pose",
        "--robot",
        "own.toml",
        "--joints-deg",
        "0,0,0,0,0,0",
        "--json",
    ];
    let ran = bench.run(&words);
    assert_eq!(ran.status, 0, "{}", ran.errors);
    let tip = json(&ran.out)["tcp_m"][0].as_f64().unwrap();
    assert!((tip - 1.75).abs() < 1e-12, "{tip}");
    assert_eq!(bench.run(&["new", "job"]).status, 0);
    bench.put(
        "part.cls",
        b"UNITS/MM\nFROM/0,0,10,0,0,1\nFEDRAT/1000,MMPM\nGOTO/0,0,0\nGOTO/50,0,0\n",
    );
    let ran = bench.run(&["plan", "job.toml", "--dry-run", "--json"]);
    assert_eq!(ran.status, 0, "{}", ran.errors);
}

#[test]
fn a_template_replaces_nothing_and_a_wrong_kind_is_told_the_right_one() {
    let bench = Bench::new();
    bench.put("job.toml", b"mine");
    let ran = bench.run(&["new", "job"]);
    assert_eq!(
        (ran.status, bench.text("job.toml")),
        (2, "mine".to_string())
    );
    let ran = bench.run(&["new", "hamer"]);
    assert_eq!(ran.status, 2);
    assert!(ran.errors.contains("`hammer` is one"), "{}", ran.errors);
    assert_eq!(bench.run(&["new", "hammer", "--dry-run"]).status, 0);
    assert!(!bench.path("hammer.csv").exists());
}

/// A stored fit of one joint, cut to what a comparison reads.
fn fit(stiffness: f64, gap: Option<f64>) -> String {
    let parameter = |name: &str, unit: &str, value: Option<f64>, error: f64| {
        let numbers = value.map_or(String::new(), |value| {
            let (low, high) = (value - 1.96 * error, value + 1.96 * error);
            format!("value = {value:?}\nstderr = {error:?}\nci95 = [{low:?}, {high:?}]\n")
        });
        let status = if value.is_some() {
            "identified"
        } else {
            "not-identifiable"
        };
        format!(
            "[[parameters]]\nname = \"{name}\"\nsite = \"A3\"\nunit = \"{unit}\"\nstatus = \"{status}\"\nmeaning = \"\"\n{numbers}"
        )
    };
    format!(
        "schema = \"ident-fit/1\"\n{}{}",
        parameter("stiffness", "N·m/rad", Some(stiffness), 1e4),
        parameter("gap", "rad", gap, 2e-6)
    )
}

#[test]
fn what_changed_between_two_campaigns_is_told_and_nothing_else() {
    let bench = Bench::new();
    bench.put("fits/winter/axis3.toml", fit(2.0e6, Some(5e-5)).as_bytes());
    bench.put("fits/winter/axis4.toml", fit(1.0e6, None).as_bytes());
    bench.put("fits/winter/robot.toml", b"name = \"x\"\n");
    bench.put("fits/summer/axis3.toml", fit(2.01e6, Some(9e-5)).as_bytes());
    bench.put("fits/summer/axis4.toml", fit(1.01e6, Some(1e-5)).as_bytes());
    let ran = bench.run(&["compare", "winter", "summer", "--json"]);
    assert_eq!(ran.status, 1, "{}", ran.errors);
    let body = json(&ran.out);
    assert_eq!(body["changed"], 1);
    let changed = body["parameters"]
        .as_array()
        .unwrap()
        .iter()
        .find(|p| p["changed"] == true)
        .unwrap();
    assert_eq!(
        (&changed["name"], &changed["fit"]),
        (&"gap".into(), &"axis3".into())
    );
    assert!((changed["change"].as_f64().unwrap() - 4e-5).abs() < 1e-12);
    assert!(
        bench
            .path("reports/compare-winter-summer/index.html")
            .exists()
    );
    let ran = bench.run(&["compare", "fits/winter", "measurements/winter", "--dry-run"]);
    assert_eq!(ran.status, 0, "{}", ran.errors);
    assert!(
        ran.out.contains("None of 3 parameters changed"),
        "{}",
        ran.out
    );
    let ran = bench.run(&["compare", "winter", "spring"]);
    assert!(
        ran.status == 2 && ran.errors.contains("help:"),
        "{}",
        ran.errors
    );
}

#[test]
fn shells_and_the_manual_are_served_and_typos_are_told() {
    let bench = Bench::new();
    for (shell, part) in [
        ("bash", "_ident()"),
        ("zsh", "#compdef ident"),
        ("fish", "complete -c ident"),
        ("man", ".TH ident"),
    ] {
        let ran = bench.run(&["completions", shell]);
        assert_eq!(ran.status, 0, "{}", ran.errors);
        assert!(
            ran.out.contains(part) && ran.out.contains("stiffness"),
            "{shell}"
        );
    }
    let ran = bench.run(&["stifness", "x.csv"]);
    assert!(
        ran.status == 2 && ran.errors.contains("stiffness"),
        "{}",
        ran.errors
    );
    let ran = bench.run(&["plan", "job.toml", "--dry-runn"]);
    assert!(
        ran.status == 2 && ran.errors.contains("--dry-run"),
        "{}",
        ran.errors
    );
}

/// Whatever a diagnosis may name can be looked up, whatever the kind of data.
#[test]
fn effects_of_every_kind_are_explained() {
    let bench = Bench::new();
    for (name, kind) in [
        ("corner_lag", "milled-part"),
        ("hose_force", "force-sensor"),
        ("wear_zone", "screw"),
        ("chipped_tooth", "milling-force"),
        ("loose_cube", "cubes"),
        ("backlash", "screw"),
    ] {
        let ran = bench.run(&["effects", name]);
        assert_eq!(ran.status, 0, "{}", ran.errors);
        let said = ran.out;
        assert!(said.contains(&format!("{name} in {kind} data")), "{said}");
        assert!(said.contains("told from rivals if you "), "{said}");
    }
    assert_eq!(bench.run(&["effects", "corner_lga"]).status, 2);
}

/// Stiffness and gap of six axes of one campaign, the stiffnesses times a factor that may depend on the axis.
fn six_axes(bench: &Bench, campaign: &str, factor: impl Fn(usize) -> f64) {
    for axis in 1..=6 {
        // Deviations of half a standard error, other ones in each campaign.
        let off = 0.5 * (axis as f64 * if campaign == "before" { 1.7 } else { 2.9 }).sin();
        let text = fit(
            factor(axis) * 1e6 * (1.0 + 0.01 * off),
            Some(5e-5 + 1e-6 * off),
        );
        let text = text.replace("\"A3\"", &format!("\"A{axis}\""));
        bench.put(&format!("fits/{campaign}/axis{axis}.toml"), text.as_bytes());
    }
}

#[test]
fn what_changed_is_explained_by_a_known_cause_or_told_as_not_separable() {
    let bench = Bench::new();
    six_axes(&bench, "before", |_| 1.0);
    six_axes(&bench, "soft", |axis| if axis == 4 { 0.85 } else { 1.0 });
    six_axes(&bench, "gain", |_| 1.08);
    six_axes(&bench, "same", |_| 1.0);
    let explained = |after: &str| {
        let ran = bench.run(&["compare", "before", after, "--json", "--dry-run"]);
        assert!(ran.status < 2, "{}", ran.errors);
        json(&ran.out)["explanation"].clone()
    };
    let names = |answer: &serde_json::Value| -> Vec<String> {
        let set = answer["sets"][0]["causes"].as_array().unwrap();
        set.iter()
            .map(|c| {
                format!(
                    "{} {}",
                    c["cause"].as_str().unwrap_or("-"),
                    c["site"].as_str().unwrap()
                )
            })
            .collect()
    };
    let soft = explained("soft");
    assert_eq!(names(&soft), ["drive_stiffness A4"]);
    assert!((soft["sets"][0]["causes"][0]["percent"].as_f64().unwrap() + 16.2).abs() < 2.0);
    assert_eq!(
        (names(&explained("gain")), &explained("gain")["separable"]),
        (vec!["force_gain ".to_string()], &true.into())
    );
    assert!(names(&explained("same")).is_empty());
    // Without the gaps a force that was read wrong and a displacement that was read wrong look alike.
    for campaign in ["before", "gain"] {
        for axis in 1..=6 {
            let name = format!("fits/{campaign}/axis{axis}.toml");
            let text = bench.text(&name);
            let cut = text.find("[[parameters]]\nname = \"gap\"").unwrap();
            bench.put(&name, &text.as_bytes()[..cut]);
        }
    }
    let gain = explained("gain");
    assert_eq!(gain["separable"], false);
    let ran = bench.run(&["compare", "before", "gain", "--dry-run"]);
    assert!(
        ran.out
            .contains("Not separable by these fits: force_gain, or sensor_gain"),
        "{}",
        ran.out
    );
}

#[test]
fn a_campaign_is_dated_by_its_files() {
    use crate::bench_of_files::{rows, with_rows};
    let bench = Bench::new();
    let dated = |date: &str| format!("# date = {date}\n{}", with_rows(&rows(600)));
    bench.put("measurements/c/a.csv", dated("2026-11-20").as_bytes());
    bench.put("measurements/c/b.csv", dated("\"2026-11-22\"").as_bytes());
    let ran = bench.run(&["run", "measurements/c"]);
    assert_eq!(ran.status, 0, "{}", ran.errors);
    let page = bench.text("reports/c/index.html");
    assert!(
        page.contains("measured 2026-11-20 to 2026-11-22"),
        "{page:.600}"
    );
    bench.put("measurements/c/b.csv", dated("\"last week\"").as_bytes());
    let ran = bench.run(&["run", "measurements/c"]);
    assert!(
        ran.status == 2 && ran.errors.contains("is no date") && ran.errors.contains("b.csv"),
        "{}",
        ran.errors
    );
}
