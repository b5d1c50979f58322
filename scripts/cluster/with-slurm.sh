#!/usr/bin/env bash
# with-slurm COMMAND...: run COMMAND against a private two-node Slurm on this machine.
# Loopback only; no /etc/slurm, systemd or cgroups. Everything lives in one temporary
# folder, and is stopped by pid and removed when COMMAND ends.
# Needs: apt-get install --no-install-recommends slurmctld slurmd slurm-client munge
set -uo pipefail
PATH=$PATH:/usr/sbin
getent hosts "$(hostname)" > /dev/null || { echo "with-slurm: this host's name has to resolve: see /etc/hosts" >&2; exit 1; }
d=$(mktemp -d /tmp/slurm.XXXXXX); chmod 755 "$d"    # munged wants its folder open to all
me=$(id -un) port=${SLURM_TEST_PORT:-16817} cpus=${SLURM_TEST_CPUS:-16} pids=()

start() { "$@" > "$d/${#pids[@]}.log" 2>&1 < /dev/null & pids+=($!); }
await() { local end=$((SECONDS + 20))
  until "$@"; do
    ((SECONDS < end)) && kill -0 "${pids[@]}" 2>/dev/null && sleep 0.1 && continue
    echo "with-slurm: gave up waiting for: $*" >&2; tail -n 5 "$d"/*.log >&2; exit 1
  done; }
idle()  { [ "$(timeout 2 sinfo -h -N -o %t 2>/dev/null | grep -c '^idle$')" = 2 ]; }
empty() { [ -z "$(timeout 2 squeue -h 2>&1)" ]; }
stop() {
  rc=$?; trap - EXIT INT TERM
  if [ -e "$d/up" ]; then               # slurmd leaves running steps alone, so end the jobs first
    timeout 5 scancel -Q -u "$me"; for _ in {1..50}; do empty && break; sleep 0.1; done
  fi
  kill "${pids[@]}" 2>/dev/null
  for _ in {1..50}; do kill -0 "${pids[@]}" 2>/dev/null || break; sleep 0.1; done
  kill -9 "${pids[@]}" 2>/dev/null; wait "${pids[@]}" 2>/dev/null
  rm -rf "$d"; exit $rc
}
trap stop EXIT; trap 'exit 130' INT; trap 'exit 143' TERM

mkdir "$d/state" "$d/n1" "$d/n2"
(umask 077; head -c 64 /dev/urandom > "$d/munge.key")
cat > "$d/slurm.conf" <<CONF
ClusterName=here
SlurmctldHost=localhost
SlurmctldPort=$port
SlurmUser=$me
SlurmdUser=$me
AuthType=auth/munge
AuthInfo=socket=$d/munge.sock
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
StateSaveLocation=$d/state
SlurmdSpoolDir=$d/%n
SlurmctldPidFile=$d/slurmctld.pid
SlurmdPidFile=$d/%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=10
KillWait=2
MailProg=/bin/true
NodeName=n[1-2] NodeAddr=127.0.0.1 Port=[$((port + 1))-$((port + 2))] CPUs=$cpus RealMemory=1000
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE
CONF
export SLURM_CONF=$d/slurm.conf

start munged -F --num-threads=10 --key-file="$d/munge.key" --socket="$d/munge.sock" \
      --pid-file="$d/munged.pid" --log-file="$d/munged.log" --seed-file="$d/munged.seed"
await test -S "$d/munge.sock"
start slurmctld -D -f "$SLURM_CONF"
for n in n1 n2; do start slurmd -D -N $n -f "$SLURM_CONF"; done    # absolute: jobs inherit it
await idle; touch "$d/up"
export SLURM_TEST_PIDS="${pids[*]}"     # munged slurmctld n1 n2, for tests that kill one
"$@"
