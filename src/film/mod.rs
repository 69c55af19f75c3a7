//! A film on disk, and the pictures that are made of it.
//!
//! `disk` keeps the surface, the frames and their reports in a folder. `pictures` makes stills, sheets and posters of them, and
//! `animation` puts pictures together to moving ones, and `export` writes
//! frames as other programs read them. `certificate` proves that nothing folds between frames, or says what does. `report` makes a page of a film that is turned with the mouse. `ledger` remembers what each picture was made of, so that it is made
//! again only when that changes. `leftovers` looks for what other films have left in the folder.

mod animation;
mod certificate;
mod disk;
mod error;
mod export;
mod kept_scene;
mod ledger;
mod leftovers;
mod metric_of_frame;
mod pictures;
mod report;

pub use certificate::{
    CERTIFICATE, CERTIFIER, Certificate, CertifiedEvent, CertifiedFrame, CertifiedPoints, CertifiedQuadruple,
    CertifiedRim, EventKind, certificate_of, certify, kept_certificate, write_certificate,
};
pub use disk::{DiskError, FilmFolder, FilmMesh, FilmSpec, FolderLock, Manifest, MeshCounts};
pub use error::FilmError;
pub use export::{EXPORTER, Exported, export};
pub use leftovers::{Leftovers, clear_film, clear_leftovers, forget_pictures, forget_preview};
pub use pictures::{
    Arrivals, Event, PictureCost, Pictured, Plan, RENDERER, Tile, Watch, make_look_sheet, make_pictures,
    make_pictures_of_arrivals, make_poster, make_preview, make_sheet_of_films, make_stills_beside_others, take_picture,
    try_a_picture,
};
pub use report::{FilmRow, FilmTable, Finding, Findings, REPORT, REPORTER, Reported, report, report_films};
