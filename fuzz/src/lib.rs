//! What the targets share: a folder in memory, files in it, and a film whose checksums are made right again, because no
//! fuzzer guesses them and the readers behind them are what is asked about.

use std::cell::OnceCell;
use std::fs;
use std::path::{Path, PathBuf};

use immerse::digest::Key;
use immerse::film::{FilmFolder, FilmMesh, FilmSpec};
use immerse::mesh::{self, Surface};
use immerse::{Scene, scene};
use tempfile::TempDir;

const OCTAHEDRON: &str = "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n\
    3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";

struct Desk {
    folder: TempDir,
    octahedron: Surface,
}

thread_local! {
    static DESK: OnceCell<Desk> = const { OnceCell::new() };
    static FILM: OnceCell<Film> = const { OnceCell::new() };
}

fn folder() -> TempDir {
    let memory = Path::new("/dev/shm");
    if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() }.expect("a folder")
}

fn at_desk<T>(work: impl FnOnce(&Desk) -> T) -> T {
    DESK.with(|desk| {
        work(desk.get_or_init(|| {
            let folder = folder();
            let path = folder.path().join("octahedron.off");
            fs::write(&path, OCTAHEDRON).expect("a file");
            Desk { octahedron: mesh::read(&path).expect("a surface"), folder }
        }))
    })
}

/// Reads a mesh file that has this ending.
pub fn mesh(bytes: &[u8], ending: &str) {
    at_desk(|desk| {
        let path = desk.folder.path().join(format!("mesh.{ending}"));
        fs::write(&path, bytes).expect("a file");
        if let Err(error) = mesh::read(&path) {
            let _ = error.to_string();
        }
    });
}

/// Reads a file of arrays, or of FOLD: as a mesh, and as what it says of an octahedron.
pub fn arrays(bytes: &[u8], ending: &str) {
    mesh(bytes, ending);
    at_desk(|desk| {
        let path = desk.folder.path().join(format!("mesh.{ending}"));
        let _ = mesh::read_lengths(&path, &desk.octahedron.mesh).map_err(|error| error.to_string());
        let _ = mesh::read_positions(&path, &desk.octahedron.mesh).map_err(|error| error.to_string());
        let _ = mesh::read_bending_angles(&path, &desk.octahedron.mesh).map_err(|error| error.to_string());
        let _ = mesh::read_length_keyframes(&path, &desk.octahedron.mesh).map_err(|error| error.to_string());
        let _ = mesh::read_bending_keyframes(&path, &desk.octahedron.mesh).map_err(|error| error.to_string());
    });
}

/// Reads tables that belong to an octahedron.
pub fn table(bytes: &[u8]) {
    at_desk(|desk| {
        let path = desk.folder.path().join("table.csv");
        fs::write(&path, bytes).expect("a file");
        let _ = mesh::read_edge_lengths(&path, &desk.octahedron.mesh).map_err(|error| error.to_string());
        let _ = mesh::read_vertex_numbers(&path, &desk.octahedron.mesh).map_err(|error| error.to_string());
    });
}

/// Reads the places of the vertices of an octahedron from another file.
pub fn positions(bytes: &[u8]) {
    at_desk(|desk| {
        let path = desk.folder.path().join("positions.off");
        fs::write(&path, bytes).expect("a file");
        let _ = mesh::read_positions(&path, &desk.octahedron.mesh).map_err(|error| error.to_string());
    });
}

/// Reads a scene and builds what it says, on an octahedron. Its own surface is made too, unless a number in it is so large
/// that the surface may be.
pub fn build(text: &str) {
    at_desk(|desk| {
        let Ok(scene) = Scene::parse(text, "fuzz", desk.folder.path()) else { return };
        let is_large = text.split(|c: char| !c.is_ascii_digit()).any(|digits| digits.len() > 2)
            || text.contains(['e', 'E']) && text.contains("edge_length");
        if !is_large {
            let _ = scene.surface().map_err(|error| error.to_string());
        }
        let _ = scene.program(&desk.octahedron).map_err(|error| error.to_string());
        let _ = scene::build::view(&scene).map_err(|error| error.to_string());
        let _ = scene::build::look(&scene).map_err(|error| error.to_string());
        let _ = scene::build::lights(&scene).map_err(|error| error.to_string());
        let _ = scene::build::output(&scene).map_err(|error| error.to_string());
    });
}

/// A film of two frames of an octahedron, one of whose files is another.
pub struct Film {
    folder: TempDir,
    manifest: String,
    mesh: Vec<u8>,
    report: String,
    state: Vec<u8>,
}

impl Film {
    fn new() -> Film {
        let folder = folder();
        fs::write(folder.path().join("mesh.off"), OCTAHEDRON).expect("a file");
        let text = "[mesh]\nfile = 'mesh.off'\n[clock]\nframes = 2\nsteps_per_frame = 1\n";
        let scene = Scene::parse(text, "film", folder.path()).expect("a scene");
        let mut simulation = scene.simulation().expect("a simulation");
        let spec = FilmSpec::of(&scene, simulation.frame_keys().expect("keys"));
        let frame = simulation.next_frame(&mut immerse::evolve::Unobserved).expect("a frame");
        let mesh = FilmMesh::of(simulation.mesh().clone());
        let (film, _) = FilmFolder::open_or_create(folder.path(), &spec, &mesh).expect("a film");
        film.write_frame(&frame).expect("a frame");
        let file = |name: &str| folder.path().join(name);
        let text = |path: PathBuf| fs::read_to_string(path).expect("a file");
        Film {
            manifest: text(file("manifest.json")),
            mesh: fs::read(file("mesh.npz")).expect("a file"),
            report: text(file("frames/000001.json")),
            state: fs::read(file("frames/000001.npz")).expect("a file"),
            folder,
        }
    }

    fn put(&self, name: &str, bytes: &[u8]) {
        fs::write(self.folder.path().join(name), bytes).expect("a file");
    }

    fn restore(&self) {
        self.put("manifest.json", self.manifest.as_bytes());
        self.put("mesh.npz", &self.mesh);
        self.put("frames/000001.json", self.report.as_bytes());
        self.put("frames/000001.npz", &self.state);
    }

    pub fn put_manifest(&self, bytes: &[u8]) {
        self.put("manifest.json", &sealed(bytes));
    }

    pub fn put_report(&self, bytes: &[u8]) {
        self.put("frames/000001.json", &sealed(bytes));
    }

    pub fn put_mesh(&self, bytes: &[u8]) {
        let manifest = with_value(&self.manifest, "\"mesh_sha256\": ", &format!("\"{}\"", Key::of_bytes(bytes)));
        self.put("manifest.json", &sealed(manifest.as_bytes()));
        self.put("mesh.npz", bytes);
    }

    pub fn put_frame(&self, bytes: &[u8]) {
        let report = with_value(&self.report, "\"state_sha256\": ", &format!("\"{}\"", Key::of_bytes(bytes)));
        let report = with_value(&report, "\"state_bytes\": ", &bytes.len().to_string());
        self.put("frames/000001.json", &sealed(report.as_bytes()));
        self.put("frames/000001.npz", bytes);
    }
}

/// Reads all of a film after `change` has put a file into it.
pub fn film(change: impl FnOnce(&Film)) {
    FILM.with(|film| {
        let film = film.get_or_init(Film::new);
        film.restore();
        change(film);
        let Ok(folder) = FilmFolder::open(film.folder.path()) else { return };
        let _ = folder.mesh().map_err(|error| error.to_string());
        let _ = folder.file_faces().map_err(|error| error.to_string());
        let _ = folder.valid_frames().map_err(|error| error.to_string());
        let _ = folder.read_frame(1).map_err(|error| error.to_string());
    });
}

/// JSON with the checksum that its first entry ought to have.
fn sealed(json: &[u8]) -> Vec<u8> {
    const PREFIX: &[u8] = b"{\n  \"crc32\": \"";
    match json.strip_prefix(PREFIX) {
        Some(rest) if rest.len() > 10 => {
            let body = &rest[10..];
            [PREFIX, format!("{:08x}\",", crc32fast::hash(body)).as_bytes(), body].concat()
        }
        _ => json.to_vec(),
    }
}

fn with_value(json: &str, key: &str, value: &str) -> String {
    let Some((before, after)) = json.split_once(key) else { return json.to_owned() };
    let rest = after.trim_start_matches(|c: char| c != ',' && c != '\n');
    format!("{before}{key}{value}{rest}")
}
