#!/bin/sh
# properties = {properties}
# Runs a job on its node; submit.sh passes NAME SETTINGS OUTPUT. A replay runs directly with the command from the line
# above, because Snakemake takes seconds to start; only other jobs need Snakemake.
command=$(sed -n 's/^# properties = //p' "$0" | python3 -IS -c 'import json, sys; print(json.load(sys.stdin).get("params", dict()).get("command", ""))')
if [ -n "$command" ]; then
  kept=.snakemake/slurm/done/$1
  sh -c "$command" && cp "$3" "$kept" && echo "$2" > "$kept.settings"
  exit
fi
{exec_job}
