//! Chunks are short, even, and all frames.

use super::{chunks, in_words};
use crate::cli::FrameRange;

#[test]
fn frames_in_words_are_those_frames() {
    for (text, shown) in [
        ("7", "7"),
        ("1-20,30-40:2", "1-20,30-40:2"),
        ("3,1,2", "1-3"),
        ("1,3", "1,3"),
        ("1,2,5,9,13,14", "1-2,5-13:4,14"),
        ("1-9:4,10", "1-9:4,10"),
    ] {
        let frames = text
            .parse::<FrameRange>()
            .map_err(|error| error.to_string())
            .and_then(|range| range.frames(40).map_err(|error| error.to_string()));
        assert_eq!(frames.map(|frames| in_words(&frames)), Ok(shown.to_owned()));
    }
}

#[test]
fn chunks_are_even_and_together_all_frames() {
    for count in [1, 2, 9, 10, 11, 24, 999, 10_000, 123_457] {
        let frames: Vec<usize> = (1..=count).map(|k| k + k / 7).collect();
        let pieces = chunks(&frames);
        assert!(pieces.len() <= 1000);
        let lists: Vec<Vec<usize>> = pieces
            .iter()
            .map(|piece| {
                piece.parse::<FrameRange>().ok().and_then(|range| range.frames(2 * count).ok()).unwrap_or_default()
            })
            .collect();
        assert_eq!(lists.concat(), frames);
        let sizes = || lists.iter().map(Vec::len);
        assert!(sizes().max() <= sizes().min().map(|least| least + 1), "{count}");
        assert!(count > 10_000 || sizes().max() <= Some(10), "{count}");
    }
}
