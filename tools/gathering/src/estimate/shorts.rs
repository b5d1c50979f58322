//! Powers of photons as integers, and sums of them.

use pm_formats::Photon;
use pm_random::mix;
use std::borrow::Borrow;

/// As many kinds of photons as two bytes tell apart.
const MOST_KINDS: usize = 1 << 16;
/// Powers whose exponents differ by no more than this are integers, in units of the least, that take 52 bits.
const MOST_APART: u8 = 44;
/// Powers whose exponents differ by no more than this take 16 bits.
const MOST_PACKED: u8 = 8;

/// Photons that are added up at once at most: 32 bits hold the sum of so many powers of 16 bits.
pub(super) const AT_ONCE: usize = 1 << 16;

/// Red, green and blue of a photon's power in units of the least, and the code of its normal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(align(32))]
pub(super) struct Short([u64; 4]);

impl Short {
    /// That of a photon, in units of 2^least.
    fn new(photon: &Photon, least: u8) -> Self {
        let [red, green, blue, exponent] = photon.power;
        // A power of 0 has the exponent 0, whatever its mantissas.
        let power = |mantissa: u8| if exponent == 0 { 0 } else { u64::from(mantissa) << (exponent - least) };
        Self([power(red), power(green), power(blue), u64::from(photon.flags >> 2)])
    }

    /// Code of the normal.
    #[inline(always)]
    pub(super) const fn normal(&self) -> u16 {
        self.0[3] as u16
    }

    /// Red, green and blue.
    #[inline(always)]
    pub(super) const fn power(&self) -> [u64; 3] {
        let [red, green, blue, _] = self.0;
        [red, green, blue]
    }

    /// In one word, 16 bits each.
    const fn packed(self) -> u64 {
        let [red, green, blue, normal] = self.0;
        red | green << 16 | blue << 32 | normal << 48
    }

    #[inline(always)]
    const fn unpacked(word: u64) -> Self {
        Self([word & 0xffff, word >> 16 & 0xffff, word >> 32 & 0xffff, word >> 48])
    }
}

/// Those of all photons of a map.
pub(super) enum Shorts {
    /// Powers lie too far apart.
    None,
    /// There are few kinds, as in most scenes: the kind of each, which takes two bytes, and what the kinds are, packed: a thousand
    /// of them stay in the nearest cache. Kinds that are not there are 0.
    Kinds(Vec<u16>, Box<[u64; MOST_KINDS]>),
    /// The same where powers do not fit 16 bits.
    WideKinds(Vec<u16>, Box<[Short; MOST_KINDS]>),
    /// Each its own, packed.
    Each(Vec<u64>),
}

impl Shorts {
    /// Of these photons, whose exponents lie between these.
    pub(super) fn of(photons: &[Photon], (least, most): (u8, u8)) -> Self {
        if most - least > MOST_APART {
            return Self::None;
        }
        let mut kinds = Kinds::new();
        let of: Option<Vec<u16>> = photons.iter().map(|photon| kinds.number(photon)).collect();
        match of {
            Some(of) if most - least > MOST_PACKED => {
                Self::WideKinds(of, kinds.finish(photons, |of| Short::new(of, least)))
            }
            Some(of) => Self::Kinds(of, kinds.finish(photons, |of| Short::new(of, least).packed())),
            None if most - least > MOST_PACKED => Self::None,
            None => Self::Each(photons.iter().map(|photon| Short::new(photon, least).packed()).collect()),
        }
    }

    /// The same in this order.
    pub(super) fn in_order(self, order: &[u32]) -> Self {
        match self {
            Self::None => Self::None,
            Self::Kinds(of, kinds) => Self::Kinds(ordered(&of, order), kinds),
            Self::WideKinds(of, kinds) => Self::WideKinds(ordered(&of, order), kinds),
            Self::Each(each) => Self::Each(ordered(&each, order)),
        }
    }

    /// That of the photon in a place, if powers do not lie too far apart.
    #[inline(always)]
    pub(super) fn get(&self, place: u32) -> Option<Short> {
        match self {
            Self::None => None,
            Self::Kinds(of, kinds) => Some(Short::unpacked(kinds[usize::from(of[place as usize])])),
            Self::WideKinds(of, kinds) => Some(kinds[usize::from(of[place as usize])]),
            Self::Each(each) => Some(Short::unpacked(each[place as usize])),
        }
    }

    /// Adds photons in their places, [`AT_ONCE`] at most. Sums of up to 2^12 powers do not overflow, whatever they are.
    #[inline]
    pub(super) fn add<T>(&self, photons: &[T], place: impl Fn(&T) -> u32, to: &mut Sum) {
        match self {
            Self::None => {}
            Self::Kinds(of, kinds) => to.add_packed(photons, |photon| kinds[usize::from(of[place(photon) as usize])]),
            Self::WideKinds(of, kinds) => {
                to.add_all(photons.iter().map(|photon| &kinds[usize::from(of[place(photon) as usize])]));
            }
            Self::Each(each) => to.add_packed(photons, |photon| each[place(photon) as usize]),
        }
    }
}

/// What photons are, in this order of their ids.
fn ordered<T: Copy>(of: &[T], order: &[u32]) -> Vec<T> {
    order.iter().map(|&id| of[id as usize]).collect()
}

/// Kinds of photons, numbered as they come.
struct Kinds {
    /// Power and normal of each kind.
    kinds: Vec<u64>,
    /// The first photon of each.
    first: Vec<u32>,
    /// Numbers of kinds and 1 more, each in the first slot that is free from its hash on; 0 where none is.
    slots: Vec<u32>,
    photons: u32,
}

impl Kinds {
    fn new() -> Self {
        Self { kinds: vec![], first: vec![], slots: vec![0; 2 * MOST_KINDS], photons: 0 }
    }

    /// The number of the next photon's kind, unless there are too many.
    #[inline]
    fn number(&mut self, photon: &Photon) -> Option<u16> {
        let kind = u64::from(u32::from_le_bytes(photon.power)) << 16 | u64::from(photon.flags >> 2);
        let mut slot = mix(kind) as usize % self.slots.len();
        let id = self.photons;
        self.photons += 1;
        loop {
            match self.slots[slot].checked_sub(1) {
                Some(number) if self.kinds[number as usize] == kind => return Some(number as u16),
                Some(_) => slot = (slot + 1) % self.slots.len(),
                None if self.kinds.len() == MOST_KINDS => return None,
                None => {
                    self.kinds.push(kind);
                    self.first.push(id);
                    self.slots[slot] = self.kinds.len() as u32;
                    return Some((self.kinds.len() - 1) as u16);
                }
            }
        }
    }

    /// What the kinds are, each by the first photon of it.
    fn finish<T: Copy + Default>(self, photons: &[Photon], what: impl Fn(&Photon) -> T) -> Box<[T; MOST_KINDS]> {
        let mut kinds: Vec<T> = self.first.iter().map(|&id| what(&photons[id as usize])).collect();
        kinds.resize(MOST_KINDS, T::default());
        kinds.into_boxed_slice().try_into().unwrap_or_else(|_| unreachable!("as long as that"))
    }
}

/// Powers added up, and in which bits normals differ.
pub(super) struct Sum {
    normal: u64,
    /// Red, green and blue.
    sums: [u64; 3],
    others: u64,
}

impl Sum {
    /// Of none so far; this is one of those that will come.
    #[inline(always)]
    pub(super) const fn new(one: &Short) -> Self {
        Self { normal: one.0[3], sums: [0; 3], others: 0 }
    }

    #[inline(always)]
    fn add_all(&mut self, photons: impl Iterator<Item = impl Borrow<Short>>) {
        // In variables of their own, which need not be in memory.
        let ([mut red, mut green, mut blue], mut others, normal) = (self.sums, self.others, self.normal);
        for photon in photons {
            let of = &photon.borrow().0;
            red += of[0];
            green += of[1];
            blue += of[2];
            others |= of[3] ^ normal;
        }
        (self.sums, self.others) = ([red, green, blue], others);
    }

    /// The same of packed ones, in as few instructions: their number is what this takes.
    #[inline(always)]
    fn add_packed<T>(&mut self, photons: &[T], word: impl Fn(&T) -> u64) {
        const EVERY_OTHER: u64 = 0xffff_0000_ffff;
        let (mut red_blue, mut all, mut others, normal) = (0, 0_u64, 0, self.normal << 48);
        for word in photons.iter().map(word) {
            red_blue += word & EVERY_OTHER;
            // What of the normals does not fit falls off at the top.
            all = all.wrapping_add(word);
            others |= word ^ normal;
        }
        let green = all.wrapping_sub(red_blue) >> 16;
        let of = [red_blue & 0xffff_ffff, green & 0xffff_ffff, red_blue >> 32];
        (0..3).for_each(|channel| self.sums[channel] += of[channel]);
        self.others |= others >> 48;
    }

    /// Have all of them one normal?
    #[inline(always)]
    pub(super) const fn is_plane(&self) -> bool {
        self.others == 0
    }

    /// Red, green and blue without those of one photon that was added.
    pub(super) fn without(&self, photon: Option<Short>) -> [u64; 3] {
        let other = photon.unwrap_or_default();
        [0, 1, 2].map(|channel| self.sums[channel] - other.0[channel])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_kinds_and_many_are_told_and_added_up_alike() {
        for (count, apart) in
            [(1, 8), (1000, 8), (1000, 44), (MOST_KINDS, 8), (MOST_KINDS + 1, 8), (200_000, 9), (3, 45)]
        {
            let photon = |id: usize| {
                let kind = id % count;
                let power = [kind as u8, (kind >> 8) as u8, (kind * 7 % 251) as u8, 100 + (kind % 2) as u8 * apart];
                Photon { power, flags: ((kind >> 16) as u16) << 2, ..bytemuck::Zeroable::zeroed() }
            };
            let photons: Vec<Photon> = (0..200_000).map(photon).collect();
            let order: Vec<u32> = (0..200_000).map(|at| at * 7919 % 200_000).collect();
            let shorts = Shorts::of(&photons, (100, 100 + apart)).in_order(&order);
            let is_there = apart <= 8 || apart <= 44 && count <= MOST_KINDS;
            assert_eq!(!matches!(shorts, Shorts::None), is_there, "{count} {apart}");
            let has_kinds = is_there && count <= MOST_KINDS;
            assert_eq!(matches!(shorts, Shorts::Kinds(..)), has_kinds && apart <= 8, "{count} {apart}");
            assert_eq!(matches!(shorts, Shorts::WideKinds(..)), has_kinds && apart > 8, "{count} {apart}");
            if !is_there {
                continue;
            }
            let of = |place: u32| photon(order[place as usize] as usize);
            let unit = pm_formats::unpack_rgbe([1, 0, 0, 100])[0];
            for place in 0..200_000 {
                let (short, of) = (shorts.get(place).unwrap(), of(place));
                assert_eq!(
                    (short.power().map(|power| power as f64 * unit), short.normal()),
                    (of.power(), of.flags >> 2)
                );
            }
            let places = [5, 77_777, 199_999, 0, 5];
            let mut sum = Sum::new(&shorts.get(5).unwrap());
            shorts.add(&places, |&place| place, &mut sum);
            let powers = [0, 1, 2].map(|channel| places.map(|place| of(place).power()[channel]).into_iter().sum());
            assert_eq!(sum.without(None).map(|power| power as f64 * unit), powers, "{count}");
            assert_eq!(sum.is_plane(), places.iter().all(|&place| of(place).flags == of(5).flags));
        }
        // As many as are added at once, of the greatest power: in 32 bits each.
        let photon = Photon { power: [255, 0, 255, 108], flags: 5 << 2, ..bytemuck::Zeroable::zeroed() };
        let shorts = Shorts::of(&[photon], (100, 108));
        let mut sum = Sum::new(&shorts.get(0).unwrap());
        shorts.add(&[0; AT_ONCE], |&place| place, &mut sum);
        assert_eq!(sum.without(None), [255 << 24, 0, 255 << 24]);
        assert!(sum.is_plane());
    }
}
