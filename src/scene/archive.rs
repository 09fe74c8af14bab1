//! What a march remembers, on disk: a resumed run recalls it, too.

use crate::geometry::Point;
use crate::model::{Model, Pair, State};
use crate::output::checkpoint::Displacements;
use crate::output::{OutputError, RunFolder};
use crate::solve::{Seen, Ways};

/// `checkpoint/seen.bin`, with one entry for each nominal step that is needed again; no file where none is.
pub(super) struct Archive<'a> {
    ways: &'a Ways<'a>,
    file: Option<Displacements>,
}

impl<'a> Archive<'a> {
    /// Opens the file: anew, or, `after` some steps, cut back to these, with what they left.
    pub fn open(
        folder: &RunFolder,
        model: &Model,
        ways: &'a Ways<'a>,
        after: usize,
    ) -> Result<(Self, Vec<Seen>), OutputError> {
        let path = folder.checkpoint().join("seen.bin");
        if !ways.any() {
            return Ok((Self { ways, file: None }, vec![]));
        }
        if after == 0 {
            return Ok((Self { ways, file: Some(Displacements::create(&path)?) }, vec![]));
        }
        let steps = (1..=after).filter(|&step| ways.keeps(step)).count();
        let multipliers: usize = model.pairs.iter().map(Pair::unknowns).sum();
        let numbers = Seen::length(model.nodes(), multipliers);
        let (file, entries) = Displacements::resume(&path, numbers.div_ceil(2), steps)?;
        let entry = |points: &Vec<Point>| {
            let flat: Vec<f64> = points.iter().flat_map(|p| [p.x, p.y]).take(numbers).collect();
            Seen::from_numbers(&flat, model.nodes())
        };
        Ok((Self { ways, file: Some(file) }, entries.iter().map(entry).collect()))
    }

    /// Takes one nominal step.
    pub fn step(&mut self, step: usize, state: &State) -> Result<(), OutputError> {
        let Some(file) = self.file.as_mut().filter(|_| self.ways.keeps(step)) else { return Ok(()) };
        let numbers = Seen::of(step, state).numbers();
        let points = numbers.chunks(2).map(|pair| Point::new(pair[0], pair.get(1).copied().unwrap_or(0.0)));
        file.append(&points.collect::<Vec<_>>())
    }

    /// Waits until everything is on the disk itself.
    pub fn sync(&self) -> Result<(), OutputError> {
        self.file.iter().try_for_each(Displacements::sync)
    }
}
