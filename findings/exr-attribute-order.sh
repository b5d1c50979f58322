#!/usr/bin/env bash
# exr 1.74.2: a picture with several attributes of one's own is another file each time it is written: the crate keeps them in a
# hash map whose order is drawn anew for every map, and writes them as they come. Pixels and attributes are the same.
#
# Seen: of 16 files that one process writes of one picture with four attributes, more than one is different from the rest.
# So files cannot be compared by their bytes, nor a build be reproduced; whoever needs that puts all into one attribute, such
# as the comments. Needs cargo and the crates' registry; fails if the behaviour is another.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'TOML'
[package]
name = "attribute-order"
version = "0.0.0"
edition = "2021"
[dependencies]
exr = { version = "=1.74.2", default-features = false }
[workspace]
TOML
cat > "$folder/src/main.rs" <<'RUST'
use exr::prelude::*;
use std::collections::BTreeSet;
use std::io::Cursor;

fn written() -> Vec<u8> {
    let channels = SpecificChannels::rgb(|_: Vec2<usize>| (0.5_f32, 0.25_f32, 0.125_f32));
    let mut attributes = LayerAttributes::named("picture");
    for name in ["seed", "samples", "photons", "scene"] {
        attributes.other.insert(Text::from(name), AttributeValue::Text(Text::from(name)));
    }
    let layer = Layer::new((4, 4), attributes, Encoding::UNCOMPRESSED, channels);
    let mut bytes = Cursor::new(vec![]);
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn main() {
    let files: BTreeSet<Vec<u8>> = (0..16).map(|_| written()).collect();
    let lengths: BTreeSet<usize> = files.iter().map(Vec::len).collect();
    println!("different files: {}, different lengths: {}", files.len(), lengths.len());
    assert!(files.len() > 1 && lengths.len() == 1);
}
RUST
cd "$folder"
cargo run --quiet --release 2>errors || { cat errors >&2; echo "exr 1.74.2 behaves otherwise than was found" >&2; exit 1; }
