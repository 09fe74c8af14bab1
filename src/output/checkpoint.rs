//! `checkpoint/`: what an interrupted run goes on from.
//!
//! `state.bin` is replaced as a whole after every nominal step: a line that says what it is, then MessagePack with field names (so that
//! a file of another layout is an error and not nonsense; numbers are kept bit for bit, `NaN` and infinities included).
//! `displacements.bin` grows by the displacements of every nominal step, which the figure of the bodies is drawn from at the end.

use std::fs::{self, File, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use serde::{Serialize, de::DeserializeOwned};

use super::OutputError;
use super::run_json::replace;
use crate::geometry::Point;
use crate::math::checksum;

/// Version of the layout.
const FORMAT: u32 = 1;
const NAME: &str = "asperity checkpoint";
/// A first line is shorter than this.
const LONGEST_HEAD: usize = 200;
const PROGRAM: &str = env!("CARGO_PKG_VERSION");

/// Makes the folder of a checkpoint.
///
/// # Errors
/// The path and the operating system's reason.
pub fn create_folder(path: &Path) -> Result<(), OutputError> {
    fs::create_dir_all(path).map_err(OutputError::io("create", path))
}

/// Writes a value atomically to `path`; with `sync` to the disk itself.
///
/// # Errors
/// The path and the operating system's reason; a file that was there stays as it was.
pub fn write(path: &Path, value: &impl Serialize, sync: bool) -> Result<(), OutputError> {
    replace(path, &encode(value), sync)
}

/// Reads a value back; `None` where there is no such file.
///
/// # Errors
/// The path, and in what respect the file is not what [`write()`] leaves.
pub fn read<T: DeserializeOwned>(path: &Path) -> Result<Option<T>, OutputError> {
    match fs::read(path) {
        Ok(bytes) => decode(&bytes).map(Some).map_err(|reason| OutputError::content(path, reason)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(OutputError::io("read", path)(error)),
    }
}

/// The bytes of a checkpoint.
pub fn encode(value: &impl Serialize) -> Vec<u8> {
    sealed(&rmp_serde::to_vec_named(value).expect("plain data"))
}

/// Content below the line that says what it is.
pub fn sealed(content: &[u8]) -> Vec<u8> {
    let head =
        format!("{NAME} {FORMAT}, asperity {PROGRAM}, {} bytes, checksum {:016x}\n", content.len(), sum(content));
    [head.as_bytes(), content].concat()
}

/// The value in the bytes of a checkpoint.
///
/// # Errors
/// What is wrong, as a sentence about the file.
pub fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, String> {
    let head = bytes.iter().take(LONGEST_HEAD).position(|b| *b == b'\n').unwrap_or(0);
    let (line, rest) = bytes.split_at(head);
    let line = String::from_utf8_lossy(line);
    let Some(words) = line.strip_prefix(NAME).filter(|_| head > 0) else {
        return Err(if bytes.is_empty() { "the file is empty" } else { "not a checkpoint of asperity" }.into());
    };
    let written = words.trim().split(", ").collect::<Vec<_>>();
    let [format, program, length, check] = written[..] else { return Err(format!("unknown head `{line}`")) };
    if format != FORMAT.to_string() || program != format!("asperity {PROGRAM}") {
        return Err(format!(
            "written by {program} in format {format}, this is asperity {PROGRAM} with format {FORMAT}: only the version that \
             wrote a checkpoint goes on bit for bit"
        ));
    }
    let content = &rest[1..];
    if length != format!("{} bytes", content.len()) {
        return Err(format!("truncated: {} bytes after the first line, which says {length}", content.len()));
    }
    if check != format!("checksum {:016x}", sum(content)) {
        return Err("damaged: the checksum does not fit".into());
    }
    rmp_serde::from_slice(content).map_err(|error| format!("written by another build of this version ({error})"))
}

/// Checksum of bytes.
fn sum(bytes: &[u8]) -> u64 {
    let (words, rest) = bytes.as_chunks::<8>();
    let last = rest.iter().fold(1, |word, b| word << 8 | u64::from(*b));
    checksum(words.iter().map(|word| u64::from_le_bytes(*word)).chain([last]))
}

/// The displacements of all nominal steps so far, on disk.
#[derive(Debug)]
pub struct Displacements {
    file: File,
    path: PathBuf,
}

impl Displacements {
    /// Starts anew; an existing file is replaced.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        let file = File::create(path).map_err(OutputError::io("create", path))?;
        Ok(Self { file, path: path.to_path_buf() })
    }

    /// Goes on after `steps` steps of `points` points each, which are returned; what lies beyond is cut off.
    ///
    /// # Errors
    /// The path and the reason if there are fewer, or if it cannot be read or written.
    pub fn resume(path: &Path, points: usize, steps: usize) -> Result<(Self, Vec<Vec<Point>>), OutputError> {
        let mut bytes = fs::read(path).map_err(OutputError::io("read", path))?;
        let length = 16 * points * steps;
        if bytes.len() < length {
            let found = bytes.len() / (16 * points).max(1);
            return Err(OutputError::content(
                path,
                format!("holds {found} steps, the checkpoint stands at step {steps}"),
            ));
        }
        bytes.truncate(length);
        let file = OpenOptions::new().append(true).open(path).map_err(OutputError::io("append to", path))?;
        file.set_len(length as u64).map_err(OutputError::io("cut back", path))?;
        let numbers: Vec<f64> = bytes.as_chunks::<8>().0.iter().map(|word| f64::from_le_bytes(*word)).collect();
        let step = |k: usize| numbers[2 * points * k..2 * points * (k + 1)].chunks(2).map(|p| Point::new(p[0], p[1]));
        Ok((Self { file, path: path.to_path_buf() }, (0..steps).map(|k| step(k).collect()).collect()))
    }

    /// Appends those of one step.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn append(&mut self, u: &[Point]) -> Result<(), OutputError> {
        let bytes: Vec<u8> = u.iter().flat_map(|u| [u.x, u.y]).flat_map(f64::to_le_bytes).collect();
        self.file.write_all(&bytes).map_err(OutputError::io("append to", &self.path))
    }

    /// Waits until everything is on the disk itself.
    ///
    /// # Errors
    /// The path and the operating system's reason.
    pub fn sync(&self) -> Result<(), OutputError> {
        self.file.sync_data().map_err(OutputError::io("write", &self.path))
    }
}
