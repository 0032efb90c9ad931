//! `ident plan` from the command line: files, JSON, refusals.

use crate::bench_of_files::Bench;
use serde_json::Value;

const POINTS: &str = "# kind = \"path\"
x_mm,y_mm,z_mm,i,j,k
0,0,0,0,0,1
100,0,0,0,0,1
100,60,0,0,0,1
99.5,60,0,0,0,1
";

fn job(lines: &str) -> String {
    format!(
        "kind = \"job\"\nrobot = \"kr210\"\npath = \"part.csv\"\nfeed_mm_min = 3000.0\n\
         start_joints_deg = [0, -90, 90, 0, 0, 0]\nblend_radius_mm = 2.0\n{lines}\n\
         [workpiece]\norigin_m = [1.5, 0.0, 0.8]\n"
    )
}

#[test]
fn a_job_gives_trajectory_report_and_json() {
    let bench = Bench::new();
    bench.put("measurements/c/part/part.csv", POINTS.as_bytes());
    bench.put("measurements/c/part/job.toml", job("").as_bytes());
    let ran = bench.run(&["plan", "measurements/c/part/job.toml", "--json"]);
    assert_eq!(ran.status, 0, "{}", ran.errors);
    let body: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(body["verb"], "plan");
    assert_eq!(body["path"]["points"], 4);
    assert_eq!(body["path"]["lines"], 3);
    assert_eq!(body["path"]["blends"], 2);
    assert_eq!(body["path"]["shrunk_blends"], 1);
    assert_eq!(body["joints"].as_array().unwrap().len(), 6);
    assert_eq!(body["exceeded"].as_array().unwrap().len(), 0);
    let file = body["trajectory"].as_str().unwrap();
    assert_eq!(file, "reports/c/part/trajectory.csv");
    let text = bench.text(file);
    let rows: Vec<&str> = text.lines().filter(|l| !l.starts_with('#')).collect();
    assert_eq!(
        rows[0],
        "time_s,x_mm,y_mm,z_mm,a_deg,b_deg,c_deg,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,feed_m_s"
    );
    assert_eq!(
        rows.len() as u64 - 1,
        body["path"]["samples"].as_u64().unwrap()
    );
    let cells: Vec<&str> = rows[5].split(',').collect();
    assert_eq!(cells.len(), 14);
    assert!(
        cells
            .iter()
            .all(|c| c.split('.').nth(1).is_some_and(|d| d.len() >= 9))
    );
    assert!(text.contains("# kind = \"trajectory\"") && text.contains("part.csv"));
    let page = bench.text("reports/c/part/index.html");
    assert!(page.contains("<canvas") && page.contains("path.svg"));
    let again = bench.run(&["plan", "measurements/c/part/job.toml", "--json"]);
    assert_eq!((ran.out, text), (again.out, bench.text(file)));
}

/// A line that holds the orientation of its end begins with it: in the trajectory, and in the program that the robot runs.
#[test]
fn a_program_starts_with_the_orientation_of_the_plan() {
    let turning = "# kind = \"path\"\nx_mm,y_mm,z_mm,a_deg,b_deg,c_deg\n\
                   0,0,0,180,0,180\n100,0,0,180,20,180\n100,60,0,180,20,150\n";
    let first = |orientation: &str| {
        let bench = Bench::new();
        bench.put("part.csv", turning.as_bytes());
        bench.put(
            "job.toml",
            job(&format!("orientation = \"{orientation}\"")).as_bytes(),
        );
        let ran = bench.run(&["plan", "job.toml", "--program", "krl"]);
        assert!(ran.status < 2, "{}", ran.errors);
        let program = bench.text("reports/job/part.src");
        let line = program.lines().find(|line| line.starts_with("LIN {"));
        let told = ran.errors.contains("over the whole of each line");
        (line.unwrap().to_string(), told)
    };
    let (blend, told) = first("blend");
    assert!(blend.contains("B 20") && told, "{blend}");
    let (whole, told) = first("whole");
    assert!(whole.contains("B 0") && !told, "{whole}");
}

#[test]
fn a_dry_run_writes_nothing() {
    let bench = Bench::new();
    bench.put("part.csv", POINTS.as_bytes());
    bench.put("job.toml", job("").as_bytes());
    let ran = bench.run(&["plan", "job.toml", "--dry-run"]);
    assert_eq!(ran.status, 0, "{}", ran.errors);
    assert!(ran.out.contains("4 points") && ran.errors.contains("blends are shorter"));
    assert!(!bench.path("reports").exists());
}

#[test]
fn a_point_out_of_reach_is_named_and_nothing_is_written() {
    let bench = Bench::new();
    bench.put("part.csv", format!("{POINTS}4000,60,0,0,0,1\n").as_bytes());
    bench.put("job.toml", job("").as_bytes());
    let ran = bench.run(&["plan", "job.toml", "--json"]);
    assert_eq!(ran.status, 2);
    assert!(ran.errors.contains("part.csv:7:"), "{}", ran.errors);
    let body: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(body["exceeded"][0]["what"], "reach");
    assert_eq!(body["unreached"]["line"], 7);
    assert_eq!(body["unreached"]["point_mm"].as_array().unwrap().len(), 3);
    assert!(body["trajectory"].is_null());
    assert!(!bench.path("reports").exists());
}

#[test]
fn a_joint_that_is_too_fast_is_named_unless_the_feed_adapts() {
    let bench = Bench::new();
    bench.put("part.csv", POINTS.as_bytes());
    let fast = job("").replace("3000.0", "300000.0")
        + "[limits]\npath_acceleration_m_s2 = 200.0\npath_jerk_m_s3 = 20000.0\n";
    bench.put("job.toml", fast.as_bytes());
    let ran = bench.run(&["plan", "job.toml", "--json"]);
    assert_eq!(ran.status, 1, "{}", ran.errors);
    let body: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(body["exceeded"][0]["what"], "joint-speed");
    bench.put(
        "job.toml",
        fast.replace("kind = \"job\"", "kind = \"job\"\nfeed = \"adapt\"")
            .as_bytes(),
    );
    let ran = bench.run(&["plan", "job.toml", "--json"]);
    let body: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(ran.status, 0, "{body}");
    assert!(body["feed"]["held_share"].as_f64().unwrap() < 1.0);
}

#[test]
fn a_path_that_is_not_there_is_said_where_the_job_names_it() {
    let bench = Bench::new();
    bench.put("measurements/c/part/job.toml", job("").as_bytes());
    let ran = bench.run(&["plan", "measurements/c/part/job.toml"]);
    assert_eq!(ran.status, 2);
    let place = "measurements/c/part/job.toml:3";
    assert!(
        ran.errors.contains(place) && ran.errors.contains("part.csv"),
        "{}",
        ran.errors
    );
}
