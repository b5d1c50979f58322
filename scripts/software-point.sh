#!/usr/bin/env bash
# One point of processor time: prints, as one row of CSV, the seconds that ordering queries and gathering them take, the medians of
# three runs, one thread, without a trace.
#   scripts/software-point.sh PHOTONS QUERIES ORDER MAP
set -euo pipefail
photons=$1 queries=$2 order=$3 map=$4
TIMEFORMAT='%U %S'
ordered=$(mktemp)
trap 'rm -f "$ordered" "$ordered.exr" "$ordered.time"' EXIT
seconds() { awk '{ printf "%.2f\n", $1 + $2 }' "$ordered".time | sort -n | sed -n 2p; }
reorder() { if [ "$order" = scanline ]; then cp "$queries" "$ordered"; else pm-reorder -q "$order" "$queries" -o "$ordered"; fi; }
gather() { pm-gather -q --no-trace --map "$map" -t 1 "$photons" "$ordered" --image "$ordered.exr"; }
# What a program has to say goes to standard error, what `time` says to the file.
timed() { for _ in 1 2 3; do { time "$1" 2>&3; } 3>&2 2>> "$ordered".time; done; }
timed reorder
ordering=$(seconds)
rm "$ordered".time
timed gather
gathering=$(seconds)
echo 'ordering_seconds,gathering_seconds'
[ "$order" = scanline ] && ordering=0
echo "$ordering,$gathering"
