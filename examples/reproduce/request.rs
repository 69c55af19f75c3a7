//! What the command line asks for.

use clap::Parser;
use std::error::Error;
use std::path::{Path, PathBuf};

/// Any error, which ends the program with its message.
pub type Outcome<T> = Result<T, Box<dyn Error>>;

/// Makes figures and tables of the paper again: REPRODUCTION.md and renders/reproduction/*.
#[derive(Debug, Parser)]
pub struct Request {
    /// Only this part, such as `fig14` or `convex`; may be given several times. The other parts of the page stay as they are.
    #[arg(long)]
    only: Vec<String>,
    /// The long parts as well: the eversion.
    #[arg(long)]
    all: bool,
    /// Where REPRODUCTION.md and renders/reproduction are written.
    #[arg(long, default_value = ".")]
    pub out: PathBuf,
    /// A folder with the meshes that come with the paper: bunny.obj, sphere.obj, torus.obj. Without it shipped ones stand in.
    #[arg(long)]
    paper_data: Option<PathBuf>,
    /// Small meshes and one seed, to see in a minute that everything runs.
    #[arg(long)]
    pub quick: bool,
}

impl Request {
    pub fn from_command_line() -> Request {
        Request::parse()
    }

    pub fn check_names(&self, names: &[&str]) -> Outcome<()> {
        match self.only.iter().find(|name| !names.contains(&name.as_str())) {
            Some(name) => Err(format!("there is no part `{name}`; --only takes one of {}", names.join(", ")).into()),
            None => Ok(()),
        }
    }

    pub fn wants(&self, name: &str, is_long: bool) -> bool {
        if self.only.is_empty() { self.all || !is_long } else { self.only.iter().any(|only| only == name) }
    }

    /// A mesh of the paper; `None`, said loudly, where it is not here.
    #[allow(clippy::print_stderr, reason = "an example talks")]
    pub fn paper_mesh(&self, name: &str) -> Outcome<Option<PathBuf>> {
        let found = self.paper_data.as_ref().map(|folder| folder.join(name)).filter(|path| path.is_file());
        if found.is_none() {
            eprintln!("  SKIPPED: {name} of the paper is not here (--paper-data DIR); a shipped surface stands in");
        }
        Ok(found.map(std::path::absolute).transpose()?)
    }

    /// Random starts: five, of which the median and the worst are told.
    pub fn seeds(&self) -> Vec<u64> {
        if self.quick { vec![0] } else { (0..5).collect() }
    }

    /// A number for the meshes of a study: `quick` in a quick run.
    pub fn size(&self, size: usize, quick: usize) -> usize {
        if self.quick { quick } else { size }
    }

    pub fn pictures(&self) -> PathBuf {
        self.out.join("renders").join("reproduction")
    }
}

/// A shipped scene.
pub fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(format!("{name}.toml"))
}

/// A scene that lies beside this example.
pub fn own(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/reproduce/scenes").join(format!("{name}.toml"))
}
