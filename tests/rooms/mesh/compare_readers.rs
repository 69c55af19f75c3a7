//! The readers beside two others, trimesh and meshio, over all small meshes of `inputs`: the same vertices, faces
//! and areas. It takes Python with both of them; `IMMERSE_PYTHON` names one, else it is `python3`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use immerse::mesh::read;
use serde_json::{Map, Value, json};

fn meshes(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        if path.is_dir() {
            meshes(&path, found);
        } else if ["obj", "ply", "off", "stl"].contains(&&*ending) {
            found.push(path);
        }
    }
}

fn summary(path: &Path) -> Value {
    let surface = match read(path) {
        Ok(surface) => surface,
        Err(error) => return json!({ "error": error.to_string() }),
    };
    let Some(points) = surface.positions else { return json!({ "error": "it has no positions" }) };
    let place = |v: u32| points[v as usize];
    let triangles = surface.mesh.triangles();
    let places: BTreeSet<_> =
        triangles.iter().flatten().map(|&v| place(v).to_array().map(|x| (x + 0.0).to_bits())).collect();
    let area = |&[a, b, c]: &[u32; 3]| 0.5 * (place(b) - place(a)).cross(place(c) - place(a)).length();
    json!({
        "vertices": places.len(),
        "faces": triangles.len(),
        "area": triangles.iter().map(area).sum::<f64>(),
    })
}

#[test]
fn trimesh_and_meshio_read_the_same() {
    let python = std::env::var("IMMERSE_PYTHON").unwrap_or_else(|_| "python3".into());
    let has_both = Command::new(&python).args(["-c", "import trimesh, meshio"]).output();
    if !has_both.is_ok_and(|output| output.status.success()) {
        // Written to standard error itself, which the test harness does not keep back.
        use std::io::Write;
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED: readers were not compared with trimesh and meshio, which `{python}` does not have; \
             `pip install trimesh meshio`, or name another Python by IMMERSE_PYTHON"
        );
        assert!(std::env::var("IMMERSE_PYTHON").is_err(), "IMMERSE_PYTHON was named to compare readers, and cannot");
        return;
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rooms/mesh/inputs");
    let mut found = Vec::new();
    meshes(&folder, &mut found);
    assert!(found.len() > 30, "only {} meshes were found", found.len());
    let name = |path: &Path| path.strip_prefix(&folder).unwrap().to_string_lossy().replace('\\', "/");
    let summaries: Map<String, Value> = found.iter().map(|path| (name(path), summary(path))).collect();
    let work = tempfile::tempdir().unwrap();
    let said = work.path().join("immerse.json");
    fs::write(&said, Value::Object(summaries).to_string()).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/rooms/mesh/compare_readers.py");
    let output = Command::new(&python).arg(script).arg(&folder).arg(&said).output().unwrap();
    let [out, err] = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    println!("{out}");
    assert!(output.status.success(), "{out}\n{err}");
}
