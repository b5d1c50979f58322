#!/usr/bin/env bash
# One point of processor time: prints, as one row of CSV, the seconds that ordering queries and gathering them take, the medians of
# three runs, one thread, without a trace.
#   scripts/software-point.sh PHOTONS QUERIES ORDER MAP
set -euo pipefail
photons=$1 queries=$2 order=$3 map=$4
TIMEFORMAT='%U %S'
ordered=$(mktemp)
trap 'rm -f "$ordered" "$ordered.exr"' EXIT
seconds() { awk '{ printf "%.2f\n", $1 + $2 }' | sort -n | sed -n 2p; }
reorder() { if [ "$order" = scanline ]; then cp "$queries" "$ordered"; else pm-reorder -q "$order" -t 1 "$queries" -o "$ordered"; fi; }
ordering=$(for _ in 1 2 3; do { time reorder; } 2>&1; done | seconds)
gathering=$(for _ in 1 2 3; do
    { time pm-gather -q --no-trace --map "$map" -t 1 "$photons" "$ordered" --image "$ordered.exr"; } 2>&1
done | seconds)
echo 'ordering_seconds,gathering_seconds'
[ "$order" = scanline ] && ordering=0
echo "$ordering,$gathering"
