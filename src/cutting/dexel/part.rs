//! Which part of a cell of ring and angle stands in material, and what an edge meets that passes over two of them.

/// The part of a cell that is in: from one angle within it to another, so much of its height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Part {
    /// Share of the height that is in.
    height: f64,
    /// Where it begins and ends, in cells from the lower border.
    span: [f64; 2],
}

/// What an edge meets while it passes over one cell's width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Met {
    /// Share of width and height in material.
    pub share: f64,
    /// Middle of that, in cells beyond the middle of what it passes over.
    pub middle: f64,
    /// Width of that, in cells.
    pub width: f64,
}

impl Part {
    /// Nothing of it.
    pub const NONE: Self = Self::even(0.0);

    /// A share of its height from end to end.
    pub const fn even(share: f64) -> Self {
        Self {
            height: share,
            span: [0.0, 1.0],
        }
    }

    /// A share of the height, at the lower end around to a share of the width or, `behind`, from there to the upper end.
    pub fn beside(height: f64, width: f64, behind: bool) -> Self {
        let span = if behind {
            [1.0 - width, 1.0]
        } else {
            [0.0, width]
        };
        Self { height, span }
    }

    /// Share of the cell.
    #[inline]
    pub fn share(&self) -> f64 {
        self.height * (self.span[1] - self.span[0])
    }

    /// Where it begins and ends, in cells, with the share of the height.
    pub fn span(&self) -> ([f64; 2], f64) {
        (self.span, self.height)
    }

    fn is_even(&self) -> bool {
        self.span == [0.0, 1.0]
    }
}

impl Met {
    /// What lies over a cell's width that begins a share `after` of the way through `low`, of that cell and of the next.
    #[inline]
    pub(super) fn over(low: &Part, high: &Part, after: f64) -> Self {
        if low.is_even() && high.is_even() {
            return Self {
                share: low.height + after * (high.height - low.height),
                middle: 0.0,
                width: 1.0,
            };
        }
        let middle = after + 0.5;
        let clip = |part: &Part, [from, to]: [f64; 2], shift: f64| {
            let [a, b] = [part.span[0].max(from), part.span[1].min(to)];
            let width = if part.height > 0.0 {
                (b - a).max(0.0)
            } else {
                0.0
            };
            (part.height * width, width, 0.5 * (a + b) + shift - middle)
        };
        let pieces = [clip(low, [after, 1.0], 0.0), clip(high, [0.0, after], 1.0)];
        let sum = |of: fn(&(f64, f64, f64)) -> f64| pieces.iter().map(of).sum::<f64>();
        let share = sum(|p| p.0);
        match share > 0.0 {
            true => Self {
                share,
                middle: sum(|p| p.0 * p.2) / share,
                width: sum(|p| p.1),
            },
            false => Self {
                share: 0.0,
                middle: 0.0,
                width: 1.0,
            },
        }
    }
}
