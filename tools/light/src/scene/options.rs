//! How OBJ and MTL files are understood.

/// How OBJ and MTL files are understood.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct LoadOptions {
    /// Obey `Ks` and `Ns` as a Phong lobe. Exporters write them on plain paint too, so they are ignored by default.
    pub glossy: bool,
    /// Let glass transmit everything, whatever its `Tf`.
    pub clear_glass: bool,
    /// Accept a scene in which nothing emits light.
    pub allow_dark: bool,
    /// Refuse what is wrong but can be gone on with: a material library that is not there, a normal that is not defined.
    pub strict: bool,
}
