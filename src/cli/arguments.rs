//! What can be typed.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use super::picture_options::PictureOptions;

/// Shape from metric: give a surface its edge lengths, get its shape; let the metric change, get the film.
#[derive(Debug, Parser)]
#[command(name = "immerse", version, after_help = EXIT_CODES)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub command: Command,
    /// Number of threads; the result does not depend on it [default: all processors]
    #[arg(long, global = true, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// No progress on standard error
    #[arg(long, short, global = true)]
    pub quiet: bool,
}

const EXIT_CODES: &str =
    "Exit codes: 0 done, 1 failed while running or a check does not hold, 2 the input is at fault.";

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Simulate (going on where an interrupted run stopped), render, and verify the scene's checks
    Run {
        #[command(flatten)]
        film: Film,
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
    },
    /// Make pictures of computed frames
    Render {
        #[command(flatten)]
        film: Film,
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
    },
    /// Validate a scene and all it names, and touch nothing
    Check {
        #[command(flatten)]
        scene: SceneFile,
        /// Print the phases that the scene goes through, as they can be written into it
        #[arg(long)]
        phases: bool,
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
    /// Write a commented scene to start from
    New {
        /// Name of the scene; NAME.toml is written
        name: String,
    },
    /// Print the JSON schema of scene files
    Schema,
    /// Print a completion script
    Completions {
        /// For which shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page
    Man,
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
}
