//! Standard output, which may be full or have no reader.

use std::io::{self, ErrorKind, StdoutLock, Write};

/// Writes results to standard output. A reader that has seen enough ends no work, as in `immerse run … | head`, and
/// neither does a full disk: that is told in the end.
pub(in crate::cli) struct Answers {
    out: StdoutLock<'static>,
    /// Why nothing is written any more.
    failed: Option<io::Error>,
}

impl Answers {
    pub fn new() -> Answers {
        Answers { out: io::stdout().lock(), failed: None }
    }

    /// Whether all that somebody wanted to read could be written.
    ///
    /// # Errors
    /// The first one, unless the reader went.
    pub fn end(mut self) -> io::Result<()> {
        let _ = self.flush();
        match self.failed {
            Some(error) if error.kind() != ErrorKind::BrokenPipe => Err(error),
            _ => Ok(()),
        }
    }

    fn note(&mut self, outcome: io::Result<()>) {
        if let Err(error) = outcome {
            self.failed.get_or_insert(error);
        }
    }
}

impl Write for Answers {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.failed.is_none() {
            let outcome = self.out.write_all(bytes);
            self.note(outcome);
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.failed.is_none() {
            let outcome = self.out.flush();
            self.note(outcome);
        }
        Ok(())
    }
}
