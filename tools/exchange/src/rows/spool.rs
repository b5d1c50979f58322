//! Records that wait in a temporary file until the header can be written.

use anyhow::Context as _;
use pm_formats::{BlockMeta, Bounds, Header, Record, RecordWriter, StageReport};
use std::fs::File;
use std::io::{BufReader, BufWriter, Read as _, Seek as _, Write};
use std::marker::PhantomData;

/// Records with their batches, in the system's folder for temporary files (`TMPDIR`).
pub(super) struct Spool<T> {
    file: BufWriter<File>,
    pub(super) records: u64,
    bounds: Bounds,
    kind: PhantomData<T>,
}

impl<T: Record> Spool<T> {
    pub(super) fn new() -> anyhow::Result<Self> {
        let file = tempfile::tempfile().context("a temporary file")?;
        let bounds = Bounds { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] };
        Ok(Self { file: BufWriter::with_capacity(1 << 18, file), records: 0, bounds, kind: PhantomData })
    }

    pub(super) fn push(&mut self, batch: u64, position: [f32; 3], record: &T) -> anyhow::Result<()> {
        for (axis, x) in position.into_iter().enumerate() {
            self.bounds.min[axis] = self.bounds.min[axis].min(x);
            self.bounds.max[axis] = self.bounds.max[axis].max(x);
        }
        self.records += 1;
        let written = self.file.write_all(&batch.to_le_bytes());
        written.and_then(|()| self.file.write_all(bytemuck::bytes_of(record))).context("a temporary file")
    }

    /// All that is left to say before the stream can be written.
    pub(super) fn finish(self, header: Header, stage: StageReport, unused: Vec<String>) -> Imported<T> {
        let header = Header { bounds: self.bounds, expected_records: Some(self.records), ..header };
        Imported { header, stage, unused, spool: self }
    }
}

/// Records read from another renderer's file, ready to be written as a stream.
pub struct Imported<T> {
    /// Header of the stream; its bounds are those of the positions.
    pub header: Header,
    /// Names of columns that the file has and nobody knows.
    pub unused: Vec<String>,
    stage: StageReport,
    spool: Spool<T>,
}

impl<T: Record> Imported<T> {
    /// Writes the stream, a new batch wherever the batch of a row differs from that before.
    ///
    /// # Errors
    /// If the stream cannot be written, or the temporary file not be read.
    pub fn write<W: Write>(self, output: W) -> anyhow::Result<W> {
        let mut writer = RecordWriter::<T, W>::new(output, &self.header)?;
        let mut file = self.spool.file.into_inner().map_err(std::io::IntoInnerError::into_error)?;
        file.rewind()?;
        let mut file = BufReader::with_capacity(1 << 18, file);
        let mut bytes = vec![0; 8 + size_of::<T>()];
        for _ in 0..self.spool.records {
            file.read_exact(&mut bytes).context("a temporary file")?;
            let batch = u64::from_le_bytes(bytes[..8].try_into().expect("eight bytes"));
            let record: T = bytemuck::pod_read_unaligned(&bytes[8..]);
            writer.write(BlockMeta { batch, ..BlockMeta::default() }, &[record])?;
        }
        Ok(writer.finish(vec![self.stage])?)
    }
}
