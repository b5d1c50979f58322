//! What a surface does to light: absorb it, spread it, or pass it on along one specular direction.

use super::surface::SurfacePoint;
use crate::scene::{Material, MaterialKind};
use glam::Vec3;
use pm_random::Random;

/// Shares of light that a material spreads: diffuse, and in a lobe.
pub(super) fn spread_shares(material: &Material) -> (Vec3, Vec3) {
    let glossy = material.kind == MaterialKind::Glossy;
    (Vec3::from(material.diffuse), if glossy { Vec3::from(material.specular) } else { Vec3::ZERO })
}

/// Does a material spread any light, so that photons are stored on it and can be asked for?
pub(super) fn spreads(material: &Material) -> bool {
    let (diffuse, specular) = spread_shares(material);
    diffuse.max(specular).max_element() > 0.0
}

/// A specular continuation: a direction, and what share of the light it carries, per channel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Specular {
    pub(super) direction: Vec3,
    pub(super) share: Vec3,
}

/// The specular continuations of light that arrives along `direction` (towards the surface): none for a diffuse surface,
/// one for a mirror, up to two for glass. Their shares add up to at most 1.
pub(super) fn specular(material: &Material, point: &SurfacePoint, direction: Vec3) -> [Option<Specular>; 2] {
    match material.kind {
        MaterialKind::Diffuse | MaterialKind::Glossy => [None, None],
        MaterialKind::Mirror => {
            let share = Vec3::from(material.specular);
            [Some(Specular { direction: reflect(point, direction), share }), None]
        }
        MaterialKind::Glass => {
            let entering = direction.dot(point.front) < 0.0;
            let eta = if entering { 1.0 / material.ior } else { material.ior };
            let normal = shading_normal(point, direction);
            let cos_in = -direction.dot(normal);
            let reflectance = fresnel(cos_in, eta);
            let reflected = Specular { direction: reflect(point, direction), share: Vec3::splat(reflectance) };
            let refracted = refract(point, normal, direction, cos_in, eta).map(|direction| Specular {
                direction,
                share: Vec3::from(material.transmittance) * (1.0 - reflectance),
            });
            // Without a refracted ray (total reflection) reflectance is 1.
            [Some(reflected), refracted]
        }
    }
}

/// Chooses one of the specular ways in proportion to its largest share; the weight makes up for the choice.
pub(super) fn choose(ways: [Option<Specular>; 2], random: &mut Random) -> Option<(Specular, f32)> {
    match ways {
        [Some(first), Some(second)] => {
            let (a, b) = (first.share.max_element(), second.share.max_element());
            let total = a + b;
            if total <= 0.0 {
                return None;
            }
            Some(if random.unit() * total < a { (first, total / a) } else { (second, total / b) })
        }
        [way, other] => way.or(other).map(|way| (way, 1.0)),
    }
}

/// Share of unpolarised light that a smooth dielectric reflects, for the cosine of the angle of incidence and the ratio
/// of indices (incident over transmitted): the equations of Fresnel.
#[must_use]
pub(super) fn fresnel(cos_in: f32, eta: f32) -> f32 {
    let sin2_out = eta * eta * (1.0 - cos_in * cos_in).max(0.0);
    if sin2_out >= 1.0 {
        return 1.0;
    }
    let cos_out = (1.0 - sin2_out).sqrt();
    let parallel = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
    let perpendicular = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
    (parallel * parallel + perpendicular * perpendicular) / 2.0
}

/// The smooth normal on the side that the light comes from, or the triangle's own where the smooth one faces away.
fn shading_normal(point: &SurfacePoint, direction: Vec3) -> Vec3 {
    let smooth = if point.facing.dot(point.front) < 0.0 { -point.smooth } else { point.smooth };
    if direction.dot(smooth) < 0.0 { smooth } else { point.facing }
}

/// The mirrored direction; where a smooth normal would send it into the surface the triangle's own is used.
fn reflect(point: &SurfacePoint, direction: Vec3) -> Vec3 {
    let mirrored = |normal: Vec3| (direction - normal * (2.0 * direction.dot(normal))).normalize();
    let out = mirrored(shading_normal(point, direction));
    if out.dot(point.facing) > 0.0 { out } else { mirrored(point.facing) }
}

/// Snell's law; `None` at total reflection.
fn refract(point: &SurfacePoint, normal: Vec3, direction: Vec3, cos_in: f32, eta: f32) -> Option<Vec3> {
    let bent = |normal: Vec3, cos_in: f32| {
        let sin2_out = eta * eta * (1.0 - cos_in * cos_in).max(0.0);
        (sin2_out < 1.0).then(|| (direction * eta + normal * (eta * cos_in - (1.0 - sin2_out).sqrt())).normalize())
    };
    let out = bent(normal, cos_in)?;
    if out.dot(point.facing) < 0.0 { Some(out) } else { bent(point.facing, -direction.dot(point.facing)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fresnel_at_known_angles() {
        // Normal incidence on glass of index 1.5: ((n - 1) / (n + 1))^2 = 0.04, from either side.
        assert!((fresnel(1.0, 1.0 / 1.5) - 0.04).abs() < 1e-6);
        assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-6);
        // Brewster's angle, tan = 1.5: only the perpendicular half, ((n^2 - 1) / (n^2 + 1))^2 / 2.
        let brewster = 1.0 / (1.0f32 + 1.5 * 1.5).sqrt();
        assert!((fresnel(brewster, 1.0 / 1.5) - 0.073_964_5).abs() < 1e-5);
        // Beyond the critical angle, sin = 1 / 1.5, everything is reflected.
        assert_eq!(fresnel(0.7, 1.5), 1.0);
        assert!(fresnel(0.75, 1.5) < 1.0);
        assert!((fresnel(0.0, 1.0 / 1.5) - 1.0).abs() < 1e-6);
    }
}
