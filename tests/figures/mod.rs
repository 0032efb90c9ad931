//! The figures of a report: same bytes each time, well-formed, small, and never a panic.
//! They are left in the test's temporary folder, to be looked at.

mod gallery;

use gallery::{all, noise};
use ident::report::{folder, html, svg};
use ident::sheet::chart::{Axis, Chart, Mark, Panel, Series};
use ident::sheet::page::{Block, Page, Tone};
use ident::sheet::table::Table;

#[test]
fn same_chart_same_bytes_and_well_formed() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    for chart in all() {
        let figure = svg::ink(&chart).unwrap();
        assert_eq!(figure, svg::ink(&chart).unwrap());
        assert!(
            figure.len() < 400_000,
            "{} has {} bytes",
            chart.name,
            figure.len()
        );
        parse(&figure);
        std::fs::write(folder.join(format!("{}.svg", chart.name)), figure).unwrap();
    }
}

/// Reads a document to its end, and checks that all elements are closed.
fn parse(document: &str) {
    let mut reader = quick_xml::Reader::from_str(document);
    loop {
        match reader.read_event().expect("well-formed XML") {
            quick_xml::events::Event::Eof => break,
            quick_xml::events::Event::Start(tag) => {
                tag.attributes()
                    .for_each(|attribute| drop(attribute.expect("a sound attribute")));
            }
            _ => {}
        }
    }
}

#[test]
fn values_grow_upwards_and_to_the_right() {
    let panel = Panel::new(Axis::default(), Axis::default())
        .with(Series::line("up", vec![[0.0, 0.0], [1.0, 1.0]]));
    let figure = svg::ink(&Chart::new("up", "", "").with(panel)).unwrap();
    let line = figure
        .lines()
        .find(|line| line.contains("#004488"))
        .unwrap();
    let (_, points) = line.split_once("points=\"").unwrap();
    let numbers: Vec<f64> = points
        .split(['"', ' ', ','])
        .map_while(|n| n.parse().ok())
        .collect();
    assert!(numbers[2] > numbers[0] && numbers[3] < numbers[1], "{line}");
}

#[test]
fn nothing_to_draw_is_no_reason_to_panic() {
    let odd = [
        f64::NAN,
        f64::INFINITY,
        -f64::INFINITY,
        f64::MAX,
        -f64::MAX,
        1e-320,
        0.0,
        -0.0,
        1e300,
    ];
    let pairs = || {
        odd.iter()
            .flat_map(|x| odd.iter().map(|y| [*x, *y]))
            .collect::<Vec<_>>()
    };
    let marks = [
        Mark::Points,
        Mark::Line,
        Mark::Dashed,
        Mark::Dotted,
        Mark::Band,
        Mark::Bars,
    ];
    for points in [
        vec![],
        vec![[f64::NAN; 2]],
        vec![[1.0, 1.0]],
        vec![[0.0, 0.0]; 3],
        pairs(),
    ] {
        for (mark, log) in marks
            .into_iter()
            .flat_map(|mark| [(mark, false), (mark, true)])
        {
            let axis = || Axis {
                log,
                ..Axis::new("a", "m")
            };
            let ends = points.iter().map(|p| [p[1], p[0]]).collect();
            let series = Series::new("s", mark, points.clone());
            let panel = Panel::new(axis(), axis())
                .with(series.clone())
                .with(series.between(ends));
            let chart = Chart::new("", "", "")
                .with(panel.clone())
                .with(panel.over(["x", "y"]));
            let figure = svg::ink(&chart).unwrap();
            assert!(!figure.contains("NaN") && !figure.contains("inf"));
            parse(&figure);
        }
    }
    parse(&svg::ink(&Chart::default()).unwrap());
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn a_million_points_stay_small() {
    let wave = |i: usize| (i as f64 * 1e-4).sin() + 0.1 * noise(i);
    let in_time: Vec<[f64; 2]> = (0..1_000_000).map(|i| [i as f64, wave(i)]).collect();
    let loops: Vec<[f64; 2]> = (0..1_000_000)
        .map(|i| [wave(i + 15_000), wave(i)])
        .collect();
    let gaps = |(i, p): (usize, &[f64; 2])| if i % 2 == 0 { *p } else { [f64::NAN; 2] };
    let gaps = in_time.iter().enumerate().map(gaps).collect();
    let over = |x| Panel::new(x, Axis::new("Force", "N"));
    let panel = || over(Axis::new("Position", "m"));
    let chart = Chart::new("million", "A million points", "")
        .with(over(Axis::new("Time", "s")).with(Series::line("gaps", gaps)))
        .with(over(Axis::new("Time", "s")).with(Series::line("line", in_time.clone())))
        .with(panel().with(Series::points("cloud", loops.clone())))
        .with(panel().with(Series::line("loops", loops)));
    let figure = svg::ink(&chart).unwrap();
    assert!(figure.len() < 400_000, "{} bytes", figure.len());
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(folder.join("million.svg"), figure).unwrap();
}

#[test]
fn a_report_with_everything() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("report");
    let table = Table::new(
        "Stiffness of the drives",
        [
            "joint",
            "stiffness in N·m/rad",
            "backlash in µrad",
            "status",
        ],
    )
    .numeric([1, 2])
    .with(["A1", "(5.601 ± 0.012)e6", "31.0 ± 0.4", "identified"])
    .with(["A2", "(4.913 ± 0.020)e6", "–", "not-identifiable"])
    .noted("95 % intervals from 200 blocks.");
    let mut page = Page::new(
        "What the simulation of kr210 gets wrong",
        "measurements/kr210, 12 files",
    )
    .with(Block::verdict(
        Tone::Attention,
        "The drive of A6 has a backlash of 31 µrad that the model lacks.",
    ))
    .with(Block::verdict(
        Tone::Good,
        "With it the error on held-out cycles falls by 94.4 %.",
    ))
    .with(Block::verdict(
        Tone::Bad,
        "The lasers disagree by more than their noise.",
    ))
    .with(Block::verdict(
        Tone::Neutral,
        "Lever arm and stiffness cannot be told apart.",
    ))
    .with(Block::heading("What is wrong"))
    .with(Block::text(
        "The residual steps at zero load on both branches.",
    ));
    page.synthetic = true;
    page.blocks
        .extend(all().into_iter().take(2).map(Block::Chart));
    page.blocks.push(Block::heading("How sure"));
    page.blocks.push(Block::Table(table));
    page.blocks.push(Block::heading("What to measure next"));
    page.blocks.push(Block::details(
        "All figures",
        all().into_iter().skip(2).map(Block::Chart).collect(),
    ));
    let written = folder::write_as(&folder, "index.html", &page).unwrap();
    let index = std::fs::read(written.last().unwrap()).unwrap();
    assert_eq!(index, html::ink(&page).unwrap().as_bytes());
}
