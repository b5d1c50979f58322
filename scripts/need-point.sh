#!/usr/bin/env bash
# One point of what a scene needs: a picture of so many photons, neighbours and rays, as one row of CSV: its error against a
# reference, seconds of processor time, and the bytes that its searches fetch through a cache of 128 KiB, row by row and along a
# Hilbert curve within tiles of 8 x 8 pixels.
#   scripts/need-point.sh OUT ROOM SIZE REFERENCE PHOTONS K SAMPLES GATHERS [options of pm-picture]
# ROOM is a scene of scenes/ or out/scenes/. Of many rays, 16 windows or tiles are traced.
set -euo pipefail
out=$1 room=$2 size=$3 reference=$4 photons=$5 k=$6 samples=$7 gathers=$8
shift 8
. "${0%/*}/room.sh"
mkdir -p "$(dirname "$out")"
work=$(mktemp -d "$out.XXXXXX")
trap 'rm -rf "$work"' EXIT

column() {
    awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = NF - i }
        NR == 2 { sub(/,"([^"]|"")*"$/, ",x"); print $(NF - at) }'
}
TIMEFORMAT='%U %S'
{ time pm-picture -q "${load[@]}" --size "$size" -n "$photons" -k "$k" --samples "$samples" --gathers "$gathers" "$@" \
    --keep "$work" --image "$work/picture.exr" 2>&3; } 3>&2 2> "$work/time"
error=$(pm-view -q "$reference" "$work/picture.exr" --format csv | column rel_mse)

rays=(-q "${load[@]}" --size "$size" --samples "$samples" --gathers "$gathers" --no-caustics)
row=$((${size%x*} * samples * gathers))
window=$((row < 400 ? row : 400))
warm_up=$((row - window < 1600 ? row - window : 1600))
scanline=(--only-tiles 16 --window $window --warm-up $warm_up) tiles=(--only-tiles 16)
if [ $((row * ${size#*x})) -le 300000 ]; then scanline=() tiles=(); fi
cache=(-q --sizes 128K --ways full --format csv)
by_row=$(pm-queries "${rays[@]}" "${scanline[@]}" | pm-gather -q "$work/map.pmp" -k "$k" | pm-cachesim "${cache[@]}" | column bytes_fetched)
by_tile=$(pm-queries "${rays[@]}" --order tiled --tile 8 "${tiles[@]}" | pm-reorder -q hilbert --per batch |
    pm-gather -q "$work/map.pmp" -k "$k" | pm-cachesim "${cache[@]}" | column bytes_fetched)
echo error,seconds,scanline_bytes,tiled_hilbert_bytes
awk -v square="$error" -v a="$by_row" -v b="$by_tile" '{ printf "%.5f,%.2f,%.0f,%.0f\n", sqrt(square), $1 + $2, a, b }' "$work/time"
