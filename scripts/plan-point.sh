#!/usr/bin/env bash
# One promise of pm-plan, held against the truth: plans a picture, runs what is to be pasted with fresh seeds, and prints, as one
# row of CSV, what was promised and how often it was kept.
#   scripts/plan-point.sh OUT ROOM ERROR RUNS REFERENCE [options of pm-plan]
# ROOM is a scene of scenes/ or out/scenes/. Where pm-plan refuses (exit code 4), `refused` says why, and nothing is run; whatever
# else goes wrong is an error here too. Streams of the runs are in a folder beside OUT while they are needed.
set -euo pipefail
out=$1 room=$2 wanted=$3 runs=$4 reference=$5
shift 5
. "${0%/*}/room.sh"
. "${0%/*}/plan-row.sh"
mkdir -p "$(dirname "$out")"
work=$(mktemp -d "$out.XXXXXX")
trap 'rm -rf "$work"' EXIT

promised=error,error_low,error_high,seconds,planning_seconds,samples,gathers,light_samples,photons,k,caustics
columns="planned_$(echo "$promised" | sed 's/,/,planned_/g')"
columns="${columns//planned_planning/planning},runs,kept,true_error,worst_error,true_seconds,refused"
code=0
pm-plan -q "${load[@]}" --error "$wanted" --format csv "$@" > "$work/plan.csv" 2> "$work/why" || code=$?
if [ $code = 4 ]; then
    echo "$columns"
    echo "$(echo "$promised" | sed 's/[^,]//g'),0,0,,,,\"$(tr -d '"\n' < "$work/why")\""
    exit
elif [ $code != 0 ]; then
    cat "$work/why" >&2
    exit $code
fi

pipe=$(planned_pipe "$work/plan.csv")
pipe=${pipe/--image plan.exr/--image "$work/run.exr"}
TIMEFORMAT='%U %S'
for seed in $(seq 1001 $((1000 + runs))); do
    { time eval "$pipe -q --seed $seed --keep $work/streams" 2>&3; } 3>&2 2> "$work/time"
    error=$(pm-view -q "$reference" "$work/run.exr" --format csv | awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == "rel_mse") at = i } NR == 2 { print $at }')
    echo "$error $(awk '{ print $1 + $2 }' "$work/time")"
    rm -r "$work/streams"
done > "$work/runs"

echo "$columns"
awk -v planned="$(planned "$work/plan.csv" "$promised")" -v wanted="${wanted%\%}" '
    { square += $1; seconds += $2; if ($1 > worst) worst = $1; if ($1 <= wanted * wanted / 1e4) kept++ }
    END { printf "%s,%d,%d,%.4f,%.4f,%.2f,\n", planned, NR, kept, sqrt(square / NR), sqrt(worst), seconds / NR }' "$work/runs"
