//! A checksum of numbers: tells whether they are bit for bit those of before.

/// Changes with every single bit; not made against intent. The same on every machine and in every version.
pub fn checksum(words: impl IntoIterator<Item = u64>) -> u64 {
    // every word is mixed in by a bijection of what came before
    const ODD: u64 = 0x517c_c1b7_2722_0a95;
    words.into_iter().fold(ODD, |sum, word| (sum.rotate_left(5) ^ word).wrapping_mul(ODD))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_and_every_place_counts() {
        let words = [3, 0, u64::MAX, 7];
        let sum = checksum(words);
        for place in 0..words.len() {
            for bit in 0..64 {
                let mut other = words;
                other[place] ^= 1 << bit;
                assert_ne!(checksum(other), sum, "bit {bit} of word {place}");
            }
        }
        assert_ne!(checksum([0, 3, u64::MAX, 7]), sum);
        assert_ne!(checksum([3, 0, u64::MAX]), sum);
    }
}
