#!/usr/bin/env bash
# One point of a path tracer beside the recipes: the same columns as scripts/recipe-point.sh, for so many seconds of processor
# time (loading is not counted). MITSUBA is a Python that has Mitsuba 3.9.1.
#   scripts/pathtracer-point.sh OUT ROOM mitsuba-SECONDSs
set -euo pipefail
out=$1 room=$2 budget=${3#mitsuba-}
scene=scenes/$room.obj
[ -e "$scene" ] || scene=out/scenes/$room.obj
# Not the seeds that the references are of.
"${MITSUBA:?name a Python that has Mitsuba}" scripts/pathtracer.py "$scene" --size 64 --samples 4 --seconds "${budget%s}" --seed 4000 -o "$out.exr" > "$out.time"
pm-view -q "scripts/references/$room.exr" "$out.exr" --format csv > "$out.error"
cut -d , -f 1 "$out.time" | paste -d , - "$out.error"
rm "$out.time" "$out.error"
