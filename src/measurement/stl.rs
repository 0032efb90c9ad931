//! STL: a surface as triangles, text or binary, whose numbers are taken as mm.

use crate::ground::problem::{Outcome, Problem};
use crate::ground::spatial::V3;

/// Bytes before the first triangle of a binary file, and of each triangle.
const HEAD: usize = 84;
const FACE: usize = 50;

/// The triangles of an STL file, m.
///
/// # Errors
/// Not STL, cut off, numbers that are none.
pub fn triangles(bytes: &[u8]) -> Outcome<Vec<[V3; 3]>> {
    let found = match binary_count(bytes) {
        Some(count) => binary(&bytes[HEAD..], count),
        None if bytes.trim_ascii_start().starts_with(b"solid") => text(bytes)?,
        None => {
            return Err(no_stl(
                "is neither text nor binary STL of the length it states",
            ));
        }
    };
    let finite = |t: &[V3; 3]| t.iter().flatten().all(|x| x.is_finite());
    match found.is_empty() || !found.iter().all(finite) {
        true => Err(no_stl("holds no triangles, or numbers that are not finite")),
        false => Ok(found),
    }
}

fn no_stl(what: &str) -> Problem {
    Problem::new(what, "export the stock as STL in mm from the CAD system")
}

/// Number of triangles, if the length of the file agrees with it.
fn binary_count(bytes: &[u8]) -> Option<usize> {
    let count = u32::from_le_bytes(bytes.get(80..HEAD)?.try_into().ok()?) as usize;
    (bytes.len() == HEAD + FACE * count).then_some(count)
}

fn binary(faces: &[u8], count: usize) -> Vec<[V3; 3]> {
    let number = |face: &[u8], i: usize| {
        let bytes = [face[i], face[i + 1], face[i + 2], face[i + 3]];
        f64::from(f32::from_le_bytes(bytes)) * 1e-3
    };
    let corner = |face: &[u8], k: usize| [0, 1, 2].map(|i| number(face, 12 * (k + 1) + 4 * i));
    let faces = faces.chunks_exact(FACE).take(count);
    faces
        .map(|face| [0, 1, 2].map(|k| corner(face, k)))
        .collect()
}

fn text(bytes: &[u8]) -> Outcome<Vec<[V3; 3]>> {
    let text = String::from_utf8_lossy(bytes);
    let mut corners = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        if words.next() == Some("vertex") {
            corners.push(vertex(words).map_err(|problem| problem.at_line(i + 1))?);
        }
    }
    if corners.len() % 3 != 0 {
        return Err(no_stl("ends within a triangle"));
    }
    Ok(corners.as_chunks::<3>().0.to_vec())
}

fn vertex<'a>(mut words: impl Iterator<Item = &'a str>) -> Outcome<V3> {
    let mut next = || words.next().and_then(|word| word.parse::<f64>().ok());
    match (next(), next(), next()) {
        (Some(x), Some(y), Some(z)) => Ok([x, y, z].map(|v| v * 1e-3)),
        _ => Err(no_stl("has a vertex without three numbers")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &[u8] = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1e1 0 0\nvertex 0 10 0\nendloop\nendfacet\nendsolid a\n";

    #[test]
    fn text_and_binary_say_the_same() {
        let from_text = triangles(TEXT).unwrap();
        let mut bytes = vec![0; 80];
        bytes.extend(1_u32.to_le_bytes());
        for x in [
            0.0_f32, 0.0, 1.0, 0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 10.0, 0.0,
        ] {
            bytes.extend(x.to_le_bytes());
        }
        bytes.extend([0, 0]);
        assert_eq!(triangles(&bytes).unwrap(), from_text);
        assert_eq!(from_text, [[[0.0; 3], [0.01, 0.0, 0.0], [0.0, 0.01, 0.0]]]);
    }

    #[test]
    fn what_is_not_stl_is_refused() {
        assert!(triangles(b"").is_err() && triangles(b"PK").is_err());
        let problem = triangles(b"solid a\nvertex 1 2\n").unwrap_err();
        assert_eq!(problem.line, Some(2));
        assert!(triangles(b"solid a\nvertex 1 2 3\n").is_err());
    }
}
