//! The vocabulary: what moves the tool, what does not, and what would and is not understood.

use super::statement::Statement;

/// What a statement does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Goto,
    From,
    Home,
    Delta,
    Rapid,
    Feed,
    Spindle,
    Circle,
    Direction,
    Tangent,
    Units,
    Axis,
    Frame,
    End,
    PassedOver,
    Refused,
}

const WORDS: &[(&str, Kind)] = &[
    ("GOTO", Kind::Goto),
    ("FROM", Kind::From),
    ("GOHOME", Kind::Home),
    ("GODLTA", Kind::Delta),
    ("RAPID", Kind::Rapid),
    ("FEDRAT", Kind::Feed),
    ("SPINDL", Kind::Spindle),
    ("CIRCLE", Kind::Circle),
    ("INDIRV", Kind::Direction),
    ("TLON,GOFWD", Kind::Tangent),
    ("UNITS", Kind::Units),
    ("TLAXIS", Kind::Axis),
    ("MSYS", Kind::Frame),
    ("FINI", Kind::End),
];

/// Words that would change the path.
const MOTION: &[&str] = &[
    "GO", "GOFWD", "GOBACK", "GOLFT", "GORGT", "GOUP", "GODOWN", "TLON", "TLLFT", "TLRGT",
    "INDIRP", "PSIS", "OFFSET", "POCKET", "PTONLY", "THREAD", "ARCSLP", "SPLINE", "NURBS", "POLAR",
    "PROFIL", "TRANS", "TRACUT", "ORIGIN", "COPY", "INDEX", "SCALE", "MIRROR", "REFSYS", "MATRIX",
    "ROTABL", "ROTATE", "ROTHED", "CALL", "MACRO", "TERMAC", "LOOPST", "LOOPND", "IF", "JUMPTO",
    "DO", "CLDIST", "LEADIN", "SURFAC", "SCURV", "MOVETO", "MOVARC", "INVERS", "REVERS",
];

/// Words that change the path unless they are switched off.
const SWITCHES: &[&str] = &["CYCLE", "CUTCOM", "TOLCOMP", "COORDFLOW"];

/// Words that carry numbers and do not move the tool.
const HARMLESS: &[&str] = &[
    "TLDATA",
    "CUTTER",
    "TOOL PATH",
    "PAINT",
    "LOADTL",
    "LOAD",
    "TOOLNO",
    "SELECT",
    "SELCTL",
    "MULTAX",
    "INTOL",
    "OUTTOL",
    "TOLER",
    "CLEARP",
    "CLRSRF",
    "DELAY",
    "DWELL",
    "SEQNO",
    "STOCK",
    "MACHIN",
    "TOOL",
    "AUXFUN",
    "PREFUN",
    "COOLNT",
    "LIMIT",
    "TMARK",
    "POSTN",
    "MODE",
    "STAN",
    "RETRCT",
];

/// Numbers that make an unknown word look like a position.
const POSITION: usize = 3;

/// What a statement does.
pub(super) fn kind_of(statement: &Statement) -> Kind {
    let word = statement.word.replace(' ', "");
    let plain = statement.word.as_str();
    if let Some(found) = WORDS.iter().find(|(known, _)| *known == word) {
        return found.1;
    }
    let head = word.split(',').next().unwrap_or_default();
    let switched = SWITCHES.contains(&head);
    let moves = MOTION.contains(&head) || (switched && !statement.says("OFF"));
    let harmless = HARMLESS.contains(&plain) || plain.contains('=');
    match moves || (!harmless && !switched && statement.count_numbers() >= POSITION) {
        true => Kind::Refused,
        false => Kind::PassedOver,
    }
}
