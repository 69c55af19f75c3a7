//! Neither half of a run waits for ever.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use super::*;

/// Whether this panics, and does not wait for ever.
fn panics(work: impl FnOnce() + Send + 'static) -> bool {
    let (tell, told) = mpsc::channel();
    thread::spawn(move || tell.send(catch_unwind(AssertUnwindSafe(work)).is_err()));
    told.recv_timeout(Duration::from_secs(30)).expect("it waits for ever")
}

#[test]
fn a_panic_on_one_side_ends_the_other() {
    assert!(panics(|| {
        let arrivals = Arrivals::default();
        let take = || if arrivals.wait_for(1) { Ok(()) } else { Err(()) };
        let _ = side_by_side(&arrivals, || panic!("a fault of the supply"), take);
    }));
    assert!(panics(|| {
        let arrivals = Arrivals::default();
        let supply = || {
            while !arrivals.is_stopped() {
                thread::sleep(Duration::from_millis(1));
            }
        };
        let _ = side_by_side::<_, (), ()>(&arrivals, supply, || panic!("a fault of the one who takes"));
    }));
}

#[test]
fn each_side_tells_its_outcome() {
    let arrivals = Arrivals::default();
    let supply = || arrivals.reach(1);
    let take = || if arrivals.wait_for(1) { Ok(1) } else { Err("nothing came") };
    assert_eq!(side_by_side(&arrivals, supply, take), (Some(()), Ok(1)));
    let arrivals = Arrivals::default();
    let take = || if arrivals.wait_for(1) { Ok(1) } else { Err("nothing came") };
    assert_eq!(side_by_side(&arrivals, || (), take), (Some(()), Err((false, "nothing came"))));
}
