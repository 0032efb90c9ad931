//! A page as one HTML file that needs nothing else: no network, and no scripts but those of a view in
//! space, which it carries.

use super::escape::escape;
use super::prose::{bound, is_long, is_word, prose};
use super::{scene, svg};
use crate::ground::problem::Outcome;
use crate::sheet::chart::Chart;
use crate::sheet::page::{APPENDIX, Block, Page, Tone, file};
use crate::sheet::scene::Scene;
use crate::sheet::table::Table;
use std::fmt::Write as _;

const STYLE: &str = include_str!("page.css");

/// Inks a page.
///
/// ```
/// use ident::report::html;
/// use ident::sheet::page::{Block, Page};
/// let page = Page::new("Axis 6", "from axis6.csv").with(Block::text("a < b"));
/// assert!(html::ink(&page).unwrap().contains("<p>a &lt; b</p>"));
/// ```
pub fn ink(page: &Page) -> Outcome<String> {
    let figures = page.figures().into_iter().map(|(stem, _)| stem);
    let mut writer = Writer {
        out: String::new(),
        figures: figures.collect::<Vec<_>>().into_iter(),
        tables: 0,
        scenes: 0,
    };
    writer.blocks(&page.blocks)?;
    Ok(document(page, &writer.out))
}

fn document(page: &Page, body: &str) -> String {
    let (title, subtitle) = (escape(&page.title), escape(&page.subtitle));
    let label = match page.synthetic {
        true => {
            "<p class=\"synthetic\"><strong>Synthetic data.</strong> Nobody measured this.</p>\n"
        }
        false => "",
    };
    let subtitle = match subtitle.is_empty() {
        true => String::new(),
        false => format!("<p class=\"subtitle\">{subtitle}</p>\n"),
    };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"generator\" content=\"ident {version}\">\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <a class=\"skip\" href=\"#story\">Skip to the findings</a>\n\
         <header>\n<h1>{title}</h1>\n{subtitle}{label}</header>\n{contents}\
         <main id=\"story\" tabindex=\"-1\">\n{body}</main>\n</body>\n</html>\n",
        version = env!("CARGO_PKG_VERSION"),
        contents = contents(&page.blocks),
    )
}

/// Links to the sections, if there are enough of them to get lost in.
fn contents(blocks: &[Block]) -> String {
    let headings: Vec<&String> = blocks.iter().filter_map(heading).collect();
    if headings.len() < 3 {
        return String::new();
    }
    let mut out = "<nav aria-label=\"Sections\">\n<ol>\n".to_string();
    for (i, text) in headings.into_iter().enumerate() {
        let _ = writeln!(
            out,
            "<li><a href=\"#section-{}\">{}</a></li>",
            i + 1,
            escape(text)
        );
    }
    out + "</ol>\n</nav>\n"
}

fn heading(block: &Block) -> Option<&String> {
    match block {
        Block::Heading(text) => Some(text),
        _ => None,
    }
}

struct Writer {
    out: String,
    figures: std::vec::IntoIter<String>,
    tables: usize,
    scenes: usize,
}

impl Writer {
    /// The blocks of the page; each heading begins a section.
    fn blocks(&mut self, blocks: &[Block]) -> Outcome<()> {
        let sections = blocks.chunk_by(|_, next| heading(next).is_none());
        let mut number = 0;
        for section in sections {
            let Some(text) = section.first().and_then(heading) else {
                self.inner(section)?;
                continue;
            };
            number += 1;
            let id = format!("section-{number}");
            let class = if text == APPENDIX {
                " class=\"appendix\""
            } else {
                ""
            };
            let text = escape(text);
            let _ = writeln!(
                self.out,
                "<section{class} aria-labelledby=\"{id}\">\n<h2 id=\"{id}\">{text}</h2>"
            );
            self.inner(&section[1..])?;
            self.out.push_str("</section>\n");
        }
        Ok(())
    }

    fn inner(&mut self, blocks: &[Block]) -> Outcome<()> {
        blocks.iter().try_for_each(|block| self.block(block))
    }

    fn block(&mut self, block: &Block) -> Outcome<()> {
        match block {
            Block::Heading(text) => self.line(&format!("<h3>{}</h3>", escape(text))),
            Block::Verdict { tone, sentence } => self.verdict(*tone, sentence),
            Block::Text(text) => self.line(&format!("<p>{}</p>", prose(text))),
            Block::Table(table) => self.table(table),
            Block::Chart(chart) => return self.figure(chart),
            Block::Scene(scene) => self.scene(scene),
            Block::Details { summary, blocks } => {
                self.line(&format!(
                    "<details>\n<summary>{}</summary>",
                    escape(summary)
                ));
                self.inner(blocks)?;
                self.line("</details>");
            }
        }
        Ok(())
    }

    fn scene(&mut self, inner: &Scene) {
        self.scenes += 1;
        self.line(&scene::ink(inner, &format!("scene-{}", self.scenes)));
    }

    fn line(&mut self, text: &str) {
        self.out.push_str(text);
        self.out.push('\n');
    }

    fn verdict(&mut self, tone: Tone, sentence: &str) {
        let class = match tone {
            Tone::Good => "good",
            Tone::Neutral => "neutral",
            Tone::Attention => "attention",
            Tone::Bad => "bad",
        };
        let (word, sentence) = (tone.word(), prose(sentence));
        self.line(&format!(
            "<p class=\"verdict {class}\"><strong>{word}:</strong> {sentence}</p>"
        ));
    }

    fn figure(&mut self, chart: &Chart) -> Outcome<()> {
        let stem = self.figures.next().unwrap_or_default();
        let drawing = svg::inline(chart, &stem)?;
        let (title, caption) = (escape(&chart.title), escape(&chart.caption));
        let name = file(&stem, chart);
        let (name, link) = (escape(&name), link(&name));
        let stop = if title.is_empty() || title.ends_with(['.', '?', '!']) {
            ""
        } else {
            "."
        };
        // Reachable by keyboard: a narrow window scrolls the figure sideways.
        let _ = write!(
            self.out,
            "<figure id=\"figure-{stem}\">\n<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Figure: {title}\">\n\
             {drawing}</div>\n<figcaption><strong>{title}{stop}</strong> {caption} \
             <a href=\"{link}\" class=\"file\">{name}</a></figcaption>\n</figure>\n"
        );
        Ok(())
    }

    fn table(&mut self, table: &Table) {
        self.tables += 1;
        let id = format!("table-{}", self.tables);
        let title = escape(&table.title);
        let label = if title.is_empty() { "Table" } else { &title };
        self.line(&format!(
            "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{label}\">\n<table id=\"{id}\">"
        ));
        if !title.is_empty() {
            self.line(&format!("<caption>{title}</caption>"));
        }
        self.head(table);
        self.line("<tbody>");
        table.rows.iter().for_each(|row| self.row(row, table));
        self.line("</tbody>\n</table>\n</div>");
        for note in &table.notes {
            self.line(&format!("<p class=\"note\">{}</p>", escape(note)));
        }
    }

    fn head(&mut self, table: &Table) {
        if table.header.is_empty() {
            return;
        }
        self.out.push_str("<thead><tr>");
        for k in 0..table.columns() {
            let text = table.header.get(k).map_or("", String::as_str);
            let _ = write!(
                self.out,
                "<th scope=\"col\"{}>{}</th>",
                flush(table, k),
                escape(text)
            );
        }
        self.line("</tr></thead>");
    }

    fn row(&mut self, row: &[String], table: &Table) {
        self.out.push_str("<tr>");
        for k in 0..table.columns() {
            let text = bound(row.get(k).map_or("", String::as_str));
            let class = flush(table, k);
            let _ = match k {
                0 if class.is_empty() && is_long(&text) => {
                    write!(self.out, "<th scope=\"row\" class=\"long\">{text}</th>")
                }
                0 => write!(self.out, "<th scope=\"row\"{class}>{text}</th>"),
                _ if class.is_empty() && is_word(&text) => {
                    write!(self.out, "<td class=\"word\">{text}</td>")
                }
                _ => write!(self.out, "<td{class}>{text}</td>"),
            };
        }
        self.line("</tr>");
    }
}

/// A file name as a relative link: signs that mean something there are encoded.
fn link(name: &str) -> String {
    let encoded = name
        .replace('%', "%25")
        .replace('#', "%23")
        .replace('?', "%3F")
        .replace(' ', "%20");
    escape(&encoded).into_owned()
}

fn flush(table: &Table, column: usize) -> &'static str {
    if table.is_right(column) {
        " class=\"number\""
    } else {
        ""
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_the_text_becomes_markup() {
        let evil = "<script>\"&'";
        let page = Page::new(evil, evil)
            .with(Block::heading(evil))
            .with(Block::verdict(Tone::Bad, evil))
            .with(Block::Table(
                Table::new(evil, [evil]).with([evil]).noted(evil),
            ))
            .with(Block::Chart(Chart::new(evil, evil, evil)))
            .with(Block::details(
                evil,
                vec![Block::heading(evil), Block::text(evil)],
            ));
        let html = ink(&page).unwrap();
        assert!(!html.contains("<script"));
        assert!(html.contains("&lt;script&gt;&quot;&amp;&#39;"));
    }

    #[test]
    fn needs_no_network() {
        let chart = Chart::new("loop", "Loop", "See.");
        let html = ink(&Page::new("t", "s").with(Block::Chart(chart))).unwrap();
        let links = html.matches("http").count();
        assert_eq!(links, html.matches("xmlns=\"http").count());
    }

    #[test]
    fn headings_begin_sections() {
        let page = Page::new("t", "").with(Block::text("lead"));
        let page = ["a", "b", "c"]
            .iter()
            .fold(page, |page, name| page.with(Block::heading(*name)));
        let html = ink(&page).unwrap();
        assert_eq!(html.matches("<section").count(), 3);
        assert!(html.contains("<li><a href=\"#section-3\">c</a></li>"));
    }
}
