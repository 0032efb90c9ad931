//! Text as other programs encode it: UTF-8, UTF-16 with its mark, Windows-1252.

use crate::ground::problem::{Outcome, Problem};

/// The encodings that a sidecar may name.
pub const ENCODINGS: &[&str] = &["utf-8", "utf-16", "windows-1252"];

/// What Windows-1252 has at 0x80 to 0x9f (Unicode consortium, CP1252.TXT); 0 where it has nothing.
const HIGH: [u32; 32] = [
    0x20AC, 0, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160, 0x2039,
    0x0152, 0, 0x017D, 0, 0, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014, 0x02DC,
    0x2122, 0x0161, 0x203A, 0x0153, 0, 0x017E, 0x0178,
];

/// The text of a file, and its encoding; `named` overrules what the bytes suggest.
///
/// # Errors
/// An encoding that is not known, bytes that it does not have, a spreadsheet or other binary file.
pub fn decoded(bytes: &[u8], named: Option<&str>) -> Outcome<(String, &'static str)> {
    let encoding = match named {
        Some(name) => known(name)?,
        None => guessed(bytes),
    };
    let refused = || {
        let remedy = format!(
            "name its `encoding` in the sidecar, one of {}",
            ENCODINGS.join(", ")
        );
        Problem::new(format!("is not {encoding} text"), remedy).at_line(1)
    };
    let text = match encoding {
        "utf-16" => utf16(bytes),
        "windows-1252" => windows(bytes),
        _ => String::from_utf8(bytes.to_vec()).ok(),
    };
    let text = text.filter(|t| !t.contains('\0')).ok_or_else(refused)?;
    Ok((text.trim_start_matches('\u{feff}').to_string(), encoding))
}

fn known(name: &str) -> Outcome<&'static str> {
    let lower = name.to_lowercase().replace('_', "-");
    let found = ENCODINGS
        .iter()
        .find(|e| **e == lower || e.replace("windows-", "cp") == lower);
    found.copied().ok_or_else(|| {
        let what = format!("the encoding `{name}` is not known");
        Problem::new(what, format!("write one of {}", ENCODINGS.join(", "))).in_column("encoding")
    })
}

fn guessed(bytes: &[u8]) -> &'static str {
    match bytes {
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => "utf-16",
        _ if std::str::from_utf8(bytes).is_ok() => "utf-8",
        _ => "windows-1252",
    }
}

fn utf16(bytes: &[u8]) -> Option<String> {
    let big = bytes.starts_with(&[0xFE, 0xFF]);
    let unit = |pair: &[u8]| match big {
        true => u16::from_be_bytes([pair[0], pair[1]]),
        false => u16::from_le_bytes([pair[0], pair[1]]),
    };
    let units: Vec<u16> = bytes.chunks_exact(2).map(unit).collect();
    String::from_utf16(&units).ok()
}

fn windows(bytes: &[u8]) -> Option<String> {
    let letter = |byte: &u8| match byte {
        0x80..=0x9F => char::from_u32(HIGH[usize::from(byte - 0x80)]).filter(|c| *c != '\0'),
        other => Some(char::from(*other)),
    };
    bytes.iter().map(letter).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn german_spreadsheets_are_read_in_each_encoding() {
        let text = "Weg in µm;Größe\n";
        let units: Vec<u8> = [0xFEFF]
            .into_iter()
            .chain(text.encode_utf16())
            .flat_map(u16::to_le_bytes)
            .collect();
        let windows: Vec<u8> = text.chars().map(|c| c as u8).collect();
        for (bytes, encoding) in [
            (text.as_bytes().to_vec(), "utf-8"),
            (units, "utf-16"),
            (windows, "windows-1252"),
        ] {
            assert_eq!(decoded(&bytes, None).unwrap(), (text.to_string(), encoding));
        }
        assert!(decoded(b"abc", Some("ebcdic")).is_err());
    }
}
