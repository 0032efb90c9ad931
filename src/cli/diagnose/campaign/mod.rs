//! How the diagnosis of a whole campaign is shown.

mod account;
mod errors;
mod page;
mod tables;

pub use account::account;
pub use page::story;

use crate::cli::Ending;
use crate::cli::chapter::Chapter;
use crate::cli::output::warn;
use crate::cli::progress::Progress;
use crate::findings::campaign::Campaign;
use crate::ground::files::replace_texts;
use crate::ground::problem::Outcome;
use crate::measurement::workspace::Place;
use crate::robot::write;
use std::path::PathBuf;

/// Diagnoses a campaign with a bar of progress.
///
/// # Errors
/// A file that cannot be read, or none at all.
pub fn examine(place: &Place, progress: bool) -> Outcome<Campaign> {
    let paths = Campaign::files(place)?;
    let progress = Progress::new(paths.len(), progress);
    let done = |path: &std::path::Path| progress.done(&path.display().to_string());
    let campaign = Campaign::diagnose(place, &paths, &done)?;
    progress.finish();
    warn(&campaign.warnings);
    Ok(campaign)
}

/// Everything that is written but its page.
///
/// # Errors
/// A file whose name no result can have, a chart that cannot be inked.
pub fn written(campaign: &Campaign) -> Outcome<Vec<(PathBuf, String)>> {
    let mut all = super::written(&campaign.files)?;
    let labelled = |robot| write::labelled(robot, campaign.synthetic());
    let robot = campaign.robot.as_ref();
    let robot = robot.map(|robot| (campaign.robot_path(), labelled(robot)));
    all.extend(robot);
    Ok(all)
}

/// How the verb ends.
pub fn ending(campaign: &Campaign) -> Ending {
    Ending::done_if(campaign.is_fine())
}

/// Diagnoses a campaign, and writes what that found.
///
/// # Errors
/// A file that cannot be read, results that cannot be written.
pub fn chapter(place: &Place) -> Outcome<Option<Chapter>> {
    let campaign = examine(place, false)?;
    replace_texts(&written(&campaign)?)?;
    let sources = campaign.files.iter().map(|file| file.found.source());
    Ok(Some(Chapter {
        title: "What the simulation gets wrong".into(),
        ending: ending(&campaign),
        inputs: sources
            .map(|s| (s.path.to_path_buf(), s.sha256.to_string()))
            .collect(),
        page: story(&campaign),
    }))
}
