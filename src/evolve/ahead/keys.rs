//! What each frame of a film is made of, as a key: two films with the same key of a frame have the same frame, to the last bit.
//!
//! A frame's key is made of the key of the frame before and of all that the frame asks for: its time and the bits of
//! lengths, bending angles and places of pins, then and at the times between. The first key is made of what all frames depend on:
//! the mesh, the start, the class, the phases and constants, and [`ALGORITHM`].

use crate::digest::{Digest, Key};
use crate::evolve::course::{Course, metric_of};
use crate::evolve::error::EvolveError;
use crate::evolve::follow::Station;
use crate::evolve::pace::{Fold, HalfwayModel, OverAPass, Pace, Settling};
use crate::evolve::program::{AskedClass, Orientation, Polishing, Program, Start};
use crate::evolve::relax::{Phase, TimeStep};
use crate::frames::Method;
use crate::mesh::shapes::FigureEight;
use crate::mesh::{Component, Mesh, Surface, VertexId};
use crate::metric::Metric;
use crate::timeline::Clock;
use glam::DVec3;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Counts the ways in which frames have been computed. Whoever changes results raises it, so that no film goes on with
/// frames of another way; a test compares small films with what they were.
pub const ALGORITHM: u32 = 4;

/// The key of every frame of a film, in order; `origin` stands for what they all depend on.
pub(in crate::evolve) fn keys_of(origin: Key, clock: &Clock, ahead: &mut LookAhead) -> Result<Vec<Key>, EvolveError> {
    let asked = clock.times().map(|time| ahead.asked_at(time)).collect::<Result<Vec<_>, _>>()?;
    let mut key = origin;
    if clock.is_looping() {
        // The first frame of a loop comes after a lap, and so after all others.
        let lap = asked.iter().fold(Digest::of("lap").key(origin), |digest, &asked| digest.key(asked));
        key = lap.key(ahead.asked_at(clock.end())?).finish();
    }
    let chain = |asked: &Key| {
        key = Digest::of("frame").key(key).key(*asked).finish();
        key
    };
    Ok(asked.iter().map(chain).collect())
}

/// Goes through the times of a film as the simulation will.
pub(in crate::evolve) struct LookAhead<'a> {
    course: &'a mut Course,
    components: Vec<&'a Component>,
    /// Where the metric is followed through times between those of frames.
    settling: Option<Settling>,
    /// How often the parts of the way may be halved for other reasons than that a step fails.
    halvings: usize,
    before: Option<Before>,
}

/// What was asked for at the frame before.
struct Before {
    time: f64,
    metric: Arc<Metric>,
    pins: Vec<(VertexId, DVec3)>,
}

impl<'a> LookAhead<'a> {
    pub fn new(course: &'a mut Course, components: Vec<&'a Component>, pace: Pace, fold: Fold) -> LookAhead<'a> {
        let settling = if let Pace::Settle(settling) = pace { Some(settling) } else { None };
        LookAhead { course, components, settling, halvings: fold.halvings(pace), before: None }
    }

    /// A key of what the frame at a time asks for, after the frame that was asked about before.
    fn asked_at(&mut self, time: f64) -> Result<Key, EvolveError> {
        let LookAhead { course, components, settling, halvings, before } = self;
        if !course.changes() && before.is_some() {
            return Ok(Digest::of("the same").finish());
        }
        let now = Before { time, metric: course.metric(time)?.metric.clone(), pins: course.pins().at(time)? };
        let mut digest = Digest::of("asked");
        if let (Some(settling), Some(before)) = (settling, before.as_ref()) {
            let parts = |component: &&Component| now.parts_after(before, component, settling);
            for parts in components.iter().map(parts).collect::<Result<BTreeSet<_>, _>>()? {
                let parts = parts << *halvings;
                for part in 1..parts {
                    let between = before.time + (time - before.time) * part as f64 / parts as f64;
                    digest = add(digest, course, between)?;
                }
            }
        }
        digest = add(digest, course, time)?;
        *before = Some(now);
        Ok(digest.finish())
    }
}

impl Before {
    /// In how many parts a component gets here.
    fn parts_after(&self, before: &Before, component: &Component, settling: &Settling) -> Result<usize, EvolveError> {
        let [from, to] = [before, self].map(|at| metric_of(component, &at.metric, at.time));
        let [from, to] = [from?, to?];
        let own = |at: &Before| {
            let here =
                |&(v, place): &(VertexId, DVec3)| Some((VertexId::new(component.vertices.here(v.index())?), place));
            at.pins.iter().filter_map(here).collect::<Vec<_>>()
        };
        let [from_pins, to_pins] = [before, self].map(own);
        let there = Station { metric: &to, pins: &to_pins };
        Station { metric: &from, pins: &from_pins }.parts_to(&there, &component.mesh, self.time, settling)
    }
}

/// All that is asked for at a time.
fn add(digest: Digest, course: &mut Course, time: f64) -> Result<Digest, EvolveError> {
    let changes = course.changes();
    let asked = course.metric(time)?;
    let digest = digest.numbers(asked.metric.edge_lengths().iter().copied()).perhaps(asked.curvature_error);
    let pins = course.pins().at(time)?;
    let digest =
        digest.counts(pins.iter().map(|(v, _)| v.index())).numbers(pins.iter().flat_map(|(_, p)| p.to_array()));
    let digest = digest.numbers(course.angles(time)?.into_iter().flatten());
    // Where nothing changes with time, it is but a label.
    Ok(if changes { digest.number(time) } else { digest })
}

/// A key of what all frames depend on.
pub(in crate::evolve) fn origin_of(surface: &Surface, program: &Program) -> Key {
    // Every field is named here, so that none is forgotten. What changes with time is asked for frame by frame.
    let Program {
        metric: _,
        bending,
        pins: _,
        class,
        start,
        orientation,
        schedule,
        accuracy,
        is_smooth,
        clock,
        pace,
        fold,
        polish,
        max_bending_growth,
    } = program;
    let Surface { mesh, positions, .. } = surface;
    let digest = Digest::of("origin").count(ALGORITHM as usize);
    let digest = add_mesh(digest, mesh, positions.as_deref());
    let digest = match bending {
        Some(bending) => digest.text("bent").counts(bending.is_asked().iter().map(|&asked| usize::from(asked))),
        None => digest.text("flat"),
    };
    let digest = match class {
        AskedClass::OfMesh => digest.text("of mesh"),
        AskedClass::OfPositions => digest.text("of positions"),
        AskedClass::Of(class) => digest.text("of").counts(class.digits().iter().map(|&q| usize::from(q))),
        AskedClass::All => digest.text("all"),
    };
    let digest = match start {
        Start::Random(seed) => digest.text("random").count(*seed as usize),
        Start::Spectral => digest.text("spectral"),
        Start::Shape { positions, is_mirrored } => {
            digest.text("shape").count(usize::from(*is_mirrored)).numbers(positions.iter().flat_map(|p| p.to_array()))
        }
    };
    let digest = digest.text(match orientation {
        Orientation::Outward => "outward",
        Orientation::AsItComes => "as it comes",
    });
    let digest = schedule.phases().iter().fold(digest.count(schedule.phases().len()), add_phase);
    let digest = digest.perhaps(*accuracy).count(usize::from(*is_smooth)).count(usize::from(clock.is_looping()));
    let digest = match pace {
        Pace::EachClass => digest.text("each class"),
        Pace::Steps(steps) => digest.text("steps").count(*steps),
        Pace::Settle(settling) => digest
            .text("settle")
            .numbers([settling.tolerance_radians(), settling.max_strain()])
            .count(settling.max_steps()),
        Pace::BothWays(OverAPass { halfway, stiffness }) => {
            let (digest, frames) = (digest.text("both ways"), clock.frames());
            let digest = match halfway {
                HalfwayModel::Sphere { lobes } => digest.counts([*lobes, frames]),
                HalfwayModel::Torus(FigureEight { columns, rows, ring_radius, tube_radius, slides }) => digest
                    .text("torus")
                    .counts([*columns, *rows, usize::from(*slides), frames])
                    .numbers([*ring_radius, *tube_radius]),
            };
            digest.number(*stiffness)
        }
    };
    // A film that may fold has the keys that it had before one could refuse.
    let digest = match fold {
        Fold::Allow => digest,
        Fold::Refuse => digest.text("no folds"),
    };
    // A film that is not polished has the keys that it had before there was polish.
    let digest = match polish {
        Polishing::Off => digest,
        Polishing::Last => digest.text("polish last").count(clock.frames()).number(*max_bending_growth),
        Polishing::Every => digest.text("polish every").number(*max_bending_growth),
    };
    digest.finish()
}

fn add_mesh(digest: Digest, mesh: &Mesh, positions: Option<&[DVec3]>) -> Digest {
    digest
        .count(mesh.vertex_count())
        .counts(mesh.triangles().into_iter().flatten().map(|v| v as usize))
        .numbers(positions.into_iter().flatten().flat_map(|p| p.to_array()))
}

fn add_phase(digest: Digest, phase: &Phase) -> Digest {
    let Phase {
        method,
        stiffness,
        dt,
        turn_radians,
        feedback,
        periods,
        crease,
        accelerate,
        tolerance_radians,
        min_steps,
        max_steps,
        untangle_steps,
        solver_tolerance,
    } = *phase;
    let method = match method {
        Method::Implicit => "implicit",
        Method::Gradient => "gradient",
        Method::Newton => "newton",
    };
    let (unit, length) = match dt {
        TimeStep::FaceAreas(areas) => ("face areas", areas),
        TimeStep::ShareOfSurface(share) => ("share", share),
    };
    digest
        .text(method)
        .numbers(stiffness)
        .text(unit)
        .numbers([length, feedback, periods, crease, tolerance_radians, solver_tolerance])
        .perhaps(turn_radians)
        .counts([usize::from(accelerate), min_steps, max_steps, untangle_steps])
}
