//! `--frames 1-20,30-40:2`.

use immerse::cli::{FrameRange, FrameRangeError};

fn frames(text: &str) -> Vec<usize> {
    text.parse::<FrameRange>().unwrap().frames(1000).unwrap()
}

#[test]
fn ranges_name_frames_in_order_and_once() {
    assert_eq!(frames("7"), [7]);
    assert_eq!(frames("3-5"), [3, 4, 5]);
    assert_eq!(frames("1-10:4"), [1, 5, 9]);
    assert_eq!(frames("5-5:3"), [5]);
    assert_eq!(frames("30-34:2, 1-3,2-4"), [1, 2, 3, 4, 30, 32, 34]);
    assert_eq!(frames("007"), [7]);
}

#[test]
fn ranges_print_as_they_are_written() {
    for text in ["7", "1-20,30-40:2", "1-240:4"] {
        assert_eq!(text.parse::<FrameRange>().unwrap().to_string(), text);
    }
    assert_eq!("5-5:3, 1-2:1".parse::<FrameRange>().unwrap().to_string(), "5,1-2");
}

#[test]
fn what_is_no_range_is_refused_with_a_remedy() {
    use FrameRangeError::*;
    let error = |text: &str| text.parse::<FrameRange>().unwrap_err();
    for text in ["", "a", "1,,2", "1-", "-3", "1-2-3", "1:2", "1-5:", "1-5:x", "+1", "1-+5", "1.5", "1-5:2:2", "٣"] {
        assert!(matches!(error(text), NotARange(_)), "{text}: {:?}", error(text));
    }
    assert!(matches!(error("99999999999999999999999"), NotARange(_)));
    assert_eq!(error("4,0-3"), Zero("0-3".into()));
    assert_eq!(error("5-3"), Backward("5-3".into()));
    assert_eq!(error("1-3:0"), ZeroStep("1-3:0".into()));
    assert!(error("x").to_string().contains("write for example 7, 1-20 or 1-240:4"));
}

#[test]
fn frames_beyond_the_end_are_refused_before_they_are_listed() {
    let range: FrameRange = "1-18446744073709551615".parse().unwrap();
    let error = range.frames(24).unwrap_err();
    assert_eq!(error, FrameRangeError::Beyond { frame: usize::MAX, frame_count: 24 });
    // The step may keep a range inside that would end beyond.
    assert_eq!("1-10:4".parse::<FrameRange>().unwrap().frames(9), Ok(vec![1, 5, 9]));
    assert!("1-9:4".parse::<FrameRange>().unwrap().frames(8).is_err());
}
