#!/usr/bin/env bash
# One promise of pm-plan --on-chip, held against the truth: plans a picture with some seeds, measures each time in full what is printed
# for that, and prints, as one row of CSV, how often the bytes were within their interval.
#   scripts/plan-traffic-point.sh OUT ROOM ERROR ON_CHIP RUNS [options of pm-plan]
# ROOM is a scene of scenes/ or out/scenes/. The map of the whole is another one of as many photons, each time with a fresh seed.
set -euo pipefail
out=$1 room=$2 wanted=$3 on_chip=$4 runs=$5
shift 5
. "${0%/*}/room.sh"
. "${0%/*}/plan-row.sh"
mkdir -p "$(dirname "$out")"
work=$(mktemp -d "$out.XXXXXX")
trap 'rm -rf "$work"' EXIT

for seed in $(seq 1 "$runs"); do
    code=0
    pm-plan -q "${load[@]}" --error "$wanted" --on-chip "$on_chip" --seed "$seed" --format csv "$@" > "$work/plan.csv" 2> "$work/why" || code=$?
    if [ $code = 4 ]; then continue; elif [ $code != 0 ]; then cat "$work/why" >&2; exit $code; fi
    mapfile -t traffic < <(planned_traffic "$work/plan.csv")
    map=(-q "${load[@]}" --seed $((1000 + seed)))
    pm-photons "${map[@]}" -n "$(planned "$work/plan.csv" photons)" -o "$work/map.pmp"
    caustics=$(planned "$work/plan.csv" caustics)
    if [ "$caustics" -gt 0 ]; then pm-photons --caustics "${map[@]}" -n "$caustics" -o "$work/caustics.pmp"; fi
    # Pipes of two maps stand one after the other; scenes are told from where this is run.
    pipes=${traffic[3]//map.pmp/$work/map.pmp}
    pipes=${pipes//caustics.pmp/$work/caustics.pmp}
    whole=0
    while read -r pipe; do
        bytes=$(eval "$pipe -q --format csv" | sed -E 's/"([^"]|"")*"/x/g' | awk -F, '
            NR == 1 { for (i = 1; i <= NF; i++) if ($i == "bytes_fetched") at = i } NR == 2 { print $at }')
        whole=$((whole + bytes))
    done < <(sed 's/; /\n/g' <<< "$pipes")
    echo "${traffic[0]} ${traffic[1]} ${traffic[2]} $whole"
done > "$work/runs"

echo "runs,kept,below,above,off,width,bytes_fetched"
awk '
    # Half a byte: numbers are rounded.
    { n++; if ($4 < $2 - 0.5) below++; else if ($4 > $3 + 0.5) above++; else kept++ }
    { x = $1 / $4 - 1; off += x < 0 ? -x : x; width += ($3 - $2) / 2 / $4; whole += $4 }
    END { if (n) printf "%d,%d,%d,%d,%.4f,%.4f,%.0f\n", n, kept, below, above, off / n, width / n, whole / n; else print "0,0,0,0,,," }' "$work/runs"
