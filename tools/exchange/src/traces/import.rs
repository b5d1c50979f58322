//! What a format of traces is to those who read it.

use super::reference::LONGEST_ACCESS;
use super::{EntryKind, Numbered, Parsed, Reference};
use crate::BadQuestion;
use pm_formats::trace::Access;
use pm_registry::Registered;

/// A format of traces that is read: an entry of [`imports`](super::imports).
pub trait TraceImport: Registered + Sync {
    /// What its entries are: lines, if it does not say otherwise.
    fn shape(&self) -> EntryShape {
        EntryShape::Line
    }

    /// Bytes of an access whose entry does not say, and a remark for the table of formats; `None` if every entry says.
    fn assumed_size(&self) -> Option<AssumedSize>;

    /// How an input is known to be of this format.
    fn recognition(&self) -> Recognition {
        match self.shape() {
            EntryShape::Line => Recognition::FirstLine,
            EntryShape::Record { .. } => Recognition::ByName,
            EntryShape::Headed { .. } => Recognition::Signature,
        }
    }

    /// Has an input that begins so the signature of the format? Then it is of this format, whatever it is said to be.
    fn signs(&self, beginning: &[u8]) -> bool {
        let _ = beginning;
        false
    }

    /// What understands its entries, one after another from the first of an input.
    fn parser(&self) -> Box<dyn EntryParser>;

    /// The same where columns are named that the input may not name, if the format has columns.
    fn parser_of_columns(&self) -> Option<ParserOfColumns> {
        None
    }

    /// An input and what it says, by which [`trial`](crate::trial) tries the format: two entries or more, the first one an
    /// access to data.
    fn example(&self) -> Example;
}

/// Makes a parser of entries with these columns, or says why they make no sense.
pub type ParserOfColumns = fn(&[String]) -> Result<Box<dyn EntryParser>, BadQuestion>;

/// Understands the entries of one input, in their order.
pub trait EntryParser {
    /// What the header says, if the input has one: how many bytes a record has.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    fn header(&mut self, header: &[u8]) -> Result<usize, String> {
        Err(format!("{} bytes of a header that the format has not", header.len()))
    }

    /// The entry in these bytes, a line without its end or a record: the first access that it tells of.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    fn parse(&mut self, entry: &[u8]) -> Parsed;

    /// The next access of the same entry, if it tells of several.
    fn rest(&mut self) -> Option<Reference> {
        None
    }

    /// Adds the entries of records of `bytes` bytes each, of which the first has this number, to `parsed`. Every parser has
    /// the loop of its own, so that a record costs no call.
    ///
    /// # Errors
    /// The number of the first that is wrong, and what is wrong with it; those before are there.
    fn parse_records(
        &mut self,
        records: &[u8],
        bytes: usize,
        first: u64,
        parsed: &mut Vec<Numbered>,
    ) -> Result<(), (u64, String)> {
        for (number, record) in (first..).zip(records.chunks_exact(bytes)) {
            if let Some(reference) = self.parse(record).map_err(|what| (number, what))? {
                parsed.push(Numbered { number, reference });
                while let Some(reference) = self.rest() {
                    parsed.push(Numbered { number, reference });
                }
            }
        }
        Ok(())
    }

    /// Replaces `accesses` by what records of `bytes` bytes each tell, if all is plain: accesses to data that end within all
    /// addresses, one a record and none longer than is believed. False if not, or if the parser remembers what it read: then
    /// nothing happened but that what is in `accesses` is worthless.
    fn plain_records(&mut self, records: &[u8], bytes: usize, sizes: Sizes, accesses: &mut Vec<Access>) -> bool {
        let _ = (records, bytes, sizes, accesses);
        false
    }

    /// No more entries follow.
    ///
    /// # Errors
    /// What is missing, in words, if the format tells where an input ends.
    fn end(&mut self) -> Result<(), String> {
        Ok(())
    }
}

/// Bytes of the accesses that entries tell of.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    /// Of all, whatever the entries say.
    pub all: Option<u32>,
    /// Of those whose entries do not say.
    pub assumed: u32,
}

impl<F: Fn(&[u8]) -> Parsed> EntryParser for F {
    fn parse(&mut self, entry: &[u8]) -> Parsed {
        self(entry)
    }

    fn plain_records(&mut self, records: &[u8], bytes: usize, sizes: Sizes, accesses: &mut Vec<Access>) -> bool {
        plain(records.chunks_exact(bytes), sizes, accesses, &*self)
    }
}

/// The [`plain_records`](EntryParser::plain_records) of what `parse` understands one by one.
pub(in crate::traces) fn plain<'a>(
    records: impl ExactSizeIterator<Item = &'a [u8]>,
    sizes: Sizes,
    accesses: &mut Vec<Access>,
    parse: impl Fn(&'a [u8]) -> Parsed,
) -> bool {
    accesses.resize(records.len(), Access::read(0, 0, 0));
    for (access, record) in accesses.iter_mut().zip(records) {
        let Ok(Some(Reference { kind: EntryKind::Data(kind), address, len })) = parse(record) else { return false };
        let told = len.unwrap_or(sizes.assumed);
        let believed = sizes.all.is_some() || told <= LONGEST_ACCESS;
        let len = sizes.all.unwrap_or(told);
        if !believed || address > u64::MAX - u64::from(len.max(1) - 1) {
            return false;
        }
        *access = Access { kind, region: 0, len, offset: address };
    }
    true
}

/// What entries are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryShape {
    /// A line of text; empty ones are passed over.
    Line,
    /// A record of a fixed length.
    Record {
        /// Its length.
        bytes: usize,
    },
    /// A header of so many bytes, and then records of the length that it says.
    Headed {
        /// Bytes of the header.
        header: usize,
    },
}

impl EntryShape {
    /// Is it text?
    #[must_use]
    pub const fn is_text(self) -> bool {
        matches!(self, Self::Line)
    }
}

/// How an input is known to be of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recognition {
    /// It has to be named: any bytes might be meant, those of a damaged stream of ours too.
    ByName,
    /// By its first bytes, which no input of another kind has.
    Signature,
    /// By its first lines; if they fit another format just as well, it has to be named.
    FirstLine,
}

/// Bytes of an access whose entry does not say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AssumedSize {
    /// So many.
    pub bytes: u32,
    /// The address is that of a unit of so many bytes, a power of two, wherever in it the entry points.
    pub aligned: bool,
}

impl AssumedSize {
    /// The byte at the address.
    pub const BYTE: Self = Self::bytes(1);

    /// So many bytes from the address on.
    #[must_use]
    pub const fn bytes(bytes: u32) -> Self {
        Self { bytes, aligned: false }
    }
}

/// An input and what it says.
#[derive(Clone, Copy, Debug)]
pub struct Example {
    /// The input, whole.
    pub input: &'static [u8],
    /// Its entries without comments.
    pub entries: &'static [Reference],
}
