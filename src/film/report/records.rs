//! What was measured of the frames, in a temporary file until ranges of the whole film are known.

use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

use glam::DVec3;

/// The large arrays of a frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Record {
    /// |V|
    pub positions: Vec<DVec3>,
    /// Shares of the sky of fronts and backs, from 0 to 63; |V| each.
    pub sky: [Vec<u8>; 2],
    /// In the order of the fields.
    pub fields: Vec<Vec<f32>>,
    /// Segments in which the surface passes through itself.
    pub crossings: Vec<[DVec3; 2]>,
}

/// A temporary file without a name, which goes with the program.
pub(super) struct Records {
    file: BufWriter<File>,
    /// Where each record begins, and where the next one would.
    starts: Vec<u64>,
}

impl Records {
    /// In a folder that has room for it.
    pub fn new(folder: &Path) -> io::Result<Records> {
        Ok(Records { file: BufWriter::new(tempfile::tempfile_in(folder)?), starts: vec![0] })
    }

    pub fn push(&mut self, record: &Record) -> io::Result<()> {
        let mut bytes = Vec::new();
        let points = |bytes: &mut Vec<u8>, points: &mut dyn Iterator<Item = DVec3>| {
            points.flat_map(|point| point.to_array()).for_each(|x| bytes.extend(x.to_le_bytes()));
        };
        let Record { positions, sky, fields, crossings } = record;
        points(&mut bytes, &mut positions.iter().copied());
        sky.iter().for_each(|side| bytes.extend(side));
        fields.iter().flatten().for_each(|value| bytes.extend(value.to_le_bytes()));
        points(&mut bytes, &mut crossings.iter().flatten().copied());
        self.file.write_all(&bytes)?;
        self.starts.push(self.starts[self.starts.len() - 1] + bytes.len() as u64);
        Ok(())
    }

    /// The record at a place, of so many vertices, with fields of these lengths.
    pub fn read(&mut self, place: usize, vertices: usize, fields: &[usize]) -> io::Result<Record> {
        self.file.flush()?;
        let (start, end) = (self.starts[place], self.starts[place + 1]);
        let file = self.file.get_mut();
        file.seek(SeekFrom::Start(start))?;
        let mut bytes = Vec::new();
        BufReader::new(file.take(end - start)).read_to_end(&mut bytes)?;
        let mut rest = bytes.as_slice();
        let mut take = |count: usize| -> io::Result<&[u8]> {
            let (taken, left) = rest.split_at_checked(count).ok_or(io::ErrorKind::UnexpectedEof)?;
            rest = left;
            Ok(taken)
        };
        let point = |bytes: &[u8; 24]| {
            DVec3::from_array([0, 1, 2].map(|k| bytes[8 * k..8 * k + 8].try_into().map_or(0.0, f64::from_le_bytes)))
        };
        let positions = take(24 * vertices)?.as_chunks().0.iter().map(point).collect();
        let sky = [take(vertices)?.to_vec(), take(vertices)?.to_vec()];
        let values = |bytes: &[u8]| bytes.as_chunks().0.iter().map(|&b| f32::from_le_bytes(b)).collect();
        let fields = fields.iter().map(|count| Ok(values(take(4 * count)?))).collect::<io::Result<_>>()?;
        let points: Vec<DVec3> = rest.as_chunks().0.iter().map(point).collect();
        Ok(Record { positions, sky, fields, crossings: points.as_chunks().0.to_vec() })
    }
}
