#!/bin/sh
# Adds windows of a stream until fetches per query are known as well as asked, and prints one row of CSV.
#
#   scripts/until.sh --until 1% --queries '--size 512x512' --window 100 --warm-up 32 --gather out/full/map.pmp
#   scripts/until.sh --pilot 51 --queries '--size 512x512 --order tiled' --reorder 'hilbert --per batch' --gather map.pmp
#
# --until P%        half the width of the 95 % interval, in percent of the value; without it the pilot is all
# --pilot N         windows to begin with [400]
# --most N          no more windows than so many
# --seed N          which windows are chosen [0]
# --window RAYS     rays of a window; without it, whole batches (tiles or scanlines)
# --warm-up RAYS    rays before each window that fill the cache [64]
# --queries, --reorder, --gather, --cachesim 'OPTIONS'   options of these programs; without --reorder there is no pm-reorder
# --quiet           tell nothing on the way
#
# First a pilot, then as many more windows as its spread says are missing (Stein 1945; SMARTS, ISCA 2003), chosen by another
# seed, and so on; until.awk puts them together. What is chosen never depends on what was found but by its number.
# BIN is the folder of the programs [target/release].

set -eu

BIN=${BIN:-target/release}
here=$(dirname "$0")
until='' pilot=400 most='' seed=0 window='' warm_up=64 queries='' reorder='' gather='' cachesim='' quiet=''

fail() { echo "until.sh: $1" >&2; exit 2; }

while [ $# -gt 0 ]; do
    option=$1
    [ "$option" = --quiet ] && { quiet=yes; shift; continue; }
    case $option in --until|--pilot|--most|--seed|--window|--warm-up|--queries|--reorder|--gather|--cachesim) ;;
        *) fail "$option: there are --until, --pilot, --most, --seed, --window, --warm-up, --queries, --reorder, --gather, --cachesim, --quiet" ;;
    esac
    [ $# -ge 2 ] || fail "$option: a value is expected"
    case $option in
        --until) until=$(echo "$2" | awk '/^[0-9.]+%$/ && $0 + 0 > 0 { print ($0 + 0) / 100 }')
            [ -n "$until" ] || fail "--until $2: percent are expected, such as 1%" ;;
        --pilot) pilot=$2 ;;
        --most) most=$2 ;;
        --seed) seed=$2 ;;
        --window) window=$2 ;;
        --warm-up) warm_up=$2 ;;
        --queries) queries=$2 ;;
        --reorder) reorder=$2 ;;
        --gather) gather=$2 ;;
        --cachesim) cachesim=$2 ;;
    esac
    shift 2
done
for number in "$pilot" "${most:-1}" "$seed"; do
    case $number in ''|*[!0-9]*) fail "$number: a whole number is expected" ;; esac
done

rows=$(mktemp -d)
trap 'rm -rf "$rows"' EXIT
trap 'exit 1' HUP INT TERM

# A round: so many windows, by a seed of its own. The options are words, so they are not quoted.
round() {
    set -- "$1" "$2" --only-tiles "$1" --sample-seed "$(awk -v s="$seed" -v r="$2" 'BEGIN { printf "%.0f", s * 1000 + r }')"
    number=$2
    shift 2
    [ -z "$window" ] || set -- "$@" --window "$window" --warm-up "$warm_up"
    "$BIN/pm-queries" -q $queries "$@" | if [ -n "$reorder" ]; then "$BIN/pm-reorder" -q $reorder; else cat; fi |
        "$BIN/pm-gather" -q $gather | "$BIN/pm-cachesim" -q --format csv $cachesim > "$rows/$number.csv"
}

windows=0 missing=$pilot rounds=0
while [ "$missing" -gt 0 ]; do
    if [ -n "$most" ] && [ $((windows + missing)) -gt "$most" ]; then
        missing=$((most - windows))
        [ "$missing" -gt 0 ] || break
    fi
    round "$missing" "$((100 + rounds))"
    windows=$((windows + missing)) rounds=$((rounds + 1))
    [ -n "$quiet" ] || awk -v people=1 -f "$here/csv.awk" -f "$here/until.awk" "$rows"/*.csv >&2
    missing=0
    [ -z "$until" ] || missing=$(awk -v until="$until" -f "$here/csv.awk" -f "$here/until.awk" "$rows"/*.csv)
    if [ "$missing" = doubt ]; then
        echo "until.sh: too much is in doubt for --until: longer --warm-up, or longer windows, fill the cache" >&2
        missing=0
    fi
done
awk -f "$here/csv.awk" -f "$here/until.awk" "$rows"/*.csv
