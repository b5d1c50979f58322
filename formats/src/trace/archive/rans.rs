//! Symbols of known frequencies as bits, and back: an asymmetric numeral system of two states that take turns.
//!
//! Duda, *Asymmetric numeral systems: entropy coding combining speed of Huffman coding with compression rate of arithmetic
//! coding*, 2013; two states as in Giesen, *Interleaved entropy coders*, 2014.

/// Frequencies of a table add up to 2 to this power.
pub(super) const BITS: u32 = 12;
/// What frequencies of a table add up to.
pub(super) const WHOLE: u32 = 1 << BITS;
/// States lie from here to 2^64; below, a word is read.
const LOWEST: u64 = 1 << 32;

/// Where a symbol's numbers begin among all of its table, and how many it has: at least one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Share {
    pub(super) start: u32,
    pub(super) size: u32,
}

/// The bytes of symbols with these shares: the two states, then what is read of them later.
pub(super) fn encode(shares: impl DoubleEndedIterator<Item = Share> + ExactSizeIterator) -> Vec<u8> {
    let mut states = [LOWEST; 2];
    let mut words = vec![];
    // The last symbol is coded first, so that the first is read first.
    for (at, Share { start, size }) in shares.enumerate().rev() {
        let (state, size) = (&mut states[at % 2], u64::from(size));
        if *state >> (64 - BITS) >= size {
            words.push(*state as u32);
            *state >>= 32;
        }
        *state = ((*state / size) << BITS) + *state % size + u64::from(start);
    }
    let mut bytes: Vec<u8> = states.iter().flat_map(|state| state.to_le_bytes()).collect();
    bytes.extend(words.iter().rev().flat_map(|word| word.to_le_bytes()));
    bytes
}

/// Reads what [`encode`] wrote.
pub(super) struct Decoder<'a> {
    /// The one that is read next, and the other.
    states: [u64; 2],
    words: &'a [u32],
    at: usize,
}

/// The states and the words behind them; `None` without two states, or behind half a word.
pub(super) fn split(bytes: &[u8]) -> Option<([u64; 2], Vec<u32>)> {
    let (states, words) = bytes.split_at_checked(16)?;
    if words.len() % 4 != 0 {
        return None;
    }
    let state = |at: usize| u64::from_le_bytes(states[at..at + 8].try_into().expect("eight bytes"));
    let word = |word: &[u8]| u32::from_le_bytes(word.try_into().expect("four bytes"));
    Some(([state(0), state(8)], words.chunks_exact(4).map(word).collect()))
}

impl<'a> Decoder<'a> {
    /// Of what [`split`] gave.
    pub(super) const fn new(states: [u64; 2], words: &'a [u32]) -> Self {
        Self { states, words, at: 0 }
    }

    /// The number that tells the next symbol: the one whose share it lies in.
    #[inline(always)]
    pub(super) const fn number(&self) -> u32 {
        self.states[0] as u32 & (WHOLE - 1)
    }

    /// Goes on behind the symbol of this share, in which [`number`](Self::number) lies.
    #[inline(always)]
    pub(super) fn take(&mut self, share: Share) {
        let within = u64::from(self.number().wrapping_sub(share.start));
        let mut state = u64::from(share.size) * (self.states[0] >> BITS) + within;
        if state < LOWEST {
            // Once in some tens of symbols: a branch that is known beforehand.
            state = refilled(state, self.words, self.at);
            self.at += 1;
        }
        self.states = [self.states[1], state];
    }

    /// Was all read that was written, and nothing else?
    pub(super) fn is_done(&self) -> bool {
        self.at == self.words.len() && self.states == [LOWEST; 2]
    }
}

/// A state with the next word; behind the last there are zeros, and [`Decoder::is_done`] sees that.
#[cold]
#[inline(never)]
fn refilled(state: u64, words: &[u32], at: usize) -> u64 {
    state << 32 | u64::from(words.get(at).copied().unwrap_or(0))
}
