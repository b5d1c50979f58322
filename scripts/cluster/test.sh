#!/usr/bin/env bash
# with-slurm.sh test.sh: a sweep on a private Slurm of two nodes gives the bytes of a local run, loses only what was cancelled
# or died, and a rerun makes only what is missing. In a folder of its own, whose Makefile, scenes and programs are the repository's.
set -euo pipefail
trap 'echo "not ok: line $LINENO: $BASH_COMMAND" >&2' ERR
n=0
ok() { n=$((n + 1)); echo "ok $n - $*"; }
# `set -e` does not look at what stands behind `!`.
fails() { if "$@"; then echo "not ok: should have failed: $*" >&2; exit 1; fi; }
root=$PWD folder=out/cluster
rm -rf "$folder"
mkdir -p "$folder"
cp -pr Makefile scenes scripts "$folder"
ln -s "$root/target" "$folder/target"
cd "$folder"
points=scripts/cluster/points.csv row=out/points/hilbert.64.csv
sweep() { make -s CARGO=true SWEEP=$points "$@" sweep; }
step="srun -Q -i none --exact -N1 -n1 -c1"

sweep -j2 > /dev/null
cp out/points.csv local.csv
[ "$(wc -l < local.csv)" = 21 ]
rm -rf out
salloc -Q -n16 -t 5 make -s CARGO=true SWEEP=$points -kj16 LAUNCH="$step" sweep > /dev/null
cmp out/points.csv local.csv
ok "twenty points on two nodes: the bytes of a local run"

rm $row out/points.csv
fails sweep LAUNCH=true > /dev/null 2> error.log
[ ! -e $row ]
grep -q "$row" error.log
ok "a launcher that did nothing and said 0 is a failure, and the row is named"

SLOW=60 salloc -Q -n1 -t 5 make -s CARGO=true SWEEP=$points LAUNCH="$step scripts/cluster/slow.sh" sweep > error.log 2>&1 &
job=$!
until running=$(squeue -h -s -o %i | grep '\.[0-9]'); do sleep 0.1; done
sleep 1
scancel "$running"
fails wait $job
[ ! -e $row ]
[ ! -e out/points.csv ]
ok "a cancelled step is a failure: no row, no table, exit 2"

salloc -Q -n16 -t 5 make CARGO=true SWEEP=$points -kj16 LAUNCH="$step" sweep > again.log
[ "$(grep -c '^srun' again.log)" = 1 ]
cmp out/points.csv local.csv
ok "run again, that row alone is made, and the table is equal"

# The pids of munged, slurmctld and the two nodes. What runs on a node dies with it.
read -r -a daemons <<< "$SLURM_TEST_PIDS"
rm -rf out/points out/points.csv
SLOW=6 salloc -Q -n8 -N2 -t 5 make -s CARGO=true SWEEP=$points -kj8 LAUNCH="$step scripts/cluster/slow.sh" sweep > error.log 2>&1 &
job=$!
until [ "$(squeue -h -s -o %i | grep -c '\.[0-9]')" -ge 8 ]; do sleep 0.1; done
victims=$(ps -eo pid,args | awk '/slurmstepd.*\[/ && !/awk/ {print $1}' | while read -r pid; do
    tr '\0' '\n' 2>/dev/null < "/proc/$pid/environ" | grep -qx 'SLURMD_NODENAME=n2' && echo "$pid" || true
done)
kill -9 "${daemons[3]}" $victims 2>/dev/null || true
fails wait $job
ok "a node dies: make says that rows are missing"

made=$(find out/points -name "*.csv" | wc -l)
[ "$made" -lt 20 ]
salloc -Q -N1 -n8 -t 5 -w n1 make -s CARGO=true SWEEP=$points -kj8 LAUNCH="$step" sweep > /dev/null
cmp out/points.csv local.csv
ok "run again on the other node ($made rows were there): the bytes of a local run"
cd "$root"
rm -rf "$folder"
echo "$n passed, 0 failed"
