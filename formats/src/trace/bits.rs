//! Single bits, written and read.

/// Bits, least significant first within each byte.
#[derive(Default)]
pub(super) struct BitWriter {
    pub(super) bytes: Vec<u8>,
    pending: u64,
    pub(super) count: u32,
}

impl BitWriter {
    #[inline]
    pub(super) fn push(&mut self, bit: bool) {
        self.pending |= u64::from(bit) << self.count;
        self.count += 1;
        if self.count == 64 {
            self.bytes.extend_from_slice(&self.pending.to_le_bytes());
            (self.pending, self.count) = (0, 0);
        }
    }

    /// Fills the last byte with zeros.
    pub(super) fn align(&mut self) {
        let whole = self.count.div_ceil(8) as usize;
        self.bytes.extend_from_slice(&self.pending.to_le_bytes()[..whole]);
        (self.pending, self.count) = (0, 0);
    }

    /// Forgets all bits since the writer was aligned at `len` bytes.
    pub(super) fn rewind(&mut self, (len, pending, count): (usize, u64, u32)) {
        self.bytes.truncate(len);
        (self.pending, self.count) = (pending, count);
    }

    pub(super) fn mark(&self) -> (usize, u64, u32) {
        (self.bytes.len(), self.pending, self.count)
    }
}

/// Reads what [`BitWriter`] wrote.
pub(super) struct BitReader<'a> {
    bytes: &'a [u8],
    position: usize,
}

impl<'a> BitReader<'a> {
    pub(super) const fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, position: 0 }
    }

    #[inline(always)]
    pub(super) fn bit(&mut self) -> Option<u32> {
        let byte = *self.bytes.get(self.position >> 3)?;
        let bit = u32::from(byte >> (self.position & 7)) & 1;
        self.position += 1;
        Some(bit)
    }

    /// The least number of bits that are [`ahead`](Self::ahead).
    pub(super) const AHEAD: usize = 57;

    /// The next bits, [`AHEAD`](Self::AHEAD) or more of them; behind the end, zeros.
    #[inline(always)]
    pub(super) fn ahead(&self) -> u64 {
        let behind = self.bytes.get(self.position >> 3..).unwrap_or_default();
        let word = match behind.first_chunk() {
            Some(&bytes) => u64::from_le_bytes(bytes),
            None => Self::last(behind),
        };
        word >> (self.position & 7)
    }

    #[cold]
    fn last(behind: &[u8]) -> u64 {
        let mut bytes = [0; 8];
        bytes[..behind.len()].copy_from_slice(behind);
        u64::from_le_bytes(bytes)
    }

    /// Goes past so many bits, which may be more than there are.
    #[inline(always)]
    pub(super) const fn skip(&mut self, bits: u32) {
        self.position += bits as usize;
    }

    /// The next bit; behind the end, 0.
    pub(super) fn take(&mut self) -> u32 {
        let bit = self.ahead() as u32 & 1;
        self.skip(1);
        bit
    }

    /// Whether no bit was taken that is not there.
    pub(super) const fn is_within(&self) -> bool {
        self.position <= 8 * self.bytes.len()
    }

    pub(super) const fn align(&mut self) {
        self.position = self.position.next_multiple_of(8);
    }

    /// Number of whole bytes read.
    pub(super) const fn bytes_read(&self) -> usize {
        self.position / 8
    }
}
