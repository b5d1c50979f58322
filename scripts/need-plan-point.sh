#!/usr/bin/env bash
# What pm-plan says to the same question as the grid of need-point.sh: its plan for an error, made and measured as a point of the
# grid, as one row of CSV.
#   scripts/need-plan-point.sh OUT ROOM SIZE REFERENCE ERROR
set -euo pipefail
out=$1 room=$2 size=$3 reference=$4 wanted=$5
here=${0%/*}
. "$here/room.sh"
. "$here/plan-row.sh"
mkdir -p "$(dirname "$out")"
plan=$(mktemp "$out.XXXXXX")
trap 'rm -f "$plan"' EXIT
pm-plan -q "${load[@]}" --size "$size" --error "$wanted" --format csv > "$plan"

field() { planned "$plan" "$1"; }
photons=$(field photons) k=$(field k) samples=$(field samples) gathers=$(field gathers)
more=(--light-samples "$(field light_samples)")
caustics=$(field caustics)
if [ "$caustics" -gt 0 ]; then more+=(--caustics "$caustics"); fi
made=$("$here/need-point.sh" "$out" "$room" "$size" "$reference" "$photons" "$k" "$samples" "$gathers" "${more[@]}")
echo "planned_error,planning_seconds,photons_of_map,neighbours,samples,gathers,$(echo "$made" | sed -n 1p)"
echo "$(field error),$(field planning_seconds),$photons,$k,$samples,$gathers,$(echo "$made" | sed -n 2p)"
