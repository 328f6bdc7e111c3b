#!/usr/bin/env bash
# Sweeps under a real Slurm of one node, with tasks that are killed, cancelled and out of time; --help says more.
set -euo pipefail

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=scripts/packages.sh
source "$source_dir/scripts/packages.sh"

steps() {
  cat <<END
Checks scripts/slurm/submit.sh and sweep.sbatch on Debian 12, as root, in some three minutes:
  1. installs the packages that are missing (${SLURM_PACKAGES[*]}),
  2. starts a Slurm of one node in a temporary folder, with ports, keys and sockets of its own,
  3. runs a sweep as a whole,
  4. runs it as an array of 4 tasks whose walltime is too short, so that they go into the queue again,
     kills clatter in one of them (SIGKILL) and cancels another one: the merge has to be cancelled,
  5. runs these two again, and the merge after them,
  6. compares the merged file with that of the whole run,
  7. stops Slurm and removes all that it wrote.
The program is build/release/apps/clatter/clatter, or what the variable CLATTER names.
END
}

usage() {
  echo "usage: scripts/slurm/check.sh"
  echo
  steps
}

case "${1-}" in
  "") ;;
  -h | --help) usage; exit 0 ;;
  *) echo "check.sh: unknown argument '$1'; try --help" >&2; exit 2 ;;
esac
[[ $(id -u) == 0 ]] || { echo "check.sh: Slurm's daemons need root here" >&2; exit 2; }
CLATTER=$(realpath -m -- "${CLATTER:-$source_dir/build/release/apps/clatter/clatter}")
[[ -x $CLATTER ]] || { echo "check.sh: $CLATTER is missing; scripts/test.sh builds it" >&2; exit 2; }
export CLATTER

steps
install_missing "${SLURM_PACKAGES[@]}"

folder=$(TMPDIR=/tmp mktemp -d)  # slurm.conf has no quotes for a blank in TMPDIR
daemons=()
began=$SECONDS

say() {
  printf '[%3d s] %s\n' "$((SECONDS - began))" "$*"
}

# Says what went wrong, with all that may explain it.
give_up() {
  local log
  say "WRONG: $*"
  for log in "$folder"/sweep/slurm-*.out "$folder"/*.log; do
    [[ -e $log ]] || continue
    echo "--- the end of $(basename "$log")"
    tail -n 15 "$log"
  done
  exit 1
}

stop_all() {
  local code=$? i daemon
  trap - EXIT
  if ((${#daemons[@]} > 2)); then  # else no job can run yet
    scancel --user=root 2>/dev/null || true
    for ((i = 0; i < 100; ++i)); do
      [[ -n $(squeue -h 2>/dev/null) ]] || break
      sleep 0.1
    done
  fi
  for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do
    daemon=${daemons[i]}
    kill "$daemon" 2>/dev/null || true
    wait "$daemon" 2>/dev/null || true
  done
  rm -rf "$folder"
  exit "$code"
}
trap stop_all EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# Waits for a condition, a command: SECONDS COMMAND [WORD]...
until_true() {
  local end=$((SECONDS + $1))
  shift
  until "$@" 2>/dev/null; do
    ((SECONDS < end)) || return 1
    sleep 0.1
  done
}

# munged wants its files in folders that nobody else can write to, and others have to reach its socket.
chmod 755 "$folder"
mkdir -m 700 "$folder/munge"
mkdir -m 755 "$folder/socket"
mkdir "$folder/state" "$folder/spool" "$folder/sweep"

free_port() {
  local port
  while true; do
    port=$((20000 + RANDOM % 12000))
    [[ $port != "${1-}" ]] && ! (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null && break
  done
  echo "$port"
}

controller_port=$(free_port)
node_port=$(free_port "$controller_port")
host=$(hostname -s)
export SLURM_CONF=$folder/slurm.conf
# cred_expire is also how long a task waits after a requeue. Two CPUs on any machine: two tasks run, two wait.
cat >"$SLURM_CONF" <<END
ClusterName=check
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$controller_port
SlurmdPort=$node_port
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$folder/socket/munge,cred_expire=5
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=2
ReturnToService=2
KillWait=10
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=check Nodes=$host Default=YES MaxTime=INFINITE State=UP
END

say "Starting Slurm $(slurmctld -V | cut -d' ' -f2) in $folder"
dd if=/dev/urandom of="$folder/munge/key" bs=128 count=1 status=none
chmod 600 "$folder/munge/key"
munged --foreground --key-file="$folder/munge/key" --socket="$folder/socket/munge" --pid-file="$folder/munge/pid" \
  --seed-file="$folder/munge/seed" --log-file="$folder/munge/log" 2>"$folder/munged.log" &
daemons+=($!)
until_true 10 test -S "$folder/socket/munge" || give_up "munged doesn't start"
slurmctld -D 2>/dev/null &
daemons+=($!)
slurmd -D -N "$host" 2>/dev/null &
daemons+=($!)
node_is_idle() { [[ $(sinfo -h -o %T) == idle ]]; }
until_true 30 node_is_idle || give_up "no node after 30 s: $(sinfo -h -o '%T %E' 2>&1)"

# Everything is simulated, though most of it could be left out: it is to take some time.
cd "$folder/sweep"
config="$folder/sweep/a map.toml"  # spaces are permitted, too
configure() {
  cat >"$config" <<END
[scene]
f = -1.0
h = 0.1
R = 0.7
[sweep]
nu = "linspace(0.5, 1.5, $1)"
xs = "linspace(0.2, 4, 120)"
[time]
max_periods = 500
[integrator]
effects = "all"
[observe]
extrema = true
period = true
stability = true
impact_log = true
END
}

# A short sweep tells how long the one has to be of which a shard takes $task seconds on one thread.
task=12 turn=4
configure 20
start=${EPOCHREALTIME//[.,]/}
"$CLATTER" run "$config" -o short.h5 --progress never --threads 1 -q
took=$((${EPOCHREALTIME//[.,]/} - start))
configure $((4 * task * 20 * 1000000 / took))
say "The whole run; 1/$((4 * task * 1000000 / took)) of it took $((took / 1000)) ms on one thread"
"$CLATTER" run "$config" -o whole.h5 --progress never

state() { scontrol show job "$1" -o 2>/dev/null | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p'; }
is_state() { [[ $(state "$1") == "$2" ]]; }
is_over() { [[ ! $(state "$1") =~ ^(PENDING|RUNNING|COMPLETING|CONFIGURING)$ ]]; }
clatter_of() { pgrep -f "run $config -o map.$1-of-4.h5"; }
has_saved() { [[ -s map.$1-of-4.h5.journal ]] && clatter_of "$1" >/dev/null; }
expect() { is_state "$1" "$2" || give_up "job $1 should be $2, not $(state "$1")"; }

# Submits and sets `array` and `merge` to the numbers of the jobs.
submit() {
  local said
  said=$("$source_dir/scripts/slurm/submit.sh" "$@") || give_up "submit.sh: exit code $?"
  say "submitted: ${said//$'\n'/; }"
  array=$(sed -n 's/^array: job //p' <<<"$said")
  merge=$(sed -n 's/^merge: job \([0-9]*\).*/\1/p' <<<"$said")
}

# A minute is the shortest walltime; most of it is kept, so that a task takes several turns.
say "An array of 4 tasks of some $task s, stopped after $turn s a turn"
MARGIN=$((60 - turn)) submit --time=1 4 "$config" -o map.h5
until_true 60 has_saved 1 || give_up "task 1 doesn't run"
sleep 1
kill -KILL "$(clatter_of 1)" || give_up "clatter of task 1 can't be killed"
say "killed clatter in task 1 (SIGKILL)"
until_true 200 has_saved 2 || give_up "task 2 doesn't run"
sleep 1
scancel "${array}_2"
say "cancelled task 2 (scancel)"
for k in 0 1 2 3; do
  until_true 300 is_over "${array}_$k" || give_up "task $k doesn't end"
  say "task $k: $(state "${array}_$k")"
done
expect "${array}_0" COMPLETED
expect "${array}_1" FAILED
expect "${array}_2" CANCELLED
expect "${array}_3" COMPLETED
for k in 0 3; do
  grep -q "goes into the queue again" "slurm-${array}_$k.out" || give_up "task $k was never out of time"
  say "task $k took $(grep -c ", turn " "slurm-${array}_$k.out") turns"
done
grep -q "clatter: terminated; " "slurm-${array}_2.out" || give_up "task 2 didn't save what was finished"
until_true 60 is_over "$merge" || give_up "the merge isn't cancelled"
expect "$merge" CANCELLED
[[ ! -e map.h5 ]] || give_up "something was merged"
say "merge: CANCELLED, as it has to be"

say "Tasks 1 and 2 again"
submit --array=1,2 4 "$config" -o map.h5
until_true 300 is_over "$merge" || give_up "the merge doesn't end"
expect "$merge" COMPLETED
for k in 1 2; do
  say "task $k: $(grep -o "goes on from .*" "slurm-${array}_$k.out" || give_up "task $k began anew")"
done
say "merge: COMPLETED"

cmp whole.h5 map.h5 || give_up "not the same bytes"
say "same bytes: $(stat -c %s map.h5) of them, $(sha256sum map.h5 | cut -c 1-16)"
