#!/usr/bin/env bash
# One point of traffic beside what the photon map loses: prints, as one row of CSV, what pm-cachesim found and what pm-gather reported.
#   scripts/reported-point.sh OUT PHOTONS QUERIES [options of pm-gather]
set -euo pipefail
out=$1
shift
trap 'rm -f "$out.traffic" "$out.report.csv"' EXIT
pm-gather -q "$@" --report "$out.report.csv" | pm-cachesim -q --format csv > "$out.traffic"
paste -d , "$out.traffic" <(cut -d , -f 5- "$out.report.csv" | sed -e s/reads_per_query/reads_reported/ -e s/lines_per_query/lines_reported/)
