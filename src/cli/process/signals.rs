//! Signals that ask the program to end.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Whether the program is asked to end, and by which signal.
#[derive(Clone, Debug, Default)]
pub(in crate::cli) struct Signals {
    asked: Arc<AtomicBool>,
    /// Whether the next one ends it at once.
    impatient: Arc<AtomicBool>,
    /// 0 for none.
    number: Arc<AtomicUsize>,
}

impl Signals {
    /// From now on the first of these signals asks the program to end, and one that comes later ends it at once, if it
    /// `writes`; what only reads may end anywhere. Signals that the program was started to ignore, as by `nohup`, stay ignored.
    pub fn new(writes: bool) -> Signals {
        let signals = Signals::default();
        for number in TO_END.iter().copied().filter(|&number| writes && !is_ignored(number)) {
            // A signal that cannot be watched does what it always does.
            let _ = flag::register_conditional_shutdown(number, 128 + number, signals.impatient.clone());
            let _ = flag::register_usize(number, signals.number.clone(), number as usize);
            let _ = flag::register(number, signals.asked.clone());
        }
        // A file that grows beyond its limit is an error when it is written, and not the end of the program.
        #[cfg(unix)]
        let _ = flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
        signals
    }

    /// From now on a signal ends the program at once. Those who wrap a program, as `timeout` and `make` do, send it the
    /// first one twice, which is no sign of impatience yet.
    pub fn be_impatient(&self) {
        self.impatient.store(true, Ordering::SeqCst);
    }

    /// The flag that is raised by a signal.
    pub fn flag(&self) -> Arc<AtomicBool> {
        self.asked.clone()
    }

    /// The signal that asked the program to end.
    pub fn received(&self) -> Option<u8> {
        let number = if self.asked.load(Ordering::SeqCst) { self.number.load(Ordering::SeqCst) } else { 0 };
        u8::try_from(number).ok().filter(|&number| number > 0)
    }
}

/// When a terminal is closed it sends SIGHUP. It is watched where one can find out that `nohup` does not want that.
#[cfg(target_os = "linux")]
const TO_END: &[i32] = &[SIGINT, SIGTERM, signal_hook::consts::SIGHUP];
#[cfg(not(target_os = "linux"))]
const TO_END: &[i32] = &[SIGINT, SIGTERM];

/// Whether the program was started with a signal ignored. Where nobody says so, it was not.
fn is_ignored(number: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0);
    mask >> (number - 1) & 1 == 1
}
