#!/bin/sh
# Prints what became of a job of Slurm: running, success or failed.
#
# usage: status.sh NUMBER
set -eu
if said=$(scontrol --oneliner show job "$1" 2>&1); then
  state=$(echo "$said" | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
elif echo "$said" | grep -q "Invalid job id"; then     # only accounting, where there is any, remembers it
  state=$(sacct --allocations --noheader --parsable2 --format=State --jobs="$1" 2>/dev/null) || state=
else
  state=UNKNOWN_YET     # the controller does not answer, and is asked again
fi
case $state in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | STOPPED | REQUEUED | REQUEUE_HOLD | RESIZING | SIGNALING | STAGE_OUT | UNKNOWN_YET)
    echo running ;;
  *) echo failed ;;
esac
