#!/usr/bin/env bash
# A sweep in shards on a Slurm cluster, from one command; --help says more.
set -euo pipefail

slurm_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

usage() {
  cat <<'END'
usage: scripts/slurm/submit.sh [OPTION of sbatch]... N CONFIG [-o FILE.h5] [OPTION of clatter run]...

Submits a sweep in N shards as a job array, and a job that merges them into FILE.h5 when all are done; FILE is the
configuration's name unless -o names it. scripts/slurm/sweep.sbatch --help says what the tasks do. Options of sbatch,
in one word each, apply to both jobs, except these:
  --array=2,5      computes these shards only, after they failed, and merges all N
  --dependency=... applies to the array only
For example: scripts/slurm/submit.sh --time=2:00:00 --cpus-per-task=4 8 configs/map_nu_xs.toml -o map.h5
END
}

refuse() {
  echo "submit.sh: $*" >&2
  exit 2
}

array="" both=() array_only=()
while (($# > 0)); do
  case "$1" in
    -h | --help) usage; exit 0 ;;
    --array=*) array=${1#*=} ;;
    -a?*) array=${1#-a} ;;
    --dependency=* | -d?*) array_only+=("$1") ;;
    --[a-z]* | -[A-Za-z]?*) both+=("$1") ;;
    *) break ;;
  esac
  shift
done
[[ ${1-} =~ ^[1-9][0-9]{0,8}$ ]] ||
  refuse "'${1-}' is no number of shards (an option of sbatch is one word here: --time=10); try --help"
(($# > 1)) || refuse "the configuration is missing; try --help"
shards=$1
shift
[[ -f $1 ]] || refuse "'$1' is no file; the configuration follows the number of shards"

# Mistakes that a task would refuse are better reported now than in its log.
"$slurm_dir/sweep.sbatch" --check "$@"

job=$(sbatch --parsable --array="${array:-0-$((shards - 1))}" "${both[@]}" "${array_only[@]}" \
  "$slurm_dir/sweep.sbatch" --shards "$shards" "$@")
job=${job%%;*}
echo "array: job $job"
# A task that fails can't become done any more: without kill-on-invalid-dep the merge would stay in the queue for ever.
merge=$(sbatch --parsable --dependency="afterok:$job" --kill-on-invalid-dep=yes "${both[@]}" \
  "$slurm_dir/sweep.sbatch" --merge --shards "$shards" "$@") || {
  echo "submit.sh: the array is submitted, the merge isn't" >&2
  exit 1
}
echo "merge: job ${merge%%;*}, after the array"
