//! Files that are whole or absent, and JSON that carries its own checksum.

use std::io;
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::error::DiskError;
use super::manifest::FORMAT;
use crate::whole_file::{self, ReadError};

/// Writes a file so that after a crash at any instant there is the old one, the new one or none.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), DiskError> {
    whole_file::write(path, bytes).map_err(DiskError::io(path, "written"))
}

/// Removes a file if it is there.
pub(super) fn remove(path: &Path) -> Result<(), DiskError> {
    whole_file::remove(path).map_err(DiskError::io(path, "removed"))
}

/// The most bytes of a file of a film: a frame of the largest mesh has fewer.
const MOST_BYTES: u64 = 1 << 40;

/// The bytes of a file, or `None` if it is not there.
pub(super) fn read(path: &Path) -> Result<Option<Vec<u8>>, DiskError> {
    match whole_file::read(path, MOST_BYTES) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(ReadError::Io(error)) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(ReadError::Io(error)) => Err(DiskError::io(path, "read")(error)),
        Err(error) => Err(DiskError::io(path, "read")(io::Error::other(error.to_string()))),
    }
}

/// A JSON object whose first entry is the CRC-32 of all the bytes after that entry.
pub(super) fn seal(record: &impl Serialize) -> serde_json::Result<Vec<u8>> {
    let text = serde_json::to_string_pretty(record)? + "\n";
    let body = text.strip_prefix('{').unwrap_or(&text);
    Ok(format!("{PREFIX}{:08x}{SUFFIX}{body}", crc32fast::hash(body.as_bytes())).into_bytes())
}

const PREFIX: &str = "{\n  \"crc32\": \"";
const SUFFIX: &str = "\",";

/// Why sealed JSON cannot be opened.
pub(super) enum SealError {
    Version(u64),
    Damaged(String),
}

/// What was sealed. The version is looked at first, since a later format may be sealed otherwise.
pub(super) fn unseal<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, SealError> {
    #[derive(serde::Deserialize)]
    struct Version {
        format: u64,
    }
    let damaged = |reason: &str| SealError::Damaged(reason.to_owned());
    let text = str::from_utf8(bytes).map_err(|_| damaged("it is not text"))?;
    let sealed = text.strip_prefix(PREFIX).and_then(|rest| rest.split_at_checked(8));
    let opened = sealed.and_then(|(crc, rest)| Some((crc, rest.strip_prefix(SUFFIX)?)));
    let checks = opened.is_some_and(|(crc, body)| crc == format!("{:08x}", crc32fast::hash(body.as_bytes())));
    match serde_json::from_str::<Version>(text) {
        Ok(Version { format }) if format != u64::from(FORMAT) => return Err(SealError::Version(format)),
        Ok(_) if checks => {}
        Ok(_) => return Err(damaged("its checksum does not match")),
        Err(error) => return Err(SealError::Damaged(format!("it is not the JSON that was written: {error}"))),
    }
    serde_json::from_str(text).map_err(|error| SealError::Damaged(error.to_string()))
}
