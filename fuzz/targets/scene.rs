//! Scenes, read only.
#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| {
    if let Err(mistakes) = immerse::Scene::parse(text, "fuzz", ".".as_ref()) {
        let _ = mistakes.to_string();
    }
});
