//! Scenes that extend another file: what counts, whose folder it is in, and where mistakes are.

use std::fs;
use std::path::{Path, PathBuf};

use immerse::scene::*;
use tempfile::TempDir;

struct Files(TempDir);

impl Files {
    fn of(files: &[(&str, &str)]) -> Files {
        let folder = TempDir::new().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        Files(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    #[track_caller]
    fn read(&self, settings: &[&str]) -> Scene {
        let settings: Vec<String> = settings.iter().map(|text| (*text).to_owned()).collect();
        Scene::read_with(&self.path("film.toml"), &settings).unwrap_or_else(|errors| panic!("{errors}"))
    }

    fn mistakes(&self) -> Vec<SceneError> {
        Scene::read(&self.path("film.toml")).unwrap_err().mistakes().to_vec()
    }

    #[track_caller]
    fn mistake(&self) -> SceneError {
        let mut mistakes = self.mistakes();
        assert_eq!(mistakes.len(), 1, "{mistakes:#?}");
        mistakes.remove(0)
    }
}

#[test]
fn a_file_counts_before_what_it_extends_and_what_is_set_before_both() {
    let files = Files::of(&[
        ("film.toml", "extends = 'near.toml'\n[clock]\nframes = 3\n[spin]\nclass = '1'\n"),
        ("near.toml", "extends = 'far.toml'\n[clock]\nframes = 2\nend = 5\n[start]\nrandom = 2\n"),
        (
            "far.toml",
            "[clock]\nframes = 1\nend = 4\nstart = 1\n[start]\nrandom = 1\n[[light]]\ndirection = [1, 0, 0]\n",
        ),
    ]);
    let scene = files.read(&[]);
    assert_eq!((scene.clock.frames, scene.clock.start, scene.clock.end), (3, 1.0, 5.0));
    assert_eq!((scene.start.from, scene.spin), (StartFrom::Random(2), SpinSection::Digits("1".into())));
    assert_eq!((scene.lights.len(), scene.name.as_str(), scene.folder.as_path()), (1, "film", files.0.path()));
    let scene = files.read(&["clock.frames=9", "light.0.direction=[0, 1, 0]"]);
    assert_eq!((scene.clock.frames, scene.clock.end, scene.lights[0].direction), (9, 5.0, [0.0, 1.0, 0.0]));
}

#[test]
fn parameters_of_the_extended_file_come_first() {
    let files = Files::of(&[
        ("film.toml", "extends = 'base.toml'\n[parameters]\naa = 'z + b'\nz = 3\n"),
        ("base.toml", "[parameters]\nz = 1\nb = 'z'\n"),
    ]);
    let scene = files.read(&[]);
    let names: Vec<&str> = scene.parameters.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!((names, &scene.parameters[0].1), (vec!["z", "b", "aa"], &NumberSection::Constant(3.0)));
    let again = Scene::parse(scene.source.text(), "film", Path::new("")).unwrap();
    assert_eq!(again.parameters, scene.parameters);
}

#[test]
fn paths_are_relative_to_the_file_that_says_them() {
    let files = Files::of(&[
        ("film.toml", "extends = 'a/near.toml'\n[start]\nfile = 's.obj'\n[look]\nmatcap = ''\n"),
        ("a/near.toml", "extends = '../b/far.toml'\n[mesh]\nfile = 'm.obj'\n[parameters]\nfile = 'file'\n"),
        ("b/far.toml", "[metric]\nfiles = ['p*.obj', '/q.obj']\n[[pin]]\nvertices = [0]\n[start]\nfile = 'no.obj'\n"),
    ]);
    let mistakes = files.mistakes();
    assert!(mistakes.iter().all(|mistake| mistake.path.ends_with("film.toml")), "{mistakes:?}");
    fs::write(files.path("film.toml"), "extends = 'a/near.toml'\n[start]\nfile = 's.obj'\n").unwrap();
    let scene = files.read(&[]);
    assert_eq!(scene.mesh, MeshSection::File(Path::new("a").join("m.obj")));
    assert_eq!(scene.start.from, StartFrom::File("s.obj".into()));
    let expected = Path::new("a").join("../b").join("p*.obj").to_string_lossy().into_owned();
    assert_eq!(scene.metric.files.unwrap().files, [expected, "/q.obj".to_owned()]);
    assert_eq!(scene.parameters[0].1, NumberSection::Formula("file".into()));
}

#[test]
fn what_excludes_a_key_of_the_extended_file_takes_its_place() {
    let base = "[mesh]\nshape = 'sphere'\nradius = 2\n[start]\nrandom = 1\n[metric]\nlength = 1\n";
    let of = |text: &str| Files::of(&[("film.toml", &format!("extends = 'base.toml'\n{text}")), ("base.toml", base)]);
    let scene = of("[mesh]\nshape = 'cylinder'\n[start]\nfrom = 'mirror'\n[metric]\nformula = 'length'\n").read(&[]);
    assert_eq!(scene.start.from, StartFrom::Mirror);
    assert_eq!(scene.metric.lengths, LengthSource::Formula("length".into()));
    assert!(scene.source.locate("mesh.radius").is_some_and(|place| place.text == "2"), "both have a radius");
    let scene = of("[mesh]\nshape = 'torus'\n").read(&[]);
    assert!(scene.source.locate("mesh.radius").is_none() && !scene.source.text().contains("radius"));
    assert_eq!(of("[mesh]\nfile = 'mesh.obj'\n").read(&[]).mesh, MeshSection::File("mesh.obj".into()));
    assert_eq!(of("").read(&["start.from=spectral"]).start.from, StartFrom::Spectral);
    // In one file, both are a mistake as ever, and so is what no shape has.
    let mistake = of("[start]\nfrom = 'mesh'\nfile = 's.obj'\n").mistake();
    assert!(mistake.path.ends_with("film.toml") && mistake.reason.contains("exclude each other"), "{mistake}");
    let mistake = of("[mesh]\nshape = 'torus'\nradius = 3\n").mistake();
    assert_eq!((mistake.line, mistake.reason.as_str()), (4, "there is no `radius` in [mesh]"));
}

#[test]
fn mistakes_are_shown_in_the_file_that_has_them() {
    let files = Files::of(&[
        ("film.toml", "extends = 'sub/base.toml'\n\n[clock]\nframse = 2\n"),
        ("sub/base.toml", "# first\n[clock]\nframes = 0\n"),
    ]);
    let mistakes = files.mistakes();
    let places: Vec<_> = mistakes.iter().map(|mistake| (&*mistake.path, mistake.line, mistake.column)).collect();
    assert_eq!(places, [(&*files.path("sub/base.toml"), 3, 10), (&*files.path("film.toml"), 4, 1)]);
    assert_eq!(mistakes[0].span, ("# first\n[clock]\nframes = ".len(), 1));
    assert!(mistakes[1].remedy.contains("did you mean `frames`?"));

    fs::write(files.path("film.toml"), "extends = 'sub/base.toml'\n[mesh]\nshape = 'sphere'\n").unwrap();
    fs::write(files.path("sub/base.toml"), "# first\n[start]\nrandom = 1\n").unwrap();
    let scene = files.read(&["clock.frames=2"]);
    let complaints = ["start.random", "mesh.radius", "clock.frames", "look.background"].map(|key| {
        let mistake = scene.complain(key, "a", "b");
        (mistake.path.file_name().unwrap().to_string_lossy().into_owned(), mistake.line, mistake.column)
    });
    let expected = [("base.toml", 3, 10), ("film.toml", 2, 1), ("command line", 1, 20), ("film.toml", 1, 1)];
    assert_eq!(complaints, expected.map(|(name, line, column)| (name.to_owned(), line, column)));
}

#[test]
fn files_that_cannot_be_extended() {
    let at = |files: &[(&str, &str)], place: (&str, usize, usize), reason: &str| {
        let mistake = Files::of(files).mistake();
        let found = (mistake.path.file_name().unwrap().to_string_lossy().into_owned(), mistake.line, mistake.column);
        assert_eq!(found, (place.0.to_owned(), place.1, place.2), "{mistake}");
        assert!(mistake.reason.contains(reason), "{mistake}");
    };
    at(&[("film.toml", "extends = 'no.toml'")], ("film.toml", 1, 11), "no.toml: there is no such file");
    at(&[("film.toml", "extends = 3")], ("film.toml", 1, 11), "`extends` is 3, it must be a string");
    at(&[("film.toml", "extends = ''")], ("film.toml", 1, 11), "`extends` is empty");
    at(&[("film.toml", "extends = \"a\\new.toml\"")], ("film.toml", 1, 11), "has a line break");
    at(&[("film.toml", "extends = 'm.obj'"), ("m.obj", "v 1 2 3")], ("film.toml", 1, 11), "m.obj: it is a mesh");
    at(&[("film.toml", "extends = 'b.toml'"), ("b.toml", "[mesh\n")], ("b.toml", 1, 6), "this is not TOML");
    at(&[("film.toml", "extends = 'film.toml'")], ("film.toml", 1, 11), "film.toml extends ");
    let (one, two) = ("extends = 'two.toml'", "\nextends = './one.toml'");
    let files = [("film.toml", "extends = 'one.toml'"), ("one.toml", one), ("two.toml", two)];
    at(&files, ("two.toml", 2, 11), "one.toml extends ");
    let mistake = Files::of(&files).mistake();
    assert!(!mistake.reason.contains("film.toml"), "{mistake}");
    assert_eq!(mistake.reason.matches("one.toml").count(), 2, "{mistake}");
    let chain: Vec<(String, String)> =
        (0..40).map(|k| (format!("{k}.toml"), format!("extends = '{}.toml'", k + 1))).collect();
    let mut files: Vec<(&str, &str)> = chain.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    files.extend([("film.toml", "extends = '0.toml'"), ("40.toml", "")]);
    at(&files, ("30.toml", 1, 11), "more than 32 files");
}
