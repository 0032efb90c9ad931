//! Bad input is refused with file, line and remedy, and nothing is written; odd input is either
//! read as it was meant or reported. Runs the program as a user does.

use crate::bench_of_files::{Bench, FRONT, HEADER, Ran, document, rows, with_body, with_rows};
use ident::measurement::load_cycle::LoadCycle;
use ident::measurement::table::Table;

/// A refusal: what the file holds, on which line the problem lies, a word of the message.
struct Refused {
    name: &'static str,
    content: Vec<u8>,
    line: Option<usize>,
    says: &'static str,
}

fn refused(
    name: &'static str,
    content: impl Into<Vec<u8>>,
    line: impl Into<Option<usize>>,
    says: &'static str,
) -> Refused {
    Refused {
        name,
        content: content.into(),
        line: line.into(),
        says,
    }
}

/// The first line of numbers in a file of [`with_body`].
fn first_row() -> usize {
    FRONT.lines().count() + 2
}

/// A good file whose line `line` (1-based) is replaced.
fn with_line(line: usize, text: &str) -> String {
    let good = with_rows(&rows(400));
    let lines = good.lines().enumerate();
    let replaced = lines.map(|(i, old)| if i + 1 == line { text } else { old });
    replaced.collect::<Vec<_>>().join("\n") + "\n"
}

fn without_fact(key: &str) -> String {
    let good = with_rows(&rows(400));
    let kept = good
        .lines()
        .filter(|l| !l.starts_with(&format!("# {key} ")));
    kept.collect::<Vec<_>>().join("\n") + "\n"
}

fn line_of(key: &str) -> usize {
    let is_it = |l: &str| l.starts_with(&format!("# {key} "));
    FRONT.lines().position(is_it).expect("a fact of the front") + 1
}

fn with_fact(key: &str, value: &str) -> String {
    with_line(line_of(key), &format!("# {key} = {value}"))
}

fn with_header(header: &str) -> String {
    with_line(first_row() - 1, header)
}

fn check(cases: Vec<Refused>) {
    for case in cases {
        let bench = Bench::new();
        bench.put("bad.csv", &case.content);
        for verb in [
            &["stiffness"][..],
            &["stiffness", "--json"],
            &["inspect"],
            &["inspect", "--json"],
        ] {
            let mut arguments = verb.to_vec();
            arguments.push("bad.csv");
            let ran = bench.run(&arguments);
            ran.is_refusal(case.name, "bad.csv", case.line, case.says);
            bench.nothing_written(case.name);
        }
    }
}

#[test]
fn what_is_no_text_table_is_refused() {
    let big_endian: Vec<u8> = "# kind".encode_utf16().flat_map(u16::to_be_bytes).collect();
    let binary: Vec<u8> = (0..40_000u32)
        .map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8)
        .collect();
    check(vec![
        refused("empty file", "", 1, "empty"),
        refused("only a line end", "\n", None, "header"),
        refused("binary", binary, 1, "text"),
        refused("UTF-16 without mark", big_endian, 1, "text"),
        refused("spreadsheet", "PK\x03\x04xxxx", 1, "spreadsheet"),
        refused("front matter only", FRONT, first_row() - 1, "header"),
        refused("headers only", with_body(""), first_row(), "0 usable rows"),
        refused(
            "no header",
            format!("{FRONT}0.0,1.0,0.01\n"),
            first_row() - 1,
            "header row is missing",
        ),
        refused(
            "one huge line",
            "x".repeat(3 << 20),
            1,
            "longer than any row",
        ),
        refused(
            "a huge row",
            with_body(&"1".repeat(3 << 20)),
            first_row(),
            "longer than any row",
        ),
        refused(
            "an open quote",
            with_line(first_row() + 2, "0.1,\"1.0,0.01"),
            first_row() + 2,
            "",
        ),
    ]);
}

#[test]
fn broken_facts_are_refused() {
    check(vec![
        refused("broken TOML", with_line(2, "# joint = = 6"), 2, "not TOML"),
        refused(
            "fact given twice",
            with_line(3, "# joint = 5"),
            3,
            "not TOML",
        ),
        refused("no kind", without_fact("kind"), 1, "kind"),
        refused(
            "wrong kind",
            with_fact("kind", "\"weather\""),
            1,
            "`weather`",
        ),
        refused("kind as a number", with_fact("kind", "3"), 1, "text"),
        refused("no joint", without_fact("joint"), 1, "joint"),
        refused("joint 7", with_fact("joint", "7"), line_of("joint"), "is 7"),
        refused(
            "joint 1.5",
            with_fact("joint", "1.5"),
            line_of("joint"),
            "1.5",
        ),
        refused(
            "joint as text",
            with_fact("joint", "\"A6\""),
            line_of("joint"),
            "number",
        ),
        refused("no axis", without_fact("axis"), 1, "axis"),
        refused(
            "unknown axis",
            with_fact("axis", "\"bend\""),
            line_of("axis"),
            "bend",
        ),
        refused(
            "zero lever",
            with_fact("load_lever_m", "0"),
            line_of("load_lever_m"),
            "not above zero",
        ),
        refused(
            "negative lever",
            with_fact("sensor_lever_m", "-0.4"),
            line_of("sensor_lever_m"),
            "not above zero",
        ),
        refused(
            "infinite lever",
            with_fact("sensor_lever_m", "inf"),
            line_of("sensor_lever_m"),
            "finite",
        ),
        refused(
            "denormal lever",
            with_fact("sensor_lever_m", "1e-320"),
            line_of("sensor_lever_m"),
            "nobody measures",
        ),
        refused(
            "lever with a decimal comma",
            with_fact("sensor_lever_m", "0,4"),
            line_of("sensor_lever_m"),
            "TOML",
        ),
        refused(
            "one lever missing",
            without_fact("sensor_lever_m"),
            None,
            "sensor_lever_m",
        ),
        refused(
            "negative spread",
            with_fact("lever_rel_std", "-0.1"),
            line_of("lever_rel_std"),
            "below zero",
        ),
    ]);
}

#[test]
fn bad_headers_are_refused() {
    let header = first_row() - 1;
    let case = |name, text: &str, says| refused(name, with_header(text), header, says);
    check(vec![
        case(
            "column without unit",
            "time_s,force,displacement_mm",
            "without a unit",
        ),
        case(
            "unknown unit",
            "time_s,force_lbf,displacement_mm",
            "unknown unit `lbf`",
        ),
        case(
            "nameless column",
            "time_s,,displacement_mm",
            "without a name",
        ),
        case("duplicate column", "time_s,force_N,force_N", "twice"),
        case("duplicate quantity", "time_s,force_N,force_kN", "twice"),
        case("units swapped", "time_s,force_mm,displacement_N", "unit of"),
        case("no load", "time_s,x_N,displacement_mm", "no load"),
        case("no deflection", "time_s,force_N,x_mm", "no deflection"),
        case("two loads", "time_s,force_N,moment_Nm", "both"),
    ]);
}

#[test]
fn bad_rows_are_refused() {
    let third = first_row() + 2;
    let case = |name, text: &str, says| refused(name, with_line(third, text), third, says);
    let truncated = with_rows(&rows(400));
    let truncated = &truncated[..truncated.trim_end().rfind(',').unwrap()];
    check(vec![
        case("short row", "0.1,1.0", "2 cells"),
        case("long row", "0.1,1.0,0.01,5", "4 cells"),
        case("text", "0.1,strong,0.01", "`strong` is not a number"),
        case("a unit in a cell", "0.1,5 N,0.01", "not a number"),
        case("NaN", "0.1,NaN,0.01", "finite"),
        case("infinity", "0.1,-inf,0.01", "finite"),
        case("too large", "0.1,1e999,0.01", "finite"),
        case("too large for squares", "0.1,-1e90,0.01", "too large"),
        case("too large in SI", "0.1,1.5e308,0.01", "too large"),
        case("a comment", "# pause", "1 cells"),
        case("time backwards", "-5.0,1.0,0.01", "backwards"),
        case("decimal comma with comma", "0,1,1,0,0,01", "6 cells"),
        case("decimal comma in part", "0,1,1.0,0.01", "4 cells"),
        refused(
            "truncated within a row",
            truncated,
            first_row() + 399,
            "2 cells",
        ),
        refused(
            "one row",
            with_body("0.0,1.0,0.01\n"),
            first_row(),
            "1 usable row",
        ),
        refused(
            "two rows",
            with_rows(&rows(2)),
            first_row(),
            "2 usable rows",
        ),
        refused(
            "three rows",
            with_rows(&rows(3)),
            first_row(),
            "3 usable rows",
        ),
    ]);
}

#[test]
fn places_are_right_after_blank_lines_and_missing_cells() {
    let mut lines: Vec<String> = rows(400).iter().map(|r| r.join(",")).collect();
    lines[1] = ",,".into();
    lines.insert(2, String::new());
    lines.insert(2, String::new());
    let mut text = lines.clone();
    text[9] = "0.3,oops,0.01".into();
    let mut back = lines.clone();
    back[9] = "-1.0,2.0,0.01".into();
    let mut after_gap = lines;
    after_gap[8] = ",2.0,0.01".into();
    after_gap[9] = "0.0001,2.0,0.01".into();
    let body = |lines: Vec<String>| with_body(&(lines.join("\n") + "\n"));
    let line = first_row() + 9;
    check(vec![
        refused("text", body(text), line, "oops"),
        refused("time backwards", body(back), line, "backwards"),
        refused(
            "time backwards over a gap",
            body(after_gap),
            line,
            "backwards",
        ),
    ]);
}

/// The same rows in another dialect.
fn dialect(delimiter: &str, sign: &str, quote: &str) -> String {
    let row = |cells: &[String]| {
        let cells = cells.iter().map(|c| c.replace('.', sign));
        cells.collect::<Vec<_>>().join(delimiter) + "\n"
    };
    let header = HEADER
        .split(',')
        .map(|name| format!("{quote}{name}{quote}"))
        .collect::<Vec<_>>()
        .join(delimiter);
    let body: String = rows(400).iter().map(|r| row(r)).collect();
    format!("{FRONT}{header}\n{body}")
}

#[test]
fn thousands_separators_are_refused() {
    let point = dialect(";", ".", "").replace("\n0.2000;", "\n0.2000;1,");
    let comma = dialect(";", ",", "").replace("\n0,2000;", "\n0,2000;1.");
    let mut first = dialect(";", ".", "");
    first = first.replacen("\n0.0000;", "\n0.0000;1,", 1);
    check(vec![
        refused("1,234.5", point, first_row() + 4, "not a number"),
        refused("1.234,5", comma, first_row() + 4, "not a number"),
        refused(
            "1,234.5 in the first row",
            first,
            first_row(),
            "not a number",
        ),
        refused(
            "1.234 among decimal commas",
            dialect(";", ",", "").replace("\n0,2000;", "\n1.234;"),
            first_row() + 4,
            "not a number",
        ),
    ]);
}

/// The numbers of a result, without the names and hashes of the files.
fn results(ran: &Ran) -> String {
    let mut found = document(ran)["results"].clone();
    found[0]["file"] = serde_json::Value::Null;
    found.to_string()
}

#[test]
fn every_dialect_is_read_alike() {
    let bench = Bench::new();
    let good = with_rows(&rows(400));
    bench.put("good.csv", good.as_bytes());
    let wanted = results(&bench.run(&["stiffness", "--dry-run", "--json", "good.csv"]));
    let others = [
        ("CRLF", good.replace('\n', "\r\n")),
        ("BOM", format!("\u{feff}{good}")),
        ("semicolon", dialect(";", ".", "")),
        ("semicolon, decimal comma", dialect(";", ",", "")),
        ("tab, decimal comma", dialect("\t", ",", "")),
        ("quoted header", dialect(",", ".", "\"")),
        ("spaces", dialect(" , ", ".", "")),
        ("blank lines at the end", format!("{good}\n\n  \n")),
        ("no line end", good.trim_end().to_string()),
        ("empty cells at the end", format!("{good},,\n")),
    ];
    for (name, text) in others {
        bench.put("other.csv", text.as_bytes());
        let ran = bench.run(&["stiffness", "--dry-run", "--json", "other.csv"]);
        assert_eq!(ran.status, 0, "{name}: {}", ran.errors);
        let found = match name {
            "empty cells at the end" => continue,
            _ => results(&ran),
        };
        assert_eq!(found, wanted, "{name}");
    }
}

#[test]
fn missing_cells_are_counted_and_said() {
    let mut cells = rows(400);
    for row in [40, 90, 200] {
        cells[row][1].clear();
    }
    let bench = Bench::new();
    bench.put("gaps.csv", with_rows(&cells).as_bytes());
    let ran = bench.run(&["stiffness", "--dry-run", "--json", "gaps.csv"]);
    let fit = document(&ran)["results"][0]["fit"].clone();
    assert_eq!(fit["rows_left_out"], 3);
    assert_eq!(fit["rows"], 397);
    assert!(ran.errors.contains("3 of 400 rows left out"));
    let seen = bench.run(&["inspect", "gaps.csv"]);
    assert!(seen.out.contains("400 rows, 3 left out"), "{}", seen.out);
}

/// `time`, load and deflection by a rule.
fn ruled(load: impl Fn(usize) -> f64, deflection: impl Fn(usize) -> f64) -> String {
    let row = |i: usize| {
        vec![
            format!("{:.2}", i as f64 * 0.05),
            format!("{:e}", load(i)),
            format!("{:e}", deflection(i)),
        ]
    };
    with_rows(&(0..400).map(row).collect::<Vec<_>>())
}

fn wave(i: usize) -> f64 {
    (i as f64 * std::f64::consts::TAU / 130.0).sin()
}

#[test]
fn what_no_data_fix_is_not_identifiable() {
    let noise = |i: usize| 1e-5 * ((i * 7919 % 1009) as f64 / 504.0 - 1.0);
    let cases = [
        ("everything constant", ruled(|_| 5.0, |_| 0.02)),
        ("everything zero", ruled(|_| 0.0, |_| 0.0)),
        ("load constant", ruled(|_| 5.0, |i| 0.02 * wave(i))),
        ("load zero", ruled(|_| 0.0, noise)),
        ("deflection constant", ruled(|i| 500.0 * wave(i), |_| 0.02)),
        ("deflection zero", ruled(|i| 500.0 * wave(i), |_| 0.0)),
    ];
    for (name, text) in cases {
        let bench = Bench::new();
        bench.put("constant.csv", text.as_bytes());
        let ran = bench.run(&["stiffness", "--json", "constant.csv"]);
        assert_eq!(ran.status, 1, "{name}: {}{}", ran.out, ran.errors);
        let parameter = document(&ran)["results"][0]["parameters"][0].clone();
        assert_eq!(parameter["name"], "stiffness", "{name}");
        // a joint that does not move at all is as stiff as the search goes, which is no value either
        let status = parameter["status"].as_str().unwrap();
        let no_value =
            status == "not-identifiable" || status == "at-bound" && name.starts_with("deflection");
        assert!(no_value, "{name}: {status}");
        assert!(parameter["value"].is_null() && parameter["ci95"].is_null());
        assert!(!bench.text("fits/constant.toml").contains("nan"), "{name}");
        let seen = bench.run(&["inspect", "--json", "constant.csv"]);
        assert_eq!(seen.status, 1, "{name}: {}", seen.errors);
        document(&seen);
    }
}

/// A recorder whose clock stands still.
fn at_one_instant() -> String {
    let mut cells = rows(400);
    cells.iter_mut().for_each(|row| row[0] = "3.0".into());
    with_rows(&cells)
}

#[test]
fn odd_but_lawful_files_do_not_break_it() {
    let stiff = |i: usize| 5e-4 * wave(i);
    let cases = [
        (
            "tiny numbers",
            ruled(|i| 1e-150 * wave(i), |i| 1e-160 * wave(i)),
        ),
        (
            "large numbers",
            ruled(|i| 1e49 * wave(i), |i| 1e40 * wave(i)),
        ),
        (
            "runs against the load",
            ruled(|i| 500.0 * wave(i), |i| -stiff(i)),
        ),
        ("swapped columns", ruled(stiff, |i| 500.0 * wave(i))),
        ("no noise at all", ruled(|i| 500.0 * wave(i), stiff)),
        ("half a cycle", ruled(|i| i as f64, |i| 1e-6 * i as f64)),
        ("time stands still", at_one_instant()),
        ("four rows", with_rows(&rows(4))),
        ("five rows", with_rows(&rows(5))),
        ("nine rows", with_rows(&rows(9))),
    ];
    for (name, text) in cases {
        let bench = Bench::new();
        bench.put("odd.csv", text.as_bytes());
        for verb in ["stiffness", "inspect"] {
            let ran = bench.run(&[verb, "--json", "odd.csv"]);
            assert!(ran.status < 2, "{name}, {verb}: {}", ran.errors);
            document(&ran);
        }
        let text = bench.run(&["stiffness", "odd.csv"]);
        assert!(!text.out.contains("NaN"), "{name}: {}", text.out);
    }
}

#[test]
fn absent_files_and_folders_are_refused() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("folder.csv")).unwrap();
    let long = format!("{}.csv", "n".repeat(300));
    for (name, file) in [
        ("absent", "absent.csv"),
        ("absent folder", "no/where.csv"),
        ("folder", "folder.csv"),
        ("long name", long.as_str()),
        ("current folder", "."),
    ] {
        for verb in ["stiffness", "inspect"] {
            bench.run(&[verb, file]).is_refusal(name, file, None, "");
            bench.nothing_written(name);
        }
    }
}

#[test]
fn one_bad_file_among_good_ones_stops_everything() {
    let bench = Bench::new();
    bench.put("good.csv", with_rows(&rows(400)).as_bytes());
    bench.put("bad1.csv", b"");
    bench.put("bad2.csv", b"PK\x03\x04");
    let first = bench.run(&["stiffness", "good.csv", "bad1.csv", "bad2.csv"]);
    first.is_refusal("first of two bad files", "bad1.csv", Some(1), "empty");
    bench.nothing_written("one bad file");
    let again = bench.run(&["stiffness", "good.csv", "bad1.csv", "bad2.csv"]);
    assert_eq!(first.errors, again.errors);
}

#[test]
fn two_files_never_write_over_each_other() {
    let bench = Bench::new();
    let text = with_rows(&rows(400));
    bench.put("a/axis.csv", text.as_bytes());
    bench.put("b/axis.csv", text.as_bytes());
    let ran = bench.run(&["stiffness", "a/axis.csv", "b/axis.csv"]);
    ran.is_refusal("same results twice", "b/axis.csv", None, "a/axis.csv");
    bench.nothing_written("same results twice");
    let dry = bench.run(&["stiffness", "--dry-run", "a/axis.csv", "b/axis.csv"]);
    assert_eq!(dry.status, 0, "{}", dry.errors);
}

#[test]
fn where_nothing_can_be_written_it_says_so() {
    for occupied in ["fits", "reports"] {
        let bench = Bench::new();
        bench.put("good.csv", with_rows(&rows(400)).as_bytes());
        bench.put(occupied, b"a file where a folder should be");
        let ran = bench.run(&["stiffness", "good.csv"]);
        ran.is_refusal(occupied, occupied, None, "cannot be written");
        assert_eq!(ran.out, "");
        let mut left = [occupied, "good.csv"].map(String::from);
        left.sort();
        assert_eq!(bench.files(), left);
        let dry = bench.run(&["stiffness", "--dry-run", "good.csv"]);
        assert_eq!(dry.status, 0);
    }
}

#[test]
fn names_with_spaces_and_signs_are_fine() {
    let bench = Bench::new();
    let long = format!("{}.csv", "n".repeat(230));
    for name in ["with space.csv", "a&b<c>\"d\".csv", "Prüfung 6°.csv", &long] {
        bench.put(name, with_rows(&rows(400)).as_bytes());
        let ran = bench.run(&["stiffness", "--json", name]);
        assert_eq!(ran.status, 0, "{name}: {}", ran.errors);
        let stem = name.trim_end_matches(".csv");
        assert_eq!(document(&ran)["inputs"][0]["path"], name);
        assert!(
            bench
                .text(&format!("reports/{stem}-stiffness.svg"))
                .starts_with("<svg")
        );
    }
}

#[test]
fn a_closed_pipe_is_no_error() {
    let bench = Bench::new();
    bench.put("good.csv", with_rows(&rows(400)).as_bytes());
    for arguments in [
        vec!["stiffness", "--dry-run", "--json", "good.csv"],
        vec!["inspect", "good.csv"],
        vec!["--help"],
    ] {
        let (status, errors) = bench.run_into_closed_pipe(&arguments);
        assert_eq!(status, 0, "{arguments:?}: {errors}");
        assert!(!errors.contains("panicked"), "{errors}");
    }
}

#[test]
fn wrong_usage_is_refused() {
    let bench = Bench::new();
    bench.put("good.csv", with_rows(&rows(400)).as_bytes());
    let many = ident::effects::EFFECTS
        .iter()
        .map(|e| e.card().name)
        .collect::<Vec<_>>()
        .join(",");
    let cases: [&[&str]; 9] = [
        &[],
        &["stiffness"],
        &["frobnicate"],
        &["stiffness", "--frobnicate", "good.csv"],
        &["stiffness", "--effects", "ghost", "good.csv"],
        &["stiffness", "--effects", &many, "good.csv"],
        &["stiffness", "--bootstrap", "-3", "good.csv"],
        &["stiffness", "--model", "absent.toml", "good.csv"],
        &["lab"],
    ];
    for arguments in cases {
        let ran = bench.run(arguments);
        assert_eq!(ran.status, 2, "{arguments:?}");
        assert!(
            !ran.errors.is_empty() && ran.out.is_empty(),
            "{arguments:?}"
        );
        bench.nothing_written("wrong usage");
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let outputs: Vec<_> = ["1", "2", "2"]
        .map(|threads| {
            let bench = Bench::new();
            for (i, name) in ["a.csv", "b.csv", "c.csv"].iter().enumerate() {
                bench.put(name, with_rows(&rows(400 + 40 * i)).as_bytes());
            }
            let arguments = [
                "stiffness",
                "--bootstrap",
                "8",
                "--json",
                "a.csv",
                "b.csv",
                "c.csv",
            ];
            let ran = bench.run_with(&arguments, &[("RAYON_NUM_THREADS", threads)]);
            assert_eq!(ran.status, 0, "{}", ran.errors);
            let files = bench.files();
            assert_eq!(files.len(), 10, "{files:?}");
            let contents: Vec<Vec<u8>> = files.iter().map(|f| bench.bytes(f)).collect();
            (ran.out, ran.errors, contents)
        })
        .into();
    assert!(outputs[0] == outputs[1], "one thread and two differ");
    assert!(outputs[1] == outputs[2], "two runs differ");
}

/// `moment_Nm, angle_rad` alone: rows are counted, which is said, and what is meant in seconds is refused.
#[test]
fn a_table_without_time_counts_its_rows() {
    let read = |facts: &str| {
        let head = format!("# kind = \"load-cycle\"\n# joint = 2\n# axis = \"rotation\"\n{facts}");
        let text =
            format!("{head}moment_Nm,angle_rad\n0,0\n100,1e-4\n,2e-4\n0,0\n-100,-1e-4\n0,0\n");
        let table = Table::from_reader("cycle.csv".as_ref(), text.as_bytes(), text.len() as u64);
        LoadCycle::from_table(table.unwrap())
    };
    let file = read("").unwrap();
    assert!(file.counts_rows);
    assert_eq!(file.time, [0.0, 1.0, 3.0, 4.0, 5.0]);
    let doubts = ident::fit::suitability::load_cycle::doubts(&file);
    assert!(doubts.iter().any(|d| d.rule == "counted"));
    let refused = read("# rest_s = 2.0\n").unwrap_err().to_string();
    assert!(refused.contains("rest_s"), "{refused}");
}
