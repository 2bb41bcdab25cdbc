#!/bin/sh
# properties = {properties}
# A job on its node, called NAME SETTINGS OUTPUT by submit.sh. Snakemake takes seconds to start there, and knows nothing of a replay that is
# not written above; only other jobs want it.
command=$(sed -n 's/^# properties = //p' "$0" | python3 -IS -c 'import json, sys; print(json.load(sys.stdin).get("params", dict()).get("command", ""))')
if [ -n "$command" ]; then
  kept=.snakemake/slurm/done/$1
  sh -c "$command" && cp "$3" "$kept" && echo "$2" > "$kept.settings"
  exit
fi
{exec_job}
