//! Pieces of a page: escaped text, tables, figures, the frame around it all.

use crate::output::figures::escape;

const STYLE: &str = include_str!("page.css");
const PLAYER: &str = include_str!("player.js");

/// A whole page; `body` is HTML.
pub fn page(title: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n\
         <link rel=\"icon\" href=\"data:,\">\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n{body}</main>\n\
         <script>\n{PLAYER}</script>\n</body>\n</html>\n",
        escape(title)
    )
}

/// A section with a heading; nothing without content.
pub fn section(title: &str, content: &str) -> String {
    if content.is_empty() {
        String::new()
    } else {
        format!("<section>\n<h2>{}</h2>\n{content}</section>\n", escape(title))
    }
}

/// A list of sentences; nothing without any.
pub fn list(lines: &[String]) -> String {
    if lines.is_empty() {
        return String::new();
    }
    let items: String = lines.iter().map(|line| format!("<li>{}</li>\n", escape(line))).collect();
    format!("<ul>\n{items}</ul>\n")
}

/// A cell of a table.
#[derive(Clone, Debug)]
pub struct Cell {
    text: String,
    class: &'static str,
}

impl Cell {
    /// A number, aligned to the right.
    pub fn number(text: impl Into<String>) -> Self {
        Self { text: text.into(), class: "number" }
    }

    /// A word.
    pub fn word(text: impl Into<String>) -> Self {
        Self { text: text.into(), class: "" }
    }

    /// A sentence, which wants some width.
    pub fn words(text: impl Into<String>) -> Self {
        Self { text: text.into(), class: "words" }
    }

    /// A word that tells good from bad.
    pub fn state(text: impl Into<String>, class: &'static str) -> Self {
        Self { text: text.into(), class }
    }
}

/// A table that scrolls sideways where the window is narrow; `label` names it for those who do not see it.
pub fn table(label: &str, heads: &[&str], rows: &[Vec<Cell>]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let heads: String = heads.iter().map(|head| format!("<th scope=\"col\">{}</th>", escape(head))).collect();
    let cell = |cell: &Cell| match cell.class {
        "" => format!("<td>{}</td>", escape(&cell.text)),
        class => format!("<td class=\"{class}\">{}</td>", escape(&cell.text)),
    };
    let rows: String =
        rows.iter().map(|row| format!("<tr>{}</tr>\n", row.iter().map(cell).collect::<String>())).collect();
    let label = escape(label);
    format!(
        "<div class=\"scroll\" role=\"region\" aria-label=\"{label}\" tabindex=\"0\">\n<table>\n<thead><tr>{heads}</tr></thead>\n\
         <tbody>\n{rows}</tbody>\n</table>\n</div>\n"
    )
}

/// The numbers that a reader looks for first: value and what it is.
pub fn key_numbers(numbers: &[(String, &str)]) -> String {
    let item =
        |(value, name): &(String, &str)| format!("<li><b>{}</b><span>{}</span></li>\n", escape(value), escape(name));
    format!("<ul class=\"key\">\n{}</ul>\n", numbers.iter().map(item).collect::<String>())
}

/// A figure of ours, put into the page as it is; the caption is its alternative text.
pub fn figure(svg: &str, caption: &str, wide: bool) -> String {
    let (caption, class) = (escape(caption), if wide { " class=\"wide\"" } else { "" });
    let svg = svg.trim().replacen("<svg ", &format!("<svg role=\"img\" aria-label=\"{caption}\" "), 1);
    let player = match svg.contains("asperity-frame") {
        true => {
            "<div class=\"player\" hidden><button type=\"button\">Pause</button>\
             <input type=\"range\" min=\"0\" value=\"0\" aria-label=\"instant of the animation\"></div>\n"
        }
        false => "",
    };
    // small print of a wide figure would be lost in a narrow window
    let svg = if wide { format!("<div class=\"pan\" tabindex=\"0\">{svg}</div>") } else { svg };
    format!("<figure{class}>\n{svg}\n{player}<figcaption>{caption}</figcaption>\n</figure>\n")
}

/// Text as it is, folded away.
pub fn folded(summary: &str, content: &str) -> String {
    format!("<details>\n<summary>{}</summary>\n{content}</details>\n", escape(summary))
}

/// Program text.
pub fn code(text: &str) -> String {
    format!("<pre tabindex=\"0\"><code>{}</code></pre>\n", escape(text))
}
