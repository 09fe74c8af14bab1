//! Valid texts, broken at random.

use proptest::prelude::*;

/// Numbers at the edges of what can be held.
pub const NUMBERS: [&str; 24] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "0.5",
    "1e-9",
    "1e9",
    "1e-300",
    "1e300",
    "1e-320",
    "1e400",
    "inf",
    "-inf",
    "nan",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "0x7f",
    "1_000",
    "1979-05-27",
    "1e",
    ".",
    "65535",
];
/// Pieces of TOML and of formulas.
const PIECES: [&str; 36] = [
    "\n", " ", "=", "[", "]", "[[", "]]", "{", "}", "{ ", ",", ".", "\"", "'", "\"\"\"", "#", "a.", "[a]\n", "\u{e9}",
    "\u{feff}", "\0", "\r", "(", ")", "+", "-", "*", "/", "^", "**", "min(", "exp(", "p", "\\", "\\u0000", ";",
];

/// One thing done to a text. Places are shares of its length.
#[derive(Clone, Debug)]
pub enum Edit {
    Delete(u16, u8),
    Insert(u16, usize),
    Number(u16, usize),
    Byte(u16, u8),
    Truncate(u16),
    Copy(u16, u16, u8),
    Repeat(u16, usize, u16),
}

pub fn edits() -> impl Strategy<Value = Vec<Edit>> {
    let edit = prop_oneof![
        1 => (any::<u16>(), any::<u8>()).prop_map(|(at, n)| Edit::Delete(at, n)),
        1 => (any::<u16>(), 0..PIECES.len()).prop_map(|(at, k)| Edit::Insert(at, k)),
        4 => (any::<u16>(), 0..NUMBERS.len()).prop_map(|(at, k)| Edit::Number(at, k)),
        1 => (any::<u16>(), any::<u8>()).prop_map(|(at, b)| Edit::Byte(at, b)),
        1 => any::<u16>().prop_map(Edit::Truncate),
        1 => (any::<u16>(), any::<u16>(), any::<u8>()).prop_map(|(from, to, n)| Edit::Copy(from, to, n)),
        1 => (any::<u16>(), 0..PIECES.len(), 0..400u16).prop_map(|(at, k, n)| Edit::Repeat(at, k, n)),
    ];
    proptest::collection::vec(edit, 0..5)
}

fn place(at: u16, length: usize) -> usize {
    at as usize * length / 65536
}

/// The bytes of a seed after some edits.
pub fn broken(seed: &[u8], edits: &[Edit]) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for edit in edits {
        let n = bytes.len();
        match *edit {
            Edit::Delete(at, length) => {
                let at = place(at, n);
                bytes.drain(at..n.min(at + length as usize));
            }
            Edit::Insert(at, k) => drop(bytes.splice(place(at, n)..place(at, n), PIECES[k].bytes())),
            Edit::Number(at, k) => number(&mut bytes, place(at, n), NUMBERS[k]),
            Edit::Byte(at, b) => {
                if n > 0 {
                    bytes[place(at, n)] = b;
                }
            }
            Edit::Truncate(at) => bytes.truncate(place(at, n)),
            Edit::Copy(from, to, length) => {
                let from = place(from, n);
                let piece = bytes[from..n.min(from + length as usize)].to_vec();
                drop(bytes.splice(place(to, n)..place(to, n), piece));
            }
            Edit::Repeat(at, k, count) => {
                let piece = PIECES[k].repeat(count as usize);
                drop(bytes.splice(place(at, n)..place(at, n), piece.bytes()));
            }
        }
    }
    bytes
}

/// Replaces the first number from a place on.
fn number(bytes: &mut Vec<u8>, from: usize, by: &str) {
    let Some(start) = (from..bytes.len()).find(|k| bytes[*k].is_ascii_digit()) else { return };
    let end = (start..bytes.len()).find(|k| !b"0123456789.eE_".contains(&bytes[*k])).unwrap_or(bytes.len());
    drop(bytes.splice(start..end, by.bytes()));
}

/// The same as text.
pub fn text(seed: &str, edits: &[Edit]) -> String {
    String::from_utf8_lossy(&broken(seed.as_bytes(), edits)).into_owned()
}
