//! Single bits, written and read.

/// Bits, least significant first within each byte.
#[derive(Default)]
pub(super) struct BitWriter {
    /// Whole bytes, and room behind them.
    bytes: Vec<u8>,
    len: usize,
    pending: u64,
    /// Bits that are pending: less than a byte.
    count: u32,
}

impl BitWriter {
    /// Makes room for so many bits, and for the word in which the last of them are written.
    pub(super) fn make_room(&mut self, bits: usize) {
        let least = self.len + bits / 8 + 2 * size_of::<u64>();
        if self.bytes.len() < least {
            self.bytes.resize(least.max(2 * self.bytes.len()), 0);
        }
    }

    /// So many bits, at most 56, the first of which is the lowest; above them are zeros. There is [room](Self::make_room) for them.
    ///
    /// How many bytes are whole is anyone's guess, so eight are written and those that are count: no branch.
    #[inline]
    pub(super) fn push_all(&mut self, bits: u64, count: u32) {
        debug_assert!(count <= 56 && bits >> count == 0);
        self.pending |= bits << self.count;
        self.count += count;
        self.bytes[self.len..][..size_of::<u64>()].copy_from_slice(&self.pending.to_le_bytes());
        self.len += self.count as usize / 8;
        self.pending >>= self.count & !7;
        self.count %= 8;
    }

    /// Fills the last byte with zeros.
    pub(super) fn align(&mut self) {
        self.make_room(8);
        self.push_all(0, (8 - self.count) % 8);
    }

    /// All bytes, if the last is filled.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes[..self.len]
    }

    /// Forgets all bits since.
    pub(super) fn rewind(&mut self, (len, pending, count): (usize, u64, u32)) {
        (self.len, self.pending, self.count) = (len, pending, count);
    }

    pub(super) fn mark(&self) -> (usize, u64, u32) {
        (self.len, self.pending, self.count)
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
