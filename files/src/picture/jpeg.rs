//! Tells a whole JPEG file from one that is cut off.

/// Marks the start of a segment.
const MARK: u8 = 0xff;

/// Returns whether the picture data of a JPEG file has an end. A file that does not follow the form up to
/// its data counts as whole; the decoder judges it.
#[must_use]
pub fn is_whole(bytes: &[u8]) -> bool {
    // A thumbnail in a segment has an end of its own, so segments are skipped.
    let mut at = 2;
    loop {
        let (kind, length) = match bytes.get(at..at + 4) {
            Some(&[MARK, kind, high, low]) => (kind, usize::from(u16::from_be_bytes([high, low]))),
            Some(_) => return true,
            None => return false,
        };
        at += 2 + length;
        // Start of scan: the data follow.
        if kind == 0xda {
            let data = bytes.get(at..).unwrap_or_default();
            return data.windows(2).any(|pair| pair == [MARK, 0xd9]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_whole_with_the_mark_behind_its_data() {
        // A thumbnail with an end of its own, and a scan.
        let file = b"\xff\xd8\xff\xe1\0\x06\xff\xd9\xff\xd9\xff\xda\0\x02data\xff\xd9";
        assert!(is_whole(file));
        for length in 2..file.len() {
            assert!(!is_whole(&file[..length]), "{length} bytes");
        }
        assert!(is_whole(b"\xff\xd8 not a segment"));
    }
}
