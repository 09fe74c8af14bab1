//! Prescribed motions and forces of edges over time.

use crate::geometry::Point;

/// Piecewise linear in time, constant before the first and after the last entry.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Increasing times.
    pub time: Vec<f64>,
    /// Values at these times.
    pub value: Vec<f64>,
}

impl Table {
    /// The same value at all times.
    pub fn constant(value: f64) -> Self {
        Self { time: vec![0.0], value: vec![value] }
    }

    /// Value at time `t`.
    pub fn at(&self, t: f64) -> f64 {
        let next = self.time.partition_point(|&s| s <= t);
        if next == 0 {
            return self.value[0];
        }
        if next == self.time.len() {
            return self.value[next - 1];
        }
        let (t0, t1) = (self.time[next - 1], self.time[next]);
        let share = (t - t0) / (t1 - t0);
        self.value[next - 1] * (1.0 - share) + self.value[next] * share
    }

    /// Slope right after time `t`.
    pub fn slope(&self, t: f64) -> f64 {
        let next = self.time.partition_point(|&s| s <= t);
        if next == 0 || next == self.time.len() {
            return 0.0;
        }
        (self.value[next] - self.value[next - 1]) / (self.time[next] - self.time[next - 1])
    }

    /// True where the value never changes.
    pub fn is_constant(&self) -> bool {
        self.value.iter().all(|v| *v == self.value[0])
    }
}

/// What is prescribed.
#[derive(Clone, Debug, PartialEq)]
pub enum Control {
    /// Displacement of every control point of the edge.
    Displacement(Table),
    /// Resultant force on the edge, which moves as one piece in this component.
    Force(Table),
}

impl Control {
    /// Its course in time.
    pub fn table(&self) -> &Table {
        match self {
            Self::Displacement(table) | Self::Force(table) => table,
        }
    }
}

/// One component of one edge.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Body.
    pub body: usize,
    /// Control points, over all bodies.
    pub nodes: Vec<usize>,
    /// 0 for x, 1 for y.
    pub component: usize,
    /// Displacement or force.
    pub control: Control,
    /// True for `[[drive]]`, false for `[[support]]`.
    pub drive: bool,
}

impl Motion {
    /// Way of the edge in its component between two times with their displacements.
    pub fn travel(&self, time: [f64; 2], u: [&[Point]; 2]) -> f64 {
        match &self.control {
            Control::Displacement(table) => table.at(time[1]) - table.at(time[0]),
            Control::Force(_) => self.nodes.first().map_or(0.0, |&i| (u[1][i] - u[0][i])[self.component]),
        }
    }
}
