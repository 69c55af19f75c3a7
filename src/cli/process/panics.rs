//! A fault of the program is told in a sentence.

use std::panic::{self, PanicHookInfo};
use std::sync::{Mutex, PoisonError};

/// What the first panic said and where it was.
static FIRST: Mutex<Option<String>> = Mutex::new(None);

/// From now on a panic says nothing of itself, unless `RUST_BACKTRACE` asks for it.
pub(super) fn keep_quiet() {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if std::env::var_os("RUST_BACKTRACE").is_some_and(|wanted| wanted != "0") {
            usual(info);
        }
        FIRST.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_with(|| what_and_where(info));
    }));
}

/// The first panic, in words.
pub(super) fn first() -> String {
    FIRST.lock().unwrap_or_else(PoisonError::into_inner).clone().unwrap_or_else(|| "a thread ended".to_owned())
}

fn what_and_where(info: &PanicHookInfo) -> String {
    let what = info.payload_as_str().unwrap_or("a panic");
    match info.location() {
        Some(place) => format!("{what} ({}:{})", place.file(), place.line()),
        None => what.to_owned(),
    }
}
