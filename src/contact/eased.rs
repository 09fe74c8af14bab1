//! A pair made easier for a while, to find a guess for what it is.

use super::mortar::Mortar;

impl Mortar {
    /// The same pair with its augmentations taken to a power: `1` leaves them, `0` makes them `E/h`.
    pub fn eased(&self, power: f64) -> Self {
        let mut eased = self.clone();
        let numerics = &mut eased.numerics;
        (numerics.r, numerics.r_tangential) = (numerics.r.powf(power), numerics.r_tangential.powf(power));
        eased
    }
}
