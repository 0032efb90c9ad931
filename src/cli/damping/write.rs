//! What `ident damping` leaves on disk: the fit, the robot that simulation loads, the report.

use super::page::page;
use super::result::Damped;
use crate::fit::damping_store::{SCHEMA, StoredDamping, StoredInput};
use crate::fit::frf_robot::damped as with_dampings;
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::report::{html, svg};
use crate::robot::write::write as robot_text;
use rayon::prelude::*;
use std::path::PathBuf;

/// Writes everything, in one step as far as the file system allows. The robot is written only in a
/// campaign: a file outside `measurements/` has no identified robot.
pub fn all(damped: &Damped) -> Outcome<Vec<PathBuf>> {
    let place = &damped.input.place;
    let (fits, reports) = (place.fits(), place.reports());
    let page = page(damped);
    let mut contents = vec![(fits.join("damping.toml"), stored(damped).text()?)];
    if !place.campaign.is_empty() {
        contents.push((fits.join("robot.toml"), robot(damped)));
    }
    let inked = page
        .figures()
        .into_par_iter()
        .map(|(stem, chart)| Ok((reports.join(format!("{stem}.svg")), svg::ink(chart)?)))
        .collect::<Vec<Outcome<(PathBuf, String)>>>();
    contents.extend(inked.into_iter().collect::<Outcome<Vec<_>>>()?);
    contents.push((reports.join("damping.html"), html::ink(&page)?));
    files::replace_texts(&contents)?;
    Ok(contents.into_iter().map(|(path, _)| path).collect())
}

/// The robot with its dampings, as text.
fn robot(damped: &Damped) -> String {
    let label = if damped.synthetic() {
        " (synthetic)"
    } else {
        ""
    };
    let origin = format!("{}{label}", damped.input.names());
    let account = &damped.account;
    let robot = with_dampings(
        &damped.input.robot.robot,
        &account.constants,
        &account.tuned.values,
        &account.parameters,
        &origin,
    );
    robot_text(&robot)
}

fn stored(damped: &Damped) -> StoredDamping {
    let (account, request) = (&damped.account, &damped.request);
    let tests = damped.input.tests.iter();
    let mut inputs: Vec<StoredInput> = tests
        .map(|test| StoredInput {
            file: files::name(&test.path),
            sha256: test.record.sha256.clone(),
        })
        .collect();
    let (file, sha256) = damped.input.robot.input();
    inputs.push(StoredInput { file, sha256 });
    let pairs = account.pairs.iter().flatten();
    StoredDamping {
        schema: SCHEMA.into(),
        version: env!("CARGO_PKG_VERSION").into(),
        synthetic: damped.synthetic(),
        band_hz: [request.from_hz, request.settings.band_hz],
        reduced_chi_square: account.tuned.reduced_chi_square,
        inputs,
        frac: pairs
            .map(|pair| (pair.name.clone(), pair.matches[1].frac))
            .collect(),
        parameters: account.parameters.clone(),
        fixed: damped.combinations(),
    }
}
