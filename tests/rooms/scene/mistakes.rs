//! Every kind of mistake in a scene file, with its place, its reason and its remedy.

use std::path::Path;

use immerse::scene::{Scene, SceneError, SceneErrors};

fn mistakes(text: &str) -> Vec<SceneError> {
    match Scene::parse(text, "test", Path::new("")) {
        Ok(_) => Vec::new(),
        Err(errors) => errors.mistakes().to_vec(),
    }
}

/// The text has exactly one mistake, at the place marked by `^` (which is taken out), with these words in
/// its reason and its remedy.
#[track_caller]
fn one(marked: &str, reason: &str, remedy: &str) {
    let offset = marked.find('^').expect("a mark");
    let before = &marked[..offset];
    let (line, column) =
        (before.matches('\n').count() + 1, before.chars().rev().take_while(|&c| c != '\n').count() + 1);
    let found = mistakes(&marked.replacen('^', "", 1));
    assert_eq!(found.len(), 1, "{found:#?}");
    let error = &found[0];
    assert!(error.reason.contains(reason), "{}", error.reason);
    assert!(error.remedy.contains(remedy), "{}", error.remedy);
    assert_eq!((error.line, error.column), (line, column), "{error}");
}

#[test]
fn unknown_names() {
    one("[^mash]\nshape = 'sphere'", "there is no `mash` in a scene", "did you mean `mesh`?");
    one("[camera]\n^feild_of_view = 3", "there is no `feild_of_view` in [camera]", "did you mean `field_of_view`?");
    one("[clock]\n^xyzzy = 3", "there is no `xyzzy` in [clock]", "the keys are `frames`, `start`");
    one("[mesh]\nshape = ^'spere'\nwhatever = 1", "there is no shape `spere`", "did you mean `sphere`?");
    one("[mesh]\nshape = 'sphere'\n^minor_radius = 2", "no `minor_radius` in [mesh]", "`radius` and `subdivisions`");
    one("[mesh]\nshape = 'flat_torus'\ngrid = ^'Squared'", "there is no grid `Squared`", "did you mean `square`?");
    one("[start]\nfrom = ^'center'", "there is no from `center`", "`spectral` and `figure eight`");
    one("[output]\nformat = ['png', ^'ext']", "there is no format `ext`", "did you mean `exr`?");
    one("[mesh]\nshape = 'implicit'\nparts = [{ sphere = { ^radus = 1, radius = 1 } }]", "no `radus`", "`radius`");
    one("[[phase]]\n[[phase]]\n^max-steps = 2", "there is no `max-steps` in [[phase]]", "did you mean `max_steps`?");
    one("^dt = 300", "there is no `dt` in a scene", "the keys are `mesh`");
}

#[test]
fn wrong_types() {
    one(
        "[mesh]\nshape = 'sphere'\nradius = ^'big'",
        "`radius` is the string \"big\", it must be a number",
        "radius = 1.0",
    );
    one(
        "[mesh]\nshape = 'sphere'\nradius = ^'1.5'",
        "it must be a number greater than 0",
        "remove the quotes around 1.5",
    );
    one(
        "[mesh]\nshape = 'sphere'\nsubdivisions = ^2.5",
        "`subdivisions` is 2.5, it must be an integer from 1 to 1000",
        "16",
    );
    one("[mesh]\nshape = ^3", "`shape` is 3, it must be a name in quotes", "`sphere`");
    one("[mesh]\nfile = ^true", "`file` is true, it must be a string", "file = \"bunny.obj\"");
    one("[look]\nlines = ^1", "`lines` is 1, it must be true or false", "lines = true");
    one("[look]\nfront = ^'orange'", "`front` is the string \"orange\", it must be a colour", "front = \"#E0823D\"");
    one("[look]\nfront = ^'#12345é'", "it must be a colour", "front = \"#E0823D\"");
    one("[spin]\nclass = ^11", "`class` is 11, it must be a string", "class = \"01\"");
    one("[camera]\nup = ^3", "`up` is 3, it must be a list of 3 entries", "up = [0.0,1.0,0.0]");
    one("[camera]\nup = [0, ^'a', 0]", "`up[1]` is the string \"a\", it must be a number", "up = [0.0,1.0,0.0]");
    one("[clock]\nframes = ^1979-05-27", "`frames` is the date", "frames = 1");
    one("clock = ^3", "`clock` is 3, it must be a table", "[clock]");
    one("^[[clock]]", "`clock` is a list, it must be a table", "single brackets");
    one("^[phase]\ndt = 3", "`phase` is one table, it must be a list", "[[phase]]");
    one("pin = [^3]", "`pin` holds 3, it must hold tables", "[[pin]]");
    one("pin = ^3", "`pin` holds 3, it must hold tables", "[[pin]]");
    one("[output]\nformat = ^[]", "`format` is a list, it must be one or several", "format = [\"png\"]");
    one("[output]\nformat = [^1]", "`format` is 1", "format = [\"png\"]");
}

#[test]
fn wrong_lengths() {
    one("[output]\nsize = ^[640, 480, 3]", "`size` has 3 entries, it must have 2", "size = [1280,960]");
    one("[output]\nsize = ^[640]", "`size` has 1 entries, it must have 2", "size = [1280,960]");
    one("[[phase]]\nepsilon = ^[1, 0, 1]", "`epsilon` has 3 entries, it must have 4", "epsilon = [1.0,0.0001,1.0,0.1]");
    one("[[pin]]\nvertices = [0]\npositions = [^[1, 2]]", "`positions[0]` has 2 entries, it must have 3", "");
    one(
        "[[pin]]\nvertices = [0]\npositions = ^[[1, 2, 3], [1, 2, 3]]",
        "2 positions for 1 vertices",
        "one [x, y, z] per vertex",
    );
    one("[[pin]]\nvertices = ^[]", "`vertices` is empty", "name at least one");
}

#[test]
fn impossible_values() {
    one("[[phase]]\ndt = ^-1", "`dt` is -1, it must be a number greater than 0", "write for example dt = 10.0");
    one("[[phase]]\ndt = ^0", "`dt` is 0, it must be a number greater than 0", "dt = 10.0");
    one("mesh = { file = 'é.obj', ^fiel = 1 }", "no `fiel`", "did you mean `file`?");
    one("[[phase]]\ndt = ^nan", "`dt` is nan, it must be finite", "dt = 10.0");
    one("[[phase]]\ndt = ^1e999", "it must be finite", "dt = 10.0");
    one("[[phase]]\nepsilon = [1, ^-inf, 0, 0]", "`epsilon[1]` is -inf, it must be finite", "epsilon = [");
    one("[[phase]]\nepsilon = [1, ^-1, 0, 0]", "`epsilon[1]` is -1, it must be a number at least 0", "epsilon = [");
    one("[[phase]]\nepsilon = ^[0, 0, 0, 0]", "all weights are 0", "make the first one 1");
    one("[[phase]]\nmin_steps = ^9\nmax_steps = 3", "`min_steps` is 9, more than `max_steps`", "at most 3");
    one("[[phase]]\nfeedback = ^1.5", "a number from 0 to 1", "feedback = 1.0");
    one("[clock]\nframes = ^0", "an integer from 1 to 999999", "frames = 1");
    one("[clock]\nframes = ^-3", "an integer from 1", "frames = 1");
    one("[clock]\nframes = ^99999999999999999999999", "an integer from 1", "frames = 1");
    one("[mesh]\nshape = 'sphere'\nsubdivisions = ^1000000000", "from 1 to 1000", "subdivisions = 16");
    one("[mesh]\nshape = 'hyperbolic_disk'\ncurvature = ^1", "a number less than 0", "curvature = -1.0");
    one("[mesh]\nshape = 'annulus'\ninner_radius = ^3", "not less than `outer_radius`, which is 1", "between 0 and 1");
    one("[mesh]\nshape = 'torus'\nminor_radius = ^1", "not less than `major_radius`, which is 1", "between 0 and 1");
    one("[mesh]\nshape = 'flat_torus'\na = [1, 2]\nb = ^[2, 4]", "parallel", "a = [3, 0] and b = [0, 2.5]");
    one(
        "[mesh]\nfile = ^'a.blend'",
        "ends in `.blend`",
        "the endings are `obj`, `ply`, `off`, `stl`, `fold`, `npz` and `npy`",
    );
    one("[spin]\nclass = ^'0a'", "one digit 0 or 1 per generator", "\"immersion\"");
    one("[checks]\nclass = ^'immersion'", "one digit 0 or 1 per generator", "class = \"01\"");
    one("[camera]\nup = ^[0, 0, 0]", "`up` is the zero vector", "up = [0, 1, 0]");
    one("[camera]\nfield_of_view = ^180", "a number from 0 to 150", "field_of_view = 30.0");
    one("[output]\nsamples = ^2", "`samples` is 2, it must be 1, 4, 8 or 16", "samples = 8");
    one("[output]\nsize = [640, ^100000]", "from 1 to 16384", "size = [1280,960]");
    one(
        "[mesh]\nshape = 'polyhedron'\nvertices = [[0, 0, 0]]\npolygons = ^[[0, 0, 7]]",
        "names vertex 7, but there are 1",
        "counted from 0",
    );
    one(
        "[mesh]\nshape = 'polyhedron'\nvertices = [[0, 0, 0]]\npolygons = ^[[0, 0]]",
        "has 2 corners",
        "add its corners",
    );
}

#[test]
fn missing_and_contradictory() {
    one("^[mesh]\n", "[mesh] has neither `file` nor `shape`", "shape = \"sphere\"");
    one("[mesh]\nfile = 'a.obj'\n^shape = 'sphere'", "both `file` and `shape`", "remove one of them");
    one("[metric]\nlength = 1\n^csv = 'a.csv'", "both `length` and `csv`", "remove one of them");
    one("[start]\nfrom = 'mesh'\n^random = 3", "both `from` and `random`", "remove one of them");
    one("^[bending]\n", "[bending] says no angles", "from = \"mirror\"");
    one("^[[pin]]\n", "[[pin]] selects nothing", "add vertices, boundary, box, ball or nearest");
    one("^[[light]]\n", "[[light]] has no `direction`", "add for example direction = [-0.5,1.0,1.0]");
    one("[mesh]\nshape = ^'polyhedron'", "needs a `name`, or both", "name = \"cube\"");
    one("[mesh]\nshape = ^'implicit'", "has no `parts`", "[[mesh.parts]]");
    one("[mesh]\nshape = 'implicit'\nparts = ^[]", "`parts` is empty", "[[mesh.parts]]");
    one("[mesh]\nshape = 'implicit'\nparts = [^{ blend = 1 }]", "this part is no solid", "add one of sphere, capsule");
    one("[mesh]\nshape = 'implicit'\nparts = [{ sphere = ^{} }]", "[sphere] has no `radius`", "radius = 1.0");
    one("[mesh]\nshape = 'implicit'\nparts = [{ group = ^[] }]", "`group` is empty", "group = [{ sphere");
    one(
        "[mesh]\nshape = 'implicit'\nparts = [{ capsule = ^{ from = [0, 0, 0], to = [1, 0, 0] } }]",
        "a capsule needs a `radius` or two `radii`",
        "radius = 0.2",
    );
}

#[test]
fn keyframes() {
    let out_of_order = "keyframes are out of order: 0 comes after 1";
    let sort = "sort them, each time greater than the last";
    let bending = |value: &str| format!("[bending]\nfrom = 'mesh'\namount = {value}");
    one(&bending("{ times = ^[1, 0], values = [0, 1] }"), out_of_order, sort);
    one(&bending("{ times = ^[0, 0], values = [0, 1] }"), "0 comes after 0", sort);
    one(&bending("{ times = ^[], values = [] }"), "`times` is empty", "at least one time");
    one(&bending("{ times = [0, 1], values = ^[0, 1, 2] }"), "there are 3 entries for 2 times", "one per time");
    one(&bending("^{ times = [0, 1] }"), "has no `values`", "values = [0.0,1.0]");
    one(&bending("^{ values = [0, 1] }"), "has no `times`", "times = [0.0,1.0]");
    one(&bending("{ times = [0, 1], values = [0, ^'a'] }"), "`values[1]` is the string", "values = ");
    one(&bending("{ times = [0, 1], values = [0, 1], ease = ^'smoth' }"), "no ease `smoth`", "did you mean `smooth`?");
    one(
        &bending("{ times = [0, 1], values = [0, 1], ^easing = 1 }"),
        "no `easing`",
        "the keys are `times`, `ease`, `values`",
    );
    one(&bending("^true"), "`amount` is true, it must be a number, a formula in quotes or", "amount = 1");
    one(&bending("^[0, 1]"), "`amount` is a list, it must be a number, a formula", "amount = 1");
    one(&bending("^nan"), "`amount` is nan, it must be finite", "amount = 1");
    let motion = |text: &str| format!("[[pin]]\nvertices = [0]\n[pin.motion]\n{text}");
    one(&motion("times = ^[1, 0]"), out_of_order, sort);
    one(&motion("times = [0, 1]\ntranslations = ^[[0, 0, 0]]"), "1 entries for 2 times", "one per time");
    one(&motion("times = [0, 1]\nrotations = ^[[0, 0, 0]]"), "1 entries for 2 times", "one per time");
    one(&motion("times = [0]\nrotations = [^[0, 0]]"), "`rotations[0]` has 2 entries, it must have 3", "");
    let keys = "[[metric.key]]\ntime = 1\n[[metric.key]]\ntime = 1";
    one("metric.key = ^[{ time = 1 }, { time = 0 }]", "keys are out of order: time 0 comes after 1", sort);
    assert_eq!(mistakes(keys).len(), 1);
    one("[parameters]\nk = { times = ^[1, 0], values = [0, 1] }", out_of_order, sort);
    one("[parameters]\nk = ^true", "`k` is true, it must be a number, a formula in quotes", "k = 1");
    one("parameters = ^3", "`parameters` is 3, it must be a table", "[parameters]");
}

#[test]
fn what_changes_with_time() {
    one("[clock]\nstart = 1\nend = ^1", "the clock ends at 1, not after its start at 1", "`end` greater than `start`");
    one("[clock]\nmax_strain = ^0", "a number greater than 0", "max_strain = 0.05");
    one("[clock]\nloop = ^1", "`loop` is 1, it must be true or false", "loop = false");
    one("[[metric.change]]\nkind = ^'richi'", "there is no kind `richi`", "did you mean `ricci`?");
    one(
        "[[metric.change]]\nkind = 'ricci'\namount = ^true",
        "`amount` is true, it must be a number, a formula",
        "amount",
    );
    let both = "[[metric.change]]\nkind = 'ricci'\ncurvature = 1\n[[metric.change.^region]]\nvertices = [0]\ntotal = 1";
    one(both, "both `curvature` and `region`", "remove one of them");
    let lengths = "[metric]\nlength = 1\nkey = ^[{ time = 0 }]";
    one(lengths, "[metric] has both lengths and [[metric.key]]", "put the lengths into a [[metric.key]]");
    one(
        "[metric]\nease = ^'in'",
        "`ease` is about [[metric.key]] or `files`, and there is none",
        "remove it, or add keys",
    );
    one("[metric]\ninterpolation = ^'squared'", "`interpolation` is about [[metric.key]]", "remove it, or add keys");
    one(
        "[start]\nformula = ^['x', 'y', 'z']",
        "`formula` moves positions, and these frames come from none",
        "add from",
    );
    one("[[pin]]\nvertices = [0]\nformula = ^['x', 'y']", "`formula` has 2 entries, it must have 3", "");
    one("[[pin]]\nvertices = [0]\n^ball = [0, 0, 0, 1]", "both `vertices` and `ball`", "remove one of them");
    one(
        "[[pin]]\nball = [0, 0, 0, 1]\npositions = ^[[0, 0, 0]]",
        "`positions` are in order of a list",
        "list `vertices`",
    );
    one("[[bending.region]]\nedges = [[0, 1]]\n^box = [[0, 0, 0], [1, 1, 1]]\nangle = 1", "both `edges` and `box`", "");
    one("[[phase]]\nturn = ^0", "a number greater than 0 and at most 90", "turn = 1.0");
    one("[checks.film]\nmax_jump = ^0", "a number greater than 0", "max_jump = 10.0");
    one("[checks]\n^film_max_jump = 3", "there is no `film_max_jump` in [checks]", "");
}

#[test]
fn text_that_is_not_toml() {
    one("[spin]\nclass = ^01", "this is not TOML: unexpected leading zero", "put a class in quotes");
    one("[mesh]\nfile = ^torus.obj", "this is not TOML", "put text in double quotes");
    one("[mesh]\nfile = ^bunny.obj", "this is not TOML", "put text in double quotes");
    one("[clock]\nframes = ^", "this is not TOML", "");
    one("[clock]\nframes = 1\n^frames = 2", "duplicate key", "remove one of the two");
    one(&format!("^[{}a]", "a.".repeat(100_000)), "recursion limit", "nest tables and lists less deeply");
    let found = mistakes("[clock\nframes = 1\n[look]\nlines = maybe\n");
    assert_eq!(found.iter().map(|error| error.line).collect::<Vec<_>>(), [1, 4], "{found:#?}");
}

#[test]
fn all_mistakes_are_reported_at_once_in_the_order_of_the_file() {
    let text = "# é\n[[phase]]\ndt = -1\n[mesh]\nradius = 'a'\nshape = 'sphere'\nspeed = 3\n[chekcs]\nmax_rims = 0\n";
    let errors = Scene::parse(text, "film", Path::new("scenes")).unwrap_err();
    let places: Vec<_> = errors.mistakes().iter().map(|error| (error.line, error.column)).collect();
    assert_eq!(places, [(3, 6), (5, 10), (7, 1), (8, 2)]);
    let spans: Vec<_> =
        errors.mistakes().iter().map(|error| &error.text[error.span.0..error.span.0 + error.span.1]).collect();
    assert_eq!(spans, ["-1", "'a'", "speed", "chekcs"]);
    let message = errors.to_string();
    assert_eq!(message.lines().count(), 4);
    assert!(message.lines().all(|line| line.contains("film.toml:")), "{message}");
}

#[test]
fn files_that_cannot_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let missing = Scene::read(&folder.path().join("none.toml")).unwrap_err();
    assert!(matches!(missing, SceneErrors::Unreadable { .. }));
    assert!(missing.to_string().contains("none.toml: there is no such file; check the path"), "{missing}");

    let binary = folder.path().join("binary.toml");
    std::fs::write(&binary, b"[mesh]\n# \xff").unwrap();
    let error = Scene::read(&binary).unwrap_err().to_string();
    assert!(error.contains("line 2 is not UTF-8 text; save the file as UTF-8"), "{error}");
    assert!(Scene::read(folder.path()).unwrap_err().to_string().contains("it cannot be read"));

    let good = folder.path().join("my film.toml");
    std::fs::write(&good, "[clock]\nframes = 2").unwrap();
    let scene = Scene::read(&good).unwrap();
    assert_eq!((scene.name.as_str(), scene.folder.as_path()), ("my film", folder.path()));
}
