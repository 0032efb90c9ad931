//! The report of a campaign in a real browser: whole without a network, printable, usable with a
//! keyboard and in grey. Passes over itself where there is no Chromium (Debian package `chromium`).

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const BROWSER: &str = "chromium";

/// Runs the browser on a page; `None` where there is none.
fn browse(profile: &Path, page: &Path, options: &[&str]) -> Option<Vec<u8>> {
    let mut command = Command::new(BROWSER);
    command
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
        ])
        .arg(format!("--user-data-dir={}", profile.display()))
        .args(options)
        .arg(format!("file://{}", page.display()))
        .stderr(Stdio::null());
    let out = command.output().ok()?;
    assert!(
        out.status.success(),
        "{BROWSER} {options:?}: {}",
        out.status
    );
    Some(out.stdout)
}

/// The example campaign, run in a folder of its own.
fn campaign() -> tempfile::TempDir {
    let bench = tempfile::tempdir().unwrap();
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("measurements/kr210");
    let folder = bench.path().join("measurements/kr210");
    std::fs::create_dir_all(&folder).unwrap();
    for entry in std::fs::read_dir(from).unwrap().flatten() {
        if entry.path().is_file() {
            std::fs::copy(entry.path(), folder.join(entry.file_name())).unwrap();
        }
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_ident"));
    let out = command
        .current_dir(bench.path())
        .args(["run", "measurements/kr210"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.code().is_some_and(|code| code < 2), "{said}");
    bench
}

/// A copy of a page with something more in its head.
fn with_head(page: &Path, name: &str, more: &str) -> PathBuf {
    let text = std::fs::read_to_string(page).unwrap();
    let copy = page.with_file_name(name);
    let text = text.replacen("</body>", &format!("{more}</body>"), 1);
    std::fs::write(&copy, text).unwrap();
    copy
}

/// Width and height of a PNG, from its header.
fn size(png: &[u8]) -> (u32, u32) {
    assert!(png.starts_with(b"\x89PNG"), "no PNG");
    let at = |from: usize| u32::from_be_bytes(png[from..from + 4].try_into().unwrap());
    (at(16), at(20))
}

#[test]
fn the_report_of_a_campaign_in_a_browser() {
    if Command::new(BROWSER).arg("--version").output().is_err() {
        println!("passed over: no {BROWSER} here (Debian package `chromium`)");
        return;
    }
    let bench = campaign();
    let page = bench.path().join("reports/kr210/index.html");
    let profile = bench.path().join("profile");
    let dom = browse(&profile, &page, &["--dump-dom"]).unwrap();
    let dom = String::from_utf8(dom).unwrap();
    stands_alone(&dom);
    is_structured(&dom);
    tells_the_story(&dom);
    is_drawn(&profile, &page);
    prints_everything(&profile, &page);
    prints_a_summary_of_four_pages(&profile, &page);
    keyboard_reaches_everything(&profile, &page, &dom);
    let bytes = std::fs::metadata(&page).unwrap().len();
    assert!(bytes < 2_500_000, "{bytes} bytes");
}

fn stands_alone(dom: &str) {
    let names = dom.matches("xmlns=\"http").count() + dom.matches("xmlns:xlink=\"http").count();
    assert_eq!(dom.matches("http").count(), names, "an external address");
    // scripts turn what stands in space, and are in the page themselves
    for taboo in ["<img", "<link", "<iframe", " src=", "@import", "url("] {
        assert!(!dom.contains(taboo), "{taboo}");
    }
    let figures = dom.matches("<figure").count();
    assert!(figures > 20, "{figures} figures");
    assert_eq!(
        dom.matches("<svg").count(),
        figures,
        "a figure that is no SVG"
    );
}

fn is_structured(dom: &str) {
    let mut last = 0;
    for at in dom.match_indices("<h").map(|found| found.0) {
        let Some(level) = dom[at + 2..].chars().next().and_then(|c| c.to_digit(10)) else {
            continue;
        };
        assert!(
            level <= last + 1,
            "h{level} after h{last}: {}",
            &dom[at..at + 60]
        );
        last = level;
    }
    assert_eq!(dom.matches("<h1").count(), 1);
    for piece in dom.split("<details").skip(1) {
        let inside = piece.split_once('>').unwrap().1.trim_start();
        assert!(inside.starts_with("<summary"), "{}", &inside[..60]);
    }
    let tables = dom.matches("<table").count();
    assert!(tables > 5, "{tables} tables");
    for piece in dom.split("<table").skip(1) {
        let table = piece.split("</table>").next().unwrap();
        let parts = ["<thead>", "<tbody>", "scope=\"col\"", "scope=\"row\""];
        parts
            .iter()
            .for_each(|part| assert!(table.contains(part), "{part}"));
    }
}

/// What is wrong, why, how sure, what it gained, what remains, what to measure next with the planned set-ups.
fn tells_the_story(dom: &str) {
    let order = [
        "What is wrong",
        "What each experiment says",
        "Why, how sure, and what naming it gained",
        "backlash at A6",
        "What remains",
        "are left closed in the simulation of workspace, hammer",
        "What to measure next",
        "Set-ups to measure next",
        "figure-next-setups",
        "Appendix",
    ];
    let story = &dom[dom.find("<main").unwrap()..];
    let places = order.map(|words| story.find(words).unwrap_or_else(|| panic!("no `{words}`")));
    assert!(places.is_sorted(), "{places:?}");
    for name in ["joint_damping", "tool-across", "--frf to use it"] {
        assert!(!story.contains(name), "{name}");
    }
}

/// On paper white, in grey, and in a narrow window.
fn is_drawn(profile: &Path, page: &Path) {
    let grey = with_head(
        page,
        "grey.html",
        "<style>html { filter: grayscale(1); }</style>",
    );
    let cases = [
        (page, "1200,3000"),
        (&grey, "1200,3000"),
        (page, "500,2000"),
    ];
    for (i, (page, window)) in cases.into_iter().enumerate() {
        let shot = page.with_file_name(format!("shot-{i}.png"));
        let to = format!("--screenshot={}", shot.display());
        let window_size = format!("--window-size={window}");
        browse(profile, page, &[&to, &window_size]).unwrap();
        let png = std::fs::read(shot).unwrap();
        let (width, height) = size(&png);
        assert_eq!(format!("{width},{height}"), window);
        assert!(png.len() > 30_000, "an empty page: {} bytes", png.len());
    }
}

/// How many pages a printer would need.
fn printed(profile: &Path, page: &Path) -> usize {
    let pdf = page.with_extension("pdf");
    let to = format!("--print-to-pdf={}", pdf.display());
    browse(profile, page, &[&to, "--no-pdf-header-footer"]).unwrap();
    let pdf = std::fs::read(pdf).unwrap();
    let key = b"/Type /Page\n";
    pdf.windows(key.len()).filter(|part| part == key).count()
}

/// The whole story stands before the appendix, on four sheets at most, and says when it was measured.
fn prints_a_summary_of_four_pages(profile: &Path, page: &Path) {
    let text = std::fs::read_to_string(page).unwrap();
    let (summary, rest) = text.split_once("<section class=\"appendix\"").unwrap();
    assert!(rest.contains("<details>") && !summary.contains("<details>"));
    assert!(summary.contains("date of the measurement not stated"));
    let cut = page.with_file_name("summary.html");
    let end = "<section class=\"appendix\"><h2>Appendix</h2></section></main></body></html>";
    std::fs::write(&cut, format!("{summary}{end}")).unwrap();
    let sheets = printed(profile, &cut);
    assert!(
        (3..=5).contains(&sheets),
        "{sheets} sheets with that of the appendix"
    );
}

/// What is folded away on the screen is open on paper.
fn prints_everything(profile: &Path, page: &Path) {
    let text = std::fs::read_to_string(page).unwrap();
    let folded = page.with_file_name("folded.html");
    std::fs::write(
        &folded,
        text.replace("details::details-content", "nothing-of-this"),
    )
    .unwrap();
    let (open, shut) = (printed(profile, page), printed(profile, &folded));
    assert!(open > shut + 10, "{open} pages, {shut} when folded");
}

/// Every fold, link and scrolling box takes the focus.
fn keyboard_reaches_everything(profile: &Path, page: &Path, dom: &str) {
    let script = "<script>const all = [...document.querySelectorAll('summary, a, .scroll')];\
        document.querySelectorAll('details').forEach(d => d.open = true);\
        const got = all.filter(e => { e.focus(); return document.activeElement === e; });\
        const folds = got.filter(e => e.tagName === 'SUMMARY').length;\
        document.title = `focus ${got.length} of ${all.length}, ${folds} folds`;</script>";
    let copy = with_head(page, "keyboard.html", script);
    let said = browse(profile, &copy, &["--dump-dom"]).unwrap();
    let said = String::from_utf8(said).unwrap();
    let title = said
        .split("<title>")
        .nth(1)
        .and_then(|t| t.split("</title>").next())
        .unwrap();
    let numbers: Vec<usize> = title
        .split(|c: char| !c.is_ascii_digit())
        .filter_map(|n| n.parse().ok())
        .collect();
    let folds = dom.matches("<details").count();
    assert!(folds > 10 && numbers.len() == 3, "{title}");
    assert_eq!((numbers[0], numbers[2]), (numbers[1], folds), "{title}");
}
