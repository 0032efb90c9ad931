//! What the readers of tool paths understand: the same part in every language, the traps of each
//! dialect, and refusals that name line and remedy.

use ident::ground::problem::Problem;
use ident::ground::vector::{V3, norm, sub};
use ident::measurement::toolpath::{Arc, Move, Orientation, Shape, Toolpath};
use std::f64::consts::{PI, TAU};
use std::path::Path;

fn read(name: &str, text: &str) -> Result<Toolpath, Problem> {
    Toolpath::of_bytes(Path::new(name), text.as_bytes())
}

fn understood(name: &str, text: &str) -> Toolpath {
    read(name, text).unwrap_or_else(|problem| panic!("{problem}"))
}

fn mm(point: V3) -> V3 {
    point.map(|x| x * 1e3)
}

fn close(a: V3, b: V3) -> bool {
    norm(sub(a, b)) < 1e-9
}

fn places(path: &Toolpath) -> Vec<V3> {
    path.moves.iter().map(|m| mm(m.to)).collect()
}

fn arc(m: &Move) -> Arc {
    match m.shape {
        Shape::Arc(arc) => arc,
        Shape::Line => panic!("line {} is no arc", m.line),
    }
}

fn count(path: &Toolpath, what: &str) -> usize {
    let found = path.passed_over.iter().find(|p| p.what == what);
    found.map_or(0, |p| p.count)
}

/// Approach, quarter circle about (10, 10), line: the same in every language.
const SAME: [(&str, &str); 3] = [
    (
        "a.cls",
        "FROM/0.,0.,5.,0.,0.,1.\nFEDRAT/1200.,MMPM\nRAPID\nGOTO/10.,0.,5.\nGOTO/10.,0.,-1.\n\
         CIRCLE/10.,10.,-1.,0.,0.,1.,10.\nGOTO/20.,10.,-1.\nGOTO/20.,30.,-1.\n",
    ),
    (
        "a.nc",
        "G21 G90 G17\nG0 X0 Y0 Z5\nG0 X10\nG1 Z-1 F1200\nG3 X20 Y10 I0 J10\nG1 Y30\nM30\n",
    ),
    (
        "a.src",
        "DEF a()\n$VEL.CP=0.02\nLIN {X 0,Y 0,Z 5,A 0,B 0,C 0}\nLIN {X 10}\nLIN {Z -1}\n\
         CIRC {X 17.0710678118655,Y 2.92893218813452},{X 20,Y 10}\nLIN {Y 30}\nEND\n",
    ),
];

#[test]
fn every_language_tells_the_same_path() {
    let wanted = [
        [0.0, 0.0, 5.0],
        [10.0, 0.0, 5.0],
        [10.0, 0.0, -1.0],
        [20.0, 10.0, -1.0],
        [20.0, 30.0, -1.0],
    ];
    for (name, text) in SAME {
        let path = understood(name, text);
        let found = places(&path);
        assert_eq!(found.len(), wanted.len(), "{name}");
        assert!(
            found.iter().zip(wanted).all(|(a, b)| close(*a, b)),
            "{name}: {found:?}"
        );
        let quarter = arc(&path.moves[3]);
        assert!(
            close(mm(quarter.centre), [10.0, 10.0, -1.0]),
            "{name}: {quarter:?}"
        );
        assert!(
            (quarter.angle - 0.5 * PI).abs() < 1e-9 && quarter.axis[2] > 0.999_999,
            "{name}"
        );
        assert!((path.moves[4].feed.unwrap() - 0.02).abs() < 1e-15, "{name}");
        assert_eq!((path.sha256.len(), path.synthetic), (64, false));
    }
}

#[test]
fn points_are_read_with_axes_angles_feeds_and_stations() {
    let text = "# kind = \"path\"\n# synthetic = true\nx_mm,y_mm,z_mm,i,j,k,feed_mm_min,rapid,s_mm\n\
                0,0,0,0,0,1,,,0\n10,0,0,,,,600,0,10\n10,5,0,0.6,0,0.8,,1,15\n";
    let path = understood("a.csv", text);
    assert!(path.synthetic && path.format == "points");
    assert_eq!(
        path.moves[1].orientation,
        Orientation::Axis([0.0, 0.0, 1.0])
    );
    assert!((path.moves[1].feed.unwrap() - 0.01).abs() < 1e-15 && !path.moves[1].rapid);
    assert_eq!(
        path.moves[2].orientation,
        Orientation::Axis([0.6, 0.0, 0.8])
    );
    assert!(path.moves[2].rapid && path.moves[2].line == 6);
    assert!((path.moves[2].station.unwrap() - 0.015).abs() < 1e-15);
    let angles = "# kind = \"path\"\nx_mm;y_mm;z_mm;a_deg;b_deg;c_deg\n0;0;0;90;0;0\n1,5;0;0;;;\n";
    let path = understood("a.csv", angles);
    let Orientation::Full(r) = path.moves[1].orientation else {
        panic!()
    };
    assert!(
        (r[1][0] - 1.0).abs() < 1e-15 && r[0][0].abs() < 1e-15,
        "{r:?}"
    );
    assert!(close(mm(path.moves[1].to), [1.5, 0.0, 0.0]));
}

#[test]
fn a_nurbs_is_read_with_its_knots_and_weights() {
    let text = "# kind = \"path\"\n# curve = \"nurbs\"\n# degree = 2\n# knots = [0, 0, 0, 1, 1, 1]\n\
                x_mm,y_mm,z_mm,weight\n1,0,0,1\n1,1,0,0.7\n0,1,0,1\n";
    let path = understood("a.csv", text);
    let curve = path.curve.unwrap();
    assert!(path.moves.is_empty() && curve.degree == 2 && curve.knots.len() == 6);
    assert_eq!((curve.weights[1], curve.lines[2]), (0.7, 8));
    assert!(close(mm(curve.points[1]), [1.0, 1.0, 0.0]));
}

#[test]
fn apt_circles_are_right_handed_and_hold_for_the_next_goto() {
    let text = "UNITS/MM\nGOTO/10,0,0\nCIRCLE/0,0,0,0,0,-1,10\nGOTO/0,10,0\nGOTO/0,30,0\n";
    let path = understood("a.cls", text);
    let round = arc(&path.moves[1]);
    assert!((round.angle - 1.5 * PI).abs() < 1e-12 && round.axis[2] == -1.0);
    assert_eq!(path.moves[2].shape, Shape::Line);
    let full = "GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/10,0,0\nGOTO/10,0,5\n";
    let path = understood("a.cls", full);
    assert!((arc(&path.moves[1]).angle - TAU).abs() < 1e-15);
    assert_eq!(path.moves[2].shape, Shape::Line, "a retract is no helix");
}

#[test]
fn several_gotos_on_one_circle_are_arcs_of_it() {
    let mut text =
        String::from("GOTO / 10.0, 0.0, 0.0\nCIRCLE / 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 10.0\n");
    for i in 1..=12 {
        let t = f64::from(i) * TAU / 12.0;
        text += &format!("GOTO / {:.6}, {:.6}, 0.0\n", 10.0 * t.cos(), 10.0 * t.sin());
    }
    text += "GOTO / 0.0, 10.0, 0.0\n";
    let path = understood("a.ncl", &text);
    let swept: f64 = path.moves[1..13].iter().map(|m| arc(m).angle).sum();
    assert!((swept - TAU).abs() < 1e-6, "{swept}");
    assert_eq!(path.moves[13].shape, Shape::Line, "the circle is full");
}

#[test]
fn tangent_circles_of_catia_begin_in_the_direction_of_indirv() {
    let text = "GOTO/ 10.0, 0.0, 0.0\nINDIRV/ 0.0, -1.0, 0.0\nTLON,GOFWD/ (CIRCLE/ 0.0, 0.0, 0.0,$\n\
                10.0),ON,(LINE/ 0.0, 0.0, 0.0,$\n 0.0, 10.0, 0.0)\nGOTO/ 0.0, 20.0, 0.0\n";
    let path = understood("a.aptsource", text);
    let round = arc(&path.moves[1]);
    assert!(
        (round.angle - 1.5 * PI).abs() < 1e-12 && round.axis[2] < -0.999,
        "{round:?}"
    );
    assert!(close(mm(path.moves[1].to), [0.0, 10.0, 0.0]));
}

#[test]
fn apt_units_feeds_and_speeds_become_si() {
    let text = "UNITS/INCHES\nSPINDL/600,RPM,CCLW\nFROM/0,0,0\nFEDRAT/IPR,0.01\nGOTO/1,0,0\n\
                FEDRAT/60.,IPM\nGOTO/2,0,0\nFEDRAT/10\nGOTO/3,0,0\nSPINDL/OFF\nGOTO/3,1,0\n";
    let path = understood("a.apt", text);
    assert!(close(mm(path.moves[1].to), [25.4, 0.0, 0.0]));
    let feeds: Vec<f64> = path.moves[1..4].iter().map(|m| m.feed.unwrap()).collect();
    let wanted = [0.01 * 0.0254 * 10.0, 0.0254, 0.0254 / 6.0];
    assert!(
        feeds.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-15),
        "{feeds:?}"
    );
    assert!((path.moves[1].spindle.unwrap() + 10.0 * TAU).abs() < 1e-12);
    assert_eq!(path.moves[4].spindle, Some(0.0));
}

#[test]
fn apt_words_without_effect_are_counted_and_rapid_holds_once() {
    let text = "TOOL PATH/PART,TOOL,MILL16\nTLDATA/MILL,16.0,0.0,75.0,0.0,0.0\nMSYS/0,0,0,1,0,0,0,1,0\n\
                $$ a comment\nPAINT/PATH\nLOADTL/1\nCOOLNT/ON\nRAPID\nGOTO/0,0,10,0,0,1\nPAINT/SPEED,10\n\
                RAPID\nGOTO/5,0,10\nGOTO/5,0,$ goes on\n 0\nPPRINT costs 5$\nEND-OF-PATH\nFINI\nGOTO/9,9,9\n";
    let path = understood("a.cls", text);
    let rapid: Vec<bool> = path.moves.iter().map(|m| m.rapid).collect();
    assert_eq!(rapid, [false, true, false]);
    assert!(close(mm(path.moves[2].to), [5.0, 0.0, 0.0]) && path.moves[2].line == 13);
    assert_eq!(
        (
            count(&path, "PAINT"),
            count(&path, "COOLNT"),
            count(&path, "MSYS")
        ),
        (2, 1, 1)
    );
}

#[test]
fn g_code_arcs_in_every_plane_and_by_radius() {
    let start = "G21 G90\nG0 X10 Y0 Z0\n";
    let case = |block: &str| arc(&understood("a.nc", &format!("{start}{block} F100\n")).moves[1]);
    let short = case("G2 X0 Y10 R10");
    assert!(
        (short.angle - 0.5 * PI).abs() < 1e-9 && short.axis[2] == -1.0,
        "{short:?}"
    );
    assert!(close(mm(short.centre), [10.0, 10.0, 0.0]));
    let long = case("G3 X0 Y10 R-10");
    assert!((long.angle - 1.5 * PI).abs() < 1e-9 && close(mm(long.centre), [10.0, 10.0, 0.0]));
    let full = case("G2 I-10");
    assert!((full.angle - TAU).abs() < 1e-12);
    let helix = case("G3 X10 Y0 Z-3 I-10 P3");
    assert!((helix.angle - 3.0 * TAU).abs() < 1e-12);
    let zx = case("G18 G3 X0 Z-10 I-10");
    assert!(
        (zx.angle - 0.5 * PI).abs() < 1e-12 && zx.axis == [0.0, 1.0, 0.0],
        "{zx:?}"
    );
    let yz = case("G19 G2 Y10 Z10 J10 K0");
    assert!(
        (yz.angle - 0.5 * PI).abs() < 1e-12 && yz.axis == [-1.0, 0.0, 0.0],
        "{yz:?}"
    );
    let absolute = case("G90.1 G3 X0 Y10 I0 J0");
    assert!(close(mm(absolute.centre), [0.0; 3]) && (absolute.angle - 0.5 * PI).abs() < 1e-12);
}

#[test]
fn g_code_begins_once_all_three_coordinates_are_known() {
    let text = "%\nO1000 (PART)\nN10 G21 G90 G17 G40 G49 G80\nN20 G28 G91 Z0\nN30 G90 G54\nT1 M6\n\
                N40 S10000 M3\nN50 G0 Z50\nN60 X0 Y0 ; go\nN70 g1 z-2. f1000\nG91\nX10\nG20 X1\nM30\nX99\n%\n";
    let path = understood("a.nc", text);
    let wanted = [
        [0.0, 0.0, 50.0],
        [0.0, 0.0, -2.0],
        [10.0, 0.0, -2.0],
        [35.4, 0.0, -2.0],
    ];
    assert!(
        places(&path).iter().zip(wanted).all(|(a, b)| close(*a, b)),
        "{:?}",
        places(&path)
    );
    assert_eq!(path.moves.len(), 4);
    assert!((path.moves[1].feed.unwrap() - 1.0 / 60.0).abs() < 1e-15);
    assert!((path.moves[1].spindle.unwrap() - 10_000.0 / 60.0 * TAU).abs() < 1e-9);
    assert_eq!(
        (count(&path, "G28"), count(&path, "M6"), count(&path, "O")),
        (1, 1, 1)
    );
}

const KRL: &str = "&ACCESS RVP\nDEF part( )\n;FOLD INI\nDECL E6POS XP2\nBAS (#INITMOV,0)\n;ENDFOLD\n\
$BASE={X 1500,Y 0,Z 800,A 0,B 0,C 0}\n$TOOL={X 0,Y 0,Z 250,A 0,B 0,C 0}\n$VEL.CP=0.05\n$APO.CDIS=2\n\
PTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}\nPTP XHOME\nLIN XP1 C_DIS\nXP2={X 10,Y 0,Z 0,A 0,B 90,C 0}\n\
LIN XP2 C_DIS C_DIS\nLIN_REL {X 5}\nLIN_REL {Z 5} C_DIS #TOOL\n\
SLIN {X 0,Y 0,Z 0} WITH $VEL.CP=0.1, $APO.CDIS=7 C_SPL\nCIRC {X 10,Y 10},{X 20,Y 0}, CA -90\nEND\n";

#[test]
fn krl_runs_lines_circles_frames_and_what_holds_for_one_motion() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("part.src");
    std::fs::write(&file, KRL).unwrap();
    let data = "DEFDAT part\nDECL E6POS XP1={X 0.0,Y 0.0,Z 0.0,A 0.0,B 90.0,C 0.0,S 2,T 35,E1 0.0}\nENDDAT\n";
    std::fs::write(folder.path().join("part.dat"), data).unwrap();
    let path = Toolpath::read(&file).unwrap();
    let wanted = [
        [0.0; 3],
        [10.0, 0.0, 0.0],
        [15.0, 0.0, 0.0],
        [20.0, 0.0, 0.0],
        [0.0; 3],
    ];
    assert!(
        places(&path).iter().zip(wanted).all(|(a, b)| close(*a, b)),
        "{:?}",
        places(&path)
    );
    let blends: Vec<Option<f64>> = path.moves.iter().map(|m| m.blend).collect();
    let expected = [0.002, 0.002, 0.0, 0.002, 0.007, 0.0].map(Some);
    assert_eq!(blends, expected);
    let feeds: Vec<Option<f64>> = path.moves[1..].iter().map(|m| m.feed).collect();
    assert_eq!(feeds, [0.05, 0.05, 0.05, 0.1, 0.05].map(Some));
    let turned = arc(&path.moves[5]);
    assert!(
        (turned.angle - 0.5 * PI).abs() < 1e-12 && turned.axis[2] > 0.999,
        "{turned:?}"
    );
    assert!(
        close(mm(path.moves[5].to), [10.0, -10.0, 0.0]),
        "{:?}",
        mm(path.moves[5].to)
    );
    assert_eq!(path.base.unwrap().point, [1.5, 0.0, 0.8]);
    assert!((path.tool.unwrap().point[2] - 0.25).abs() < 1e-15);
    assert_eq!((count(&path, "PTP"), path.inputs.len()), (2, 1));
}

#[test]
fn krl_follows_programs_in_the_file_and_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let main = "DEF main()\n$VEL.CP=0.1\nLIN {X 0,Y 0,Z 0,A 0,B 0,C 0}\nhere()\nbeside()\nEND\nDEF here()\nLIN {X 1}\nEND\n";
    std::fs::write(folder.path().join("main.src"), main).unwrap();
    std::fs::write(
        folder.path().join("beside.src"),
        "DEF beside()\nLIN {X 2}\nEND\n",
    )
    .unwrap();
    let path = Toolpath::read(&folder.path().join("main.src")).unwrap();
    assert_eq!(
        places(&path).iter().map(|p| p[0]).collect::<Vec<_>>(),
        [0.0, 1.0, 2.0]
    );
    assert!(path.inputs[0].0.ends_with("beside.src"));
    std::fs::write(
        folder.path().join("beside.src"),
        "DEF beside()\nbeside()\nEND\n",
    )
    .unwrap();
    let problem = Toolpath::read(&folder.path().join("main.src")).unwrap_err();
    assert!(
        problem.what.contains("without end") && problem.line == Some(2),
        "{problem}"
    );
}

/// A file name, its text, the line of the refusal, and words of the message.
const REFUSALS: &[(&str, &str, usize, &str)] = &[
    (
        "a.csv",
        "# kind = \"path\"\nx_mm,y_mm\n0,0\n1,1\n",
        2,
        "columns x, y, z",
    ),
    (
        "a.csv",
        "# kind = \"path\"\n# knot = [1]\nx_mm,y_mm,z_mm\n0,0,0\n",
        2,
        "`knots`",
    ),
    (
        "a.csv",
        "# kind = \"path\"\nx_mm,y_mm,z_mm\n0,0,0\n1,,1\n",
        4,
        "coordinate",
    ),
    (
        "a.csv",
        "# kind = \"path\"\nx_mm,y_mm,z_mm,i,j,k\n0,0,0,0,0,1\n1,0,0,0,0,2\n",
        4,
        "length 2",
    ),
    (
        "a.csv",
        "# kind = \"path\"\nx_mm,y_mm,z_mm,i,j,k\n0,0,0,,,\n",
        3,
        "i, j, k",
    ),
    (
        "a.csv",
        "# kind = \"path\"\nx_mm,y_mm,z_mm,force_N\n0,0,0,1\n",
        2,
        "force_N",
    ),
    (
        "a.csv",
        "# kind = \"path\"\nx_mm,y_mm,z_mm,rapid\n0,0,0,2\n",
        3,
        "neither 0 nor 1",
    ),
    (
        "a.csv",
        "# kind = \"path\"\nx_mm,y_mm,z_mm,feed_mm_min\n0,0,0,-2\n",
        3,
        "above zero",
    ),
    (
        "a.csv",
        "# kind = \"path\"\nx_mm,y_mm,z_mm\n0,0,nan\n",
        3,
        "finite",
    ),
    (
        "a.csv",
        "# kind = \"path\"\nx_mm,y_mm,z_mm\n0,0,0\n",
        1,
        "two points",
    ),
    (
        "a.csv",
        "# kind = \"path\"\n# curve = \"nurbs\"\n# degree = 2\n# knots = [0,0,0,1,1]\nx_mm,y_mm,z_mm\n0,0,0\n1,0,0\n1,1,0\n",
        4,
        "instead of 6",
    ),
    (
        "a.csv",
        "# kind = \"path\"\n# curve = \"nurbs\"\n# degree = 1\n# knots = [0,2,1,3]\nx_mm,y_mm,z_mm\n0,0,0\n1,0,0\n",
        4,
        "decreases",
    ),
    (
        "a.csv",
        "# kind = \"path\"\n# curve = \"nurbs\"\n# degree = 3\n# knots = [0,1]\nx_mm,y_mm,z_mm\n0,0,0\n1,0,0\n",
        3,
        "degree",
    ),
    ("a.cls", "GOTO/0,0,0\nGOTO/P1\n", 2, "`P1` is not a number"),
    ("a.cls", "GOTO/0,0,0\nGOTO/1,2\n", 2, "2 numbers"),
    ("a.cls", "GOTO/0,0,0,0,0,3\n", 1, "length 3"),
    (
        "a.cls",
        "GOTO/0,0,0\nCYCLE/DRILL,10,MMPM,100\nGOTO/1,0,0\n",
        2,
        "`CYCLE` would change",
    ),
    (
        "a.cls",
        "GOTO/0,0,0\nCUTCOM/LEFT\nGOTO/1,0,0\n",
        2,
        "CUTCOM",
    ),
    ("a.cls", "GOTO/0,0,0\nTRANS/1,0,0\nGOTO/1,0,0\n", 2, "TRANS"),
    (
        "a.cls",
        "GOTO/0,0,0\nWANDER/1,0,0\nGOTO/1,0,0\n",
        2,
        "WANDER",
    ),
    (
        "a.cls",
        "GOTO/0,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/10,0,0\n",
        3,
        "from its centre",
    ),
    (
        "a.cls",
        "GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,11,0\n",
        3,
        "ends of the arc",
    ),
    (
        "a.cls",
        "GOTO/10,0,0\nCIRCLE/0,0,0,0,1\nGOTO/0,10,0\n",
        2,
        "radius",
    ),
    (
        "a.cls",
        "GOTO/10,0,0\nTLON,GOFWD/(CIRCLE/0,0,0,10),ON,(LINE/0,0,0,0,10,0)\n",
        2,
        "INDIRV",
    ),
    ("a.cls", "GOTO/0,0,0\nFEDRAT/1,FURLONG\n", 2, "unit of feed"),
    ("a.cls", "GOTO/0,0,0\nFEDRAT/0.1,MMPR\n", 2, "SPINDL"),
    ("a.cls", "GOTO/0,0,0\nFEDRAT/0\n", 2, "above zero"),
    ("a.cls", "UNITS/PARSEC\n", 1, "UNITS/MM"),
    ("a.cls", "GOTO/0,0,0\nUNITS/INCHES\n", 2, "unit changes"),
    (
        "a.cls",
        "GOTO/0,0,0\nGOTO/1,0,0\nFROM/5,5,5\n",
        3,
        "RAPID and GOTO",
    ),
    ("a.cls", "GOTO/0,0,1e9\n", 1, "km away"),
    (
        "a.cls",
        "MSYS/0,0,0\nGOTO/0,0,0\nMSYS/5,0,0\n",
        3,
        "coordinate system",
    ),
    ("a.nc", "G0 X0 Y0 Z0\nG1 X1 A5\n", 2, "linear axes"),
    ("a.nc", "G0 X0 Y0 Z0\nG41 D1\n", 2, "`G41`"),
    ("a.nc", "G0 X0 Y0 Z0\nG81 Z-5 R2\n", 2, "`G81`"),
    ("a.nc", "G0 X0 Y0 Z0\nM98 P100\n", 2, "`M98`"),
    ("a.nc", "G0 X0 Y0 Z0\nG1 X#1\n", 2, "parameters"),
    ("a.nc", "G0 X0 Y0 Z0\n#1=5\n", 2, "parameters"),
    ("a.nc", "G0 X0 Y0 Z0\nG1 X1 X2\n", 2, "twice"),
    ("a.nc", "G0 X0 Y0 Z0\nG1 G2 X1\n", 2, "two motions"),
    ("a.nc", "X0 Y0 Z0\n", 1, "G0, G1"),
    ("a.nc", "G91\nG0 X1\n", 2, "G90"),
    ("a.nc", "G0 X0 Y0\nG2 X1 I1\n", 2, "not known"),
    ("a.nc", "G0 X0 Y0 Z0\nG2 X1 Y1\n", 2, "centre and radius"),
    ("a.nc", "G0 X0 Y0 Z0\nG2 X10 R1\n", 2, "no arc of radius"),
    ("a.nc", "G0 X0 Y0 Z0\nG2 X10 I4\n", 2, "ends of the arc"),
    ("a.nc", "G0 X0 Y0 Z0\nG1 X10 R1\n", 2, "straight motion"),
    ("a.nc", "G0 X0 Y0 Z0\nG54\nG55\n", 3, "coordinate system"),
    ("a.nc", "G0 X0 Y0 Z0\n/G1 X1\n", 2, "operator"),
    ("a.nc", "G0 X0 Y0 Z0\nG1 X1 F0\n", 2, "above zero"),
    ("a.nc", "G0 X0 Y0 Z0\nG95 G1 X1 F0.1\n", 2, "revolution"),
    ("a.nc", "G0 X0 Y0 Z0\nG1 X\n", 2, "no number"),
    (
        "a.src",
        "DEF a()\nLIN {X 0,Y 0,Z 0}\nEND\n",
        2,
        "A is not stated",
    ),
    (
        "a.src",
        "DEF a()\nLIN XP9\nEND\n",
        2,
        "`XP9` is not defined",
    ),
    (
        "a.src",
        "DEF a()\nPTP {X 0,Y 0,Z 0,A 0,B 0,C 0}\nEND\n",
        2,
        "no path",
    ),
    (
        "a.src",
        "DEF a()\nFOR i=1 TO 5\nENDFOR\nEND\n",
        2,
        "conditions, loops",
    ),
    (
        "a.src",
        "DEF a()\nIF $IN[1] THEN\nEND\n",
        2,
        "conditions, loops",
    ),
    ("a.src", "DEF a()\nagain:\nEND\n", 2, "jumps"),
    (
        "a.src",
        "DEF a()\nLIN {X 0,Y 0,Z 0,A 0,B 0,C 0} C_VEL\nEND\n",
        2,
        "C_DIS",
    ),
    (
        "a.src",
        "DEF a()\nLIN {X 0,Y 0,Z 0,A 0,B 0,C 0}:{X 1}\nEND\n",
        2,
        "`:`",
    ),
    (
        "a.src",
        "DEF a()\nLIN {X 0,Y 0,Z 0,A 0,B 0,C 0}\nCIRC {X 1},{X 2}\nEND\n",
        3,
        "no circle",
    ),
    (
        "a.src",
        "DEF a()\nLIN {X 0,Y 0,Z 0,A 0,B 0,C 0}\n$BASE={X 1}\nEND\n",
        3,
        "$BASE changes",
    ),
    (
        "a.src",
        "DEF a()\nLIN {X 0,Y 0,Z 0,A 0,B 0,C 0,E1 5}\nEND\n",
        2,
        "external axis",
    ),
    ("a.src", "DEF a()\n$VEL.CP=fast\nEND\n", 2, "no number"),
    ("a.src", "DEF a()\n$VEL.CP=0\nEND\n", 2, "above zero"),
    ("a.src", "DEF a()\n$IPO_MODE=#TCP\nEND\n", 2, "fixed tool"),
    (
        "a.src",
        "DEF a()\nLIN {X 0,Y 0,Z 0,A 0,B 0,C 0}\nunknown()\nEND\n",
        3,
        "`unknown`",
    ),
    (
        "a.src",
        "DEF a()\nLIN {X 0,Y 0,Z 0,A 0,B 0,C 0}\nPTP {A1 0}\nLIN {X 5}\nEND\n",
        4,
        "not known",
    ),
    (
        "a.nc",
        "G21 G90\nG1 X0 Y0 Z0 F100\nG1 X5 (to the end; Y3\n",
        3,
        "not closed",
    ),
    (
        "a.src",
        "DEF a()\nWIGGLE 5\nEND\n",
        2,
        "`WIGGLE` is not understood",
    ),
    (
        "a.src",
        "DEF a()\nLIN {X 0,Y 0,Z 0,A 0,B 0,C 0}\nLIN_REL {B 5}\nEND\n",
        3,
        "LIN",
    ),
];

#[test]
fn every_refusal_names_file_line_and_remedy() {
    for (name, text, line, words) in REFUSALS {
        let problem = match read(name, text) {
            Ok(path) => panic!("{name} {text:?} was read: {:?}", path.moves),
            Err(problem) => problem,
        };
        assert_eq!(problem.file.as_deref(), Some(Path::new(name)));
        assert_eq!(problem.line, Some(*line), "{text:?}: {problem}");
        assert!(problem.to_string().contains(words), "{text:?}: {problem}");
        assert!(!problem.remedy.is_empty());
    }
}

#[test]
fn a_format_is_recognised_by_its_first_lines_and_binary_files_are_refused() {
    for (name, text) in SAME {
        let format = understood(name, text).format;
        assert_eq!(understood("part.txt", text).format, format);
    }
    assert!(
        read("a.txt", "hello\n")
            .unwrap_err()
            .remedy
            .contains(".cls")
    );
    for name in ["a.cls", "a.nc", "a.src"] {
        let problem = Toolpath::of_bytes(Path::new(name), b"G0 X0\n\0\0").unwrap_err();
        assert_eq!(
            (problem.line, problem.what.as_str()),
            (Some(2), "is a binary file")
        );
    }
    let latin = b"PPRINT F\xfcr die Probe\nGOTO/0,0,0\nGOTO/1,0,0\n";
    assert_eq!(
        Toolpath::of_bytes(Path::new("a.cls"), latin)
            .unwrap()
            .moves
            .len(),
        2
    );
}

#[test]
#[ignore = "takes long: .ci/thorough runs it"]
fn ten_megabytes_are_read_in_seconds() {
    let start = std::time::Instant::now();
    let many = 10_000_000 / 30;
    let lines = |f: &dyn Fn(usize) -> String| (0..many).map(f).collect::<String>();
    let files = [
        (
            "a.cls",
            lines(&|i| format!("GOTO/{}.125,{}.5,-1.000\n", i % 1000, i % 777)),
        ),
        (
            "a.nc",
            "G1 X0 Y0 Z0\n".to_string()
                + &lines(&|i| format!("N{i} G1 X{}.125 Y{}.5\n", i % 1000, i % 777)),
        ),
        (
            "a.src",
            "DEF a()\nLIN {X 0,Y 0,Z 0,A 0,B 0,C 0}\n".to_string()
                + &lines(&|i| format!("LIN {{X {}.125,Y {}.5}} C_DIS\n", i % 1000, i % 777)),
        ),
        (
            "a.csv",
            "# kind = \"path\"\nx_mm,y_mm,z_mm\n".to_string()
                + &lines(&|i| format!("{}.125,{}.5,-1\n", i % 1000, i % 777)),
        ),
    ];
    for (name, text) in files {
        assert!(understood(name, &text).moves.len() >= many, "{name}");
    }
    for wild in [
        "(",
        "$\n",
        "X",
        "{",
        "/",
        "G1 ",
        "LIN {",
        "DEF a()\n",
        "A(",
        "\"",
        "\r",
        "9",
        "GOTO/1,",
    ] {
        let text = wild.repeat(3_000_000 / wild.len());
        for name in ["a.cls", "a.nc", "a.src", "a.csv"] {
            drop(read(name, &text));
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    assert!(seconds < 60.0, "{seconds} s");
}
