#!/usr/bin/env bash
# moka 0.12.16: a cache with the policy "LRU" evicts in arrears. Reads and inserts go into logs that are worked off in batches, by
# whoever calls when one is full or some time has passed; until then the cache holds more than its capacity. Its documentation
# says so (run_pending_tasks), but a count of misses made with it is not that of an LRU.
#
# Seen: 101 keys in turn in a cache of 100. An LRU misses each of 20,000 times. moka does if run_pending_tasks is called after
# each access, and misses less than one time in twenty if it is not. Its default policy is no LRU at all but TinyLFU.
# Needs cargo and the crates' registry; fails if the behaviour is another.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'TOML'
[package]
name = "in-arrears"
version = "0.0.0"
edition = "2021"
[dependencies]
moka = { version = "=0.12.16", features = ["sync"] }
[workspace]
TOML
cat > "$folder/src/main.rs" <<'RUST'
use moka::policy::EvictionPolicy;
use moka::sync::Cache;

const ACCESSES: u64 = 20_000;

fn misses(tended: bool) -> u64 {
    let cache: Cache<u64, u64> = Cache::builder().max_capacity(100).eviction_policy(EvictionPolicy::lru()).build();
    let mut misses = 0;
    for access in 0..ACCESSES {
        let key = access % 101;
        if cache.get(&key).is_none() {
            misses += 1;
            cache.insert(key, key);
        }
        if tended {
            cache.run_pending_tasks();
        }
    }
    misses
}

fn main() {
    let (tended, untended) = (misses(true), misses(false));
    println!("misses of {ACCESSES}: {tended} if tended after each access, {untended} if not");
    assert!(tended == ACCESSES && untended < ACCESSES / 20);
}
RUST
cd "$folder"
cargo run --quiet --release 2>errors || { cat errors >&2; echo "moka 0.12.16 behaves otherwise than was found" >&2; exit 1; }
