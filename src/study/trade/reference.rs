//! How wrong the reference itself is, from what its last two refinements changed.
//!
//! Each refinement halves the elements and the steps together. With `d1` the difference of the last two levels and `d2` that of the two
//! before, the observed ratio `d2/d1` of a method of order `q` is `2^q`, and what is left beyond the finest level is
//! `d1/(2^q - 1)` (Richardson). The ratio is believed from 2 (first order) on, and credited up to 4 (second order: a moving edge
//! of contact allows little more). Below 2 the levels are not in their limit yet: then `d1` in full is said to be the error.

/// Least ratio that is believed.
const FIRST_ORDER: f64 = 2.0;
/// Largest ratio that is credited.
const SECOND_ORDER: f64 = 4.0;

/// Estimated error of the finest of three levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The error.
    pub error: f64,
    /// Observed ratio of the two differences; `nan` where the coarsest level is missing.
    pub ratio: f64,
}

impl Estimate {
    /// From the difference of the last two levels, and that of the two before.
    pub fn new(last: f64, before: f64) -> Self {
        let ratio = before / last;
        let credited = if ratio >= FIRST_ORDER { ratio.min(SECOND_ORDER) } else { FIRST_ORDER };
        Self { error: last / (credited - 1.0), ratio }
    }

    /// In words.
    pub fn words(&self) -> String {
        match self.ratio {
            ratio if ratio.is_nan() => "two levels: their difference".into(),
            ratio if ratio >= FIRST_ORDER => {
                format!("Richardson: the last two refinements differ by a factor of {ratio:.1}")
            }
            ratio => {
                format!("two levels: their difference, as the observed ratio {ratio:.1} is no order of convergence")
            }
        }
    }
}
