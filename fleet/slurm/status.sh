#!/bin/sh
# Prints what became of a job of Slurm: running, success or failed.
#
# usage: status.sh NUMBER     or done:NAME, where submit.sh found that it had ended before
set -eu

# Snakemake asks for one job after the other, and for hundreds that wait: the controller is asked for all of them, every few seconds.
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
elif said=$(scontrol --oneliner show job "$1" 2>&1); then     # begun since then
  state=$(echo "$said" | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
  name=$(echo "$said" | sed -n 's/.* JobName=\([^ ]*\).*/\1/p')
elif echo "$said" | grep -q "Invalid job id"; then     # only accounting, where there is any, remembers it
  state=$(sacct --allocations --noheader --parsable2 --format=State --jobs="$1" 2>/dev/null) || state=
else
  state=UNKNOWN_YET     # the controller does not answer, and is asked again
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
