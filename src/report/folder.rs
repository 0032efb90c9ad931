//! A page on disk: `index.html` and beside it every figure as its own file.

use super::{html, svg};
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::sheet::page::{Page, file};
use std::path::{Path, PathBuf};

/// Writes a page and its figures into a folder: all of them, or none. Returns the files in the order of writing.
pub fn write_as(folder: &Path, name: &str, page: &Page) -> Outcome<Vec<PathBuf>> {
    let all = inked(folder, name, page)?;
    files::replace_texts(&all)?;
    Ok(all.into_iter().map(|(path, _)| path).collect())
}

/// Files (path and text) and a page that rests on them: all of them, or none. Returns the page's path.
///
/// # Errors
/// What cannot be inked or written.
pub fn write_with(
    files: Vec<(PathBuf, String)>,
    folder: &Path,
    name: &str,
    page: &Page,
) -> Outcome<PathBuf> {
    let all = [files, inked(folder, name, page)?].concat();
    files::replace_texts(&all)?;
    Ok(folder.join(name))
}

/// Figures and page, the page last.
fn inked(folder: &Path, name: &str, page: &Page) -> Outcome<Vec<(PathBuf, String)>> {
    let index = (folder.join(name), html::ink(page)?);
    let figure =
        |(stem, chart): (String, &_)| Ok((folder.join(file(&stem, chart)), svg::ink(chart)?));
    let figures = page.figures().into_iter().map(figure);
    let mut contents = figures.collect::<Outcome<Vec<_>>>()?;
    contents.push(index);
    Ok(contents)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::chart::Chart;
    use crate::sheet::page::Block;

    #[test]
    fn figures_stand_beside_the_index() {
        let folder = tempfile::tempdir().unwrap();
        let chart = || Block::Chart(Chart::new("loop", "Loop", "See."));
        let page = Page::new("t", "s").with(chart()).with(chart());
        let written = write_as(&folder.path().join("r"), "index.html", &page).unwrap();
        let names: Vec<_> = written.iter().filter_map(|path| path.file_name()).collect();
        assert_eq!(names, ["loop.svg", "loop-2.svg", "index.html"]);
        let index = std::fs::read_to_string(&written[2]).unwrap();
        assert!(index.contains("href=\"loop-2.svg\""));
    }
}
