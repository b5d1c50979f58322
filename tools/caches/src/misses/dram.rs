//! Banks of a DRAM and the rows open in them, as the fetches of a cache meet them.
//!
//! A DRAM reads a row of some kilobytes into the buffer of its bank (*activates* it) before it transfers any of it. A fetch that
//! finds its row open is a *hit*; where another row is open that has to be closed first, a *conflict*. Fetches are served in
//! their order: no controller looks ahead for those that would hit, and nothing is refreshed.

use std::fmt;
use std::str::FromStr;

use pm_registry::Choice as _;
use pm_size::{Bytes, SizeError};
use thiserror::Error;

pm_registry::choices! {
    /// What becomes of a row after a fetch.
    #[derive(Debug)]
    pub enum RowPolicy {
        /// It stays open until another row of its bank is needed
        Open = "open",
        /// It is closed: every fetch activates its row
        Closed = "closed",
    }
}

pm_registry::choices! {
    /// Which bank a row lies in.
    #[derive(Debug)]
    pub enum BankMap {
        /// Row number modulo banks: rows one after another lie in banks one after another
        Row = "row",
        /// The same, its bits inverted where those above are set: powers of two apart lie in different banks
        Xor = "xor",
    }
}

/// A DRAM: `BANKS,ROW,POLICY`, such as `32,8K,open`, or with the map of addresses to banks behind it, `32,8K,open,xor`.
///
/// `row`, the map where none is told, is that of a memory controller that takes the bank from the bits above those of the row.
/// With `xor` the bank is the exclusive or of these bits and those above them (Zhang, Zhu and Zhang, *A permutation-based page
/// interleaving scheme*, MICRO 2000).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dram {
    banks: u32,
    row_bytes: u64,
    policy: RowPolicy,
    map: BankMap,
}

/// Why there is no such DRAM.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum DramError {
    /// Not three parts between commas, or four.
    #[error("`{0}`: a DRAM is BANKS,ROW,POLICY such as 32,8K,open or 16,2K,closed, and may end in ,row or ,xor")]
    Parts(String),
    /// The banks are no power of two.
    #[error("`{0}`: a power of two of banks is expected, from 1 to 65536, such as 32")]
    Banks(String),
    /// The row is no power of two.
    #[error("`{0}`: a row is a power of two of bytes, from 64 on, such as 8K")]
    Row(String),
    /// The row is no size.
    #[error(transparent)]
    Size(#[from] SizeError),
}

impl FromStr for Dram {
    type Err = DramError;

    fn from_str(text: &str) -> Result<Self, DramError> {
        let parts = || DramError::Parts(text.to_owned());
        let words: Vec<&str> = text.split(',').collect();
        let (banks, row, policy, map) = match words[..] {
            [banks, row, policy] => (banks, row, policy, Some(BankMap::Row)),
            [banks, row, policy, map] => (banks, row, policy, BankMap::of_word(map)),
            _ => return Err(parts()),
        };
        let map = map.ok_or_else(parts)?;
        let policy = RowPolicy::of_word(policy).ok_or_else(parts)?;
        let number = banks.parse().ok().filter(|banks: &u32| banks.is_power_of_two() && *banks <= 1 << 16);
        let banks = number.ok_or_else(|| DramError::Banks(banks.to_owned()))?;
        let row_bytes = row.parse::<Bytes>()?.0;
        if !row_bytes.is_power_of_two() || row_bytes < 64 {
            return Err(DramError::Row(row.to_owned()));
        }
        Ok(Self { banks, row_bytes, policy, map })
    }
}

impl fmt::Display for Dram {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { banks, policy, map, .. } = self;
        f.pad(&format!("{banks},{},{},{}", Bytes(self.row_bytes), policy.word(), map.word()))
    }
}

/// What the fetches of a cache did to a DRAM. A fetch that reaches over several rows is one of each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DramCounts {
    /// They found their row open.
    pub hits: u64,
    /// They found another row open in its bank.
    pub conflicts: u64,
    /// Rows activated: all that were no hits.
    pub activates: u64,
}

/// The banks of a DRAM while it is simulated.
#[derive(Clone, Debug)]
pub(crate) struct Banks {
    dram: Dram,
    /// By bank, the row that is open in it.
    open: Vec<Option<u64>>,
    pub(crate) counts: DramCounts,
}

impl Banks {
    pub(crate) fn new(dram: Dram) -> Self {
        Self { dram, open: vec![None; dram.banks as usize], counts: DramCounts::default() }
    }

    /// The bytes from address `first` to `last` are fetched.
    pub(crate) fn fetch(&mut self, first: u64, last: u64, counted: bool) {
        let (shift, banks) = (self.dram.row_bytes.ilog2(), u64::from(self.dram.banks));
        for row in first >> shift..=last >> shift {
            let own = match self.dram.map {
                BankMap::Row => row,
                BankMap::Xor => row ^ (row / banks),
            };
            let open = &mut self.open[(own & (banks - 1)) as usize];
            if counted {
                let counts = &mut self.counts;
                counts.hits += u64::from(*open == Some(row));
                counts.conflicts += u64::from(open.is_some_and(|open| open != row));
                counts.activates += u64::from(*open != Some(row));
            }
            *open = (self.dram.policy == RowPolicy::Open).then_some(row);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(text: &str, fetches: &[u64]) -> (u64, u64, u64) {
        let mut banks = Banks::new(text.parse().unwrap());
        fetches.iter().for_each(|&address| banks.fetch(address, address + 127, true));
        let DramCounts { hits, conflicts, activates } = banks.counts;
        (hits, conflicts, activates)
    }

    #[test]
    fn rows_stay_open_in_their_banks() {
        let row = 8192;
        // Two rows of one bank take turns; two rows of two banks do not disturb one another.
        let apart = |rows: u64| [0, rows * row, 128, rows * row + 128, 0, rows * row];
        assert_eq!(counts("4,8K,open", &apart(4)), (0, 5, 6));
        assert_eq!(counts("4,8K,open", &apart(1)), (4, 0, 2));
        assert_eq!(counts("4,8K,open,xor", &apart(4)), (4, 0, 2));
        assert_eq!(counts("4,8K,open,xor", &apart(5)), (0, 5, 6), "0 + 0 and 1 ^ 1");
        assert_eq!(counts("1,8K,open", &apart(1)), (0, 5, 6));
        assert_eq!(counts("4,8K,closed", &apart(1)), (0, 0, 6));
        // A fetch over the end of a row is one of each.
        assert_eq!(counts("4,8K,open", &[row - 64, 0, row]), (2, 0, 2));
        assert_eq!(counts("65536,64,open", &[u64::MAX - 127]), (0, 0, 2));
    }

    #[test]
    fn warm_up_opens_rows_and_counts_nothing() {
        let mut banks = Banks::new("2,64,open".parse().unwrap());
        banks.fetch(0, 63, false);
        assert_eq!(banks.counts, DramCounts::default());
        banks.fetch(0, 63, true);
        assert_eq!(banks.counts, DramCounts { hits: 1, ..DramCounts::default() });
    }

    #[test]
    fn drams_read_as_they_are_printed_and_refusals_say_what_would_do() {
        for (text, printed) in [("32,8K,open", "32,8K,open,row"), ("1,2048,closed,xor", "1,2K,closed,xor")] {
            let dram: Dram = text.parse().unwrap();
            assert_eq!((dram.to_string(), dram.to_string().parse()), (printed.to_owned(), Ok(dram)));
        }
        for (text, hint) in [
            ("", "BANKS,ROW,POLICY"),
            ("32,8K", "BANKS,ROW,POLICY"),
            ("32,8K,ajar", "BANKS,ROW,POLICY"),
            ("32,8K,open,row,xor", "BANKS,ROW,POLICY"),
            ("32,8K,open,diagonal", "BANKS,ROW,POLICY"),
            ("12,8K,open", "power of two of banks"),
            ("0,8K,open", "power of two of banks"),
            ("16,32,open", "from 64 on"),
            ("16,100,open", "from 64 on"),
            ("16,8KB,open", "8K"),
        ] {
            let message = text.parse::<Dram>().unwrap_err().to_string();
            assert!(message.contains(hint), "{text}: {message}");
        }
    }
}
