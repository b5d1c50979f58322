//! The photons by their places in the map: what most estimates ask of them lies side by side where they are found together.

use super::super::surface::coarse;
use pm_formats::{Photon, unpack_direction, unpack_rgbe};
use pm_maps::Nearest;
use std::sync::{Arc, OnceLock};

/// Codes of a photon's normal.
const CODES: u32 = 1 << 14;
/// Powers whose exponents differ by no more than this are short in units of the least.
const MOST_SHORT: u8 = 8;

/// Power and normal of a photon in one word: red, green and blue in units of the least power, and the normal's code, 16 bits
/// each.
#[derive(Clone, Copy)]
pub(super) struct Short(u64);

/// Powers added up, in units of the least: of up to 2^16 photons.
#[derive(Clone, Copy, Default)]
pub(super) struct Sums {
    /// Red below, blue above.
    red_blue: u64,
    /// Green below; what is above means nothing.
    green: u64,
}

impl Short {
    /// Number of the normal.
    #[inline(always)]
    pub(super) const fn normal(self) -> u16 {
        (self.0 >> 48) as u16
    }

    /// Red, green and blue.
    #[inline(always)]
    const fn power(self) -> [u16; 3] {
        [self.0 as u16, (self.0 >> 16) as u16, (self.0 >> 32) as u16]
    }
}

impl Sums {
    /// Every other 16 bits.
    const HALF: u64 = 0x0000_ffff_0000_ffff;

    #[inline(always)]
    pub(super) const fn add(&mut self, photon: Short) {
        self.red_blue += photon.0 & Self::HALF;
        self.green += photon.0 >> 16 & Self::HALF;
    }

    /// Red, green and blue without those of one photon that was added.
    pub(super) fn without(self, photon: Option<Short>) -> [u32; 3] {
        let mut other = Self::default();
        photon.into_iter().for_each(|photon| other.add(photon));
        let (red_blue, green) = (self.red_blue - other.red_blue, self.green as u32 - other.green as u32);
        [red_blue as u32, green, (red_blue >> 32) as u32]
    }
}

/// Photons by their places in a map.
pub(super) struct Placed<'a> {
    photons: &'a [Photon],
    /// Ids by place; where there are none places are ids.
    order: Option<Arc<[u32]>>,
    /// Places by id, for those whom another map found.
    places: OnceLock<Vec<u32>>,
    /// By place; empty if powers lie too far apart.
    short: Vec<Short>,
    /// By place, if places are no ids.
    positions: Vec<[f32; 3]>,
    /// The least exponent of the powers, and what they are multiples of.
    least: u8,
    unit: f64,
    /// The surface normals that there are, in steps of 1/127.
    normals: Box<[[i8; 3]]>,
}

impl<'a> Placed<'a> {
    /// Photons that lie as their ids say.
    pub(super) fn by_id(photons: &'a [Photon]) -> Self {
        let normals = (0..CODES).map(|code| coarse(unpack_direction::<7>(code))).collect();
        let (least, most) = exponents(photons);
        let unit = unpack_rgbe([1, 0, 0, least])[0];
        let mut placed = Self {
            photons,
            order: None,
            places: OnceLock::new(),
            short: vec![],
            positions: vec![],
            least,
            unit,
            normals,
        };
        if most - least <= MOST_SHORT {
            placed.short = photons.iter().map(|photon| placed.shortened(photon)).collect();
        }
        placed
    }

    /// The same photons in this order.
    pub(super) fn in_order(mut self, order: Option<&Arc<[u32]>>) -> Self {
        if let Some(order) = order {
            if !self.short.is_empty() {
                self.short = order.iter().map(|&id| self.shortened(&self.photons[id as usize])).collect();
            }
            self.positions = order.iter().map(|&id| self.photons[id as usize].position).collect();
            self.order = Some(Arc::clone(order));
        }
        self
    }

    fn shortened(&self, photon: &Photon) -> Short {
        let [red, green, blue, exponent] = photon.power;
        // A power of 0 has the exponent 0, whatever its mantissas.
        let power = |mantissa: u8| if exponent == 0 { 0 } else { u64::from(mantissa) << (exponent - self.least) };
        Short(power(red) | power(green) << 16 | power(blue) << 32 | u64::from(photon.flags >> 2) << 48)
    }

    /// What the powers of [`short`](Self::short) photons are multiples of, if they are not too far apart, and k not too many.
    pub(super) fn unit(&self, k: usize) -> Option<f64> {
        (!self.short.is_empty() && k <= 1 << 16).then_some(self.unit)
    }

    /// Power and normal of the photon in a place.
    #[inline(always)]
    pub(super) fn short(&self, place: u32) -> Short {
        self.short[place as usize]
    }

    /// All that is known of the photon in a place, from far away in memory.
    pub(super) fn photon(&self, place: u32) -> &Photon {
        &self.photons[self.id(place) as usize]
    }

    /// Where the photon in a place is.
    #[inline]
    pub(super) fn position(&self, place: u32) -> [f32; 3] {
        match &self.order {
            Some(_) => self.positions[place as usize],
            None => self.photons[place as usize].position,
        }
    }

    /// Flux of the photon in a place, times the number of emitted paths.
    #[inline]
    pub(super) fn power(&self, place: u32) -> [f64; 3] {
        match self.short.get(place as usize) {
            Some(short) => short.power().map(|power| f64::from(power) * self.unit),
            None => self.photon(place).power(),
        }
    }

    /// Code of the normal of the photon in a place.
    #[inline]
    pub(super) fn code(&self, place: u32) -> u16 {
        self.short.get(place as usize).map_or_else(|| self.photon(place).flags >> 2, |short| short.normal())
    }

    /// The id of the photon in a place.
    #[inline]
    pub(super) fn id(&self, place: u32) -> u32 {
        self.order.as_ref().map_or(place, |order| order[place as usize])
    }

    /// A normal by its code, in steps of 1/127.
    #[inline]
    pub(super) fn normal(&self, code: u16) -> [i8; 3] {
        self.normals[usize::from(code)]
    }

    /// Are these the places of the map that found them?
    #[inline]
    pub(super) fn knows(&self, found: &Nearest) -> bool {
        match (&self.order, found.order()) {
            (None, None) => true,
            (Some(mine), Some(theirs)) => Arc::ptr_eq(mine, theirs),
            _ => false,
        }
    }

    /// The place of the photon with this id.
    pub(super) fn place(&self, id: u32) -> u32 {
        let Some(order) = &self.order else { return id };
        let places = || {
            let mut places = vec![0; order.len()];
            (0..).zip(&**order).for_each(|(place, &id)| places[id as usize] = place);
            places
        };
        self.places.get_or_init(places)[id as usize]
    }
}

/// The least and the greatest exponent of powers that are not 0.
pub(super) fn exponents(photons: &[Photon]) -> (u8, u8) {
    let exponents = || photons.iter().map(|photon| photon.power[3]).filter(|&exponent| exponent > 0);
    (exponents().min().unwrap_or(0), exponents().max().unwrap_or(0))
}
