//! The account of a campaign on the terminal.

use super::tables;
use crate::findings::campaign::Campaign;
use crate::findings::sentence::sentences;
use crate::report::text;

/// The account on the terminal.
pub fn account(campaign: &Campaign) -> String {
    let mut said = format!(
        "{}{}: {}\n",
        campaign.place.measurements().display(),
        if campaign.synthetic() {
            " (synthetic)"
        } else {
            ""
        },
        campaign.verdict.name()
    );
    said.push_str(&text::indented(&campaign.sentence(), 2));
    said.push_str(&format!("\n{}", text::table(&tables::overview(campaign))));
    said.push_str(&format!("\n{}", text::table(&tables::causes(campaign))));
    if let Some(joint) = campaign.joined() {
        said.push_str(&format!("\n{}", text::table(&tables::together(joint))));
        let settled = campaign.settled();
        said.extend(settled.iter().map(|s| text::indented(s, 2)));
    }
    if !campaign.checks.is_empty() {
        said.push_str(&format!("\n{}", text::table(&tables::checked(campaign))));
    }
    for one in &campaign.files {
        let answer = one.found.answer();
        if answer.is_fine() {
            continue;
        }
        said.push_str(&format!("\n{}\n", one.stem()));
        said.extend(sentences(answer).iter().map(|s| text::indented(s, 2)));
    }
    if !campaign.remarks.is_empty() {
        said.push('\n');
    }
    said.extend(campaign.remarks.iter().map(|s| text::indented(s, 0)));
    said
}
