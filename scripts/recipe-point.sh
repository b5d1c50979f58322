#!/usr/bin/env bash
# One point of error against time: makes a picture by pm-picture, and prints, as one row of CSV, the seconds of processor time
# that all its programs take together, and how far the picture is from a reference.
#   scripts/recipe-point.sh OUT ROOM [options of pm-picture]
# ROOM is a scene of scenes/ or out/scenes/ whose reference is scripts/references/ROOM.exr; lamps and their mirror images are NaN
# there, and are not compared. One thread, 64 x 64 pixels.
set -euo pipefail
out=$1 room=$2
shift 2
. "${0%/*}/room.sh"
TIMEFORMAT='%U %S'
mkdir -p "$out.streams"
{ time pm-picture -q "${load[@]}" --size 64x64 "$@" --keep "$out.streams" --image "$out.exr" 2>&3; } 3>&2 2> "$out.time"
rm -r "$out.streams"
pm-view -q "scripts/references/$room.exr" "$out.exr" --format csv > "$out.error"
{
    echo seconds
    awk '{ printf "%.2f\n", $1 + $2 }' "$out.time"
} | paste -d , - "$out.error"
rm "$out.time" "$out.error"
