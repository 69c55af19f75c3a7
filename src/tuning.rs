//! The numbers that tune the method, each with its reason. They were found on the bunny, tori of all classes, disks, the
//! hare, the double duck and surfaces of genus 2; what was tried and did not pay is in ARCHITECTURE.md.

/// How often random frames are drawn anew, at most, when rims are left in the end. On surfaces of genus 2 some classes
/// took five attempts.
pub const MAX_RESTARTS: usize = 8;

/// How many faces around rims are given smooth frames where rims are left in the end, in steps across edges, one patch
/// after the other. Two undo most single edges that folded over; what sixteen do not undo is better drawn anew.
pub const PATCH_RINGS: [usize; 4] = [2, 4, 8, 16];

/// Steps of the last phase after that, at most. The surface around a patch has settled, so that a quarter of what the phase
/// may take will do.
pub const MENDING_STEPS: usize = 100;

/// Δt of the first phase, as a share of the area of the surface. All strains cost the same there, so that a step of any
/// length is one solve; longer steps gain nothing.
pub const SMOOTHING_SHARE: f64 = 1.0 / 28.0;

/// Residual of the linear solve of a step relative to that of standing still, where frames have nearly settled. Tighter
/// solves did not save steps.
pub const SOLVER_TOLERANCE: f64 = 1e-2;

/// Mean turn per step in radians (0.1°) from which on solves on the way to a later phase become looser in proportion.
/// A rough solution leads as far as an exact one as long as frames turn by much.
pub const SETTLED_TURN: f64 = 0.1 / 180.0 * std::f64::consts::PI;

/// How much looser than [`SOLVER_TOLERANCE`] such a solve may be. At a tenth everywhere, crumpled tori end at a larger error.
pub const LOOSEST_SOLVE: f64 = 10.0;

/// Single precision does for linear solves that are no tighter than this, and has half the bytes.
pub const SINGLE_PRECISION_TOLERANCE: f64 = 1e-4;

/// Single precision does for time steps that are no longer than this many mean face areas. Beyond them the mass matrix
/// is lost in the rounding of Δt L.
pub const SINGLE_PRECISION_DT: f64 = 1e4;

/// Iterations of a linear solve. No step took more on a mesh of ten million faces.
pub const MAX_SOLVER_ITERATIONS: usize = 5000;

/// The least factor from one Δt to the next, where it is chosen by how far frames turn.
pub const LEAST_DT_FACTOR: f64 = 0.5;

/// The largest factor from one Δt to the next. It is nearer to 1 than the least one, because a step that was too long
/// does more harm than one that was too short.
pub const LARGEST_DT_FACTOR: f64 = 1.5;

/// The shortest Δt in mean face areas, where it is chosen.
pub const SHORTEST_DT: f64 = 0.1;

/// The longest Δt in mean face areas, where it is chosen. Longer steps gain nothing.
pub const LONGEST_DT: f64 = 1e3;

/// Bending beyond which a spring holds creases open, in radians (155°). Beyond 180° they turn into rims.
pub const CREASE_ANGLE: f64 = 155.0 / 180.0 * std::f64::consts::PI;

/// How many earlier steps Anderson acceleration combines. Ten take as many steps.
pub const ACCELERATION_WINDOW: usize = 5;

/// An accelerated correction is at most this many steps long on the whole. With twenty, some surfaces take more steps.
pub const ACCELERATION_REACH: f64 = 5.0;

/// In a single face it is at most this many times that mean, so that no face is thrown across its neighbours.
pub const ACCELERATION_REACH_OF_A_FACE: f64 = 4.0;

/// Relative regularization of the normal equations of the acceleration, whose rows become nearly parallel.
pub const ACCELERATION_REGULARIZATION: f64 = 1e-8;

/// Steps at a metric that a film only passes on its way to the time of a frame; it has to settle there only.
pub const STEPS_ON_THE_WAY: usize = 3;

/// Parts that the way from one frame to the next may have. At 5 % each they double all lengths a hundred times over, or
/// lead a pin across a surface of a million faces; what takes more is a mistake, and would not end.
pub const MOST_PARTS_OF_A_FRAME: usize = 1000;

/// How often the parts of the way to a frame are halved when a step fails, before the film is given up.
pub const HALVINGS_OF_A_PART: usize = 3;

/// How often the steps from one frame of a film of the relaxation to the next are halved where something folds, before the film is given
/// up. A hinge that folds after a hundredth of a step folds whatever the step.
pub const HALVINGS_OF_STEPS: usize = 6;

/// Faces times frames up to which a film is looked ahead at frame by frame, some seconds' work; of a longer one frames
/// are taken evenly from all of it.
pub const LOOK_AHEAD: usize = 20_000_000;

/// Steps between the frames of a film of the relaxation that does not say how many.
pub const STEPS_PER_FRAME: usize = 2;

/// Weights of bending that a frame of a smooth film is settled with first, the stiffest that fits. After the last of
/// them comes the weight of the phase itself.
pub const STIFFER_BENDING: [f64; 2] = [5e-3, 1e-3];

/// L2 length error up to which lengths are kept well enough to stay that stiff.
pub const STIFF_LENGTH_ERROR: f64 = 1e-3;

/// Weight of bending that dents of a convex metric do not withstand.
pub const IRONING_BENDING: f64 = 0.1;

/// The depth from which on a dent of a convex metric is one, as a share of the radius of the round sphere of that area.
pub const DENT_DEPTH: f64 = 0.01;

/// How far a film may turn from one frame to the next toward the positions of its mesh, in degrees. Small turns cannot
/// add up then, and nobody sees it turn.
pub const LARGEST_TURN_DEGREES: f64 = 2.0;

/// Room between components that nothing says the places of, as a share of their extents.
pub const GAP_BETWEEN_COMPONENTS: f64 = 0.25;

/// How much nearer to the mesh's positions, as a factor, a mirror image must be to be taken. A flat surface is as near as
/// its mirror image.
pub const NEARER_MIRROR_IMAGE: f64 = 0.999;

/// Pinned lengths that differ from those of the metric by a smaller share are taken for equal: what is reached differs
/// by more.
pub const PINNED_LENGTH_TOLERANCE: f64 = 1e-3;

/// Shortest paths between pins are looked for from so many of the pinned vertices, spread over all of them.
pub const PINNED_PATH_SOURCES: usize = 16;

/// The angle from which on hinges are held open while a surface is polished, in radians (140°).
pub const BARRIER_ANGLE: f64 = 140.0 / 180.0 * std::f64::consts::PI;

/// Weight of that barrier, relative to bending.
pub const BARRIER_WEIGHT: f64 = 10.0;

/// What holds a surface to its place while it is polished, so that rigid motions have an answer; strain weighs 1.
pub const POLISH_ANCHOR: f64 = 1e-13;

/// The least share of its area that a face may be left with by a step of polish.
pub const FACE_AREA_LEFT: f64 = 0.2;

/// The largest turn of a hinge in a step of polish, in radians (86°). An angle that passes 180° jumps by more.
pub const LARGEST_HINGE_TURN: f64 = 1.5;

/// By which share polish may make the mean bending angle grow, where nothing else is asked for.
pub const MAX_BENDING_GROWTH: f64 = 0.2;

/// The part of what the slope promises that a step of polish must keep (Armijo).
pub const ARMIJO: f64 = 1e-4;

/// How often a step of polish is halved before it is given up.
pub const HALVINGS_OF_A_POLISH_STEP: usize = 20;

/// What the weight of bending is multiplied with between two steps of polish, as a rule.
pub const POLISH_FADE: f64 = 0.5;

/// The same after whole steps that move no vertex farther than [`FAR_MOVE`], and than [`NEAR_MOVE`].
pub const FAST_FADES: [f64; 2] = [0.1, 0.01];

/// Steps of polish with the same weight of bending. With one, tori end with more bending.
pub const STEPS_PER_STIFFNESS: usize = 2;

/// A short move in mean edge lengths.
pub const FAR_MOVE: f64 = 0.03;

/// A very short move in mean edge lengths.
pub const NEAR_MOVE: f64 = 0.003;

/// The weight of bending at which polish ends.
pub const SOFTEST_POLISH: f64 = 1e-30;

/// L2 length error at which edges have their lengths: that of rounding.
pub const ISOMETRIC: f64 = 1e-13;

/// The share by which length errors must get better in eight steps, once bending does not hold them back any more.
pub const POLISH_GAIN: f64 = 0.02;

/// Weight of bending that polish begins with where a shape is to be kept: about that which frames were relaxed with.
pub const GENTLE_POLISH: f64 = 1e-4;

/// In films, where every frame has to go the same way as the one before: what holds the moves of neighbouring vertices together, what
/// it is multiplied with after every second step, and how many steps there are. Errors of usual frames of
/// `breathing_torus`, `hyperbolic_disk` and `ricci_hare` come to a fifth and less.
pub const NEAR_POLISH: (f64, f64, usize) = (1e-4, 0.3, 8);

/// The same for frames that a membrane would fold over, as weight of bending: three times the work for each step.
pub const STIFF_NEAR_POLISH: (f64, f64, usize) = (1e-5, 0.3, 6);

/// A frame of a film whose error has come to such a share is not polished otherwise.
pub const NEAR_ENOUGH: f64 = 0.9;

/// Where the surface may go far, without handles: there is an isometric immersion near it or none.
pub const FIRM_POLISH: f64 = 1e-3;

/// What holds neighbouring vertices of a convex surface together while it is polished without bending.
pub const MEMBRANE_HOLD: f64 = 1e-7;

/// On surfaces with handles, whose lengths are over-determined: they have to find a fit on a way of their own, and of several the
/// best one is taken. Weights of bending, and what they are multiplied with; the first two are always tried.
pub const STIFF_POLISH: [(f64, f64); 3] = [(0.3, POLISH_FADE), (1.0, POLISH_FADE), (0.3, 0.7)];

/// The weight of bending that the best one is made stiff with once more.
pub const REHEATING: f64 = 0.1;

/// L2 length error at which no more than two ways are tried.
pub const GOOD_FIT: f64 = 4e-4;

/// The weight below which the barrier does not fade then, in units of [`BARRIER_WEIGHT`].
pub const LEAST_BARRIER: f64 = 1e-6;

/// Rounds of local search on the best one.
pub const ROUNDS: usize = 12;

/// A round that makes the error better by a smaller share is idle.
pub const ROUND_GAIN: f64 = 0.02;

/// Idle rounds after which local search ends.
pub const IDLE_ROUNDS: usize = 3;

/// The weight of bending with which the whole surface goes on after a round.
pub const ROUND_STIFFNESS: f64 = 1e-9;

/// A patch is tried if the edges of its middle hold this share of all squared strain.
pub const SHARE_OF_A_TRY: f64 = 1e-3;

/// Rings of vertices around the middle of a patch that move.
pub const RINGS_OF_A_TRY: usize = 5;

/// Those of them that are disturbed.
pub const DISTURBED_RINGS: usize = 3;

/// How often a patch is tried in a round. On tori and the bunny one try of twenty finds a better fit, whatever the kind of
/// disturbance.
pub const TRIES: usize = 20;

/// Steps of polish in each try.
pub const STEPS_OF_A_TRY: usize = 30;

/// The largest disturbance, in mean edge lengths, in each direction.
pub const DISTURBANCE: f64 = 0.6;

/// Weights of bending that a try begins with. Stiffer patches come back to where they were.
pub const STIFFNESS_OF_A_TRY: (f64, f64) = (2e-6, 2e-3);

/// L2 length error at which no further attempt is made.
pub const ACCURATE_POLISH: f64 = 1e-8;

/// Faces up to which a static scene is polished without being asked to. Sparse factors of three unknowns a vertex take 4 s and
/// 2 GB there.
pub const MOST_FACES_TO_POLISH: usize = 200_000;

/// The share of its area below which a face resists on the way over a pass. Corners of a stiff shell would crush faces.
pub const LEAST_AREA: f64 = 0.7;

/// Parts in which the lengths of a halfway model become those that are asked for, and steps in each. With ten parts faces get crushed.
pub const PARTS_TO_A_PASS: usize = 25;

/// See [`PARTS_TO_A_PASS`].
pub const STEPS_TO_A_PASS: usize = 2;

/// Shares of the weight of bending that a surface comes to rest with on a pass, one after another. Of a stiff halfway model with
/// lengths far from those asked for, slivers would be crushed.
pub const SOFT_ON_A_PASS: [f64; 3] = [0.04, 0.2, 1.0];

/// Steps with each of them. The rest does not have to be complete, since the way down begins there.
pub const STEPS_ON_A_PASS: usize = 15;

/// The work of the push off a pass, where every vertex goes as far as the radius of the sphere, in units of the weight of bending. A soft
/// halfway model is at rest in a shallow dip and does not leave it by itself; pushed twice as hard it runs into a corner that locks.
pub const PUSH_OFF_A_PASS: f64 = 35.0;

/// How far the surface has to be from the pass before it goes on by itself, root mean square, in radii. At 0.7 it is pressed into that
/// corner, too.
pub const REACH_OF_THE_PUSH: f64 = 0.5;

/// The least drag of the way down: work as in [`PUSH_OFF_A_PASS`]. It keeps slow moves from becoming jumps.
pub const DRAG_OF_A_DESCENT: f64 = 0.4;

/// How far a step of the way down moves a vertex, in radii, but not farther than an edge.
pub const STEP_OF_A_DESCENT: f64 = 0.04;

/// What is left of a step in the next one. Newton's matrix without its indefinite part is stiffer than the shell.
pub const MOMENTUM: f64 = 0.8;

/// Steps of the way down, at most. That of `sphere_eversion` has some 500.
pub const MOST_STEPS_OF_A_DESCENT: usize = 2000;

/// L2 length error from which on what is left is polish.
pub const NEARLY_DOWN: f64 = 0.01;

/// The largest turn of a hinge in a step over a pass, in radians (57°).
pub const GENTLE_HINGE_TURN: f64 = 1.0;

/// Weight of bending of a shell on its way over a pass, where a scene does not say: that of `sphere_eversion`. Half as much makes a
/// third less strain on the pass.
pub const STIFFNESS_OVER_A_PASS: f64 = 0.25;

/// By which factor the shell gets stiffer from step to step of the way down, as long as its strain is less than on the pass or it does not
/// move. A shell that stays as soft as it was there makes narrow pockets, whose corners lock before they have opened.
pub const STIFFENING: f64 = 1.03;

/// How much stiffer it may get in all.
pub const MOST_STIFFENING: f64 = 20.0;

/// How much more than on the pass, in L2 strain, a surface that has left it and stands still is stretched when it is down. A ring of
/// eights, which is not rigid, comes to rest stretched by its stiffness alone; a sphere whose corner locks is not there yet.
pub const STRETCHED_AT_REST: f64 = 1.2;
