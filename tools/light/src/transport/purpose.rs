//! What random numbers are for: keys of different purposes never meet.

/// The part of a random number's key that says what it decides.
#[derive(Clone, Copy)]
#[repr(u64)]
pub(super) enum Purpose {
    PhotonPath = 1,
    PhotonRounding = 2,
    EyePath = 3,
    GatherRay = 4,
    DirectLight = 5,
    StrataOrder = 6,
    LightAtShortEnd = 7,
    PixelSample = 8,
    RecordRay = 9,
    AimingPath = 10,
}
