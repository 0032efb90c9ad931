//! A progress bar on work longer than a second: on a terminal or when asked for, never in a pipe.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::Duration;

/// Progress of a batch.
pub struct Progress {
    bar: Option<ProgressBar>,
    asked: bool,
    total: u64,
}

impl Progress {
    /// A bar over `total` pieces of work; `asked`: also without a terminal, as plain lines.
    pub fn new(total: usize, asked: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = (terminal && total > 1).then(|| {
            let bar =
                ProgressBar::with_draw_target(Some(total as u64), ProgressDrawTarget::hidden());
            if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}") {
                bar.set_style(style);
            }
            let shown = bar.clone();
            std::thread::spawn(move || {
                std::thread::sleep(Duration::from_secs(1));
                if !shown.is_finished() {
                    shown.set_draw_target(ProgressDrawTarget::stderr());
                }
            });
            bar
        });
        Self {
            bar,
            asked: asked && !terminal,
            total: total as u64,
        }
    }

    /// One piece is done.
    pub fn done(&self, what: &str) {
        if let Some(bar) = &self.bar {
            bar.set_message(super::output::harmless(what).into_owned());
            bar.inc(1);
        }
        if self.asked {
            super::output::tell(&format!("{what} done (of {})", self.total));
        }
    }

    /// All is done: the bar goes away.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}
