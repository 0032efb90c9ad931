//! Writes universal files.

use super::UniversalFile;
use super::axis::Axis;
use super::function::{Abscissa, Dof, Function, Values};
use super::header::Header;
use super::units::Units;

/// How the values of data set 58 are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Encoding {
    /// 58: text of 13 digits for 8-byte values.
    Ascii,
    /// 58b: IEEE 754, little endian.
    #[default]
    Binary,
}

const MARKER: &str = "    -1\n";

/// The bytes of a universal file: 151 and 164 first, then nodes and functions.
pub fn write(file: &UniversalFile, encoding: Encoding) -> Vec<u8> {
    let mut out = Vec::new();
    if let Some(header) = &file.header {
        block(&mut out, 151, &header_records(header));
    }
    if let Some(units) = &file.units {
        block(&mut out, 164, &units_records(units));
    }
    if !file.nodes.is_empty() {
        block(&mut out, 15, &node_records(file));
    }
    for function in &file.functions {
        match encoding {
            Encoding::Ascii => {
                let mut records = head_records(function);
                records.extend(data_records(function));
                block(&mut out, 58, &records);
            }
            Encoding::Binary => binary(&mut out, function),
        }
    }
    out
}

fn block(out: &mut Vec<u8>, set: u32, records: &[String]) {
    let mut text = format!("{MARKER}{set:6}\n");
    for record in records {
        text += record.trim_end();
        text.push('\n');
    }
    text += MARKER;
    out.extend(text.into_bytes());
}

/// At most `width` characters on one line, ASCII, so that bytes and columns agree.
fn plain(text: &str, width: usize) -> String {
    let simple = |c: char| match c {
        '²' => '2',
        c if c.is_ascii() && !c.is_ascii_control() => c,
        _ => '?',
    };
    text.chars().take(width).map(simple).collect()
}

fn header_records(header: &Header) -> Vec<String> {
    vec![
        plain(&header.model, 80),
        plain(&header.description, 80),
        plain(&header.program, 80),
        format!("{:<20}{:10}{:10}{:10}", plain(&header.created, 20), 1, 1, 0),
        format!("{:<20}", plain(&header.saved, 20)),
        plain(&header.writer, 80),
        plain(&header.written, 20),
    ]
}

fn units_records(units: &Units) -> Vec<String> {
    let [length, force, temperature] = units.factors.map(|f| exponent(f, 25, 17, 'D'));
    vec![
        format!(
            "{:10}{:<20}{:10}",
            units.code,
            plain(&units.description, 20),
            2
        ),
        format!("{length}{force}{temperature}"),
        exponent(units.temperature_offset, 25, 17, 'D'),
    ]
}

fn node_records(file: &UniversalFile) -> Vec<String> {
    let row = |node: &super::nodes::Node| {
        let [a, b, c] = node.systems;
        let [x, y, z] = node.position.map(|p| exponent(p, 13, 5, 'E'));
        format!("{:10}{a:10}{b:10}{c:10}{x}{y}{z}", node.label)
    };
    file.nodes.iter().map(row).collect()
}

/// `1PEw.d`: one digit before the point, sign and at least two digits of the exponent.
fn exponent(value: f64, width: usize, digits: usize, letter: char) -> String {
    let text = format!("{value:.digits$e}");
    let Some((mantissa, power)) = text.split_once('e') else {
        return format!("{text:>width$}");
    };
    let (sign, power) = power.strip_prefix('-').map_or(('+', power), |p| ('-', p));
    let text = if power.len() > 2 {
        format!("{mantissa}{letter}{sign}{power}")
    } else {
        format!("{mantissa}{letter}{sign}{power:0>2}")
    };
    // Three digits of exponent in a narrow field: FORTRAN drops the letter.
    let narrow = text.len() > width;
    format!(
        "{:>width$}",
        if narrow {
            text.replace(letter, "")
        } else {
            text
        }
    )
}

/// Records 1 to 11.
fn head_records(function: &Function) -> Vec<String> {
    let id = function.id.iter().map(|line| match plain(line, 80) {
        blank if blank.trim().is_empty() => "NONE".into(),
        line => line,
    });
    let mut records: Vec<String> = id.collect();
    let [number, version, load_case] = function.numbers;
    records.push(format!(
        "{:5}{number:10}{version:5}{load_case:10}{}{}",
        function.kind.code(),
        dof(&function.response),
        dof(&function.reference)
    ));
    records.push(layout(function));
    records.extend(function.axes.iter().map(axis));
    records
}

fn dof(dof: &Dof) -> String {
    format!(
        " {:<10}{:10}{:4}",
        plain(&dof.entity, 10),
        dof.node,
        dof.direction
    )
}

fn layout(function: &Function) -> String {
    let complex = matches!(function.values, Values::Complex(_));
    let kind = match (complex, function.double) {
        (false, false) => 2,
        (false, true) => 4,
        (true, false) => 5,
        (true, true) => 6,
    };
    let (even, start, step) = match function.abscissa {
        Abscissa::Even { start, step } => (1, start, step),
        Abscissa::Uneven(_) => (0, 0.0, 0.0),
    };
    let [start, step, z] = [start, step, function.z].map(|v| exponent(v, 13, 5, 'E'));
    format!(
        "{kind:10}{:10}{even:10}{start}{step}{z}",
        function.values.len()
    )
}

fn axis(axis: &Axis) -> String {
    let [length, force, temperature] = match axis.quantity {
        super::Quantity::General => axis.exponents,
        _ => [0; 3],
    };
    format!(
        "{:10}{length:5}{force:5}{temperature:5} {:<20} {:<20}",
        axis.quantity.code(),
        plain(&axis.label, 20),
        plain(&axis.unit, 20)
    )
}

/// The values in the order of the file: abscissa if uneven, real part, imaginary part.
fn rows(function: &Function) -> Vec<(Option<f64>, Vec<f64>)> {
    let place = |i: usize| match &function.abscissa {
        Abscissa::Even { .. } => None,
        Abscissa::Uneven(places) => Some(places.get(i).copied().unwrap_or(0.0)),
    };
    let parts: Vec<Vec<f64>> = match &function.values {
        Values::Real(values) => values.iter().map(|v| vec![*v]).collect(),
        Values::Complex(values) => values.iter().map(|v| vec![v.re, v.im]).collect(),
    };
    parts
        .into_iter()
        .enumerate()
        .map(|(i, parts)| (place(i), parts))
        .collect()
}

fn data_records(function: &Function) -> Vec<String> {
    let (width, digits) = if function.double { (20, 12) } else { (13, 5) };
    let row = |(place, parts): (Option<f64>, Vec<f64>)| -> String {
        let place = place.map(|p| exponent(p, 13, 5, 'E')).into_iter();
        let parts = parts.into_iter().map(|p| exponent(p, width, digits, 'E'));
        place.chain(parts).collect()
    };
    let rows = rows(function);
    let length = rows.first().map_or(1, |(place, parts)| {
        usize::from(place.is_some()) * 13 + parts.len() * width
    });
    let texts: Vec<String> = rows.into_iter().map(row).collect();
    texts
        .chunks((80 / length).max(1))
        .map(|line| line.concat())
        .collect()
}

fn binary(out: &mut Vec<u8>, function: &Function) {
    let mut payload = Vec::new();
    for (place, parts) in rows(function) {
        for value in place.into_iter().chain(parts) {
            if function.double {
                payload.extend(value.to_le_bytes());
            } else {
                payload.extend((value as f32).to_le_bytes());
            }
        }
    }
    let bytes = payload.len();
    let mut head = format!("{MARKER}{:6}b{:6}{:6}{:12}{bytes:12}", 58, 1, 2, 11);
    head += &format!("{:6}{:6}{:12}{:12}\n", 0, 0, 0, 0);
    for record in head_records(function) {
        head += &format!("{record:<80}\n");
    }
    out.extend(head.into_bytes());
    out.extend(payload);
    out.extend(MARKER.as_bytes());
}
