#!/usr/bin/env bash
# One point of speed against accuracy: renders a picture and prints, as one row of CSV, the traffic of its searches, the
# seconds they take, and how far the picture is from a reference.
#   scripts/picture-point.sh OUT REFERENCE PHOTONS [options of pm-queries] -- [options of pm-gather]
# OUT.exr is the picture. REFERENCE.exr has its direct light beside it in REFERENCE.base.exr, which all pictures share, so
# that what differs is what was gathered. Queries go tile by tile, each along the Hilbert curve. One thread.
set -euo pipefail
out=$1 reference=$2 photons=$3
shift 3
queries=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do queries+=("$1"); shift; done
[ $# -eq 0 ] || shift

now() { echo $(($(date +%s%N) / 1000000)); }

start=$(now)
pm-queries -q --order tiled "${queries[@]}" | pm-reorder -q hilbert --per batch --storage 4M -o "$out.pmq"
cast=$(now)
pm-gather -q "$photons" "$out.pmq" "$@" --base "$reference.base.exr" --image "$out.exr" --no-trace
gathered=$(now)
pm-gather -q "$photons" "$out.pmq" "$@" | pm-cachesim -q --format csv > "$out.traffic"
pm-view "$reference.exr" "$out.exr" --format csv > "$out.error"
seconds() { printf '%d.%03d' $(($1 / 1000)) $(($1 % 1000)); }
{
    echo seconds_cast,seconds_gather,seconds
    echo "$(seconds $((cast - start))),$(seconds $((gathered - cast))),$(seconds $((gathered - start)))"
} > "$out.time"
paste -d , "$out.traffic" "$out.time" "$out.error"
rm -f "$out.traffic" "$out.time" "$out.error" "$out.pmq"
