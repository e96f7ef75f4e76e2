#!/usr/bin/env bash
# Renders 240 frames as an array of 4 tasks on two nodes of a Slurm of its own, kills one node in the middle, and checks
# that Slurm requeues its tasks and that the frames are whole and equal to those of one process.
#   node_dies.sh REFLET FOLDER     REFLET: the program; FOLDER: empty, for everything that is written
# Needs slurmctld, slurmd, munged, and no root. Takes about 30 s, most of it Slurm's: a dead node is noticed after
# SlurmdTimeout, and a requeued task waits for cred_expire.
set -euo pipefail
reflet=$(realpath "$1")
dir=$(realpath "$2")
PATH=$PATH:/usr/sbin
export LP_NUM_THREADS=1 GALLIVM_PERF=${GALLIVM_PERF-nopt} # small frames: compiling shaders is most of a task's time

me=$(id -un)
host=$(hostname -s)
mkdir -p "$dir"/{state,run,n1,n2,frames,one}
chmod 700 "$dir/run"

daemons() { for pid in "$dir"/run/*.pid; do [[ ! -s "$pid" ]] || cat "$pid"; done; }
# The tasks of a node, and the daemon (slurmstepd) that watches over each, which is its parent. The environment says whose
# they are.
tasksOf() {
    local file pid parent
    for file in /proc/[0-9]*/environ; do
        pid=${file//[^0-9]/}
        if grep -qz "^SLURMD_NODENAME=$1\$" "$file" && grep -qz "^SLURM_CONF=$dir/" "$file"; then
            parent=$(sed -n 's/^PPid:[[:space:]]*//p' "/proc/$pid/status")
            ((parent <= 1)) || echo "$parent"
            echo "$pid"
        fi
    done 2>/dev/null || true
}
killAll() { for pid in "$@"; do kill -KILL "$pid" 2>/dev/null || true; done; }
finish() {
    local status=$?
    ((status == 0)) || tail -n 20 "$dir"/*.log "$dir"/said.* >&2 || true
    mapfile -t left < <(tasksOf n1; tasksOf n2; daemons)
    killAll "${left[@]}"
    exit "$status"
}
trap finish EXIT

# Ports that nobody listens on. Bash opens what begins with /dev/tcp itself.
port=$((20000 + $$ % 20000))
isFree() { ! (: >"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }
until isFree "$port" && isFree $((port + 1)) && isFree $((port + 2)); do port=$((port + 7)); done

dd if=/dev/urandom of="$dir/run/key" bs=128 count=1 status=none
chmod 600 "$dir/run/key"
munged --force --key-file="$dir/run/key" --socket="$dir/run/munge" --pid-file="$dir/run/munge.pid" \
    --log-file="$dir/munge.log" --seed-file="$dir/run/seed"

export SLURM_CONF=$dir/slurm.conf
cat >"$SLURM_CONF" <<CONF
ClusterName=two
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
AuthType=auth/munge
AuthInfo=socket=$dir/run/munge,cred_expire=5
CredType=cred/munge
SlurmUser=$me
SlurmdUser=$me
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/%n
SlurmctldPidFile=$dir/run/controller.pid
SlurmdPidFile=$dir/run/%n.pid
SlurmctldLogFile=$dir/controller.log
SlurmdLogFile=$dir/%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=2,batch_sched_delay=0,bf_interval=2
JobRequeue=1
ReturnToService=2
SlurmdTimeout=3
MessageTimeout=3
TCPTimeout=1
KillWait=2
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
slurmctld
slurmd -N n1
slurmd -N n2

waitFor() {  # seconds condition...
    local end=$((SECONDS + $1))
    shift
    until "$@"; do
        ((SECONDS < end)) || { echo "node_dies.sh: waited in vain for: $*" >&2; exit 1; }
        sleep 0.05
    done
}
bothIdle() { [[ $(sinfo -h -t idle -o %D 2>/dev/null) == 2 ]]; }
waitFor 20 bothIdle

sequence=(render builtin:cubes --preset plain --size 32x18 --frames 240 --path orbit --set materials.anisotropy=1)
cat >"$dir/job.sh" <<JOB
#!/bin/sh
echo "task \$SLURM_ARRAY_TASK_ID on \$SLURMD_NODENAME, restart \${SLURM_RESTART_COUNT-0}"
exec $(printf '%q ' "$reflet" "${sequence[@]}" -o "$dir/frames/a_####.png") --share auto
JOB
job=$(sbatch --parsable --array=0-3 --requeue --open-mode=append -o "$dir/said.%a" "$dir/job.sh")

# Meanwhile: the same by one process.
"$reflet" "${sequence[@]}" -o "$dir/one/a_####.png" &
one=$!

# The node dies when its task has written some of its 60 frames. Which task it has is in what the task says.
taskOnNode2() { task=$(sed -n 's/^task \([0-9]\) on n2, .*/\1/p' "$dir"/said.* 2>/dev/null | tail -n 1); [[ -n "$task" ]]; }
framesOf() { local i n=0; for ((i = $1; i < 240; i += 4)); do [[ ! -e $(printf '%s/frames/a_%04d.png' "$dir" "$i") ]] || n=$((n + 1)); done; echo "$n"; }
someFrames() { (($(framesOf "$task") >= 5)); }
waitFor 30 taskOnNode2
waitFor 30 someFrames
mapfile -t victims < <(cat "$dir/run/n2.pid"; tasksOf n2)
killAll "${victims[@]}"
rm -f "$dir/run/n2.pid"
had=$(framesOf "$task")
echo "node n2 killed (${#victims[@]} processes) when task $task had written $had of 60 frames"
((had < 60)) || { echo "node_dies.sh: the node died too late" >&2; exit 1; }

jobEnded() { [[ -z $(squeue -h -j "$job" 2>/dev/null) ]]; }
waitFor 90 jobEnded
wait "$one"

grep -h '^task' "$dir"/said.*
grep -q "^task $task on n1, restart 1\$" "$dir/said.$task" || { echo "node_dies.sh: task $task was not requeued" >&2; exit 1; }
count=$(find "$dir/frames" -name 'a_????.png' | wc -l)
((count == 240)) || { echo "node_dies.sh: $count of 240 frames" >&2; exit 1; }
for file in "$dir"/one/*; do
    cmp "$file" "$dir/frames/${file##*/}"
done
echo "240 frames, equal to those of one process"
