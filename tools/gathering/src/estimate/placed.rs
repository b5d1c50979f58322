//! The photons by their places in the map: what most estimates ask of them lies side by side where they are found together.

use super::super::surface::{Spot, coarse};
use super::shorts::{AT_ONCE, Short, Shorts, Sum};
use glam::{DVec3, Vec3};
use pm_formats::{Photon, unpack_direction, unpack_rgbe};
use pm_maps::Nearest;
use std::sync::{Arc, OnceLock};

/// Codes of a photon's normal.
const CODES: u32 = 1 << 14;

/// Photons by their places in a map.
pub(super) struct Placed<'a> {
    photons: &'a [Photon],
    /// Ids by place; where there are none places are ids.
    order: Option<Arc<[u32]>>,
    /// Places by id, for those whom another map found.
    places: OnceLock<Vec<u32>>,
    /// By place.
    shorts: Shorts,
    /// By place.
    spots: Vec<Spot>,
    /// What powers are multiples of.
    unit: f64,
    /// The surface normals that there are, by their codes, in steps of 1/127.
    normals: Box<[[i8; 3]]>,
}

impl<'a> Placed<'a> {
    /// Photons that lie as their ids say.
    pub(super) fn by_id(photons: &'a [Photon]) -> Self {
        let normals = (0..CODES).map(|code| coarse(unpack_direction::<7>(code))).collect();
        let exponents = exponents(photons);
        let unit = unpack_rgbe([1, 0, 0, exponents.0])[0];
        Self {
            photons,
            order: None,
            places: OnceLock::new(),
            shorts: Shorts::of(photons, exponents),
            spots: photons.iter().map(Spot::of).collect(),
            unit,
            normals,
        }
    }

    /// The same photons in this order.
    pub(super) fn in_order(mut self, order: Option<&Arc<[u32]>>) -> Self {
        if let Some(order) = order {
            self.shorts = self.shorts.in_order(order);
            // Those by id are gone before, so that there are never both.
            self.spots = vec![];
            self.spots = order.iter().map(|&id| Spot::of(&self.photons[id as usize])).collect();
            self.order = Some(Arc::clone(order));
        }
        self
    }

    /// What the powers of [`short`](Self::short) photons are multiples of.
    pub(super) fn unit(&self) -> Option<f64> {
        (!matches!(self.shorts, Shorts::None)).then_some(self.unit)
    }

    /// Power and normal of the photon in a place, if powers do not lie too far apart.
    #[inline(always)]
    pub(super) fn short(&self, place: u32) -> Option<Short> {
        self.shorts.get(place)
    }

    /// Adds the photons in these places, if they are [`short`](Self::short).
    #[inline(always)]
    pub(super) fn add(&self, places: &[u32], to: &mut Sum) {
        places.chunks(AT_ONCE).for_each(|places| self.shorts.add(places, |&place| place, to));
    }

    /// All that is known of the photon in a place, from far away in memory.
    pub(super) fn photon(&self, place: u32) -> &Photon {
        &self.photons[self.id(place) as usize]
    }

    /// Where the photon in a place is, and on what surface.
    #[inline(always)]
    pub(super) fn spot(&self, place: u32) -> Spot {
        self.spots[place as usize]
    }

    /// Flux of these photons, times the number of emitted paths, if powers are short. Exact, where sums in double precision are.
    pub(super) fn sum(&self, photons: &[(u32, f32)]) -> Option<[f64; 3]> {
        let &(first, _) = photons.first()?;
        let mut sum = Sum::new(&self.shorts.get(first)?);
        photons.chunks(AT_ONCE).for_each(|photons| self.shorts.add(photons, |photon| photon.0, &mut sum));
        Some(sum.without(None).map(|power| power as f64 * self.unit))
    }

    /// Flux of the photon in a place, times the number of emitted paths.
    #[inline]
    pub(super) fn power(&self, place: u32) -> [f64; 3] {
        match self.shorts.get(place) {
            Some(short) => short.power().map(|power| power as f64 * self.unit),
            None => self.photon(place).power(),
        }
    }

    /// The id of the photon in a place.
    #[inline]
    pub(super) fn id(&self, place: u32) -> u32 {
        self.order.as_ref().map_or(place, |order| order[place as usize])
    }

    /// A normal by its code, in steps of 1/127.
    #[inline]
    pub(super) fn normal(&self, code: u32) -> [i8; 3] {
        self.normals[code as usize]
    }

    /// Unit normal of the surface that the photon in a place lies on.
    pub(super) fn direction(&self, place: u32) -> DVec3 {
        Vec3::from(unpack_direction::<7>(self.spot(place).code)).as_dvec3()
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
