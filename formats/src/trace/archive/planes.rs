//! The payload of a block of searches as its four planes, and those of several blocks as one.

use crate::trace::varint::{push, take, unzigzag, zigzag};

/// Heads, destinations, walks and others.
pub(super) type Planes<T> = [T; 4];

/// Place of the heads and of the walks.
pub(super) const HEADS: usize = 0;
pub(super) const WALKS: usize = 2;

/// The planes of a payload; `None` if it is none.
pub(super) fn split(payload: &[u8]) -> Option<Planes<&[u8]>> {
    let (lengths, mut rest) = payload.split_at_checked(12)?;
    let mut planes = [&[][..]; 4];
    for (length, plane) in lengths.chunks_exact(4).zip(&mut planes) {
        let length = u32::from_le_bytes(length.try_into().expect("four bytes"));
        (*plane, rest) = rest.split_at_checked(usize::try_from(length).ok()?)?;
    }
    planes[3] = rest;
    Some(planes)
}

/// The payload of these planes.
///
/// # Panics
/// If a plane has more than 4 GiB.
pub(super) fn join(planes: Planes<&[u8]>) -> Vec<u8> {
    let mut payload = Vec::with_capacity(12 + planes.iter().map(|plane| plane.len()).sum::<usize>());
    for plane in &planes[..3] {
        payload.extend_from_slice(&u32::try_from(plane.len()).expect("less than 4 GiB").to_le_bytes());
    }
    planes.iter().for_each(|plane| payload.extend_from_slice(plane));
    payload
}

/// Payloads of blocks that follow one another, put together.
#[derive(Default)]
pub(in crate::trace) struct Joined {
    planes: Planes<Vec<u8>>,
    last_pixel: i64,
}

impl Joined {
    /// Puts the searches of one more behind those so far; `None` if it does not hold so many, and worthless then.
    pub(in crate::trace) fn push(&mut self, payload: &[u8], searches: u32) -> Option<()> {
        let [heads, mut destinations, walks, others] = split(payload)?;
        self.planes[HEADS].extend_from_slice(heads);
        self.planes[WALKS].extend_from_slice(walks);
        self.planes[3].extend_from_slice(others);
        // Pixels are told by how far they are from the one before in the block.
        let (mut pixel, coded) = (0i64, &mut self.planes[1]);
        for _ in 0..searches {
            let pixels = take(&mut destinations)?;
            push(coded, pixels);
            for _ in 0..pixels {
                pixel = pixel.checked_add(unzigzag(take(&mut destinations)?))?;
                push(coded, zigzag(pixel.checked_sub(self.last_pixel)?));
                self.last_pixel = pixel;
            }
        }
        destinations.is_empty().then_some(())
    }

    pub(in crate::trace) fn payload(&self) -> Vec<u8> {
        join(self.planes.each_ref().map(|plane| &plane[..]))
    }
}
