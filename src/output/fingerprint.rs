//! A short number that stands for a text.

/// FNV-1a hash of 64 bits: among `n` texts two agree with a probability of about `n^2/4e19`.
pub fn fingerprint(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    /// Published test vectors of FNV-1a 64.
    #[test]
    fn known_texts_have_their_known_numbers() {
        for (text, hash) in
            [("", 0xcbf2_9ce4_8422_2325), ("a", 0xaf63_dc4c_8601_ec8c), ("foobar", 0x8594_4171_f739_67e8)]
        {
            assert_eq!(super::fingerprint(text), hash);
        }
    }
}
