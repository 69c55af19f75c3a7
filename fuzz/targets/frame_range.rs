//! Frame ranges.
#![no_main]

use immerse::cli::FrameRange;

libfuzzer_sys::fuzz_target!(|text: &str| {
    if let Ok(range) = text.parse::<FrameRange>() {
        let _ = range.frames(1000);
    }
});
