//! From the lower triangle of a matrix to its Cholesky factor, panel by panel.

use super::dense::{Finish, Part, Products, STRIP};
use super::elimination::{Elimination, Update};
use super::products::{Source, Target, subtract_product};
use super::supernodes::Supernodes;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::ops::Range;

/// Products and sums in a panel of the trunk below which strips do not pay.
const WORK_OF_STRIPS: usize = 500_000;

/// Finished panels from one on.
#[derive(Clone, Copy)]
struct Finished<'a> {
    real: &'a [f64],
    imaginary: &'a [f64],
    /// Where they begin among all.
    begin: usize,
}

/// What is factorized.
#[derive(Clone, Copy)]
struct Plan<'a> {
    supernodes: &'a Supernodes,
    elimination: &'a Elimination,
}

/// From the lower triangle of a matrix to its factor, in place; else the row whose pivot is not positive.
pub(super) fn factorize(
    supernodes: &Supernodes,
    elimination: &Elimination,
    real: &mut [f64],
    imaginary: &mut [f64],
) -> Result<(), usize> {
    let plan = Plan { supernodes, elimination };
    let mut branches = Vec::with_capacity(elimination.branches.len());
    let (mut rest, mut begin) = (Part { real: &mut *real, imaginary: &mut *imaginary }, 0);
    for branch in &elimination.branches {
        let ends = [branch.start, branch.end - 1].map(|s| supernodes.panel(s));
        let (_, from) = rest.split(ends[0].start - begin);
        let (own, after) = from.split(ends[1].end - ends[0].start);
        (rest, begin) = (after, ends[1].end);
        branches.push((branch.clone(), own));
    }
    let workspace = || Workspace::of(supernodes);
    let eliminate = |workspace: &mut Workspace, (branch, panels): (Range<usize>, Part)| {
        Arch::new().dispatch(Branch { plan, branch, panels, workspace })
    };
    branches.into_par_iter().map_init(workspace, eliminate).reduce(|| Ok(()), Result::and)?;
    let mut trunk = workspace();
    for &s in &elimination.trunk {
        let panel = supernodes.panel(s);
        let (before, from) = Part { real: &mut *real, imaginary: &mut *imaginary }.split(panel.start);
        let (own, _) = from.split(panel.len());
        let finished = Finished { real: before.real, imaginary: before.imaginary, begin: 0 };
        trunk.enter(supernodes, s);
        plan.grow(s, own, finished, &mut trunk)?;
    }
    Ok(())
}

/// What is used again and again on one thread, for any supernodes.
struct Workspace {
    /// Per row of the panel at hand: which one it is there.
    local: Vec<u32>,
    products: Products,
}

impl Workspace {
    fn of(supernodes: &Supernodes) -> Workspace {
        Workspace { local: vec![0; supernodes.of_row.len()], products: Products::default() }
    }

    /// Numbers the rows of the panel of a supernode.
    fn enter(&mut self, supernodes: &Supernodes, s: usize) {
        let columns = supernodes.columns(s);
        for (number, &row) in supernodes.below(s).iter().enumerate() {
            self.local[row as usize] = (columns.len() + number) as u32;
        }
        for (number, row) in columns.enumerate() {
            self.local[row] = number as u32;
        }
    }
}

/// A branch, on the calling thread.
struct Branch<'a> {
    plan: Plan<'a>,
    branch: Range<usize>,
    panels: Part<'a>,
    workspace: &'a mut Workspace,
}

impl WithSimd for Branch<'_> {
    type Output = Result<(), usize>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Result<(), usize> {
        let Branch { plan, branch, mut panels, workspace } = self;
        let Plan { supernodes, elimination } = plan;
        let begin = supernodes.panel(branch.start).start;
        for s in branch {
            let panel = supernodes.panel(s);
            let (before, from) = panels.reborrow().split(panel.start - begin);
            let (mut own, _) = from.split(panel.len());
            let finished = Finished { real: before.real, imaginary: before.imaginary, begin };
            workspace.enter(supernodes, s);
            let Workspace { local, products } = &mut *workspace;
            let (columns, height) = (supernodes.columns(s), supernodes.height(s));
            let (updates, part) = (elimination.updates(s), own.reborrow());
            let all = 0..columns.len();
            Take { supernodes, updates, finished, local, columns: all, height, part, products }.with_simd(simd);
            let finish = Finish { part: own, height, products, in_strips: false };
            finish.with_simd(simd).map_err(|column| columns.start + column)?;
        }
        Ok(())
    }
}

impl Plan<'_> {
    /// Eliminates a supernode of the trunk, strip by strip where it is large.
    fn grow(self, s: usize, mut own: Part, finished: Finished, workspace: &mut Workspace) -> Result<(), usize> {
        let Plan { supernodes, elimination } = self;
        let (columns, height, updates) = (supernodes.columns(s), supernodes.height(s), elimination.updates(s));
        let in_strips = columns.len() > STRIP && columns.len() * columns.len() * height >= WORK_OF_STRIPS;
        let Workspace { local, products } = workspace;
        let take_into = |columns: Range<usize>, part: Part, products: &mut Products| {
            Arch::new().dispatch(Take { supernodes, updates, finished, local, columns, height, part, products });
        };
        if in_strips {
            own.reborrow().strips(height).into_par_iter().with_max_len(1).for_each_init(
                Products::default,
                |products, (begin, part)| {
                    take_into(begin..columns.len().min(begin + STRIP), part, products);
                },
            );
        } else {
            take_into(0..columns.len(), own.reborrow(), products);
        }
        let finish = Finish { part: own, height, products, in_strips };
        Arch::new().dispatch(finish).map_err(|column| columns.start + column)
    }
}

/// Takes from some columns of a panel what finished ones have in them.
struct Take<'a> {
    supernodes: &'a Supernodes,
    updates: &'a [Update],
    finished: Finished<'a>,
    /// Per row: which one it is in the panel.
    local: &'a [u32],
    /// Of the panel.
    columns: Range<usize>,
    height: usize,
    part: Part<'a>,
    products: &'a mut Products,
}

impl WithSimd for Take<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Take { supernodes, updates, finished, local, columns: strip, height, part, products } = self;
        let Products { rows, columns, scratch } = products;
        for Update { from, rows: [begin, end] } in updates {
            let source = *from as usize;
            let below = supernodes.below(source);
            let within = &below[*begin as usize..*end as usize];
            let before = |column: usize| within.partition_point(|&row| (local[row as usize] as usize) < column);
            let [first, last] = [before(strip.start), before(strip.end)];
            if first == last {
                continue;
            }
            let skipped = *begin as usize + first;
            rows.clear();
            rows.extend(below[skipped..].iter().map(|&row| local[row as usize]));
            columns.clear();
            columns.extend(rows[..last - first].iter().map(|&row| row - strip.start as u32));
            let width = supernodes.columns(source).len();
            let place = supernodes.panel(source).start + width + skipped - finished.begin;
            let source = Source {
                real: &finished.real[place..],
                imaginary: finished.imaginary.get(place..).unwrap_or_default(),
                height: supernodes.height(source),
                width,
            };
            let target = Target { real: part.real, imaginary: part.imaginary, height, columns, rows };
            subtract_product(simd, source, target, scratch);
        }
    }
}
