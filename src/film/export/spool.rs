//! Parts of a file in the making, of each of which every frame has a piece.

use std::fs::File;
use std::io::{self, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

use super::layout::Part;
use crate::whole_file;

/// Temporary files without names, which go with the program.
pub(super) struct Spools {
    folder: PathBuf,
    parts: Vec<BufWriter<File>>,
    lengths: Vec<u64>,
}

impl Spools {
    /// In a folder that has room for the file itself.
    pub fn new(folder: &Path) -> Spools {
        Spools { folder: folder.to_owned(), parts: Vec::new(), lengths: Vec::new() }
    }

    /// Appends the pieces of a frame.
    pub fn push(&mut self, pieces: &[Vec<u8>]) -> io::Result<()> {
        while self.parts.len() < pieces.len() {
            self.parts.push(BufWriter::new(tempfile::tempfile_in(&self.folder)?));
            self.lengths.push(0);
        }
        for ((part, length), piece) in self.parts.iter_mut().zip(&mut self.lengths).zip(pieces) {
            part.write_all(piece)?;
            *length += piece.len() as u64;
        }
        Ok(())
    }

    /// Bytes of each part.
    pub fn lengths(&self) -> &[u64] {
        &self.lengths
    }

    /// Writes a file of parts. It appears whole or not at all.
    pub fn write(&mut self, path: &Path, parts: &[Part]) -> io::Result<()> {
        let mut file = BufWriter::new(whole_file::begin(path)?);
        for part in parts {
            match part {
                Part::Bytes(bytes) => file.write_all(bytes)?,
                Part::Pieces(number) => {
                    if let Some(spool) = self.parts.get_mut(*number) {
                        spool.flush()?;
                        let spool = spool.get_mut();
                        spool.rewind()?;
                        io::copy(spool, &mut file)?;
                    }
                }
            }
        }
        whole_file::publish(file.into_inner().map_err(io::IntoInnerError::into_error)?, path)
    }
}
