#!/usr/bin/env bash
# One point of error against traffic: prints, as one row of CSV, the traffic of looking irradiance up, and how far the picture of what
# was gathered is from that of the full estimate at every query.
#   scripts/held-point.sh PHOTONS QUERIES ORDER [options of pm-gather]
set -euo pipefail
photons=$1 queries=$2 order=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ "$order" = scanline ]; then cp "$queries" "$work/q.pmq"; else pm-reorder -q "$order" "$queries" -o "$work/q.pmq"; fi
pm-gather -q --no-trace "$photons" "$work/q.pmq" --image "$work/full.exr"
pm-gather -q "$photons" "$work/q.pmq" "$@" --image "$work/own.exr" -o "$work/own.pmt"
pm-cachesim -q --format csv "$work/own.pmt" > "$work/traffic"
pm-view "$work/full.exr" "$work/own.exr" --format csv > "$work/error"
{
    echo searched_all_the_same
    pm-view "$work/own.pmt" | awk '$1 == "pm-gather" && $2 == "lookups_without_site" { gsub(",", "", $3); n = $3 } END { print n + 0 }'
} > "$work/searched"
paste -d , "$work/traffic" "$work/searched" "$work/error"
