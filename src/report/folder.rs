//! A page on disk: `index.html` and beside it every figure as its own file.

use super::{html, svg};
use crate::ground::files;
use crate::ground::problem::Outcome;
use crate::sheet::page::{Page, file};
use std::path::{Path, PathBuf};

/// Writes a page into a folder, each file in one step, the page last: what it links to is there.
/// Everything is inked before anything is written. Returns the files in the order of writing.
pub fn write_as(folder: &Path, name: &str, page: &Page) -> Outcome<Vec<PathBuf>> {
    let mut written = Vec::new();
    for (path, content) in inked(folder, name, page)? {
        files::replace(&path, content.as_bytes())?;
        written.push(path);
    }
    Ok(written)
}

/// Files (path and text) and a page that rests on them: all of them, or none. Returns the page's path.
///
/// # Errors
/// What cannot be inked or written.
pub fn write_with(
    mut files: Vec<(PathBuf, String)>,
    folder: &Path,
    name: &str,
    page: &Page,
) -> Outcome<PathBuf> {
    files.extend(inked(folder, name, page)?);
    let all: Vec<(&Path, &[u8])> = files
        .iter()
        .map(|(path, text)| (path.as_path(), text.as_bytes()))
        .collect();
    crate::ground::files::replace_all(&all)?;
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
