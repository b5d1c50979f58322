#!/usr/bin/env bash
# What a machine can do to the programs: kills, full disks, refused memory and threads, two makes, folders of others. Prints a
# line for each kind, and fails if anything looks whole that is not, or ends otherwise than by one line and an exit code.
#   scripts/faults.sh PROGRAMS [KILLS]
set -uo pipefail
bin=$(realpath "$1") kills=${2:-200} root=$(realpath "$(dirname "$0")/..")
work=$(mktemp -d) wrong=0
trap 'rm -rf "$work"' EXIT
export PATH="$bin:$PATH" RUST_BACKTRACE=0
cd "$work" && chmod 755 .

tell() { printf '%-10s %s\n' "$1" "$2"; }
blame() { wrong=$((wrong + 1)); echo "  wrong: $*"; }

# One line on standard error that begins with the name of a program, exit 1, and nothing left behind; or all is well.
judge() { # name, exit code, file of standard error, names before
    case $2 in
    0 | 1) ;;
    *) blame "$1: exit $2: $(head -c 300 "$3")" ;;
    esac
    if [ "$2" = 1 ]; then
        refused=$((refused + 1))
        [ "$(wc -l <"$3")" = 1 ] && grep -q '^pm-' "$3" || blame "$1: $(head -c 300 "$3")"
        [ "$(ls -A)" = "$4" ] || blame "$1: leaves $(ls -A | tr '\n' ' ')"
    fi
}

pm-photons -n 20000 -o map.pmp
pm-queries --size 64x64 --gathers 16 -o q.pmq
pm-gather map.pmp q.pmq -o t.pmt
pm-queries --size 64x64 --gathers 16 --part 1/2 -o p1.pmq
pm-queries --size 64x64 --gathers 16 --part 2/2 -o p2.pmq
table=$(pm-cachesim t.pmt)
programs=(
    "pm-photons -n 50000" "pm-queries --size 64x64 --gathers 16" "pm-queries --size 64x64 --irradiance-cache 0.1"
    "pm-reorder hilbert q.pmq" "pm-reorder random q.pmq" "pm-sample --every 1000 --window 100 q.pmq" "pm-gather map.pmp q.pmq"
    "pm-gather map.pmp q.pmq --map wide" "pm-cachesim t.pmt --format csv" "pm-cachesim t.pmt --curve" "pm-view q.pmq"
    "pm-view --merge p1.pmq p2.pmq" "pm-view --archive t.pmt" "pm-view --export din t.pmt"
)

# A stage of a pipe killed at any moment: there is no table, or the right one.
RANDOM=1 whole=0 none=0
for ((i = 0; i < kills; i++)); do
    rm -f a b c
    mkfifo a b c
    pm-queries --size 64x64 --gathers 16 -q >a 2>/dev/null & one=$!
    pm-reorder hilbert -q <a >b 2>/dev/null & two=$!
    pm-gather -q map.pmp <b >c 2>/dev/null & three=$!
    pm-cachesim -q <c >out 2>/dev/null & four=$!
    stages=($one $two $three $four)
    sleep "0.$(printf '%03d' $((RANDOM % 700)))"
    kill -9 "${stages[RANDOM % 4]}" 2>/dev/null
    wait "$four"; code=$?
    wait "$one" "$two" "$three" 2>/dev/null
    if [ -s out ]; then
        # Its history tells pipes from files; the numbers are the same.
        [ "$(pm-cachesim <(pm-queries --size 64x64 --gathers 16 -q | pm-reorder hilbert -q | pm-gather -q map.pmp))" = "$(cat out)" ] || blame "kill $i: another table"
        whole=$((whole + 1))
    else
        [ $code != 0 ] || blame "kill $i: exit 0 without a table"
        none=$((none + 1))
    fi
done 2>/dev/null
rm -f a b c out
tell kills "$kills: $none without a table, $whole whole"

# A full disk.
names=$(ls -A) refused=0
for line in "${programs[@]}"; do
    $line >/dev/full 2>/tmp/faults.$$; code=$?
    [ $code = 1 ] || blame "full disk, $line: exit $code"
    judge "full disk, $line" $code /tmp/faults.$$ "$names"
done
tell full "${#programs[@]}: $refused refused"

# Refused memory: from too little to begin with up to enough; threads take addresses for much more than they need.
refused=0 tried=0
for line in "${programs[@]}" "pm-photons -n 200000 -t 8" "pm-queries --size 64x64 --gathers 16 -t 8" "pm-gather map.pmp q.pmq -t 8"; do
    for megabytes in 8 10 12 14 16 18 20 22 24 28 32 40 48 64 80 96 128 160 256 400; do
        { (ulimit -v $((megabytes * 1024)) && exec $line >/dev/null 2>/tmp/faults.$$); code=$?; } 2>/dev/null
        # The system could not even load the program.
        [ $code = 127 ] && continue
        [ $code = 139 ] && { (ulimit -v $((megabytes * 1024)) && exec ${line%% *} -V &>/dev/null); code=$?; } 2>/dev/null && [ $code = 139 ] && continue
        tried=$((tried + 1))
        judge "$megabytes MB, $line" $code /tmp/faults.$$ "$names"
    done
done
tell memory "$tried: $refused refused in a line"

# Refused threads, as somebody whose processes are counted; and a folder that is not theirs.
if [ "$(id -u)" = 0 ] && command -v setpriv >/dev/null && chmod -R a+rX . 2>/dev/null && setpriv --reuid=65534 --clear-groups test -x "$bin/pm-view"; then
    refused=0
    other() { setpriv --reuid=65534 --regid=65534 --clear-groups bash -c "$1"; }
    for limit in 1 2 3; do
        for line in "pm-photons -n 20000 -t 8" "pm-queries --size 32x32 -t 8" "pm-gather map.pmp q.pmq -t 8"; do
            other "ulimit -u $limit; exec $line" >threads.out 2>/tmp/faults.$$; code=$?
            judge "$limit threads, $line" $code /tmp/faults.$$ "$(ls -A)"
            [ $code = 0 ] && { cmp -s threads.out <(${line% -t 8}) || blame "$limit threads, $line: another stream"; }
        done
    done
    rm -f threads.out
    tell threads "9: $refused refused"
    refused=0
    mkdir locked
    for line in "pm-photons -n 100 -o locked/x" "pm-queries --size 8x8 -o locked/x" "pm-view --merge p1.pmq p2.pmq -o locked/x"; do
        other "exec $line" 2>/tmp/faults.$$; code=$?
        judge "folder of others, $line" $code /tmp/faults.$$ "$(ls -A)"
        [ $code = 1 ] && [ -z "$(ls -A locked)" ] || blame "folder of others, $line: exit $code"
    done
    rmdir locked
    tell folders "3: $refused refused"
else
    tell threads "not tried: needs root, setpriv, and programs that others may run"
fi

# Two makes at once in one folder.
mkdir makes && cp -r "$root/Makefile" "$root/scripts" "$root/scenes" makes && mkdir makes/target && ln -s "$bin" makes/target/release
for folder in formats tools Cargo.toml Cargo.lock; do ln -s "$root/$folder" makes/; done
goal=(make -s -C makes CARGO=true SIZE=16x16 GATHERS=4 PHOTONS=2000 run)
"${goal[@]}" >first 2>second & one=$!
"${goal[@]}" >third 2>fourth; two=$?
wait $one; one=$?
alone=$(rm -rf makes/out && "${goal[@]}" 2>/dev/null)
[ -n "$alone" ] || blame "a make alone prints nothing"
for pair in "$one first second" "$two third fourth"; do
    read -r code out err <<<"$pair"
    if [ "$code" = 0 ]; then [ "$(cat "$out")" = "$alone" ] || blame "two makes: another table"; else
        grep -q 'has\|hold' "$err" || blame "two makes: $(head -c 300 "$err")"; fi
done
tell makes "exit codes $one and $two"

rm -f /tmp/faults.$$
[ $wrong = 0 ] || { echo "$wrong wrong"; exit 1; }
