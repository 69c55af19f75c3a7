//! Frames that are still being computed while pictures are made of those that are there.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// Tells those who make pictures which frames of a film are on disk, and those who compute frames whether anybody still
/// wants them. Waiting blocks the thread: it must not be one that the frames are computed on.
#[derive(Debug, Default)]
pub struct Arrivals {
    now: Mutex<Now>,
    changed: Condvar,
    /// Somebody may raise this flag at any time; then no more are wanted.
    given_up: Arc<AtomicBool>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Now {
    /// All frames up to this one are there.
    reached: usize,
    /// No more will come.
    is_over: bool,
    /// No more are wanted.
    is_stopped: bool,
}

impl Arrivals {
    /// Of a film that is on disk as far as it goes: nobody waits.
    pub fn over() -> Arrivals {
        let now = Now { reached: usize::MAX, is_over: true, is_stopped: false };
        Arrivals { now: Mutex::new(now), ..Arrivals::default() }
    }

    /// As long as this flag is down.
    pub fn unless(self, given_up: Arc<AtomicBool>) -> Arrivals {
        Arrivals { given_up, ..self }
    }

    /// No more frames will come when this is dropped, also by a panic: nobody waits for ever.
    pub fn supply(&self) -> impl Drop {
        Supply(self)
    }

    /// No more frames are wanted when this is dropped by a panic.
    pub fn demand(&self) -> impl Drop {
        Demand(self)
    }

    /// All frames up to this one are on disk.
    pub fn reach(&self, frame: usize) {
        self.change(|now| now.reached = frame);
    }

    /// No more frames will come.
    pub fn end(&self) {
        self.change(|now| now.is_over = true);
    }

    /// No more frames are wanted. Says whether they would have come.
    pub fn stop(&self) -> bool {
        let mut would_have_come = false;
        self.change(|now| {
            would_have_come = !now.is_over;
            now.is_stopped = true;
        });
        would_have_come
    }

    /// Whether no more frames are wanted.
    pub fn is_stopped(&self) -> bool {
        self.now().is_stopped || self.given_up.load(Ordering::SeqCst)
    }

    /// Whether a frame is on disk by now.
    pub fn has(&self, frame: usize) -> bool {
        self.now().reached >= frame
    }

    /// Waits until a frame is on disk; says whether it is, for it may be that no more will come.
    pub fn wait_for(&self, frame: usize) -> bool {
        let waiting = |now: &mut Now| !now.is_over && now.reached < frame;
        let now = self.changed.wait_while(self.now(), waiting).unwrap_or_else(PoisonError::into_inner);
        now.reached >= frame
    }

    fn change(&self, change: impl FnOnce(&mut Now)) {
        change(&mut self.now());
        self.changed.notify_all();
    }

    /// What is known stays right if a thread that knew it panics.
    fn now(&self) -> MutexGuard<'_, Now> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

struct Supply<'a>(&'a Arrivals);

impl Drop for Supply<'_> {
    fn drop(&mut self) {
        self.0.end();
    }
}

struct Demand<'a>(&'a Arrivals);

impl Drop for Demand<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.stop();
        }
    }
}
