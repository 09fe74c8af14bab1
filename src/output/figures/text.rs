//! Text of figures: a little markup and its extent in DejaVu Sans, the font of the PNGs.
//!
//! `*F*_x` is an italic F with subscript x; `_` and `^` lower and raise the next character or `{group}`.

/// Font of all figures in points: readable at one column width (84 mm).
pub const SIZE: f64 = 7.5;
/// Subscripts and superscripts relative to the running size.
const SMALL: f64 = 0.75;

/// Advance widths of U+0020..U+007E in DejaVu Sans 2.37, in 1/2048 of the size.
const ADVANCE: [u16; 95] = [
    651, 821, 942, 1716, 1303, 1946, 1597, 563, 799, 799, 1024, 1716, 651, 739, 651, 690, 1303, 1303, 1303, 1303, 1303,
    1303, 1303, 1303, 1303, 1303, 690, 690, 1716, 1716, 1716, 1087, 2048, 1401, 1405, 1430, 1577, 1294, 1178, 1587,
    1540, 604, 604, 1343, 1141, 1767, 1532, 1612, 1235, 1612, 1423, 1300, 1251, 1499, 1401, 2025, 1403, 1251, 1403,
    799, 690, 799, 1716, 1024, 1024, 1255, 1300, 1126, 1300, 1260, 721, 1300, 1298, 569, 569, 1186, 569, 1995, 1298,
    1253, 1300, 1300, 842, 1067, 803, 1298, 1212, 1675, 1212, 1212, 1075, 1303, 690, 1303, 1716,
];

/// Where a piece of text stands relative to the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Level {
    Line,
    Below,
    Above,
}

/// A run of text in one style.
#[derive(Clone, Debug, PartialEq)]
struct Piece {
    text: String,
    italic: bool,
    level: Level,
}

fn pieces(markup: &str) -> Vec<Piece> {
    let mut found: Vec<Piece> = Vec::new();
    let (mut italic, mut rest) = (false, markup);
    while let Some(letter) = rest.chars().next() {
        let after = &rest[letter.len_utf8()..];
        let (text, level, next) = match letter {
            '*' => {
                italic = !italic;
                rest = after;
                continue;
            }
            '_' | '^' if !after.is_empty() => {
                let (text, next) = argument(after);
                (text, if letter == '_' { Level::Below } else { Level::Above }, next)
            }
            _ => (&rest[..letter.len_utf8()], Level::Line, after),
        };
        match found.last_mut() {
            Some(last) if last.level == level && last.italic == italic => last.text.push_str(text),
            _ => found.push(Piece { text: text.to_owned(), italic, level }),
        }
        rest = next;
    }
    found
}

/// The next character or `{group}` and what follows it.
fn argument(text: &str) -> (&str, &str) {
    if let Some((inside, after)) = text.strip_prefix('{').and_then(|open| open.split_once('}')) {
        return (inside, after);
    }
    text.split_at(text.chars().next().map_or(0, char::len_utf8))
}

/// Width of a marked-up text at the given size.
pub fn width(markup: &str, size: f64) -> f64 {
    let advance = |letter: char| {
        let index = (letter as usize).wrapping_sub(32);
        f64::from(ADVANCE.get(index).copied().unwrap_or(1400)) / 2048.0
    };
    let piece = |piece: &Piece| {
        let size = if piece.level == Level::Line { size } else { SMALL * size };
        size * piece.text.chars().map(advance).sum::<f64>()
    };
    pieces(markup).iter().map(piece).sum()
}

/// SVG content of a `<text>` element: escaped, one `<tspan>` per style.
pub fn spans(markup: &str, size: f64) -> String {
    let mut svg = String::new();
    let mut raised = 0.0;
    for piece in pieces(markup) {
        let shift = match piece.level {
            Level::Line => 0.0,
            Level::Below => 0.22 * size,
            Level::Above => -0.36 * size,
        };
        let style = if piece.italic { " font-style=\"italic\"" } else { "" };
        let small = if piece.level == Level::Line { size } else { SMALL * size };
        let text = escape(&piece.text);
        svg.push_str(&format!("<tspan dy=\"{:.2}\" font-size=\"{small:.2}\"{style}>{text}</tspan>", shift - raised));
        raised = shift;
    }
    svg
}

/// Text for XML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_becomes_styles() {
        let found = pieces("*F*_x / N^{-1}");
        let texts: Vec<_> = found.iter().map(|piece| (piece.text.as_str(), piece.italic, piece.level)).collect();
        assert_eq!(
            texts,
            [
                ("F", true, Level::Line),
                ("x", false, Level::Below),
                (" / N", false, Level::Line),
                ("-1", false, Level::Above)
            ]
        );
        assert!(width("il", 10.0) < width("WM", 10.0));
        assert!(spans("a<b", 10.0).contains("a&lt;b"));
    }

    #[test]
    fn loose_markup_is_harmless() {
        for markup in ["_", "^", "*", "a_{b", "", "µ^"] {
            let _ = (width(markup, 1.0), spans(markup, 1.0));
        }
    }
}
