//! What can be typed.

mod frame_range;
mod names;
mod picture_options;

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

pub use self::frame_range::{FrameRange, FrameRangeError};
use self::names::one_of;
pub(super) use self::picture_options::PictureOptions;
use super::farm::Engine;
use super::new::recipes;
use super::progress::LogFormat;
use crate::scene::ExportFormat;

/// Shape from metric: give a surface its edge lengths, get its shape; let the metric change, get the film.
#[derive(Debug, Parser)]
#[command(name = "immerse", version, after_help = EXIT_CODES)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub command: Command,
    /// Number of threads; the result does not depend on it [default: all processors]
    #[arg(long, global = true, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// How things are said on standard error; JSON is one object a line, as docs/program.md has it
    #[arg(long, global = true, value_name = "FORMAT", default_value = "text")]
    pub log: LogFormat,
    /// No progress on standard error
    #[arg(long, short, global = true)]
    pub quiet: bool,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 failed while running or a check does not hold, 2 the input is at fault, 75 another process is at \
     work in the folder, 129, 130 or 143 ended by SIGHUP, SIGINT or SIGTERM.";

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Simulate (going on where an interrupted run stopped), render, and verify the scene's checks
    Run {
        #[command(flatten)]
        film: Film,
        /// Begin anew, replacing frames and pictures that are there
        #[arg(long)]
        restart: bool,
        /// Keep a small picture of the newest frame meanwhile, DIR/preview.png
        #[arg(long)]
        preview: bool,
        #[command(flatten)]
        pictures: PictureOptions,
    },
    /// Compute the frames
    Simulate {
        #[command(flatten)]
        film: Film,
        /// Begin anew, replacing the frames that are there
        #[arg(long)]
        restart: bool,
        /// Keep a small picture of the newest frame meanwhile, DIR/preview.png
        #[arg(long)]
        preview: bool,
    },
    /// Make pictures of computed frames
    Render {
        #[command(flatten)]
        film: Film,
        /// Make all pictures anew
        #[arg(long)]
        restart: bool,
        /// Make stills beside others that do the same with other --frames, and nothing else; `run` then puts all together
        #[arg(long, conflicts_with = "restart")]
        share: bool,
        #[command(flatten)]
        pictures: PictureOptions,
    },
    /// Make one picture of each scene: simulate where that was not done, and show the film as a whole
    Gallery {
        /// The scene files [default: scenes/*.toml; those whose input is not there are skipped]
        #[arg(value_name = "SCENES")]
        scenes: Vec<PathBuf>,
        /// Folder for the pictures
        #[arg(long, value_name = "DIR", default_value = "renders")]
        out: PathBuf,
        /// Folder for the films
        #[arg(long, value_name = "DIR", default_value = "target/gallery")]
        work: PathBuf,
        /// Begin all films anew
        #[arg(long)]
        restart: bool,
        #[command(flatten)]
        settings: Settings,
    },
    /// Run a scene once for every combination of values, several at a time, and put what they are worth in one table
    Sweep {
        /// The scene file
        #[arg(value_name = "SCENE")]
        scene: PathBuf,
        /// A mesh file in place of the scene's [mesh]
        #[arg(long, value_name = "FILE")]
        mesh: Option<PathBuf>,
        /// A key of the scene and its values, as in --set start.random=0,1,2; of several keys all combinations are run
        #[arg(long, value_name = "KEY=VALUES", required = true)]
        set: Vec<String>,
        /// Folder for the films, one in it for each run [default: renders/<scene name>.sweep]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Begin all films anew
        #[arg(long)]
        restart: bool,
    },
    /// Write job files that make a film on a farm, or with several values in --set a sweep, into DIR/farm
    Farm {
        #[command(flatten)]
        film: Film,
        /// What the job files are for
        #[arg(long, value_name = "ENGINE")]
        engine: Engine,
        /// Which frames become pictures, as in 1-20,30-240:4 [default: all]
        #[arg(long, value_name = "RANGE")]
        frames: Option<FrameRange>,
    },
    /// Validate a scene and all it names, and touch nothing
    Check {
        #[command(flatten)]
        scene: SceneFile,
        /// Print the phases that the scene goes through, as they can be written into it
        #[arg(long)]
        phases: bool,
        /// Take no trial steps: say nothing of the time, memory and disk that a run will take
        #[arg(long)]
        no_trial: bool,
    },
    /// Say what each computed frame is worth
    Inspect {
        /// The folder of the film
        folder: PathBuf,
        /// Print one JSON object instead of tables
        #[arg(long)]
        json: bool,
        /// Also write its curves over time there: curves.csv and curves.svg
        #[arg(long)]
        curves: bool,
    },
    /// Prove that a film is a regular homotopy, or list what folds and vanishes between its frames, into DIR/certificate.json
    Certify {
        /// The folder of the film, or one of OBJ files with the same faces, in the order of their names
        #[arg(value_name = "DIR")]
        folder: PathBuf,
        /// Print the certificate instead of a table
        #[arg(long)]
        json: bool,
        /// Also count double curves and triple points of each frame, and find the moments at which four sheets meet in a point
        #[arg(long)]
        points: bool,
    },
    /// Write a computed film as other programs read it
    Export {
        /// The folder of the film
        folder: PathBuf,
        /// The formats, several separated by commas
        #[arg(long, value_name = "FORMAT", value_delimiter = ',', required = true, value_parser = one_of(&ExportFormat::ALL))]
        format: Vec<ExportFormat>,
        /// Which frames, as in 1-20,30-240:4 [default: all]
        #[arg(long, value_name = "RANGE")]
        frames: Option<FrameRange>,
        /// Where to [default: DIR/export]
        #[arg(long, value_name = "FOLDER")]
        to: Option<PathBuf>,
        /// Write all files anew
        #[arg(long)]
        restart: bool,
    },
    /// Write a page of a computed film, DIR/report.html, which needs nothing else: the film to be turned, curves, tables
    Report {
        /// The folder of the film
        folder: PathBuf,
        /// Write it anew
        #[arg(long)]
        restart: bool,
    },
    /// Write the commented scene of a recipe, or one to start from
    #[command(after_help = recipes())]
    New {
        /// A recipe; anything else is the name of a scene to start from
        #[arg(value_name = "KIND")]
        kind: String,
        /// Name of the recipe's scene; NAME.toml is written [default: KIND]
        #[arg(value_name = "NAME")]
        name: Option<String>,
    },
    /// Print the JSON schema of scene files, for editors, or the reference of all keys, for people
    Schema {
        /// The reference as a page of Markdown, which is docs/reference.md
        #[arg(long)]
        markdown: bool,
    },
    /// Print a completion script
    Completions {
        /// For which shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page
    Man,
}

impl Command {
    /// Whether files are written, so that it takes care to end between two of them.
    pub fn writes(&self) -> bool {
        matches!(
            self,
            Command::Run { .. }
                | Command::Simulate { .. }
                | Command::Render { .. }
                | Command::Gallery { .. }
                | Command::Sweep { .. }
                | Command::Farm { .. }
                | Command::Certify { .. }
                | Command::Export { .. }
                | Command::Report { .. }
        )
    }

    /// Whether it begins anew whatever is there.
    pub fn restarts(&self) -> bool {
        match self {
            Command::Run { restart, .. }
            | Command::Simulate { restart, .. }
            | Command::Render { restart, .. }
            | Command::Gallery { restart, .. }
            | Command::Sweep { restart, .. }
            | Command::Export { restart, .. }
            | Command::Report { restart, .. } => *restart,
            _ => false,
        }
    }
}

#[derive(Args, Debug)]
pub(super) struct Film {
    #[command(flatten)]
    pub scene: SceneFile,
    /// Folder for frames and pictures [default: renders/<scene name>]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Args, Debug)]
pub(super) struct SceneFile {
    /// The scene file
    #[arg(value_name = "SCENE")]
    pub path: PathBuf,
    /// A mesh file in place of the scene's [mesh]
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    #[command(flatten)]
    pub settings: Settings,
}

#[derive(Args, Debug)]
pub(super) struct Settings {
    /// Sets a key of the scene, as in --set spin.class=01; may be given several times
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}
