//! How many bytes an instruction of RISC-V loads, as its code tells (The RISC-V Instruction Set Manual, volume I, chapters on
//! RV32I, RV64I, A, F, D, C and V).

/// Bytes that each load of this instruction reads; `None` if it is no load that is known.
pub(super) fn of_load(code: u64) -> Option<u32> {
    let bits = |from: u32, number: u32| code >> from & ((1 << number) - 1);
    if bits(0, 2) != 3 {
        return of_compressed_load(bits(0, 2), bits(13, 3));
    }
    let width = bits(12, 3);
    match bits(0, 7) {
        // LOAD: the highest bit of the width tells that no sign is kept.
        0x03 => Some(1 << (width & 3)),
        // LOAD-FP: scalars by their logarithm, elements of vectors by a code of their own.
        0x07 => match width {
            0 => Some(1),
            1..=4 => Some(1 << width),
            5..=7 => Some(1 << (width - 4)),
            _ => None,
        },
        // AMO, load-reserved.
        0x2f => Some(1 << width),
        _ => None,
    }
}

/// The same of a compressed instruction, by quadrant and function; those of 64 bits, where C.LD has the place of C.FLW.
fn of_compressed_load(quadrant: u64, function: u64) -> Option<u32> {
    match (quadrant, function) {
        // C.FLD, C.LD; C.FLDSP, C.LDSP.
        (0 | 2, 1 | 3) => Some(8),
        // C.LW; C.LWSP.
        (0 | 2, 2) => Some(4),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::of_load;

    #[test]
    fn loads_have_the_width_of_their_code() {
        for (code, bytes) in [
            (0x0005_8503, Some(1)), // lb a0, 0(a1)
            (0x0005_c503, Some(1)), // lbu
            (0x0005_9503, Some(2)), // lh
            (0x0005_d503, Some(2)), // lhu
            (0x0005_a503, Some(4)), // lw
            (0x0005_e503, Some(4)), // lwu
            (0x0005_b503, Some(8)), // ld
            (0x0005_a507, Some(4)), // flw fa0, 0(a1)
            (0x0005_b507, Some(8)), // fld
            (0x0205_8007, Some(1)), // vle8.v v0, (a1)
            (0x0205_d007, Some(2)), // vle16.v
            (0x0205_e007, Some(4)), // vle32.v
            (0x0205_f007, Some(8)), // vle64.v
            (0x00a5_a52f, Some(4)), // amoadd.w a0, a0, (a1)
            (0x00a5_b52f, Some(8)), // amoadd.d
            (0x4188, Some(4)),      // c.lw a0, 0(a1)
            (0x6588, Some(8)),      // c.ld a0, 8(a1)
            (0x6522, Some(8)),      // c.ldsp a0, 8(sp)
            (0x4522, Some(4)),      // c.lwsp a0, 8(sp)
            (0x00c5_b023, None),    // sd a2, 0(a1)
            (0x8082, None),         // ret
        ] {
            assert_eq!(of_load(code), bytes, "{code:#x}");
        }
    }
}
