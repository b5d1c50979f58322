#!/usr/bin/env bash
# One promise of pm-plan, held against the truth: plans a picture, runs what is to be pasted with fresh seeds, and prints, as one
# row of CSV, what was promised and how often it was kept.
#   scripts/plan-point.sh OUT SCENE ERROR RUNS REFERENCE [options of pm-plan]
# REFERENCE is a picture of the same scene and size by ten times the effort or more, with another seed. Where pm-plan refuses,
# `refused` says why, and nothing is run. Streams of the runs go to a folder beside OUT while they are needed.
set -euo pipefail
out=$1 scene=$2 wanted=$3 runs=$4 reference=$5
shift 5
columns=planned_error,planned_low,planned_high,planned_seconds,planning_seconds,samples,gathers,light_samples,photons,k,caustics
columns+=,runs,kept,true_error,worst_error,true_seconds,refused
work=$(mktemp -d "$out.XXXXXX")
trap 'rm -rf "$work"' EXIT
echo "$columns"
if ! pm-plan -q "$scene" --error "$wanted" --format csv "$@" > "$work/plan.csv" 2> "$work/why"; then
    grep -q '^pm-plan: refused\|^pm-plan: --error\|^pm-plan: --seconds\|^pm-plan: .*' "$work/why"
    reason=$(tr -d '",\n' < "$work/why")
    printf '%s,,,,,,,,,,0,0,,,,"%s"\n' "" "$reason"
    exit 0
fi
# A field by its name; only the first, the pipe, and the last are quoted.
field() {
    awk -v name="$1" -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) from_end = NF - i }
        NR == 2 { sub(/,"[^"]*"$/, ",x"); print $(NF - from_end) }' "$work/plan.csv"
}
pipe=$(awk 'NR == 2' "$work/plan.csv" | sed -E 's/^"?(pm-picture [^,"]*)"?,.*/\1/')
pipe=${pipe/--image plan.exr/--image "$work/run.exr"}
TIMEFORMAT='%U %S'
for seed in $(seq 1001 $((1000 + runs))); do
    { time eval "$pipe -q --seed $seed --keep '$work/streams'" 2>&3; } 3>&2 2> "$work/time"
    seconds=$(awk '{ print $1 + $2 }' "$work/time")
    error=$(pm-view -q "$reference" "$work/run.exr" --format csv | awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == "rel_mse") at = i } NR == 2 { print $at }')
    echo "$error $seconds"
    rm -rf "$work/streams"
done > "$work/runs"
planned=$(for name in error error_low error_high seconds planning_seconds samples gathers light_samples photons k caustics; do
    field $name
done | paste -sd,)
awk -v planned="$planned" -v wanted="${wanted%\%}" '
    { square += $1; seconds += $2; if ($1 > worst) worst = $1; if ($1 <= wanted * wanted / 1e4) kept++ }
    END { printf "%s,%d,%d,%.4f,%.4f,%.2f,\n", planned, NR, kept, sqrt(square / NR), sqrt(worst), seconds / NR }' "$work/runs"
