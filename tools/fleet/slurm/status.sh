#!/bin/sh
# Prints the state of a Slurm job: running, success or failed.
#
# usage: status.sh NUMBER     or done:NAME, if submit.sh found that the job had ended before
set -eu

# Snakemake asks for each of hundreds of jobs separately. This script asks the controller for all jobs at once, every
# few seconds.
states=.snakemake/slurm/states
if [ -z "$(find "$states" -newermt '-5 seconds' 2>/dev/null)" ]; then
  squeue --me --noheader --states=all --format='%i %T %j' >"$states.new" 2>/dev/null && mv "$states.new" "$states" || rm -f "$states"
fi
name=
case $1 in
  done:*) state=COMPLETED name=${1#done:} ;;
  *)
    read -r state name <<END
$(sed -n "s/^$1 //p" "$states" 2>/dev/null)
END
    ;;
esac

if [ -n "$state" ]; then
  :
elif said=$(scontrol --oneliner show job "$1" 2>&1); then     # the job started after the last query
  state=$(echo "$said" | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
  name=$(echo "$said" | sed -n 's/.* JobName=\([^ ]*\).*/\1/p')
elif echo "$said" | grep -q "Invalid job id"; then     # only Slurm's accounting, if it exists, still knows the job
  state=$(sacct --allocations --noheader --parsable2 --format=State --jobs="$1" 2>/dev/null) || state=
else
  state=UNKNOWN_YET     # the controller does not answer; Snakemake asks again
fi
case $state in
  COMPLETED)
    [ -z "$name" ] || rm -f ".snakemake/slurm/done/$name" ".snakemake/slurm/done/$name.settings"
    echo success
    ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | STOPPED | REQUEUED | REQUEUE_HOLD | RESIZING | SIGNALING | STAGE_OUT | UNKNOWN_YET)
    echo running ;;
  *) echo failed ;;
esac
