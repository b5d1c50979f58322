#!/usr/bin/env bash
# Searches far from all photons: 20,000 photons in a plane, 100 queries at a height above it. Prints the row of their traffic.
#   scripts/empty-point.sh OUT HEIGHT [options of pm-gather]
set -euo pipefail
out=$1 height=$2
shift 2
lattice() { pm-sweep derive lattice --with side="$1" --with height="$2"; }
lattice 141 0 | pm-view -q --import photons - -o "$out.pmp"
lattice 10 "$height" | pm-view -q --import queries - | pm-gather -q "$out.pmp" - -k 50 "$@" | pm-cachesim -q --format csv
rm "$out.pmp"
