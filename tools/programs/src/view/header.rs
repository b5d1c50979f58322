//! A header as text.

use indicatif::HumanCount;
use pm_formats::trace::Coding;
use pm_formats::{Header, StreamKind, as_commands};
use pm_report::printable;
use std::io::{self, Write};

/// Writes what a header says.
pub(super) fn header(kind: StreamKind, version: u16, header: &Header, output: &mut impl Write) -> io::Result<()> {
    let mut line = |name: &str, value: String| writeln!(output, "{:<12} {}", printable(name), printable(&value));
    line("stream", format!("{}, format version {}", kind.plural(), version))?;
    let corner = |p: [f32; 3]| format!("({}, {}, {})", p[0], p[1], p[2]);
    line("bounds", format!("{} to {}", corner(header.bounds.min), corner(header.bounds.max)))?;
    if header.pixels() > 0 {
        line("image", format!("{} x {} pixels", header.image[0], header.image[1]))?;
    }
    for (id, material) in header.materials.iter().enumerate() {
        let [r, g, b] = material.diffuse;
        let mut text = format!("{id} {}: diffuse {r} {g} {b}", material.name);
        if material.specular != [0.0; 3] {
            let [r, g, b] = material.specular;
            text += &format!(", specular {r} {g} {b}, exponent {}", material.exponent);
        }
        line("material", text)?;
    }
    for region in &header.regions {
        let coding = match region.coding {
            Coding::Records => String::new(),
            Coding::HeapWalk { nodes, reread } => {
                let twice = if reread { ", inner nodes read twice" } else { "" };
                format!(", a tree of {} nodes{twice}", HumanCount(nodes.into()))
            }
            Coding::LeavesApart { leaves } => {
                format!(", a tree of {} leaves, which lie behind it", HumanCount(leaves.into()))
            }
            Coding::InTurns => ", read in turns".to_owned(),
            Coding::Waiting => ", read in turns, and each read says what it waits for".to_owned(),
            Coding::Addresses => {
                line("region", format!("{}: all addresses of 64 bits", region.name))?;
                continue;
            }
        };
        let place = format!("{:#x} to {:#x}", region.base, region.base + region.size);
        line("region", format!("{}: {place}, records of {} bytes{coding}", region.name, region.record_size))?;
    }
    for (name, value) in &header.meaning {
        line(name, value.clone())?;
    }
    if let Some(records) = header.expected_records {
        line("expected", format!("up to {} records", HumanCount(records)))?;
    }
    for command in as_commands(&header.history).lines() {
        line("history", command.to_owned())?;
    }
    if let Some(step) = header.history.last() {
        line("version", step.version.clone())?;
    }
    Ok(())
}
