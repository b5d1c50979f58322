#!/usr/bin/env bash
# Do all builds and all numbers of threads write the same bytes? Runs small pipes with the programs of each folder, with one, two and
# seven threads, and compares what they write. Prints a line for each folder, and names what differs.
#   scripts/same-bytes.sh PROGRAMS [PROGRAMS...]
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export RUST_BACKTRACE=0

# Everything that is written, in the folder where we are, with so many threads: maps, queries, orders, traces, pictures, tables.
write() { # threads
    local t=$1 map
    pm-photons -q -n 20000 -t "$t" -o map.pmp
    pm-photons -q -n 5000 --caustics -t "$t" -o caustics.pmp
    pm-photons -q -n 5000 --part 2/3 -t "$t" -o part.pmp
    pm-queries -q --size 32x32 --gathers 16 -t "$t" --base base.exr -o q.pmq
    pm-queries -q --size 32x32 --gathers 16 --order tiled --tile 8 -t "$t" -o tiled.pmq
    pm-queries -q --size 32x32 --irradiance-cache 0.1 -t "$t" -o cached.pmq
    pm-queries -q --size 32x32 --gathers 16 --guide map.pmp -t "$t" -o guided.pmq
    pm-reorder -q hilbert q.pmq -o hilbert.pmq
    pm-reorder -q hilbert --per batch tiled.pmq -o tiled-hilbert.pmq
    pm-reorder -q random q.pmq -o random.pmq
    pm-sample -q --every 500 --window 50 q.pmq -o windows.pmq
    for map in kd bucket-kd wide vvh block-hash; do
        pm-gather -q map.pmp q.pmq --map $map -k 20 -t "$t" -o $map.pmt
        pm-gather -q map.pmp hilbert.pmq --map $map -k 20 -t "$t" --no-trace --base base.exr --image $map.exr
    done
    pm-gather -q map.pmp cached.pmq -t "$t" --no-trace --image cached.exr --image cached.png
    pm-gather -q map.pmp windows.pmq -t "$t" -o windows.pmt
    pm-view -q --archive kd.pmt -o archive.pmt
    pm-cachesim -q --format csv kd.pmt >lru.csv
    pm-cachesim -q --format csv --curve kd.pmt >curve.csv
    pm-cachesim -q --format csv windows.pmt >windows.csv
}

first='' different=0
for folder in "$@"; do
    folder=$(realpath "$folder")
    for t in 1 2 7; do
        here=$work/now
        mkdir "$here"
        # No && between them: what fails ends all.
        (
            cd "$here"
            PATH="$folder:$PATH"
            write $t
            sha256sum ./* | sort -k 2
        ) >"$work/sums"
        rm -r "$here"
        if [ -z "$first" ]; then
            first="$folder, one thread"
            cp "$work/sums" "$work/first"
        elif ! odd=$(diff "$work/first" "$work/sums"); then
            different=1
            echo "$folder, $t threads: not as of $first: $(sed -n 's/^> [0-9a-f]* *\.\///p' <<<"$odd" | tr '\n' ' ')"
        fi
    done
    echo "$folder: $(wc -l <"$work/first") files with 1, 2 and 7 threads"
done
exit $different
