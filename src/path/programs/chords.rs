//! Arcs that a language cannot say, cut into pieces that it can.

use super::ProgramMove;
use crate::ground::spatial::V3;
use crate::ground::vector::{add, dot, scale, sub};
use crate::measurement::toolpath::{Arc, Shape};
use crate::path::quaternion::Quaternion;

/// Distance of a chord from its arc, m.
const CHORD: f64 = 2e-6;

/// Whether the ends of an arc lie at different heights.
pub(super) fn is_helix(from: V3, to: V3, arc: &Arc) -> bool {
    dot(sub(to, from), arc.axis).abs() > 1e-9
}

/// An arc so flat that a line says the same to 2 nm.
pub(super) fn is_straight(from: V3, arc: &Arc) -> bool {
    let half = 0.5 * arc.angle.min(std::f64::consts::PI);
    arc.radius(from) * (1.0 - half.cos()) < 2e-9
}

/// The moves as a language can say them: helices become chords, and an arc what `cut` makes of it.
pub(super) fn spelled(
    moves: &[ProgramMove],
    cut: impl Fn(&ProgramMove, &ProgramMove, &Arc) -> Option<Vec<ProgramMove>>,
) -> Vec<ProgramMove> {
    let said = |from: &ProgramMove, next: &ProgramMove| match &next.shape {
        Shape::Arc(arc) if is_helix(from.to, next.to, arc) => Some(chords(from, next, arc)),
        Shape::Arc(arc) => cut(from, next, arc),
        Shape::Line => None,
    };
    let each = moves.windows(2);
    each.flat_map(|pair| said(&pair[0], &pair[1]).unwrap_or_else(|| vec![pair[1]]))
        .collect()
}

/// The arc as short lines; they blend into each other.
pub(super) fn chords(from: &ProgramMove, next: &ProgramMove, arc: &Arc) -> Vec<ProgramMove> {
    let radius = arc.radius(from.to).max(1e-9);
    let step = 2.0 * (1.0 - (CHORD / radius).min(0.5)).acos();
    let count = (arc.angle / step).ceil().clamp(1.0, 1e5) as usize;
    let length = radius * arc.angle / count as f64;
    pieces(from, next, arc, count, |piece| {
        piece.shape = Shape::Line;
        piece.blend = piece.blend.max(0.25 * length);
    })
}

/// The arc as `count` equal arcs, with orientations in proportion.
pub(super) fn arcs(
    from: &ProgramMove,
    next: &ProgramMove,
    arc: &Arc,
    count: usize,
) -> Vec<ProgramMove> {
    let angle = arc.angle / count as f64;
    pieces(from, next, arc, count, |piece| {
        piece.shape = Shape::Arc(Arc { angle, ..*arc })
    })
}

/// Equal pieces of an arc or a helix; `shaped` makes each but the last of them blend as it likes.
fn pieces(
    from: &ProgramMove,
    next: &ProgramMove,
    arc: &Arc,
    count: usize,
    shaped: impl Fn(&mut ProgramMove),
) -> Vec<ProgramMove> {
    let (start, end) = (
        Quaternion::of(&from.rotation),
        Quaternion::of(&next.rotation),
    );
    let turn = start.way_to(end);
    let rise = scale(dot(sub(next.to, from.to), arc.axis), arc.axis);
    let piece = |i: usize| {
        let share = i as f64 / count as f64;
        let mut piece = *next;
        if i < count {
            piece.to = add(arc.at(from.to, share * arc.angle), scale(share, rise));
            piece.rotation = start.turned(scale(share, turn)).matrix();
            piece.blend = 0.0;
        }
        let blend = piece.blend;
        shaped(&mut piece);
        if i == count {
            piece.blend = blend;
        }
        piece
    };
    (1..=count).map(piece).collect()
}
